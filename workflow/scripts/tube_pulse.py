"""Rule tube_pulse: the family of tubes that collapse behind a pulse of heat."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.tube import production

    params = snakemake.params
    gel = from_config(params.tube["gel"], params.gel)
    pulse = production.family(gel, params.tube, params.settings, params.numerics)
    print(pulse.attrs)
    netcdf.write(
        pulse,
        snakemake.output[0],
        title="tubes that collapse behind a pulse of heat",
        parameters={
            "tube": params.tube,
            "gel": params.gel,
            "tube_pulse": params.settings,
            "numerics": params.numerics,
        },
        provenance=provenance,
    )
