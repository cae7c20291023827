"""Rule fig09_relax: profiles about the drying front, and its sharpness."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig09_relax, style

    figure = snakemake.params.figure
    published = {claim: block["value"] for claim, block in snakemake.params.published.items()}
    with style.styled():
        fig = fig09_relax.draw(
            netcdf.read(snakemake.input.pulse),
            netcdf.read(snakemake.input.fit),
            figure["ell"],
            {"ell": figure["published_ell"], "Phi1": published.get("front-phi", [])},
            published.get("A-values", []),
        )
        style.save(fig, snakemake.output, provenance)
