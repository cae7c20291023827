# What all rules share, beginning with the checked configuration.
import json
from pathlib import Path
from types import SimpleNamespace

import gelpump
import yaml

PACKAGE = Path(workflow.basedir).resolve() / "src/gelpump"
if Path(gelpump.__file__).resolve().parent != PACKAGE:
    raise WorkflowError(
        f"gelpump would be imported from {Path(gelpump.__file__).resolve().parent}, which is not"
        f" the code of this folder ({PACKAGE}), so its jobs would run another folder's models."
        " Use an environment of this folder's own (.venv/bin/snakemake, after"
        " python3 -m venv .venv && .venv/bin/pip install -r requirements.txt), and unset"
        " PYTHONPATH if it names another folder."
    )

from gelpump import config as checked
from gelpump import config_physics, imports, launch, provenance

launch.settle()

with open(workflow.source_path("../schemas/config.schema.yaml")) as stream:
    schema = yaml.safe_load(stream)


def fitted_gels():
    """Put what fits them in place of measured gels; how they were measured, by gel.

    What there is to beware of is said once, before any job.
    """
    gels = config.get("gels")
    blocks = gels.values() if isinstance(gels, dict) else []
    if not any(isinstance(each, dict) and each.get("model") == "measured" for each in blocks):
        return {}
    from gelpump.materials import measured

    folders = [".", *(Path(file).parent for file in workflow.configfiles)]
    warn = (lambda text: logger.warning(f"warning: {text}")) if workflow.is_main_process else str
    try:
        return measured.resolve(gels, folders, warn)
    except ValueError as refusal:
        raise checked.ConfigError(f"the configuration is refused:\n  gels.{refusal}")


try:
    launch.complete(workflow, config)
except checked.ConfigError as refusal:
    raise WorkflowError(str(refusal))

if workflow.is_main_process:
    try:
        for file in workflow.configfiles:
            checked.require_plain(file)
        MEASURED = fitted_gels()
        checked.validate(config, schema)
    except checked.ConfigError as refusal:
        raise WorkflowError(str(refusal))
else:  # a job of a workflow that was checked when it started
    checked.fill_defaults(config, schema)
    MEASURED = fitted_gels()

# Priorities of rules: the longest chain of jobs begins first (3), then long jobs (2, 1), so that
# figures and other short ones fill the gaps.
DATA = "results/data"
SCRIPTS = "workflow/scripts"
ENERGY_GELS = config_physics.explicit_gels(config["gels"])


def modules(rule):
    """Files of the gelpump modules that the script of this rule imports, directly or not.

    They are inputs, so that an edit reruns what depends on it and nothing else.  A job fails if it
    imported a module that is not among them.
    """
    return imports.modules(f"{SCRIPTS}/{rule}.py") + [f"{SCRIPTS}/_helpers.py"]


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
    if not rules.has(job["rule"]):
        return None
    made_by = getattr(rules, job["rule"])
    wildcards = SimpleNamespace(**job["wildcards"])
    try:
        block = {k: v(wildcards) if callable(v) else v for k, v in made_by.params.items()}
    except KeyError:  # the configuration has no such case, gel or view any more
        return None
    return provenance.digest(block)


def ends_of_the_build(wildcards):
    """Jobs that only `all` asks for: they make what the manifest does not list."""
    ends = set(rules.all.input) - set(PRODUCTS)
    return sorted(rule.name for rule in workflow.rules if ends & set(map(str, rule.output)))


def published(*claims):
    """What the paper prints or draws for these claims; a claim without an entry is left out."""
    return {claim: config["published"][claim] for claim in claims if claim in config["published"]}


def bead_case(wildcards):
    return config["beads"][wildcards.case]


def bead_gel(wildcards):
    return config["gels"][config["beads"][wildcards.case]["gel"]]


def tube_gel(wildcards):
    return config["gels"][config["tube"]["gel"]]


def measured_points(wildcards):
    """The file that a measured gel was fitted to."""
    return MEASURED.get(wildcards.gel, {}).get("points", [])


def told(name):
    """What page and article tell of the rule of a figure or a table."""
    made_by = getattr(rules, name)
    return {
        "caption": f"workflow/report/{name}.rst",
        "params": dict(made_by.params.items()),
        "data": sorted(str(file) for file in made_by.input if str(file).endswith(".nc")),
        "files": {suffix: str(file) for suffix, file in made_by.output.items()},
    }


def radii_read_off(case):
    """Radii that were read off the paper's figure of this case, by model."""
    verb = {"swelling": "swell", "drying": "dry"}.get(case)
    claimed = {model: f"{verb}-radius-{model}" for model in ("lens", "nonlinear")}
    known = config["published"]
    return {model: known[claim]["value"] for model, claim in claimed.items() if claim in known}


def separation_case(wildcards):
    """A bead of the paper up to another last time, or one of those that are only solved here."""
    if wildcards.case in SEPARATION["drawn"]:
        return config["beads"][wildcards.case] | {"end": SEPARATION["drawn"][wildcards.case]}
    return SEPARATION["cases"][wildcards.case]


def truth_settings(*names):
    """The blocks of config["truth"] that a rule takes, and the tube's gel."""
    return {name: config["truth"][name] for name in names}
