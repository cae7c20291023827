# What all rules share, beginning with the checked configuration.
import yaml

from gelpump import config as checked

with open(workflow.source_path("../schemas/config.schema.yaml")) as stream:
    schema = yaml.safe_load(stream)
if workflow.is_main_process:
    try:
        for file in workflow.configfiles:
            checked.require_plain(file)
        checked.validate(config, schema)
    except checked.ConfigError as refusal:
        raise WorkflowError(str(refusal))
else:  # a job of a workflow that was checked when it started
    checked.fill_defaults(config, schema)

DATA = "results/data"
ENERGY_GELS = [name for name, block in config["gels"].items() if block["model"] == "energy-based"]


def modules(*names):
    """Files of the gelpump modules that a rule's script imports, directly or not.

    They are inputs, so that an edit reruns what depends on it and nothing else.  A job fails if it
    imported a module that its rule does not list; a test fails if a listed one is not used.
    """
    files = [
        "src/gelpump/__init__.py",
        "src/gelpump/provenance.py",
        "workflow/scripts/_helpers.py",
    ]
    return files + [f"src/gelpump/{name.replace('.', '/')}.py" for name in names]


GEL = [
    "materials/__init__",
    "materials/energy_based",
    "materials/piecewise_linear",
    "materials/validation",
]


def published(*claims):
    """What the paper prints or draws for these claims; a claim without an entry is left out."""
    return {claim: config["published"][claim] for claim in claims if claim in config["published"]}


def bead_case(wildcards):
    return config["beads"][wildcards.case]


def bead_gel(wildcards):
    return config["gels"][config["beads"][wildcards.case]["gel"]]


def tube_gel(wildcards):
    return config["gels"][config["tube"]["gel"]]
