"""Rule bead_lens: a bead in the LENS model."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead import lens, production
    from gelpump.materials import from_config

    case, numerics = snakemake.params.case, snakemake.params.numerics
    gel = from_config(case["gel"], snakemake.params.gel)
    temperature, phi_initial, times = production.start(gel, case, numerics)
    bead = lens.solve(
        gel,
        temperature,
        phi_initial,
        times,
        numerics["cells"],
        tolerance=numerics["tolerance"],
    )
    print(bead.attrs)
    netcdf.write(
        production.measured(bead, gel, temperature),
        snakemake.output[0],
        title=f"{snakemake.wildcards.case} bead, LENS model",
        parameters={"case": case, "gel": snakemake.params.gel, "numerics": numerics},
        provenance=provenance,
    )
