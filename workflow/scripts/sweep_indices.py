"""Rule sweep_indices: Sobol's indices of a sweep."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.sweep import sensitivity

    sweep = snakemake.params.sweep
    netcdf.write(
        sensitivity.indices(sweep, netcdf.read(snakemake.input.sweep)),
        snakemake.output[0],
        title="Sobol indices of a sweep",
        parameters=sweep,
        provenance=provenance,
    )
