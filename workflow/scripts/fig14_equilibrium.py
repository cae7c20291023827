"""Rule fig14_equilibrium: equilibrium polymer fraction against temperature."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig14_equilibrium, style

    gels = snakemake.params.figure["gels"]
    drawn = {
        gel: [
            block["drawn"]
            for claim, block in snakemake.params.published.items()
            if claim.endswith(f"-{gel.lower()}") and "drawn" in block
        ]
        for gel in gels
    }
    with style.styled():
        fig = fig14_equilibrium.draw(
            dict(zip(gels, map(netcdf.read, snakemake.input.materials), strict=True)), drawn
        )
        style.save(fig, snakemake.output, provenance)
