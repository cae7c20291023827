"""Rule figX3_slenderness: where the slender tube is within 1, 5 and 20 % of two dimensions."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX3_slenderness, style

    with style.styled():
        fig = figX3_slenderness.draw(netcdf.read(snakemake.input.slenderness))
        style.save(fig, snakemake.output, provenance)
