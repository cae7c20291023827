"""Rule truth_statements: what the two-dimensional tube says, judged."""

from _helpers import job

with job(snakemake):
    from gelpump import netcdf
    from gelpump.statements import truth, views
    from gelpump.statements.statement import Evidence
    from gelpump.text import write_json, write_text

    data = netcdf.read_all(snakemake.input.data, "results")
    evidence = Evidence(data=data, gels={}, cases={}, tube={}, scales={}, published={})
    records = list(truth.statements.records(evidence))
    write_json(records, snakemake.output.records)
    write_text(views.beyond(records), snakemake.output.table)
