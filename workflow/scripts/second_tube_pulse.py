"""Rule second_tube_pulse: some tubes behind a pulse of heat by the second solver."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.second_solvers import tube

    params = snakemake.params
    gel = from_config(params.tube["gel"], params.gel)
    netcdf.write(
        tube.observed(
            gel,
            params.tube,
            params.ell,
            params.tau,
            params.numerics["nodes"],
            params.numerics["tolerance"],
        ),
        snakemake.output[0],
        title="tubes that collapse behind a pulse of heat, second solver",
        parameters={"tube": params.tube, "gel": params.gel, "numerics": params.numerics},
        provenance=provenance,
    )
