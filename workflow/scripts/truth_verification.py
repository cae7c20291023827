"""Rule truth_verification: how the two-dimensional tube was tried."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.truth import verification

    params = snakemake.params
    netcdf.write(
        verification.verification(
            from_config("tube", params.gel),
            from_config(params.settings["bead"]["gel"], params.bead_gel),
            params.settings["bead"],
            **params.settings["verified"],
        ),
        snakemake.output[0],
        title="verification of the tube in two dimensions",
        parameters={"gel": params.gel, "bead_gel": params.bead_gel, "truth": params.settings},
        provenance=provenance,
    )
