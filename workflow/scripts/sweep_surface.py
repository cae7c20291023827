"""Rule sweep_surface: the response surface of a sweep."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import style
    from gelpump.figures import sweep as figures

    with style.styled():
        fig = figures.surface(netcdf.read(snakemake.input.sweep), snakemake.params.varied)
        style.save(fig, snakemake.output, provenance)
