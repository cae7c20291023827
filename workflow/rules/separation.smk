# Beads that separate, to the end (beyond the paper).  The case `separating` of figure 5 and two
# figures are part of a rebuild; further cases: `snakemake --cores 2 separation`.

SEPARATION = config["separation"]
SEPARATION_GEL = SEPARATION["coexistence"]["gel"]
FRONTS = expand(
    f"{DATA}/separation_{{case}}_{{model}}.nc",
    case=SEPARATION["drawn"],
    model=["nonlinear", "lens"],
)
SEPARATED = [
    *FRONTS,
    f"{DATA}/coexistence_{SEPARATION_GEL}.nc",
    f"{DATA}/cycle_beads.nc",
]


rule separation:
    input:
        SEPARATED,
        expand(
            f"{DATA}/separation_{{case}}_{{model}}.nc",
            case=SEPARATION["cases"],
            model=["nonlinear", "lens"],
        ),
        expand(
            "results/separation/widths_{case}_{model}.nc",
            case=[SEPARATING, *SEPARATION["widths"]["cases"]],
            model=["nonlinear", "lens"],
        ),
        expand("results/separation/figX7_hysteresis.{suffix}", suffix=["pdf", "png", "svg", "csv"]),
    localrule: True


rule cycle_beads:
    input:
        src=modules("cycle_beads"),
    output:
        f"{DATA}/cycle_beads.nc",
    log:
        "results/logs/cycle_beads.log",
    benchmark:
        "results/benchmarks/cycle_beads.tsv"
    priority: 1
    params:
        gels={
            case["gel"]: config["gels"][case["gel"]]
            for case in config["cycles"]["beads"]["cases"].values()
        },
        beads=config["cycles"]["beads"],
    script:
        "../scripts/cycle_beads.py"


rule separation_front:
    input:
        src=modules("separation_front"),
    output:
        f"{DATA}/separation_{{case}}_{{model}}.nc",
    log:
        "results/logs/separation_{case}_{model}.log",
    benchmark:
        "results/benchmarks/separation_{case}_{model}.tsv"
    wildcard_constraints:
        model="nonlinear|lens",
    params:
        case=separation_case,
        gel=lambda wildcards: config["gels"][separation_case(wildcards)["gel"]],
        numerics=SEPARATION["numerics"],
    script:
        "../scripts/separation_front.py"


rule coexistence:
    input:
        src=modules("coexistence"),
    output:
        f"{DATA}/coexistence_{{gel}}.nc",
    log:
        "results/logs/coexistence_{gel}.log",
    benchmark:
        "results/benchmarks/coexistence_{gel}.tsv"
    params:
        gel=lambda wildcards: config["gels"][wildcards.gel],
        view=SEPARATION["coexistence"],
    script:
        "../scripts/coexistence.py"


rule separation_widths:
    input:
        sharp=f"{DATA}/separation_{{case}}_{{model}}.nc",
        src=modules("separation_widths"),
    output:
        "results/separation/widths_{case}_{model}.nc",
    log:
        "results/logs/separation_widths_{case}_{model}.log",
    benchmark:
        "results/benchmarks/separation_widths_{case}_{model}.tsv"
    wildcard_constraints:
        model="nonlinear|lens",
    params:
        case=separation_case,
        gel=lambda wildcards: config["gels"][separation_case(wildcards)["gel"]],
        widths=SEPARATION["widths"],
        second=lambda wildcards: (wildcards.case, wildcards.model) == (SEPARATING, "lens"),
    script:
        "../scripts/separation_widths.py"


rule separation_hysteresis:
    input:
        src=modules("separation_hysteresis"),
    output:
        "results/separation/hysteresis_{gel}.nc",
    log:
        "results/logs/separation_hysteresis_{gel}.log",
    benchmark:
        "results/benchmarks/separation_hysteresis_{gel}.tsv"
    params:
        gel=lambda wildcards: config["gels"][wildcards.gel],
        loop=lambda wildcards: SEPARATION["loops"][wildcards.gel],
    script:
        "../scripts/separation_hysteresis.py"


rule figX7_hysteresis:
    input:
        loops=expand("results/separation/hysteresis_{gel}.nc", gel=SEPARATION["loops"]),
        src=modules("figX7_hysteresis"),
    output:
        expand("results/separation/figX7_hysteresis.{suffix}", suffix=["pdf", "png", "svg", "csv"]),
    log:
        "results/logs/figX7_hysteresis.log",
    script:
        "../scripts/figX7_hysteresis.py"
