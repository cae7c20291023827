"""Rule lumen_pulse: the pulse of water that travels along the lumen."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.tube import lumen_pulse

    params = snakemake.params
    netcdf.write(
        lumen_pulse.lumen_pulse(
            from_config(params.tube["gel"], params.gel),
            params.tube,
            params.settings,
            netcdf.read(snakemake.input.pulse),
            netcdf.read(snakemake.input.fit),
        ),
        snakemake.output[0],
        title="pulse of water in the lumen",
        parameters={"tube": params.tube, "gel": params.gel, "lumen_pulse": params.settings},
        provenance=provenance,
    )
