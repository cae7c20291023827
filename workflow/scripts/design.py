"""Rule design: a device solved in SI units, with its sheet."""

import pint  # noqa: F401  before `job` hides from xarray what is not imported
from _helpers import job

with job(snakemake) as provenance:
    import io

    from gelpump import netcdf, tables
    from gelpump.design import dataset, description, gel_errors, sheet
    from gelpump.figures import design as drawing
    from gelpump.figures import style
    from gelpump.materials import measured
    from gelpump.text import write_text

    params, name = snakemake.params, snakemake.wildcards.name
    design = description.checked(name, params.block, params.gels)
    errors = fit = None
    if params.measured:
        _, fit = measured.measured(params.block["gel"], params.measured)
        try:
            errors = gel_errors.gel_errors(name, params.block, fit)
        except description.DesignError as refusal:
            errors = refusal
    data = dataset.assemble(design, params.numerics[design.kind], errors, fit)
    netcdf.write(
        data,
        snakemake.output.data,
        title=f"{design.title}: a design in SI units",
        parameters={"design": params.block, "gels": params.gels, "numerics": params.numerics},
        provenance=provenance,
    )
    headings = ("key", "meaning", "value", "unit", "uncertainty", "gel error", "source")
    columns = [tables.Column(each, each) for each in headings]
    write_text(tables.csv(columns, dataset.csv_rows(data)), snakemake.output.table)
    with style.styled():
        svg = io.StringIO()
        drawing.pictures(data).savefig(svg, format="svg", metadata=style.METADATA["svg"])
        write_text(sheet.html(data, svg.getvalue()), snakemake.output.page)
        style.save(drawing.page(data), [snakemake.output.pdf], provenance)
