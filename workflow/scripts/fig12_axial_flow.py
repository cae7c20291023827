"""Rule fig12_axial_flow: the pulse of water in the lumen."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig12_axial_flow, style

    names = {
        "peak": "lumen-peak-height",
        "far": "lumen-far-nonzero",
        "product": "lumen-peak-product",
    }
    published = {
        name: [snakemake.params.published[claim]["value"]]
        if claim in snakemake.params.published
        else []
        for name, claim in names.items()
    }
    with style.styled():
        fig = fig12_axial_flow.draw(
            netcdf.read(snakemake.input.pulse),
            published | {"A": snakemake.params.figure["published_A"]},
        )
        style.save(fig, snakemake.output, provenance)
