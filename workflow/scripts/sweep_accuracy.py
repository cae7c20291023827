"""Rule sweep_accuracy: designs drawn at random, solved again on a finer mesh."""

from _helpers import job

with job(snakemake) as provenance:
    import xarray as xr

    from gelpump import netcdf
    from gelpump.sweep import accuracy

    sweep = snakemake.params.sweep
    with xr.open_dataset(snakemake.input.sweep, engine="netcdf4") as dataset:
        chosen = dataset.isel(index=accuracy.subset(sweep, dataset.sizes["index"])).load()
    chosen.attrs.clear()
    found = accuracy.errors(chosen, sweep)
    worst, allowed = float(found.largest_error), float(found.allowed_error)
    print(f"largest relative error {worst:.2e}, allowed {allowed:.1e}")
    netcdf.write(
        found,
        snakemake.output[0],
        title="errors of a sweep, of designs drawn at random",
        parameters=sweep,
        provenance=provenance,
    )
