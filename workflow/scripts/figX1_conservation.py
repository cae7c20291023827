"""Rule figX1_conservation: whether the wall conserves water, by closure."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX1_conservation, style

    with style.styled():
        fig = figX1_conservation.draw(
            netcdf.read(snakemake.input.balance),
            netcdf.read(snakemake.input.printed),
            netcdf.read(snakemake.input.conserving),
            snakemake.params.figure["ell"],
        )
        style.save(fig, snakemake.output, provenance)
