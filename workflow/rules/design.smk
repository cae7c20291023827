# A device in millimetres and seconds: `snakemake --cores 2 design_NAME` for config/designs/NAME.yaml,
# or for another file with `--config design=path/to/NAME.yaml`.


rule design:
    input:
        file=design_input,
        points=design_points,
        texts=["src/gelpump/design/schema.yaml", "src/gelpump/design/sheet.html.j2"],
        src=modules("design"),
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
        measured=design_measured,
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
