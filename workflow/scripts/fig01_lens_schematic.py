"""Rule fig01_lens_schematic: a solved bead's deformation, isotropic and deviatoric."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig01_lens_schematic, style

    with style.styled():
        fig = fig01_lens_schematic.draw(
            netcdf.read(snakemake.input.bead), snakemake.params.figure["time"]
        )
        style.save(fig, snakemake.output, provenance)
