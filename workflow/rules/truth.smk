# The tube in two dimensions, and how good the slender one is: `snakemake --cores 2 pump_truth`.
# Needs requirements-truth.txt; no part of a rebuild.

TRUTH = "results/truth"


rule pump_truth:
    input:
        expand(f"{TRUTH}/{{name}}.nc", name=["waves", "verification", "slenderness"]),
        expand(
            f"{TRUTH}/{{figure}}.{{suffix}}",
            figure=["figX3_slenderness", "figX3_fields"],
            suffix=["pdf", "png", "svg", "csv"],
        ),
        f"{TRUTH}/statements.md",
    localrule: True


rule truth_waves:
    input:
        src=modules("truth_waves"),
    output:
        f"{TRUTH}/waves.nc",
    log:
        "results/logs/truth_waves.log",
    benchmark:
        "results/benchmarks/truth_waves.tsv"
    params:
        gel=tube_gel,
        settings=truth_settings("ell", "M", "waves", "verified"),
    script:
        "../scripts/truth_waves.py"


rule truth_pulses:
    input:
        src=modules("truth_pulses"),
    output:
        f"{TRUTH}/pulses.nc",
    log:
        "results/logs/truth_pulses.log",
    benchmark:
        "results/benchmarks/truth_pulses.tsv"
    priority: 3
    params:
        gel=tube_gel,
        Le=config["tube"]["Le"],
        settings=truth_settings("pulses"),
    script:
        "../scripts/truth_pulses.py"


rule truth_walls:
    input:
        src=modules("truth_walls"),
    output:
        f"{TRUTH}/walls.nc",
    log:
        "results/logs/truth_walls.log",
    benchmark:
        "results/benchmarks/truth_walls.tsv"
    priority: 2
    params:
        gel=tube_gel,
        settings=truth_settings("ell", "M", "walls"),
    script:
        "../scripts/truth_walls.py"


rule truth_verification:
    input:
        src=modules("truth_verification"),
    output:
        f"{TRUTH}/verification.nc",
    log:
        "results/logs/truth_verification.log",
    benchmark:
        "results/benchmarks/truth_verification.tsv"
    params:
        gel=tube_gel,
        bead_gel=config["gels"].get(config["truth"]["bead"]["gel"]),
        settings=truth_settings("bead", "verified"),
    script:
        "../scripts/truth_verification.py"


rule slenderness:
    input:
        pulses=f"{TRUTH}/pulses.nc",
        walls=f"{TRUTH}/walls.nc",
        src=modules("slenderness"),
    output:
        f"{TRUTH}/slenderness.nc",
    log:
        "results/logs/slenderness.log",
    benchmark:
        "results/benchmarks/slenderness.tsv"
    params:
        gel=tube_gel,
    script:
        "../scripts/slenderness.py"


rule figX3_slenderness:
    input:
        slenderness=f"{TRUTH}/slenderness.nc",
        src=modules("figX3_slenderness"),
    output:
        expand(f"{TRUTH}/figX3_slenderness.{{suffix}}", suffix=["pdf", "png", "svg", "csv"]),
    log:
        "results/logs/figX3_slenderness.log",
    script:
        "../scripts/figX3_slenderness.py"


rule figX3_fields:
    input:
        pulses=f"{TRUTH}/pulses.nc",
        waves=f"{TRUTH}/waves.nc",
        slenderness=f"{TRUTH}/slenderness.nc",
        src=modules("figX3_fields"),
    output:
        expand(f"{TRUTH}/figX3_fields.{{suffix}}", suffix=["pdf", "png", "svg", "csv"]),
    log:
        "results/logs/figX3_fields.log",
    script:
        "../scripts/figX3_fields.py"


rule truth_statements:
    input:
        data=expand(
            f"{TRUTH}/{{name}}.nc",
            name=["waves", "pulses", "walls", "verification", "slenderness"],
        ),
        src=modules("truth_statements"),
    output:
        table=f"{TRUTH}/statements.md",
        records=f"{TRUTH}/statements.json",
    log:
        "results/logs/truth_statements.log",
    script:
        "../scripts/truth_statements.py"


# On purpose only, after `pump_truth`: rewrites the record that each build's statements are from.
rule record_truth:
    input:
        src=modules("record_truth"),
    log:
        "results/logs/record_truth.log",
    params:
        record=TRUTH_RECORD,
        folder=TRUTH,
    script:
        "../scripts/record_truth.py"
