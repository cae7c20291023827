"""Rule separation_widths: a bead with interfaces of three widths, towards the sharp limit."""

from _helpers import job

with job(snakemake) as provenance:
    import numpy as np

    from gelpump import netcdf
    from gelpump.bead.production import initial_polymer_fraction
    from gelpump.materials import from_config
    from gelpump.separation import diffuse, diffuse_lens, limit
    from gelpump.separation.energy import ENERGIES

    case, widths, model = snakemake.params.case, snakemake.params.widths, snakemake.wildcards.model
    gel, end = from_config(case["gel"], snakemake.params.gel), case["temperature_final"]
    phi = initial_polymer_fraction(gel, case)
    times = np.linspace(0.0, case["end"], 601)
    runs = []
    for width, cells in sorted(widths["shells"], reverse=True):
        runs.append(diffuse.solve(ENERGIES[model](gel, end), phi, times, cells, width=width))
        print(runs[-1].attrs, flush=True)
    sharp = netcdf.read(snakemake.input.sharp)
    arrives = "completion_t" in sharp.attrs  # it may have stopped, in words
    dataset = limit.towards(runs, sharp if arrives else None)
    if snakemake.params.second:
        fixed = {"width": width, "tolerance": widths["fipy_tolerance"]}
        other = diffuse_lens.solve(gel, end, phi, times, widths["fipy_cells"], **fixed)
        dataset = dataset.assign_attrs(limit.between_solvers(runs[-1], other))
        print(dataset.attrs)
    netcdf.write(
        dataset,
        snakemake.output[0],
        f"{snakemake.wildcards.case} bead with interfaces of several widths, {model}",
        {"case": case, "gel": snakemake.params.gel, "widths": widths},
        provenance,
    )
