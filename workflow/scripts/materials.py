"""Rule materials: curves and special points of an energy-based gel."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.materials import from_config, tables

    gel = from_config(snakemake.wildcards.gel, snakemake.params.gel)
    settings = snakemake.params.tables
    netcdf.write(
        tables.tabulated(gel, settings["temperatures"], settings["polymer_fractions"]),
        snakemake.output[0],
        title=f"{gel.name}: osmotic pressure, equilibrium and spinodal curves",
        parameters={"gel": snakemake.params.gel, "tables": settings},
        provenance=provenance,
    )
