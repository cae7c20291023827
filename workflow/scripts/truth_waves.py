"""Rule truth_waves: the front that has travelled, in two dimensions."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.truth import production

    settings = snakemake.params.settings
    waves = production.waves(
        from_config("tube", snakemake.params.gel),
        settings["ell"],
        settings["waves"]["Pe"],
        settings["waves"]["cells"],
    )
    others = production.other_gels(
        snakemake.params.gel,
        settings["M"],
        **settings["verified"],
        cells=settings["waves"]["cells"],
    )
    netcdf.write(
        waves.merge(others),
        snakemake.output[0],
        title="fronts that have travelled, in two dimensions",
        parameters={"gel": snakemake.params.gel, "truth": settings},
        provenance=provenance,
    )
