"""Rule sweep_designs: the parameters of all designs of a sweep."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.sweep import sampling

    sweep = snakemake.params.sweep
    netcdf.write(
        sampling.sample(sweep),
        snakemake.output[0],
        title="designs of a sweep",
        parameters=sweep,
        provenance=provenance,
    )
