"""Rule statements: what is stated, judged; and its views: claims, ledger, figure numbers."""

from _helpers import job

with job(snakemake):
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.statements import beyond, numbers, paper, views
    from gelpump.statements.statement import Evidence
    from gelpump.text import write_json, write_text
    from gelpump.truth import record

    params, output = snakemake.params, snakemake.output
    gels = {name: from_config(name, block) for name, block in params.gels.items()}
    gels["tube"] = gels[params.tube["gel"]]
    evidence = Evidence(
        data=netcdf.read_all(snakemake.input.data, "results/data")
        | record.read(snakemake.input.truth),
        gels=gels,
        cases=params.beads,
        tube=params.tube,
        scales=params.scales,
        published=params.published,
    )
    claims = list(paper.statements.records(evidence))
    ledger = views.ledger(claims)
    further = list(beyond.statements.records(evidence))
    shown = list(numbers.key_numbers(evidence.data, gels, params))
    for records, file in (
        (claims, output.claims),
        (ledger, output.ledger),
        (shown, output.figure_numbers),
        (further, output.beyond),
    ):
        write_json(records, file)
    texts = (
        views.claims(claims),
        views.ledger_table(ledger),
        numbers.markdown(shown),
        views.beyond(further),
    )
    for text, file in zip(texts, output.tables, strict=True):
        write_text(text, file)
    print(views.headline(claims))
