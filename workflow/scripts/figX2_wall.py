"""Rule figX2_wall: how fast a wall resolved in r deswells."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX2_wall, style

    with style.styled():
        fig = figX2_wall.draw(netcdf.read(snakemake.input.times))
        style.save(fig, snakemake.output, provenance)
