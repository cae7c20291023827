"""Rule bead_lens: a bead in the LENS model, and its refinement."""

from _helpers import job

with job(snakemake) as provenance:
    from functools import partial
    from itertools import chain

    from gelpump import netcdf
    from gelpump.bead import lens, production
    from gelpump.finite_volume import together
    from gelpump.materials import from_config

    case, numerics = snakemake.params.case, snakemake.params.numerics
    gel = from_config(case["gel"], snakemake.params.gel)
    temperature, phi_initial, times = production.start(gel, case, numerics)

    def solve(meshes, tolerance):
        beads = lens.solve_meshes(gel, temperature, phi_initial, times, meshes, tolerance=tolerance)
        print(meshes, tolerance, beads[0].attrs)
        return [production.measured(bead, gel, temperature) for bead in beads]

    def run(meshes, tolerance):
        beads = solve(meshes, tolerance)
        if len(meshes) > 1 and beads[0].attrs["stopped"]:  # each mesh stops at a time of its own
            return [bead for [bead] in together(*(partial(solve, [n], tolerance) for n in meshes))]
        return beads

    def runs(asked):
        return list(chain(*together(*(partial(run, *each) for each in asked))))

    bead, refinement = production.refined(runs, numerics["cells"], numerics["tolerance"])
    title = f"{snakemake.wildcards.case} bead, LENS model"
    parameters = {"case": case, "gel": snakemake.params.gel, "numerics": numerics}
    netcdf.write(bead, snakemake.output.bead, title, parameters, provenance)
    netcdf.write(
        refinement, snakemake.output.refinement, f"{title}, refinement", parameters, provenance
    )
