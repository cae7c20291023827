"""Rule coexistence: the phases of a gel that meet at a front, and where surfaces separate."""

from _helpers import job

with job(snakemake) as provenance:
    import numpy as np

    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.separation import phases

    gel = from_config(snakemake.wildcards.gel, snakemake.params.gel)
    view = snakemake.params.view
    low, high, count = view["temperatures"]
    # dense at the low end, where phases part like the root of the distance
    temperatures = low + (high - low) * np.linspace(0.0, 1.0, int(count)) ** 2
    dataset = phases.dataset(gel, temperatures, tuple(view["radii"]))
    netcdf.write(
        dataset,
        snakemake.output[0],
        f"coexistence of two phases, {snakemake.wildcards.gel}",
        {"gel": snakemake.params.gel, "view": view},
        provenance,
    )
