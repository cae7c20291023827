"""Rule sweep_accuracy: designs drawn at random, solved again on a finer mesh.

Fails if they are less accurate than the sweep's file asks for.
"""

from _helpers import job

with job(snakemake) as provenance:
    from functools import partial

    from gelpump import netcdf
    from gelpump.sweep import accuracy, part

    sweep = snakemake.params.sweep
    chosen = part.read(snakemake.input.sweep, partial(accuracy.subset, sweep))
    found = accuracy.errors(chosen, sweep)
    passed, told = accuracy.verdict(found)
    if not passed:
        raise SystemExit(
            f"the sweep {snakemake.wildcards.sweep} is not as accurate as it should be: {told}; "
            "give it more numerics.cells and a smaller numerics.tolerance, or allow a larger "
            "accuracy.error"
        )
    print(told)
    netcdf.write(
        found,
        snakemake.output[0],
        title="errors of a sweep, of designs drawn at random",
        parameters=sweep,
        provenance=provenance,
    )
