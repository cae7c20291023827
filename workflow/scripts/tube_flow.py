"""Rule tube_flow: flow through the wall and in the lumen of one tube at one time."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.tube import views

    view = snakemake.params.view
    netcdf.write(
        views.tube_flow(netcdf.read(snakemake.input.pulse), view["ell"], view["tau"]),
        snakemake.output[0],
        title=f"flow in a collapsing tube: {snakemake.wildcards.view}",
        parameters={"view": view},
        provenance=provenance,
    )
