"""Rule bead_lens: a bead in the LENS model, and its refinement."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead import lens, production
    from gelpump.materials import from_config

    case, numerics = snakemake.params.case, snakemake.params.numerics
    gel = from_config(case["gel"], snakemake.params.gel)
    temperature, phi_initial, times = production.start(gel, case, numerics)

    def run(cells, tolerance):
        bead = lens.solve(gel, temperature, phi_initial, times, cells, tolerance=tolerance)
        print(cells, tolerance, bead.attrs)
        return production.measured(bead, gel, temperature)

    def run_meshes(meshes, tolerance):
        beads = lens.solve_meshes(gel, temperature, phi_initial, times, meshes, tolerance=tolerance)
        print(meshes, tolerance, beads[0].attrs)
        if beads[0].attrs["stopped"]:  # at the first mesh's time: each has its own
            return [run(cells, tolerance) for cells in meshes]
        return [production.measured(bead, gel, temperature) for bead in beads]

    bead, refinement = production.refined(run, run_meshes, numerics["cells"], numerics["tolerance"])
    title = f"{snakemake.wildcards.case} bead, LENS model"
    parameters = {"case": case, "gel": snakemake.params.gel, "numerics": numerics}
    netcdf.write(bead, snakemake.output.bead, title, parameters, provenance)
    netcdf.write(
        refinement, snakemake.output.refinement, f"{title}, refinement", parameters, provenance
    )
