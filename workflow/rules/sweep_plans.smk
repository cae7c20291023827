# What the rules of a sweep take from its file.
from functools import cache

from gelpump.sweep import plan


def sweep_names(*taken):
    """The sweeps that there are; none may have the name of one of the rules below."""
    found = sorted(path.stem for path in Path("config/sweeps").glob("*.yaml"))
    for name in sorted({*found} & {*taken}):
        raise WorkflowError(
            f"config/sweeps/{name}.yaml: {name!r} must have another name, sweep_{name} is a rule; "
            f"taken: {list(taken)}"
        )
    return found


@cache
def sweep_plan(name):
    try:
        return plan.load(f"config/sweeps/{name}.yaml")
    except checked.ConfigError as refusal:
        raise WorkflowError(str(refusal))


def sweep_params(*keys):
    """What a rule takes of its sweep's file; all of it but the size of the chunks without keys."""
    return lambda wildcards: {
        key: value
        for key, value in sweep_plan(wildcards.sweep).items()
        if (key in keys if keys else key != "chunk")
    }


def sweep_chunks(wildcards):
    count = plan.chunks(sweep_plan(wildcards.sweep))
    return [f"results/sweeps/{wildcards.sweep}/chunks/{i:06d}.nc" for i in range(count)]


def sweep_spacing(wildcards):
    return {
        key: (block.get("spaced") == "log" if isinstance(block, dict) else plan.by_ratios(block))
        for key, block in sweep_plan(wildcards.sweep)["parameters"].items()
    }


def sweep_products(name):
    kinds = ["surface"] + (["bars"] if sweep_plan(name)["method"] == "sobol" else [])
    figures = [f"{kind}.{suffix}" for kind in kinds for suffix in ("pdf", "png", "svg")]
    return [f"results/sweeps/{name}/{file}" for file in ("sweep.nc", "accuracy.nc", *figures)]
