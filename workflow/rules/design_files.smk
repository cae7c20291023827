# Which designs there are, and what their rule takes from their files.

DESIGNS = {file.stem: file for file in sorted(Path("config/designs").glob("*.yaml"))}
if config.get("design"):
    DESIGNS[Path(config["design"]).stem] = Path(config["design"])


def design_file(wildcards):
    if wildcards.name not in DESIGNS:
        raise WorkflowError(f"no design {wildcards.name!r}: must be one of {sorted(DESIGNS)}")
    return str(DESIGNS[wildcards.name])


def design_gels(block):
    """The gel that a design names, if it does; the block may be of any kind."""
    named = block.get("gel") if isinstance(block, dict) else None
    return {named: config["gels"][named]} if str(named) in config["gels"] else config["gels"]


def checked_design(wildcards):
    """The block of a design that was checked before any job."""
    from gelpump.design import description

    try:
        block = description.read(design_file(wildcards))
        description.checked(wildcards.name, block, config["gels"])
    except checked.ConfigError as refusal:
        raise WorkflowError(str(refusal))
    return block


def design_input(wildcards):
    """The design's file, once it is known to be one."""
    if workflow.is_main_process:
        checked_design(wildcards)
    return design_file(wildcards)


def design_measured(wildcards):
    """How the design's gel was measured, if it is a measured one."""
    block = checked_design(wildcards)
    return MEASURED.get(str(block.get("gel")), {}) if isinstance(block, dict) else {}


def design_points(wildcards):
    """The file that the design's gel was fitted to, if it is a measured one."""
    return design_measured(wildcards).get("points", [])
