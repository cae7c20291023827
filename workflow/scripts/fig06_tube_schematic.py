"""Rule fig06_tube_schematic: a tube behind a pulse of heat, cut open."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig06_tube_schematic, style

    figure = snakemake.params.figure
    pulse = netcdf.read(snakemake.input.pulse)
    with style.styled():
        fig = fig06_tube_schematic.draw(
            pulse.sel(ell=figure["ell"], tau=figure["tau"], method="nearest", tolerance=1e-12)
        )
        style.save(fig, snakemake.output, provenance)
