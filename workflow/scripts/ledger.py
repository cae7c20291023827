"""Rule ledger: where the paper disagrees with itself or with what follows from its equations."""

from _helpers import job

with job(snakemake):
    from gelpump import netcdf
    from gelpump.ledger import beads, materials, table, tubes
    from gelpump.materials import from_config
    from gelpump.text import write_json, write_text

    params = snakemake.params
    data = netcdf.read_all(snakemake.input.data, "results/data")
    gels = {name: from_config(name, block) for name, block in params.gels.items()}
    entries = [
        *materials.entries(data, gels, params.published),
        *beads.entries(data, gels, params.cases, params.published),
        *tubes.entries(data, params.tube, params.scales, params.published),
    ]
    records = [entry.record() for entry in entries]
    write_json(records, snakemake.output.json)
    write_text(table.markdown(records), snakemake.output.md)
