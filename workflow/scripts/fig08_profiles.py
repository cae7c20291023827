"""Rule fig08_profiles: a tube at several times behind a pulse of heat."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig08_profiles, style

    figure, published = snakemake.params.figure, snakemake.params.published
    pulse = netcdf.read(snakemake.input.pulse)
    with style.styled():
        fig = fig08_profiles.draw(
            pulse.sel(ell=figure["ell"], tau=figure["tau"], method="nearest", tolerance=1e-12),
            [position for block in published.values() for position in block["value"]],
        )
        style.save(fig, snakemake.output, provenance)
