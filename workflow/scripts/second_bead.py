"""Rule second_bead: a bead in either model by its second solver."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead import production
    from gelpump.materials import from_config
    from gelpump.second_solvers import lens_bead, nonlinear_bead
    from gelpump.second_solvers.course import observed

    params, wildcards = snakemake.params, snakemake.wildcards
    solvers = {
        "lens": (lens_bead, "cells", "LENS model"),
        "nonlinear": (nonlinear_bead, "elements", "fully nonlinear model"),
    }
    solver, mesh, name = solvers[wildcards.model]
    gel = from_config(params.case["gel"], params.gel)
    temperature, phi_initial, times = production.start(
        gel, params.case, {"output_times": params.output_times}
    )
    size, tolerance = params.numerics[mesh], params.numerics["tolerance"]
    netcdf.write(
        observed(solver.solve, gel, temperature, phi_initial, times, size, tolerance),
        snakemake.output[0],
        title=f"{wildcards.case} bead, {name}, second solver",
        parameters={"case": params.case, "gel": params.gel, "numerics": params.numerics},
        provenance=provenance,
    )
