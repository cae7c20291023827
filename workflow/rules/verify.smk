# What a build consists of, and whether it is still that.
PRODUCTS = [
    *MATERIALS,
    *BEADS,
    *TUBES,
    *SENSITIVITIES,
    *FIGURES,
    *SEPARATED,
    *TABLES,
    *rules.statements.output,
    *CHECKS,
    "results/report.html",
    "results/replication.pdf",
]
REFERENCE = {
    "quantities": "workflow/reference/quantities.yaml",
    "values": "workflow/reference/values.json",
}


rule manifest:
    input:
        products=PRODUCTS,
        src=modules("manifest"),
    output:
        "results/manifest.json",
    log:
        "results/logs/manifest.log",
    benchmark:
        "results/benchmarks/manifest.tsv"
    params:
        config=config,
    script:
        "../scripts/manifest.py"


rule ro_crate:
    input:
        manifest="results/manifest.json",
        src=modules("ro_crate"),
    output:
        "results/ro-crate-metadata.json",
    log:
        "results/logs/ro_crate.log",
    benchmark:
        "results/benchmarks/ro_crate.tsv"
    script:
        "../scripts/ro_crate.py"


# The next two take no output of another rule as input: Snakemake would make missing and stale
# outputs again before they are looked at, and what depends on an altered one with them.  They
# declare no output either, so that they run whenever they are asked for.
rule verify:
    input:
        src=modules("verify"),
    log:
        "results/logs/verify.log",
    params:
        **REFERENCE,
        blocks=config_blocks,
    script:
        "../scripts/verify.py"


# On purpose only, after a look at what `verify` says: rewrites workflow/reference/values.json.
rule renew_reference:
    input:
        src=modules("renew_reference"),
    log:
        "results/logs/renew_reference.log",
    params:
        **REFERENCE,
        blocks=config_blocks,
    script:
        "../scripts/renew_reference.py"


# On purpose only, on a quiet machine after a build of everything: renews the seconds that readers
# are shown, the README's map and verdict, and its picture.
rule renew_map:
    input:
        src=modules("renew_map"),
    log:
        "results/logs/renew_map.log",
    params:
        ends=ends_of_the_build,
        seconds="workflow/reference/seconds.json",
        readme="README.md",
        models="docs/map.md",
        published=config["published"],
        picture="results/figures/fig06_tube_schematic.png",
        shown="docs/pump.png",
    script:
        "../scripts/renew_map.py"
