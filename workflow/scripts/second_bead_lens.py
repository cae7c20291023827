"""Rule second_bead_lens: a bead in the LENS model by the second solver."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead import production
    from gelpump.materials import from_config
    from gelpump.second_solvers import lens_bead

    params = snakemake.params
    gel = from_config(params.case["gel"], params.gel)
    temperature, phi_initial, times = production.start(
        gel, params.case, {"output_times": params.output_times}
    )
    netcdf.write(
        lens_bead.observed(
            gel,
            temperature,
            phi_initial,
            times,
            params.numerics["cells"],
            params.numerics["tolerance"],
        ),
        snakemake.output[0],
        title=f"{snakemake.wildcards.case} bead, LENS model, second solver",
        parameters={"case": params.case, "gel": params.gel, "numerics": params.numerics},
        provenance=provenance,
    )
