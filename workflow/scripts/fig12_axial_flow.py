"""Rule fig12_axial_flow: the pulse of water in the lumen."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig12_axial_flow, style

    with style.styled():
        fig = fig12_axial_flow.draw(
            netcdf.read(snakemake.input.pulse),
            [block["value"] for block in snakemake.params.published.values()],
        )
        style.save(fig, snakemake.output, provenance)
