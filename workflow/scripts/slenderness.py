"""Rule slenderness: each closure of the slender tube against the two-dimensional one."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.truth import slenderness

    netcdf.write(
        slenderness.slenderness(
            netcdf.read(snakemake.input.pulses),
            netcdf.read(snakemake.input.walls),
            from_config("tube", snakemake.params.gel),
        ),
        snakemake.output[0],
        title="how good the slender tube is",
        parameters={"gel": snakemake.params.gel},
        provenance=provenance,
    )
