"""Rule tube_flow: flow through the wall and in the lumen of a tube at one time, for each view."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.tube import flow_fields

    pulse = netcdf.read(snakemake.input.pulse)
    for (name, view), path in zip(snakemake.params.views.items(), snakemake.output, strict=True):
        netcdf.write(
            flow_fields.tube_flow(pulse, view["ell"], view["tau"]),
            path,
            title=f"flow in a collapsing tube: {name}",
            parameters={"view": view},
            provenance=provenance,
        )
