"""Rule tube_heat: tubes whose collapse holds their front of heat back (docs/heat.md)."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.tube import heat_study

    params = snakemake.params
    gel = from_config(params.tube["gel"], params.gel)
    netcdf.write(
        heat_study.study(gel, params.tube, params.settings, params.numerics),
        snakemake.output[0],
        title="heat that the collapse of a tube consumes, by its surrounding",
        parameters={
            "tube": params.tube,
            "gel": params.gel,
            "tube_heat": params.settings,
            "numerics": params.numerics,
        },
        provenance=provenance,
    )
