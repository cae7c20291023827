"""Rule gel: an energy-based or measured gel, its fit, and the jumps that part phases."""

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
    if snakemake.input.points:
        points = measured.read(snakemake.input.points)
        fit = measured.fit(name, points, block["temperature_range"])
        for warning in fit.warnings:
            print(f"WARNING {warning}")
    data = sheet.assembled(
        gel, settings["temperatures"], settings["polymer_fractions"], fit, points
    )
    netcdf.write(
        data,
        snakemake.output.data,
        title=f"{name}: equilibrium, spinodal and jumps that separate phases",
        parameters={"gel": block, "tables": settings},
        provenance=provenance,
    )
    columns = [Column(each, each) for each in ("quantity", "value", "uncertainty or reason")]
    write_text(csv(columns, sheet.rows(data, gel)), snakemake.output.table)
    with style.styled():
        style.save(drawing.draw(data), snakemake.output.figure, provenance)
