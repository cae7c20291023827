"""Rule fig13_osmotic: osmotic pressure against polymer fraction at several temperatures."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig13_osmotic, style

    gels = snakemake.params.figure["gels"]
    with style.styled():
        fig = fig13_osmotic.draw(
            dict(zip(gels, map(netcdf.read, snakemake.input.materials), strict=True))
        )
        style.save(fig, snakemake.output, provenance)
