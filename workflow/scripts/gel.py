"""Rule gel: an energy-based or measured gel, its fit, and the jumps that part phases."""

import pint  # noqa: F401  before `job` hides from xarray what is not imported
from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.figures import gel as drawing
    from gelpump.figures import style
    from gelpump.materials import from_config, measured, sheet
    from gelpump.tables import Column, csv
    from gelpump.text import write_text

    name, block = snakemake.wildcards.gel, snakemake.params.gel
    gel, settings, fit, points = from_config(name, block), snakemake.params.tables, None, None
    if snakemake.params.measured:
        points, fit = measured.measured(name, snakemake.params.measured)
        for warning in fit.warnings:
            print(f"WARNING {warning}")
    data = sheet.assembled(
        gel, settings["temperatures"], settings["polymer_fractions"], fit, points
    )
    netcdf.write(
        data,
        snakemake.output.data,
        title=f"{name}: equilibrium, spinodal and jumps that separate phases",
        parameters={"gel": block, "measured": snakemake.params.measured, "tables": settings},
        provenance=provenance,
    )
    columns = [Column(each, each) for each in ("quantity", "value", "uncertainty or reason")]
    write_text(csv(columns, sheet.rows(data, gel)), snakemake.output.table)
    with style.styled():
        style.save(drawing.draw(data), snakemake.output.figure, provenance)
