# gelpump: every figure, table and number of Webber & Montenegro-Johnson (2025), from one command:
#
#   snakemake --cores 2
#
# and whether a build is still what was made, with the numbers that it should have:
#
#   snakemake --cores 2 verify

from snakemake.utils import min_version

min_version("9.0")


configfile: "config/config.yaml"


# no container is used or needed: the line keeps `snakemake --lint` content
container: "docker://python:3.11-slim"


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/materials.smk"
include: "workflow/rules/bead.smk"
include: "workflow/rules/tube.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/separation.smk"
include: "workflow/rules/statements.smk"
include: "workflow/rules/evidence.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/article.smk"
include: "workflow/rules/verify.smk"
include: "workflow/rules/design_files.smk"
include: "workflow/rules/design.smk"
include: "workflow/rules/sweep_plans.smk"
include: "workflow/rules/sweep.smk"
include: "workflow/rules/performance.smk"
include: "workflow/rules/truth.smk"


rule all:
    input:
        PRODUCTS,
        "results/manifest.json",
        "results/ro-crate-metadata.json",


# A job that fails gives back what was there before it: Snakemake restores outputs that it believes
# to be updated, and removes all others before a job begins.  Ours are replaced as a whole.
for each in workflow.rules:
    for file in each.output:
        file.flags["update"] = True


onerror:
    provenance.age_restored()
