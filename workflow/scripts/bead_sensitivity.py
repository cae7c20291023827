"""Rule bead_sensitivity: what printed digits leave open of the course of a bead."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.bead.sensitivity import of_case
    from gelpump.materials import from_config

    case, numerics = snakemake.params.case, snakemake.params.numerics
    gel = from_config(case["gel"], snakemake.params.gel)
    netcdf.write(
        of_case(gel, case, numerics, snakemake.params.half_units),
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
