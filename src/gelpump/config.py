"""The configuration: defaults from its JSON schema, and every refusal before any job runs.

A refusal names the key as a path (``beads.drying.gel``), the value given and what is allowed.
"""

import sys
from argparse import ArgumentParser
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from gelpump import config_physics

DEEPEST, LARGEST = 20, 20_000  # nesting and number of values of a file; ours has 5 and some 600
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
    _refuse(config_physics.problems(config))


def _refuse(problems: Iterator[str]) -> None:
    found = list(problems)
    if found:
        raise ConfigError("the configuration is refused:\n  " + "\n  ".join(found))


def value_problems(value: Any, key: str) -> Iterator[str]:
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


def schema_problems(config: Any, schema: Mapping[str, Any]) -> Iterator[str]:
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


def main(paths: Iterable[str]) -> None:
    """Check files before Snakemake, which would run what a template says, sees any of them."""
    for path in paths:
        require_plain(path)
        print(f"{path}: plain")


if __name__ == "__main__":
    main(sys.argv[1:])
