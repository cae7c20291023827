# A device in millimetres and seconds: `snakemake --cores 2 design_NAME` for config/designs/NAME.yaml,
# or for another file with `--config design=path/to/NAME.yaml`.


rule design:
    input:
        file=design_input,
        points=design_points,
        texts=["src/gelpump/design/schema.yaml", "src/gelpump/design/sheet.html.j2"],
        src=modules(
            *(name for name in PULSE if name != "tube/production"),
            "bead/__init__",
            "bead/dataset",
            "bead/lens",
            "config",
            "materials/measured",
            "tables",
            "text",
            "tube/budget",
            "figures/__init__",
            "figures/style",
            "figures/design",
            "design/__init__",
            "design/dataset",
            "design/description",
            "design/device",
            "design/gel_errors",
            "design/inverse",
            "design/material",
            "design/result",
            "design/sheet",
            "design/solve",
            "design/units",
            "design/validity",
        ),
    output:
        data="results/designs/{name}.nc",
        table="results/designs/{name}.csv",
        page="results/designs/{name}.html",
        pdf="results/designs/{name}.pdf",
    log:
        "results/logs/design_{name}.log",
    benchmark:
        "results/benchmarks/design_{name}.tsv"
    params:
        block=checked_design,
        gels=lambda wildcards: design_gels(checked_design(wildcards)),
        numerics={
            "tube": config["numerics"]["tube_pulse"],
            "bead": config["numerics"]["bead_lens"],
        },
    script:
        "../scripts/design.py"


for name in DESIGNS:

    rule:
        name:
            f"design_{name}"
        input:
            f"results/designs/{name}.nc",
            f"results/designs/{name}.csv",
            f"results/designs/{name}.html",
            f"results/designs/{name}.pdf",
