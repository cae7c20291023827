"""Rule truth_walls: walls heated everywhere, resolved in the radius."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.truth import walls

    settings = snakemake.params.settings
    netcdf.write(
        walls.collapse_times(
            from_config("tube", snakemake.params.gel),
            settings["ell"],
            settings["M"],
            **settings["walls"],
        ),
        snakemake.output[0],
        title="walls heated everywhere, resolved in the radius",
        parameters={"gel": snakemake.params.gel, "truth": settings},
        provenance=provenance,
    )
