"""Rule sweep_surface: the response surface of a sweep, of every n-th design of a very large one."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump.figures import style
    from gelpump.figures import sweep as figures
    from gelpump.sweep import part

    dataset = part.read(
        snakemake.input.sweep, lambda count: slice(None, None, -(-count // snakemake.params.most))
    )
    with style.styled():
        fig = figures.surface(dataset, snakemake.params.varied)
        style.save(fig, snakemake.output, provenance)
