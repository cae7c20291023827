"""Rule fig11_flow_close: flow in the wall next to the drying front."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig11_flow_close, style

    with style.styled():
        fig = fig11_flow_close.draw(
            [netcdf.read(view) for view in snakemake.input.views],
            netcdf.read(snakemake.input.budget),
            snakemake.params.figure["wall_times"],
        )
        style.save(fig, snakemake.output, provenance)
