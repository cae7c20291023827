# Beads that separate, to the end (beyond the paper).  The case `separating` of figure 5 and two
# figures are part of a rebuild; further cases: `snakemake --cores 2 separation`.

SEPARATION = config["separation"]
SEPARATION_GEL = SEPARATION["coexistence"]["gel"]
DRAWN = next(iter(SEPARATION["drawn"]))
FRONTS = expand(
    f"{DATA}/separation_{{case}}_{{model}}.nc",
    case=SEPARATION["drawn"],
    model=["nonlinear", "lens"],
)
SEPARATED = [
    *FRONTS,
    f"{DATA}/coexistence_{SEPARATION_GEL}.nc",
    *expand(
        "results/separation/{figure}.{suffix}",
        figure=["figX5_front", "figX6_coexistence"],
        suffix=["pdf", "png", "svg", "csv"],
    ),
]


rule separation:
    input:
        SEPARATED,
        "results/separation/widths.nc",
        expand(
            f"{DATA}/separation_{{case}}_{{model}}.nc",
            case=SEPARATION["cases"],
            model=["nonlinear", "lens"],
        ),
    localrule: True


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


rule figX5_front:
    input:
        nonlinear=f"{DATA}/separation_{DRAWN}_nonlinear.nc",
        lens=f"{DATA}/separation_{DRAWN}_lens.nc",
        src=modules("figX5_front"),
    output:
        expand("results/separation/figX5_front.{suffix}", suffix=["pdf", "png", "svg", "csv"]),
    log:
        "results/logs/figX5_front.log",
    benchmark:
        "results/benchmarks/figX5_front.tsv"
    script:
        "../scripts/figX5_front.py"


rule figX6_coexistence:
    input:
        material=f"{DATA}/materials_{SEPARATION_GEL}.nc",
        phases=f"{DATA}/coexistence_{SEPARATION_GEL}.nc",
        src=modules("figX6_coexistence"),
    output:
        expand("results/separation/figX6_coexistence.{suffix}", suffix=["pdf", "png", "svg", "csv"]),
    log:
        "results/logs/figX6_coexistence.log",
    benchmark:
        "results/benchmarks/figX6_coexistence.tsv"
    script:
        "../scripts/figX6_coexistence.py"


rule separation_widths:
    input:
        sharp=f"{DATA}/separation_{DRAWN}_nonlinear.nc",
        src=modules("separation_widths"),
    output:
        "results/separation/widths.nc",
    log:
        "results/logs/separation_widths.log",
    benchmark:
        "results/benchmarks/separation_widths.tsv"
    params:
        case=config["beads"][DRAWN] | {"end": SEPARATION["drawn"][DRAWN]},
        gel=config["gels"][config["beads"][DRAWN]["gel"]],
        widths=SEPARATION["widths"],
    script:
        "../scripts/separation_widths.py"
