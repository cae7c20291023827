"""Rule deswelling_map: how long tubes of different gels take to deswell."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.tube import uniform

    params = snakemake.params
    gel = from_config(params.tube["gel"], params.gel)
    netcdf.write(
        uniform.deswelling_map(gel, params.tube["eps"], params.settings),
        snakemake.output[0],
        title="time for a tube to deswell when heated everywhere",
        parameters={"tube": params.tube, "gel": params.gel, "deswelling_map": params.settings},
        provenance=provenance,
    )
