"""Rule fig02_osmotic_schema: osmotic pressure below and above the transition."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import fig02_osmotic_schema, style

    with style.styled():
        fig = fig02_osmotic_schema.draw(
            netcdf.read(snakemake.input.material), snakemake.params.figure["temperatures"]
        )
        style.save(fig, snakemake.output, provenance)
