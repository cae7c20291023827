"""Rule figX3_fields: the tube in two dimensions, and the sharpness of its front."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX3_fields, style

    with style.styled():
        fig = figX3_fields.draw(
            netcdf.read(snakemake.input.pulses),
            netcdf.read(snakemake.input.waves),
            netcdf.read(snakemake.input.slenderness),
        )
        style.save(fig, snakemake.output, provenance)
