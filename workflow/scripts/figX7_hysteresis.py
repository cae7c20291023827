"""Rule figX7_hysteresis: quasi-static loops of beads."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX7_hysteresis, style

    with style.styled():
        fig = figX7_hysteresis.draw([netcdf.read(file) for file in snakemake.input.loops])
        style.save(fig, snakemake.output, provenance)
