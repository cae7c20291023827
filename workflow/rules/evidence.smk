# Why a number may be believed: a second solver for each equation, and known solutions.

SECOND_BEADS = expand("bead_{case}_{model}", case=config["beads"], model=["lens", "nonlinear"])
CHECKS = [f"{DATA}/second/{bead}.nc" for bead in SECOND_BEADS] + [
    f"{DATA}/second/tube_pulse.nc",
    "results/cross_check.json",
    "results/tables/cross_check.md",
    "results/verification.json",
    "results/tables/verification.md",
    *(f"results/figures/verification.{suffix}" for suffix in ("pdf", "png", "svg")),
]
CROSS_CHECKED = [
    f"{DATA}/{folder}{dataset}.nc"
    for dataset in [*SECOND_BEADS, "tube_pulse"]
    for folder in ["", "refinement/", "second/"]
]


rule second_bead:
    input:
        src=modules("second_bead"),
    output:
        f"{DATA}/second/bead_{{case}}_{{model}}.nc",
    log:
        "results/logs/second_bead_{case}_{model}.log",
    benchmark:
        "results/benchmarks/second_bead_{case}_{model}.tsv"
    wildcard_constraints:
        model="lens|nonlinear",
    priority: 1
    params:
        case=bead_case,
        gel=bead_gel,
        numerics=lambda wildcards: config["numerics"][f"second_bead_{wildcards.model}"],
        output_times=lambda wildcards: config["numerics"][f"bead_{wildcards.model}"]["output_times"],
    script:
        "../scripts/second_bead.py"


rule second_tube_pulse:
    input:
        src=modules("second_tube_pulse"),
    output:
        f"{DATA}/second/tube_pulse.nc",
    log:
        "results/logs/second_tube_pulse.log",
    benchmark:
        "results/benchmarks/second_tube_pulse.tsv"
    priority: 1
    params:
        gel=tube_gel,
        tube=config["tube"],
        ell=config["numerics"]["refine_tube_pulse"]["ell"],
        tau=config["tube_pulse"]["tau"],
        numerics=config["numerics"]["second_tube_pulse"],
    script:
        "../scripts/second_tube_pulse.py"


rule cross_check:
    input:
        data=CROSS_CHECKED,
        src=modules("cross_check"),
    output:
        json="results/cross_check.json",
        md=report(
            "results/tables/cross_check.md",
            caption="../report/cross_check.rst",
            category="Evidence",
            labels={"shows": "a second solver"},
        ),
    log:
        "results/logs/cross_check.log",
    benchmark:
        "results/benchmarks/cross_check.tsv"
    params:
        beads=SECOND_BEADS,
        bounds=config["cross_check"],
    script:
        "../scripts/cross_check.py"


rule verification:
    input:
        src=modules("verification"),
    output:
        json="results/verification.json",
        md=report(
            "results/tables/verification.md",
            caption="../report/verification.rst",
            category="Evidence",
            labels={"shows": "known solutions, table"},
        ),
        pdf="results/figures/verification.pdf",
        svg="results/figures/verification.svg",
        png=report(
            "results/figures/verification.png",
            caption="../report/verification.rst",
            category="Evidence",
            labels={"shows": "known solutions, errors"},
        ),
    log:
        "results/logs/verification.log",
    benchmark:
        "results/benchmarks/verification.tsv"
    priority: 2
    script:
        "../scripts/verification.py"
