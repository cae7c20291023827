"""Rule figX9_cycle: loops of beads, and what tubes pump to and fro."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX9_cycle, style
    from gelpump.materials import from_config

    gels = {name: from_config(name, block) for name, block in snakemake.params.curves.items()}
    with style.styled():
        fig = figX9_cycle.draw(
            netcdf.read(snakemake.input.beads), netcdf.read(snakemake.input.tube), gels
        )
        style.save(fig, snakemake.output, provenance)
