# Swelling and drying beads (section 2.1) in both models, each together with its refinement.

BEADS = expand(
    [
        f"{DATA}/bead_{{case}}_{{model}}.nc",
        f"{DATA}/refinement/bead_{{case}}_{{model}}.nc",
    ],
    case=config["beads"],
    model=["lens", "nonlinear"],
)
SENSITIVITIES = expand(f"{DATA}/sensitivity_{{case}}.nc", case=config["sensitivity"]["cases"])


wildcard_constraints:
    case="[a-z][a-z0-9]*",


rule bead_lens:
    input:
        src=modules("bead_lens"),
    output:
        bead=f"{DATA}/bead_{{case}}_lens.nc",
        refinement=f"{DATA}/refinement/bead_{{case}}_lens.nc",
    log:
        "results/logs/bead_{case}_lens.log",
    benchmark:
        "results/benchmarks/bead_{case}_lens.tsv"
    priority: 2
    params:
        case=bead_case,
        gel=bead_gel,
        numerics=config["numerics"]["bead_lens"],
    script:
        "../scripts/bead_lens.py"


rule bead_nonlinear:
    input:
        src=modules("bead_nonlinear"),
    output:
        bead=f"{DATA}/bead_{{case}}_nonlinear.nc",
        refinement=f"{DATA}/refinement/bead_{{case}}_nonlinear.nc",
    log:
        "results/logs/bead_{case}_nonlinear.log",
    benchmark:
        "results/benchmarks/bead_{case}_nonlinear.tsv"
    priority: 2
    params:
        case=bead_case,
        gel=bead_gel,
        numerics=config["numerics"]["bead_nonlinear"],
    script:
        "../scripts/bead_nonlinear.py"


rule bead_sensitivity:
    input:
        src=modules("bead_sensitivity"),
    output:
        f"{DATA}/sensitivity_{{case}}.nc",
    log:
        "results/logs/sensitivity_{case}.log",
    benchmark:
        "results/benchmarks/sensitivity_{case}.tsv"
    priority: 2
    params:
        case=bead_case,
        gel=bead_gel,
        numerics=config["numerics"]["bead_nonlinear"],
        half_units=config["sensitivity"]["half_units"],
    script:
        "../scripts/bead_sensitivity.py"
