"""Rule refine_tube_pulse: some of the tubes on other meshes and with other time steps."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.tube import production

    params = snakemake.params
    gel = from_config(params.tube["gel"], params.gel)
    netcdf.write(
        production.refinement(
            gel, params.tube, params.numerics, params.subset, netcdf.read(snakemake.input.pulse)
        ),
        snakemake.output[0],
        title="tubes that collapse behind a pulse of heat, refinement",
        parameters={
            "tube": params.tube,
            "gel": params.gel,
            "numerics": params.numerics,
            "subset": params.subset,
        },
        provenance=provenance,
    )
