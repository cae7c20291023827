"""Rule separation_front: a bead through separation, in the sharp limit, in one model."""

from _helpers import job

with job(snakemake) as provenance:
    import numpy as np

    from gelpump import netcdf
    from gelpump.bead.production import initial_polymer_fraction
    from gelpump.materials import from_config
    from gelpump.separation import lens_front, observed, sharp
    from gelpump.separation.energy import ENERGIES

    case, numerics = snakemake.params.case, snakemake.params.numerics
    model = snakemake.wildcards.model
    gel = from_config(case["gel"], snakemake.params.gel)
    start, end = case["temperature_initial"], case["temperature_final"]
    phi = initial_polymer_fraction(gel, case)
    times = case["end"] * np.linspace(0.0, 1.0, numerics["output_times"]) ** 2
    cells = tuple(numerics["cells_lens" if model == "lens" else "cells"])
    skin = numerics["skin"]

    def run(cells, skin, factor):
        if model == "lens" and start < end:
            tolerance = factor * numerics["tolerance_lens"]
            return lens_front.solve(gel, end, phi, times, cells, tolerance=tolerance, skin=skin)
        energy, tolerance = ENERGIES[model](gel, end), factor * numerics["tolerance"]
        return sharp.solve(energy, phi, times, cells, tolerance=tolerance, skin=skin)

    bead = run(cells, skin, 1.0)
    coarse = run(tuple(n // 2 for n in cells), 2.0 * skin, 4.0)
    bead = observed.with_uncertainty(bead, coarse)
    print(bead.attrs)
    netcdf.write(
        bead,
        snakemake.output[0],
        f"{snakemake.wildcards.case} bead through separation, sharp front, {model}",
        {"case": case, "gel": snakemake.params.gel, "numerics": numerics},
        provenance,
    )
