"""Rule sweep_bars: Sobol's indices as bars."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import style
    from gelpump.figures import sweep as figures

    with style.styled():
        fig = figures.bars(netcdf.read(snakemake.input.indices))
        style.save(fig, snakemake.output, provenance)
