"""Rule separation_widths: the separating bead with interfaces, towards the sharp limit."""

from _helpers import job

with job(snakemake) as provenance:
    import numpy as np

    from gelpump import netcdf
    from gelpump.bead.production import initial_polymer_fraction
    from gelpump.materials import from_config
    from gelpump.separation import diffuse, observed
    from gelpump.separation.energy import Nonlinear

    case, widths = snakemake.params.case, snakemake.params.widths
    gel = from_config(case["gel"], snakemake.params.gel)
    energy = Nonlinear(gel, case["temperature_final"])
    phi = initial_polymer_fraction(gel, case)
    times = np.linspace(0.0, case["end"], 601)
    runs = []
    for width, cells in sorted(widths.values(), reverse=True):
        runs.append(diffuse.solve(energy, phi, times, int(cells), width=width))
        print(runs[-1].attrs)
    dataset = observed.towards_sharp(runs, netcdf.read(snakemake.input.sharp))
    netcdf.write(
        dataset,
        snakemake.output[0],
        "the separating bead with interfaces of several widths, fully nonlinear",
        {"case": case, "gel": snakemake.params.gel, "widths": widths},
        provenance,
    )
