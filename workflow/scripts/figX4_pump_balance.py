"""Rule figX4_pump_balance: where the water of the pump goes."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX4_pump_balance, style

    with style.styled():
        fig = figX4_pump_balance.draw(
            netcdf.read(snakemake.input.balance),
            netcdf.read(snakemake.input.response),
            snakemake.params.figure["ell"],
        )
        style.save(fig, snakemake.output, provenance)
