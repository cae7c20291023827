"""Rule figX6_coexistence: which phases meet at a front, beside figure 5's spinodal."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import figX6_coexistence, style

    with style.styled():
        fig = figX6_coexistence.draw(
            netcdf.read(snakemake.input.material), netcdf.read(snakemake.input.phases)
        )
        style.save(fig, snakemake.output, provenance)
