"""Rule bead_nonlinear: a bead in the fully nonlinear model, and its refinement."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead import nonlinear, production
    from gelpump.materials import from_config

    case, numerics = snakemake.params.case, snakemake.params.numerics
    gel = from_config(case["gel"], snakemake.params.gel)
    title = f"{snakemake.wildcards.case} bead, fully nonlinear model"
    parameters = {"case": case, "gel": snakemake.params.gel, "numerics": numerics}
    bead, refinement = production.run(nonlinear, gel, case, numerics)
    netcdf.write(bead, snakemake.output.bead, title, parameters, provenance)
    netcdf.write(
        refinement, snakemake.output.refinement, f"{title}, refinement", parameters, provenance
    )
