"""Rule fig05_spinodal: trajectories of beads and the region of negative diffusivity."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig05_spinodal, style

    cases = snakemake.params.cases
    with style.styled():
        fig = fig05_spinodal.draw(
            netcdf.read(snakemake.input.material),
            dict(zip(cases, map(netcdf.read, snakemake.input.beads), strict=True)),
            cases,
        )
        style.save(fig, snakemake.output, provenance)
