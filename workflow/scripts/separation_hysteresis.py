"""Rule separation_hysteresis: a bead heated and cooled quasi-statically."""

from _helpers import job

with job(snakemake) as provenance:
    import numpy as np

    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.separation import hysteresis

    loop, name = snakemake.params.loop, snakemake.wildcards.gel
    low, high, count = loop["temperatures"]
    dataset = hysteresis.dataset(
        from_config(name, snakemake.params.gel),
        np.linspace(low, high, int(count)),
        loop["cells"],
        **{key: loop[key] for key in ("width", "width_at", "resolution")},
    )
    print(dataset.jump_temperature, dataset.fold_temperature, dataset.equal_energy_temperature)
    netcdf.write(
        dataset,
        snakemake.output[0],
        f"a bead of {name}, heated and cooled quasi-statically",
        {"gel": snakemake.params.gel, "loop": loop},
        provenance,
    )
