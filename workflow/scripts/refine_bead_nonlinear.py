"""Rule refine_bead_nonlinear: the nonlinear bead on other meshes and with other tolerances."""

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

    def run_meshes(meshes, tolerance):
        return [run(cells, tolerance) for cells in meshes]

    netcdf.write(
        production.refinement(run, run_meshes, numerics["cells"], numerics["tolerance"]),
        snakemake.output[0],
        title=f"{snakemake.wildcards.case} bead, fully nonlinear model, refinement",
        parameters={"case": case, "gel": snakemake.params.gel, "numerics": numerics},
        provenance=provenance,
    )
