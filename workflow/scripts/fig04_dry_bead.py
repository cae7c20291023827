"""Rule fig04_dry_bead: a bead dries, in both models."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig04_dry_bead, style

    models = ("lens", "nonlinear")
    radii = {
        model: block["value"]
        for claim, block in snakemake.params.published.items()
        for model in models
        if claim.endswith(f"-{model}")
    }
    with style.styled():
        fig = fig04_dry_bead.draw(
            {model: netcdf.read(snakemake.input[model]) for model in models},
            snakemake.params.case,
            radii,
        )
        style.save(fig, snakemake.output, provenance)
