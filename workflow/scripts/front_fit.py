"""Rule front_fit: how sharp the drying front is, and how that scales with the wall."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.tube import front_fit

    settings = snakemake.params.settings
    netcdf.write(
        front_fit.front_fit(
            netcdf.read(snakemake.input.pulse), netcdf.read(snakemake.input.refinement), settings
        ),
        snakemake.output[0],
        title="sharpness of the drying front",
        parameters={"front_fit": settings},
        provenance=provenance,
    )
