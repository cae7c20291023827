"""Rule claims: what we find of each statement of the paper, judged."""

from _helpers import job

with job(snakemake):
    from gelpump import netcdf
    from gelpump.claims import beads, figure_numbers, materials, table, tubes
    from gelpump.claims.verdict import judged
    from gelpump.materials import from_config
    from gelpump.text import write_json, write_text

    params = snakemake.params
    data = netcdf.read_all(snakemake.input.data, "results/data")
    gels = {name: from_config(name, block) for name, block in params.gels.items()}
    drawn = {name: from_config(name, block) for name, block in params.drawn_gels.items()}
    findings = [
        *materials.findings(data, gels),
        *beads.findings(data, params.cases),
        *tubes.findings(data, params.scales),
    ]
    claims = [judged(finding, params.published.get(finding.id)) for finding in findings]
    write_json(claims, snakemake.output.json)
    write_text(table.markdown(claims), snakemake.output.md)
    numbers = [each.record() for each in figure_numbers.key_numbers(data, drawn, params.shown)]
    write_json(numbers, snakemake.output.numbers)
    write_text(figure_numbers.markdown(numbers), snakemake.output.numbers_md)
    print(table.counts(claims))
