"""Rule table2_gel_parameters: the parameters of the energy-based gels."""

from _helpers import job

with job(snakemake):
    from gelpump import tables

    columns = [
        tables.Column("Model", "Model"),
        tables.Column("A0", "$A_0$"),
        tables.Column("A1", "$A_1$"),
        tables.Column("B0 (1/K)", r"$B_0$ ($\mathrm{K}^{-1}$)"),
        tables.Column("B1 (1/K)", r"$B_1$ ($\mathrm{K}^{-1}$)"),
        tables.Column("Omega", r"$\Omega$"),
    ]
    rows = [
        [name, *(gel[key] for key in ("A0", "A1", "B0", "B1", "Omega"))]
        for name, gel in snakemake.params.gels.items()
    ]
    tables.write(snakemake.output, columns, rows)
