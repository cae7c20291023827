"""Rule truth_pulses: tubes behind the printed front, in two dimensions."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config
    from gelpump.truth import production

    params = snakemake.params
    netcdf.write(
        production.pulses(from_config("tube", params.gel), params.Le, **params.settings["pulses"]),
        snakemake.output[0],
        title="tubes behind a front of heat, in two dimensions",
        parameters={"gel": params.gel, "Le": params.Le, "truth": params.settings},
        provenance=provenance,
    )
