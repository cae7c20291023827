"""Rule wall_times: how long walls resolved in r take to deswell."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.tube.wall_times import wall_times

    params = snakemake.params
    gel = from_config(params.tube["gel"], params.gel)
    netcdf.write(
        wall_times(gel, params.tube, params.settings),
        snakemake.output[0],
        title="time for a wall resolved in r to deswell",
        parameters={"tube": params.tube, "gel": params.gel, "wall_times": params.settings},
        provenance=provenance,
    )
