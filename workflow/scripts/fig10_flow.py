"""Rule fig10_flow: flow through the wall and along the lumen."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig10_flow, style

    figure = snakemake.params.figure
    with style.styled():
        fig = fig10_flow.draw(
            [netcdf.read(view) for view in snakemake.input.views],
            figure["wall_time"],
            figure["lumen_time"],
        )
        style.save(fig, snakemake.output, provenance)
