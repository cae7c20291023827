"""Rule figX5_front: a bead that separates, in both models."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX5_front, style

    with style.styled():
        fig = figX5_front.draw(
            netcdf.read(snakemake.input.nonlinear), netcdf.read(snakemake.input.lens)
        )
        style.save(fig, snakemake.output, provenance)
