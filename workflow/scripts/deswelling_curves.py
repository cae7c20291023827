"""Rule deswelling_curves: polymer fraction of tubes that are heated everywhere at once."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.tube import uniform

    params = snakemake.params
    gel = from_config(params.tube["gel"], params.gel)
    netcdf.write(
        uniform.deswelling_curves(gel, params.tube["eps"], params.settings),
        snakemake.output[0],
        title="uniform deswelling and reswelling of tubes",
        parameters={"tube": params.tube, "gel": params.gel, "deswelling_curves": params.settings},
        provenance=provenance,
    )
