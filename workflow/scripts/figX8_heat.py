"""Rule figX8_heat: how far the latent heat of a collapse holds the front back."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX8_heat, style

    with style.styled():
        fig = figX8_heat.draw(netcdf.read(snakemake.input.heat))
        style.save(fig, snakemake.output, provenance)
