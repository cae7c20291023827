"""Rule water_budget: where the water of the collapsing tubes goes."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.tube import budget

    netcdf.write(
        budget.water_budget(netcdf.read(snakemake.input.pulse)),
        snakemake.output[0],
        title="water shed by collapsing tubes",
        parameters={},
        provenance=provenance,
    )
