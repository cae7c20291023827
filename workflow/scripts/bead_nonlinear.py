"""Rule bead_nonlinear: a bead in the fully nonlinear model, and its refinement."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead import nonlinear, production
    from gelpump.materials import from_config

    case, numerics = snakemake.params.case, snakemake.params.numerics
    gel = from_config(case["gel"], snakemake.params.gel)
    temperature, phi_initial, times = production.start(gel, case, numerics)

    def run(cells, tolerance):
        bead = nonlinear.solve(gel, temperature, phi_initial, times, cells, tolerance=tolerance)
        print(cells, tolerance, bead.attrs)
        return production.measured(bead, gel, temperature)

    def runs(asked):
        return [run(cells, tolerance) for meshes, tolerance in asked for cells in meshes]

    bead, refinement = production.refined(runs, numerics["cells"], numerics["tolerance"])
    title = f"{snakemake.wildcards.case} bead, fully nonlinear model"
    parameters = {"case": case, "gel": snakemake.params.gel, "numerics": numerics}
    netcdf.write(bead, snakemake.output.bead, title, parameters, provenance)
    netcdf.write(
        refinement, snakemake.output.refinement, f"{title}, refinement", parameters, provenance
    )
