# What the paper states, checked against what was computed: claims, ledger and figure numbers.

CLAIM_GELS = ["ANB", "HHT"]
CLAIM_BEADS = ["swelling", "drying", "separating"]
# datasets, below results/data, of the statements beyond the paper
BEYOND = [
    "pump_balance",
    "wall_times",
    "tube_heat",
    "cycle_tube",
    *(Path(file).stem for file in SEPARATED if file.endswith(".nc")),
]
DRAWN_BEADS = {
    case
    for block in config["figures"].values()
    for case in [block.get("case", CLAIM_BEADS[0]), *block.get("cases", [])]
}
EVIDENCE = expand(
    f"{DATA}/{{folder}}bead_{{case}}_{{model}}.nc",
    folder=["", "refinement/"],
    case=CLAIM_BEADS + sorted(DRAWN_BEADS - set(CLAIM_BEADS)),
    model=["lens", "nonlinear"],
) + expand(
    f"{DATA}/{{dataset}}.nc",
    dataset=[
        *(f"materials_{gel}" for gel in dict.fromkeys([*CLAIM_GELS, *ENERGY_GELS])),
        "sensitivity_drying",
        "deswelling_map",
        "deswelling_curves",
        "wall_times",
        "tube_pulse",
        "refinement/tube_pulse",
        "front_fit",
        "tube_flow_whole",
        "water_budget",
        "lumen_pulse",
        *BEYOND,
    ],
)
TRUTH_RECORD = "workflow/reference/truth.json"  # of the last `pump_truth`
VERDICTS = {
    "claims": "statements of the paper, checked",
    "ledger": "where the paper disagrees",
    "figure_numbers": "key numbers of the figures",
    "beyond": "statements beyond the paper",
}


rule statements:
    input:
        data=EVIDENCE,
        truth=TRUTH_RECORD,
        src=modules("statements"),
    output:
        claims="results/claims.json",
        ledger="results/ledger.json",
        beyond="results/beyond.json",
        figure_numbers="results/tables/figure_numbers.json",
        tables=[
            report(
                f"results/tables/{view}.md",
                caption=f"../report/{view}.rst",
                category="Verdicts",
                labels={"shows": shows},
            )
            for view, shows in VERDICTS.items()
        ],
    log:
        "results/logs/statements.log",
    benchmark:
        "results/benchmarks/statements.tsv"
    params:
        **{
            key: config[key]
            for key in (
                "published",
                "tube",
                "scales",
                "figures",
                "beads",
                "tube_flow",
                "lumen_pulse",
            )
        },
        gels={
            name: block
            for name, block in config["gels"].items()
            if name in [*CLAIM_GELS, *ENERGY_GELS, config["tube"]["gel"]]
        },
    script:
        "../scripts/statements.py"
