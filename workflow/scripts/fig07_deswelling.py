"""Rule fig07_deswelling: tubes that deswell everywhere at once."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig07_deswelling, style

    tau, published = snakemake.params.published_times[:1], snakemake.params.published
    points = [(now, Phi1) for now in tau for block in published.values() for Phi1 in block["value"]]
    with style.styled():
        fig = fig07_deswelling.draw(
            netcdf.read(snakemake.input.times),
            netcdf.read(snakemake.input.curves),
            points,
        )
        style.save(fig, snakemake.output, provenance)
