# Energy-based derivation of the LENS parameters (appendix A).

MATERIALS = expand(f"{DATA}/materials_{{gel}}.nc", gel=ENERGY_GELS)


rule materials:
    input:
        points=measured_points,
        src=modules("materials"),
    output:
        f"{DATA}/materials_{{gel}}.nc",
    log:
        "results/logs/materials_{gel}.log",
    benchmark:
        "results/benchmarks/materials_{gel}.tsv"
    params:
        gel=lambda wildcards: config["gels"][wildcards.gel],
        tables=config["materials"],
    script:
        "../scripts/materials.py"


# Your gel: `snakemake --cores 2 gel_NAME` for any gel of the configuration with a free energy, or a measured one.


rule gel:
    input:
        points=measured_points,
        src=modules("gel"),
    output:
        data="results/gels/{gel}.nc",
        table="results/gels/{gel}.csv",
        figure=expand("results/gels/{{gel}}.{suffix}", suffix=["pdf", "png", "svg"]),
    log:
        "results/logs/gel_{gel}.log",
    benchmark:
        "results/benchmarks/gel_{gel}.tsv"
    params:
        gel=lambda wildcards: config["gels"][wildcards.gel],
        measured=lambda wildcards: MEASURED.get(wildcards.gel, {}),
        tables=config["materials"],
    script:
        "../scripts/gel.py"


for _gel in ENERGY_GELS:

    rule:
        name:
            f"gel_{_gel}"
        input:
            expand("results/gels/{gel}.{suffix}", gel=_gel, suffix=["nc", "csv", "pdf"]),
        localrule: True
