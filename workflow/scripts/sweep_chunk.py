"""Rule sweep_chunk: the pulses of one chunk of designs."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.sweep import part, solving

    sweep, size = snakemake.params.sweep, snakemake.params.size
    start = int(snakemake.wildcards.chunk) * size
    here = part.read(snakemake.input.designs, lambda count: slice(start, start + size))
    solved = solving.solve_designs(here, sweep["tau"], sweep["numerics"], snakemake.params.error)
    netcdf.write(
        solved,
        snakemake.output[0],
        title="a chunk of a sweep",
        parameters=sweep,
        provenance=provenance,
        flag="status",
    )
