# Energy-based derivation of the LENS parameters (appendix A).

MATERIALS = expand(f"{DATA}/materials_{{gel}}.nc", gel=ENERGY_GELS)


rule materials:
    input:
        src=modules("netcdf", "materials/tables", *GEL),
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
