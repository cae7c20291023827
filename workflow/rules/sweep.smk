# Sweeps over the tube's parameters: config/sweeps/NAME.yaml is `snakemake --cores 2 sweep_NAME`.
# A file is read when its sweep is asked for, and only then.

import sys

SWEEPS = sweep_names("designs", "chunk", "combine", "accuracy", "indices", "surface", "bars")


wildcard_constraints:
    sweep="[A-Za-z0-9_.-]+",
    chunk="[0-9]+",


localrules:
    sweep_designs,
    sweep_combine,
    sweep_surface,
    sweep_indices,
    sweep_bars,


for _name in SWEEPS:

    rule:
        name:
            f"sweep_{_name}"
        input:
            lambda wildcards, name=_name: sweep_products(name),
        localrule: True


rule sweep_designs:
    input:
        src=modules("sweep_designs"),
    output:
        "results/sweeps/{sweep}/designs.nc",
    log:
        "results/logs/sweep_{sweep}_designs.log",
    params:
        sweep=sweep_params("method", "parameters", "fixed", "samples", "seed"),
    script:
        "../scripts/sweep_designs.py"


rule sweep_chunk:
    input:
        designs="results/sweeps/{sweep}/designs.nc",
        src=modules("sweep_chunk"),
    output:
        "results/sweeps/{sweep}/chunks/{chunk}.nc",
    log:
        "results/logs/sweep_{sweep}/{chunk}.log",
    params:
        sweep=sweep_params("tau", "numerics"),
        error=lambda wildcards: sweep_plan(wildcards.sweep)["accuracy"]["error"],
        size=lambda wildcards: sweep_plan(wildcards.sweep)["chunk"],
    script:
        "../scripts/sweep_chunk.py"


rule sweep_combine:
    input:
        chunks=sweep_chunks,
        src=modules("sweep_combine"),
    output:
        "results/sweeps/{sweep}/sweep.nc",
    log:
        "results/logs/sweep_{sweep}_combine.log",
    params:
        sweep=sweep_params(),
        designs=lambda wildcards: plan.designs(sweep_plan(wildcards.sweep)),
    script:
        "../scripts/sweep_combine.py"


rule sweep_accuracy:
    input:
        sweep="results/sweeps/{sweep}/sweep.nc",
        src=modules("sweep_accuracy"),
    output:
        "results/sweeps/{sweep}/accuracy.nc",
    log:
        "results/logs/sweep_{sweep}_accuracy.log",
    params:
        sweep=sweep_params("tau", "numerics", "accuracy", "seed"),
    script:
        "../scripts/sweep_accuracy.py"


rule sweep_indices:
    input:
        sweep="results/sweeps/{sweep}/sweep.nc",
        src=modules("sweep_indices"),
    output:
        "results/sweeps/{sweep}/indices.nc",
    log:
        "results/logs/sweep_{sweep}_indices.log",
    params:
        sweep=sweep_params("method", "parameters", "fixed", "samples", "seed"),
    script:
        "../scripts/sweep_indices.py"


rule sweep_surface:
    input:
        sweep="results/sweeps/{sweep}/sweep.nc",
        src=modules("sweep_surface"),
    output:
        multiext("results/sweeps/{sweep}/surface", ".pdf", ".png", ".svg"),
    log:
        "results/logs/sweep_{sweep}_surface.log",
    params:
        varied=sweep_spacing,
        most=100_000,
    script:
        "../scripts/sweep_surface.py"


rule sweep_bars:
    input:
        indices="results/sweeps/{sweep}/indices.nc",
        src=modules("sweep_bars"),
    output:
        multiext("results/sweeps/{sweep}/bars", ".pdf", ".png", ".svg"),
    log:
        "results/logs/sweep_{sweep}_bars.log",
    script:
        "../scripts/sweep_bars.py"


# What sweeps cost, measured; not part of a build, since nothing measured repeats to the byte.
MEASURED_SWEEPS = "results/benchmarks/sweeps/measured.json"


rule measure_sweeps:
    output:
        MEASURED_SWEEPS,
    log:
        "results/logs/measure_sweeps.log",
    params:
        python=sys.executable,
    shell:
        "OMP_NUM_THREADS=1 {params.python:q} -m benchmarks.sweeps measure {output:q} > {log:q} 2>&1"


rule costs_of_sweeps:
    input:
        MEASURED_SWEEPS,
    log:
        "results/logs/costs_of_sweeps.log",
    params:
        python=sys.executable,
    shell:
        "{params.python:q} -m benchmarks.sweeps page {input:q} docs > {log:q} 2>&1"
