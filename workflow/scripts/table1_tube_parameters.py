"""Rule table1_tube_parameters: the parameters of the collapsing tubes."""

from _helpers import job

with job(snakemake):
    from gelpump import tables

    parameters = snakemake.params.gel | snakemake.params.tube
    columns = [
        tables.Column("Parameter", "Parameter"),
        tables.Column("Name", "Name"),
        tables.Column("Value", "Value"),
    ]
    meaning = {
        "Phi_inf": "Deswollen scaled polymer fraction",
        "Pi_ratio": "Ratio of osmotic pressure scales",
        "eps": "Aspect ratio a_1/L",
        "M": "Shear parameter",
        "Le": "Lewis number",
    }
    rows = [[text, name, float(parameters[name])] for name, text in meaning.items()]
    tables.write(snakemake.output, columns, rows)
