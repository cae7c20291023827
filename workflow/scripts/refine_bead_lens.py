"""Rule refine_bead_lens: the LENS bead on other meshes and with other time tolerances."""

from _helpers import job

with job(snakemake):
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

    netcdf.write(
        production.refinement(run, numerics["cells"], numerics["tolerance"]),
        snakemake.output[0],
        title=f"{snakemake.wildcards.case} bead, LENS model, refinement",
        parameters={"case": case, "gel": snakemake.params.gel, "numerics": numerics},
    )
