"""The configuration: defaults from its JSON schema, and every refusal before any job runs.

A refusal names the key as a path (``beads.drying.gel``), the value given and what is allowed.
"""

import sys
import warnings
from argparse import ArgumentParser
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

THICK = 0.5  # a slenderness that is of order one
DEEPEST, LARGEST = 20, 20_000  # nesting and number of values of a file; ours has 5 and some 600
VALUES = 100_000_000  # of one variable of a dataset
PLAIN = ("map", "seq", "str", "int", "float", "bool", "null")


class ConfigError(ValueError):
    """Some keys of the configuration are refused; the message lists them all, one a line."""


def require_plain(path: str | Path) -> None:
    """Refuse a YAML or JSON file that does not mean what it seems to, without running any of it.

    Snakemake's own loader takes the last of several equal keys, runs Python in templates
    (``__use_yte__``), and follows aliases however large they make the whole.  Raises ConfigError.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, ValueError) as problem:
        raise ConfigError(f"{path}: cannot be read: {problem}") from problem
    require_plain_text(text, str(path))


def require_plain_text(text: str, where: str) -> Any:
    """The value of a YAML text, refused as by `require_plain` if it is not plain."""
    import yaml

    try:
        root = yaml.compose(text, Loader=yaml.SafeLoader)
    except (ValueError, yaml.YAMLError, RecursionError) as problem:
        raise ConfigError(f"{where}: cannot be read: {problem}") from problem
    if root is not None:
        _refuse(f"{where}: {problem}" for problem in _node_problems(root))
    return yaml.safe_load(text)


def require_plain_arguments(arguments: Sequence[str] | None = None) -> None:
    """Refuse the configuration files of a command line, by default that of this process.

    profiles/default calls this: Snakemake reads a profile before any configuration, and those
    before the Snakefile, when their templates have run.  SystemExit with the reason.
    """
    parser = ArgumentParser(add_help=False)
    parser.add_argument("--configfile", "--configfiles", nargs="*", action="extend", default=[])
    parser.add_argument("--config", nargs="*")
    for file in parser.parse_known_args(arguments)[0].configfile:
        try:
            require_plain(file)
        except ConfigError as refusal:
            raise SystemExit(str(refusal)) from None


def _node_problems(root) -> Iterator[str]:
    pending, visited = [(root, "", 0)], 0
    while pending:
        node, key, depth = pending.pop()
        visited += 1
        where = f"{key or 'the file'} (line {node.start_mark.line + 1})"
        if depth > DEEPEST or visited > LARGEST:
            yield f"{where}: more than {LARGEST} values, or nested deeper than {DEEPEST}"
            return
        kind = node.tag.removeprefix("tag:yaml.org,2002:")
        if kind not in PLAIN:
            yield f"{where}: {kind!r} values are not allowed; only {', '.join(PLAIN)}"
        elif kind == "seq":
            pending += [(item, f"{key}[{i}]", depth + 1) for i, item in enumerate(node.value)]
        elif kind == "map":
            seen = set()
            for name, value in node.value:
                path = f"{key}.{name.value}".lstrip(".")
                if name.tag != "tag:yaml.org,2002:str":
                    yield f"{where}: the key {name.value!r} is not a string"
                elif name.value == "__use_yte__":
                    yield f"{where}: templates (__use_yte__) can run code and are not allowed"
                elif name.value in seen:
                    yield f"{path} (line {name.start_mark.line + 1}): given twice"
                else:
                    seen.add(name.value)
                    pending.append((value, path, depth + 1))


def fill_defaults(config: dict[str, Any], schema: Mapping[str, Any]) -> None:
    """Put the schema's defaults where ``config`` has no value, in place."""
    for key, rule in schema.get("properties", {}).items():
        if key not in config and "default" in rule:
            default = rule["default"]
            config[key] = default.copy() if isinstance(default, dict | list) else default
        if isinstance(config.get(key), dict):
            fill_defaults(config[key], rule)
    anything_else = schema.get("additionalProperties")
    if isinstance(anything_else, Mapping):
        for key, value in config.items():
            if key not in schema.get("properties", {}) and isinstance(value, dict):
                fill_defaults(value, anything_else)


def validate(config: dict[str, Any], schema: Mapping[str, Any]) -> None:
    """Check ``config`` against the schema, fill in its defaults, then check the physics.

    Raises ConfigError.
    """
    _refuse(value_problems(config, ""))
    _refuse(schema_problems(config, schema))
    fill_defaults(config, schema)
    _refuse(_physical_problems(config))


def _refuse(problems: Iterator[str]) -> None:
    found = list(problems)
    if found:
        raise ConfigError("the configuration is refused:\n  " + "\n  ".join(found))


def value_problems(value, key) -> Iterator[str]:
    """Keys that are not strings, and numbers that a float cannot hold."""
    if isinstance(value, dict):
        for name, each in value.items():
            if isinstance(name, str):
                yield from value_problems(each, f"{key}.{name}".lstrip("."))
            else:
                yield f"{key or 'the configuration'}: the key {name!r} is not a string"
    elif isinstance(value, list):
        for i, each in enumerate(value):
            yield from value_problems(each, f"{key}[{i}]")
    elif isinstance(value, int | float) and not abs(value) <= sys.float_info.max:
        yield f"{key} = {str(value)[:20]}: must be a finite number"


def schema_problems(config, schema) -> Iterator[str]:
    """What a JSON schema refuses, in words: key, value and what is allowed."""
    from jsonschema import Draft202012Validator

    errors = Draft202012Validator(schema).iter_errors(config)
    for error in sorted(errors, key=lambda e: [str(part) for part in e.absolute_path]):
        key = ".".join(str(part) for part in error.absolute_path)
        allowed = error.validator_value
        match error.validator:
            case "additionalProperties":
                known = sorted(error.schema["properties"])
                for name in sorted(set(error.instance) - set(known), key=str):
                    path = f"{key}.{name}" if key else name
                    yield f"{path} = {error.instance[name]!r}: no such key; allowed: {known}"
            case "required":
                missing = [name for name in allowed if name not in error.instance]
                yield f"{key or 'the configuration'}: missing {missing}"
            case "enum":
                yield f"{key} = {error.instance!r}: must be one of {allowed}"
            case "type":
                yield f"{key} = {error.instance!r}: must be of type {allowed}"
            case _:
                yield f"{key} = {error.instance!r}: {error.validator} {allowed}"


def _physical_problems(config) -> Iterator[str]:
    from gelpump.materials import from_config

    gels = {}
    for name, block in config["gels"].items():
        try:
            gels[name] = from_config(name, block)
        except ValueError as refusal:
            yield f"gels.{refusal}"
    temperatures = config["materials"]["temperatures"]
    if any(b <= a for a, b in pairwise(temperatures)):
        yield f"materials.temperatures = {temperatures}: must increase"
    for case, block in config["beads"].items():
        yield from _bead_problems(f"beads.{case}", block, gels, config["gels"])
    yield from _tube_problems(config)
    yield from _choice_problems(config)
    yield from _published_problems(config)


def explicit_gels(blocks: Mapping[str, Any]) -> list[str]:
    """Names of the gels that have a free energy, so that T(phi) is explicit."""
    return [n for n, b in blocks.items() if b["model"] in ("energy-based", "flory-rehner")]


def _bead_problems(key, block, gels, blocks) -> Iterator[str]:
    from gelpump.bead.production import initial_polymer_fraction

    energy_based = sorted(explicit_gels(blocks))
    name = block["gel"]
    if name not in energy_based:
        yield f"{key}.gel = {name!r}: must be one of the energy-based gels {energy_based}"
        return
    if name not in gels:  # refused above
        return
    gel = gels[name]
    lowest, highest = gel.temperature_range
    outside = False
    for end in ("temperature_initial", "temperature_final"):
        if not lowest <= block[end] <= highest:
            outside = True
            yield (
                f"{key}.{end} = {block[end]}: must be within gels.{name}.temperature_range, "
                f"{lowest} to {highest} K"
            )
    if not outside:
        try:
            initial_polymer_fraction(gel, block)
        except ValueError as refusal:
            yield f"{key}: no initial state: {refusal}"
    for times in ("published_times", "profile_times"):
        late = [t for t in block[times] if t > block["end"]]
        if late:
            yield f"{key}.{times} = {late}: must not lie after {key}.end = {block['end']}"


def _tube_problems(config) -> Iterator[str]:
    linear = sorted(n for n, b in config["gels"].items() if b["model"] == "piecewise-linear")
    tube, pulse = config["tube"], config["tube_pulse"]
    refined = config["numerics"]["refine_tube_pulse"]
    if tube["gel"] not in linear:
        yield f"tube.gel = {tube['gel']!r}: must be one of the piecewise-linear gels {linear}"
    elif not config["gels"][tube["gel"]]["Phi_inf"] > 1:
        Phi_inf = config["gels"][tube["gel"]]["Phi_inf"]
        yield f"gels.{tube['gel']}.Phi_inf = {Phi_inf}: must be greater than 1 in a tube"
    if tube["eps"] >= THICK:
        message = f"tube.eps = {tube['eps']} is of order one: the slender tube needs eps^2 << 1"
        warnings.warn(message, stacklevel=2)
    increasing = {
        "deswelling_map.M": config["deswelling_map"]["M"],
        "deswelling_map.Pi_ratio": config["deswelling_map"]["Pi_ratio"],
        "deswelling_map.compared_ell": config["deswelling_map"]["compared_ell"],
        "deswelling_map.Phi_inf": config["deswelling_map"]["Phi_inf"],
        "deswelling_curves.ell": config["deswelling_curves"]["ell"],
        "tube_pulse.ell": pulse["ell"],
        "tube_pulse.law_range": pulse["law_range"],
        "tube_pulse.tau": pulse["tau"],
        "tube_pulse.tau_range": pulse["tau_range"],
        "front_fit.windows": config["front_fit"]["windows"],
        "lumen_pulse.tau": config["lumen_pulse"]["tau"],
        "lumen_pulse.A": config["lumen_pulse"]["A"],
        "lumen_pulse.Z": config["lumen_pulse"]["Z"],
        "numerics.refine_tube_pulse.ell": refined["ell"],
        "numerics.refine_tube_pulse.tau": refined["tau"],
    }
    chosen = {
        "numerics.refine_tube_pulse": refined,
        "front_fit": config["front_fit"],
        "lumen_pulse": config["lumen_pulse"],
        **{f"tube_flow.{name}": view for name, view in config["tube_flow"].items()},
    }
    for key, values in increasing.items():
        if any(b <= a for a, b in pairwise(values)):
            yield f"{key} = {values}: must increase"
    tubes, times = len(pulse["ell"]) + pulse["law_count"], len(pulse["tau"]) + pulse["tau_count"]
    values = tubes * times * 2 * sum(config["numerics"]["tube_pulse"]["cells"])
    if values > VALUES:
        yield (
            f"tube_pulse.law_count = {pulse['law_count']}, tube_pulse.tau_count = "
            f"{pulse['tau_count']}, numerics.tube_pulse.cells: {values} values are too many, "
            f"at most {VALUES}"
        )
    solved = {"ell": pulse["ell"], "tau": sorted({*pulse["tau"], *pulse["tau_range"]})}
    for name, block in chosen.items():
        for key, allowed in solved.items():
            value = block.get(key, [])
            for each in value if isinstance(value, list) else [value]:
                if each not in allowed:
                    yield f"{name}.{key} = {each}: must be one of tube_pulse's, {allowed}"


def _choice_problems(config) -> Iterator[str]:
    """Figures and tables may only name gels, cases, temperatures, views and tubes that exist."""
    pulse = config["tube_pulse"]
    known = {
        "view": sorted(config["tube_flow"]),
        "ell": pulse["ell"],
        "tau": sorted({*pulse["tau"], *pulse["tau_range"]}),
        "gel": sorted(explicit_gels(config["gels"])),
        "case": sorted(config["beads"]),
        "temperature": config["materials"]["temperatures"],
    }
    blocks = {
        f"{kind}.{name}": b for kind in ("figures", "tables") for name, b in config[kind].items()
    }
    blocks["sensitivity"] = config["sensitivity"]
    for name, block in blocks.items():
        for key, value in block.items():
            allowed = known.get(key.removesuffix("s"))
            for each in value if isinstance(value, list) else [value]:
                if allowed is not None and each not in allowed:
                    yield f"{name}.{key} = {each!r}: must be one of {allowed}"
        gel = config["gels"].get(block.get("gel"), {})
        lowest, highest = gel.get("temperature_range", (0.0, sys.float_info.max))
        for each in block.get("temperatures", []):
            if not lowest <= each <= highest:
                yield (
                    f"{name}.temperatures = {each}: must be within "
                    f"gels.{block['gel']}.temperature_range, {lowest} to {highest} K"
                )


def _published_problems(config) -> Iterator[str]:
    """Radii that were read off a figure need a time each, unless no time is compared at all; where
    each value has a resolution, there are as many."""
    for claim, block in config["published"].items():
        value, resolution = block["value"], block.get("resolution")
        many = value if isinstance(value, list) else []
        if isinstance(resolution, list) and len(resolution) != len(many):
            yield f"published.{claim}.resolution = {resolution}: must be one number, or one a value"
    for verb, case in (("swell", "swelling"), ("dry", "drying")):
        times = config["beads"][case]["published_times"] if case in config["beads"] else []
        for model in ("lens", "nonlinear"):
            claim = f"{verb}-radius-{model}"
            values = config["published"].get(claim, {"value": times})["value"]
            if times and not (isinstance(values, list) and len(values) == len(times)):
                yield (
                    f"published.{claim}.value = {values}: must have one value for each of "
                    f"beads.{case}.published_times = {times}"
                )


def main(paths: Iterable[str]) -> None:
    """Check files before Snakemake, which would run what a template says, sees any of them."""
    for path in paths:
        require_plain(path)
        print(f"{path}: plain")


if __name__ == "__main__":
    main(sys.argv[1:])
