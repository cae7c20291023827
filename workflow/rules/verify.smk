# What a build consists of, and whether it is still that.
import json
from pathlib import Path
from types import SimpleNamespace

from gelpump import provenance

PRODUCTS = [
    *MATERIALS,
    *BEADS,
    *TUBES,
    *SENSITIVITIES,
    *FIGURES,
    *TABLES,
    "results/claims.json",
    "results/tables/claims.md",
    "results/ledger.json",
    "results/tables/ledger.md",
    *CHECKS,
]
VERIFY = [
    "netcdf",
    "text",
    "verify/__init__",
    "verify/problem",
    "verify/manifest",
    "verify/integrity",
    "verify/crate",
    "verify/build",
    "verify/reference",
]
REFERENCE = {
    "quantities": "workflow/reference/quantities.yaml",
    "values": "workflow/reference/values.json",
}


def config_blocks(wildcards):
    """Digest of what each job of the manifest takes from the configuration now.

    None if its rule is gone, or takes something else.  Only called when verify is asked for.
    """
    manifest = Path("results/manifest.json")
    if not manifest.exists():
        return {}
    jobs = json.loads(manifest.read_text(encoding="utf-8"))["jobs"]
    return {name: config_block(job) for name, job in jobs.items()}


def config_block(job):
    made_by = getattr(rules, job["rule"], None)
    if made_by is None:
        return None
    wildcards = SimpleNamespace(**job["wildcards"])
    try:
        block = {k: v(wildcards) if callable(v) else v for k, v in made_by.params.items()}
    except KeyError:  # the configuration has no such case, gel or view any more
        return None
    return provenance.digest(block)


rule manifest:
    input:
        products=PRODUCTS,
        src=modules("netcdf", "text", "verify/__init__", "verify/manifest"),
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
        src=modules("netcdf", "text", "verify/__init__", "verify/crate"),
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
        src=modules(*VERIFY, "verify/conventions", "verify/table"),
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
        src=modules(*VERIFY),
    log:
        "results/logs/renew_reference.log",
    params:
        **REFERENCE,
        blocks=config_blocks,
    script:
        "../scripts/renew_reference.py"
