# What the paper states, checked against what was computed, and where it disagrees with itself.

CLAIM_GELS = ["ANB", "HHT"]
CLAIM_BEADS = ["swelling", "drying", "separating"]
EVIDENCE = (
    expand(
        [
            f"{DATA}/bead_{{case}}_{{model}}.nc",
            f"{DATA}/refinement/bead_{{case}}_{{model}}.nc",
        ],
        case=CLAIM_BEADS,
        model=["lens", "nonlinear"],
    )
    + expand(f"{DATA}/materials_{{gel}}.nc", gel=CLAIM_GELS)
    + expand(
        f"{DATA}/{{dataset}}.nc",
        dataset=[
            "deswelling_map",
            "deswelling_curves",
            "tube_pulse",
            "refinement/tube_pulse",
            "front_fit",
            "water_budget",
            "lumen_pulse",
        ],
    )
)
DRAWN_BEADS = {
    case
    for block in config["figures"].values()
    for case in [block.get("case", CLAIM_BEADS[0]), *block.get("cases", [])]
}
DRAWN_BEADS_DATA = expand(
    [f"{DATA}/{{folder}}bead_{{case}}_{{model}}.nc"],
    folder=["", "refinement/"],
    case=sorted(DRAWN_BEADS - set(CLAIM_BEADS)),
    model=["lens", "nonlinear"],
)
CLAIMED_GELS = {name: config["gels"][name] for name in CLAIM_GELS if name in config["gels"]}
CLAIMED_BEADS = {name: config["beads"][name] for name in CLAIM_BEADS if name in config["beads"]}


rule claims:
    input:
        data=list(dict.fromkeys(EVIDENCE + MATERIALS + DRAWN_BEADS_DATA)),
        src=modules("claims"),
    output:
        json="results/claims.json",
        numbers="results/tables/figure_numbers.json",
        numbers_md=report(
            "results/tables/figure_numbers.md",
            caption="../report/figure_numbers.rst",
            category="Verdicts",
            labels={"shows": "key numbers of the figures"},
        ),
        md=report(
            "results/tables/claims.md",
            caption="../report/claims.rst",
            category="Verdicts",
            labels={"shows": "statements of the paper, checked"},
        ),
    log:
        "results/logs/claims.log",
    benchmark:
        "results/benchmarks/claims.tsv"
    params:
        published=config["published"],
        gels=CLAIMED_GELS,
        cases=CLAIMED_BEADS,
        scales=config["scales"],
        drawn_gels={name: config["gels"][name] for name in ENERGY_GELS},
        shown={key: config[key] for key in ("figures", "beads", "tube_flow", "lumen_pulse")},
    script:
        "../scripts/claims.py"


rule ledger:
    input:
        data=EVIDENCE + [f"{DATA}/sensitivity_drying.nc", f"{DATA}/tube_flow_whole.nc"],
        src=modules("ledger"),
    output:
        json="results/ledger.json",
        md=report(
            "results/tables/ledger.md",
            caption="../report/ledger.rst",
            category="Verdicts",
            labels={"shows": "where the paper disagrees"},
        ),
    log:
        "results/logs/ledger.log",
    benchmark:
        "results/benchmarks/ledger.tsv"
    params:
        published=config["published"],
        gels=CLAIMED_GELS,
        cases=CLAIMED_BEADS,
        tube={**config["tube"], "M": config["gels"][config["tube"]["gel"]]["M"]},
        scales=config["scales"],
    script:
        "../scripts/ledger.py"
