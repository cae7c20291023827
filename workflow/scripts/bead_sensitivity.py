"""Rule bead_sensitivity: what printed digits leave open of the course of a bead."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead import nonlinear, production
    from gelpump.bead.sensitivity import sensitivity
    from gelpump.materials import from_config

    case, numerics = snakemake.params.case, snakemake.params.numerics
    gel = from_config(case["gel"], snakemake.params.gel)
    temperature, _, times = production.start(gel, case, numerics)

    def radius(gel, temperature):
        phi_initial = production.initial_polymer_fraction(gel, case)
        # differences of one mesh: a quarter of the cells is enough
        cells, tolerance = max(numerics["cells"] // 4, 24), numerics["tolerance"]
        return nonlinear.solve(
            gel, temperature, phi_initial, times, cells, tolerance=tolerance
        ).radius

    netcdf.write(
        sensitivity(radius, gel, temperature, snakemake.params.half_units),
        snakemake.output[0],
        title=f"{snakemake.wildcards.case} bead: sensitivity to the printed digits",
        parameters={
            "case": case,
            "gel": snakemake.params.gel,
            "numerics": numerics,
            "half_units": snakemake.params.half_units,
        },
        provenance=provenance,
    )
