"""Rule sweep_chunk: the pulse solves of one chunk of designs."""

from _helpers import job

with job(snakemake) as provenance:
    import xarray as xr

    from gelpump import netcdf
    from gelpump.sweep import solving

    sweep, start = snakemake.params.sweep, int(snakemake.wildcards.chunk) * snakemake.params.size
    with xr.open_dataset(snakemake.input.designs, engine="netcdf4") as designs:
        here = designs.isel(index=slice(start, start + snakemake.params.size)).load()
    here.attrs.clear()
    solved = solving.solve_designs(here, sweep["tau"], sweep["numerics"])
    netcdf.write(
        solved,
        snakemake.output[0],
        title="a chunk of a sweep",
        parameters=sweep,
        provenance=provenance,
        flag="status",
    )
