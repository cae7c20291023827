# What the paper states, checked against what was computed.

CLAIM_GELS = ["ANB", "HHT"]
CLAIM_BEADS = ["swelling", "drying", "separating"]


rule claims:
    input:
        data=expand(
            [
                f"{DATA}/bead_{{case}}_{{model}}.nc",
                f"{DATA}/refinement/bead_{{case}}_{{model}}.nc",
            ],
            case=CLAIM_BEADS,
            model=["lens", "nonlinear"],
        )
        + expand(f"{DATA}/materials_{{gel}}.nc", gel=CLAIM_GELS),
        src=modules(
            "netcdf",
            "text",
            "uncertainty",
            *GEL,
            "claims/__init__",
            "claims/finding",
            "claims/verdict",
            "claims/table",
            "claims/materials",
            "claims/beads",
        ),
    output:
        json="results/claims.json",
        md=report(
            "results/tables/claims.md",
            caption="../report/claims.rst",
            category="Claims",
        ),
    log:
        "results/logs/claims.log",
    benchmark:
        "results/benchmarks/claims.tsv"
    params:
        published=config["published"],
        gels={name: config["gels"][name] for name in CLAIM_GELS if name in config["gels"]},
        cases={name: config["beads"][name] for name in CLAIM_BEADS if name in config["beads"]},
    script:
        "../scripts/claims.py"
