"""A sweep as its file in config/sweeps describes it: checked, with its number of designs.

method      grid, latin_hypercube or sobol
parameters  what varies: a grid has lists of values, the others `between: [least, largest]`,
            evenly or, with `spaced: log`, in the logarithm
fixed       the rest; what is missing there has the values of table 1
samples     of the latin hypercube; base samples of Sobol's scheme, a power of two
seed        of the random numbers
tau         times at which the tubes are looked at
chunk       designs of one job
numerics    cells behind and ahead of the front, tolerance, reach
accuracy    designs that are solved again on a finer mesh, and the error that is allowed
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import log, prod
from pathlib import Path
from typing import Any

from gelpump.config import ConfigError, require_plain

PARAMETERS = {  # of one tube: default, and what is allowed
    "ell": (0.5, "0 < ell < 1", lambda v: 0 < v < 1),
    "M": (1.0, "M >= 0", lambda v: v >= 0),
    "Pi_ratio": (1.0, "Pi_ratio > 0", lambda v: v > 0),
    "Phi_inf": (2.0, "Phi_inf > 1", lambda v: v > 1),
    "eps": (0.1, "0 < eps < 0.5", lambda v: 0 < v < 0.5),
    "Le": (10.0, "Le > 0", lambda v: v > 0),
}
METHODS = ("grid", "latin_hypercube", "sobol")
DEFAULTS = {
    "samples": 64,
    "seed": 0,
    "chunk": 500,
    "numerics": {"cells": [32, 20], "tolerance": 5.0e-4, "reach": 12.0},
    "accuracy": {"designs": 16, "error": 1.0e-2},
}
KEYS = ("method", "parameters", "fixed", "tau", *DEFAULTS)
MOST = 10_000_000  # designs
WHOLE = {  # keys of whole numbers: least and largest
    "samples": (1, MOST),
    "seed": (0, 2**32 - 1),
    "chunk": (1, 500_000),
}


def load(path: str | Path) -> dict[str, Any]:
    """The checked sweep of a file; ConfigError with key, what was given and what is allowed."""
    import yaml

    require_plain(path)
    with open(path, encoding="utf-8") as stream:
        given = yaml.safe_load(stream)
    problems: list[str] = []
    sweep = checked(given, problems)
    if problems:
        raise ConfigError(f"{path} is refused:\n  " + "\n  ".join(problems))
    return sweep


def designs(sweep: Mapping) -> int:
    """How many tubes there are."""
    if sweep["method"] == "grid":
        return prod(len(values) for values in sweep["parameters"].values())
    if sweep["method"] == "sobol":
        return sweep["samples"] * (len(sweep["parameters"]) + 2)
    return sweep["samples"]


def chunks(sweep: Mapping) -> int:
    """How many jobs solve them."""
    return -(-designs(sweep) // sweep["chunk"])


def by_ratios(values: Sequence[float]) -> bool:
    """Whether a grid's increasing values are spaced by their logarithm rather than evenly."""
    if values[0] <= 0 or len(values) < 3:
        return values[0] > 0 and values[-1] > 10 * values[0]
    evenness = [
        max(steps) / min(steps)
        for steps in (
            [b - a for a, b in pairwise(values)],
            [log(b / a) for a, b in pairwise(values)],
        )
    ]
    return evenness[1] < evenness[0]


def checked(given: Any, problems: list[str]) -> dict[str, Any]:
    """`given` with its defaults; what is wrong is appended to `problems`."""
    if not isinstance(given, Mapping):
        problems.append(f"the file = {given!r}: must be a mapping of {list(KEYS)}")
        return {}
    for key in sorted(set(given) - set(KEYS)):
        problems.append(f"{key} = {given[key]!r}: no such key; allowed: {list(KEYS)}")
    sweep = {**DEFAULTS, "fixed": {}, **{k: v for k, v in given.items() if k in KEYS}}
    for key in ("method", "parameters", "tau"):
        if key not in given:
            problems.append(f"{key}: missing")
    if problems:
        return {}
    if sweep["method"] not in METHODS:
        problems.append(f"method = {sweep['method']!r}: must be one of {list(METHODS)}")
    for key, (least, largest) in WHOLE.items():
        if type(sweep[key]) is not int or not least <= sweep[key] <= largest:
            problems.append(
                f"{key} = {sweep[key]!r}: must be a whole number from {least} to {largest}"
            )
    samples = sweep["samples"]
    if sweep["method"] == "sobol" and type(samples) is int and samples & (samples - 1):
        problems.append(f"samples = {samples}: must be a power of two for sobol")
    tau = sweep["tau"]
    if not (_numbers(tau) and tau and tau[0] > 0 and all(a < b for a, b in pairwise(tau))):
        problems.append(f"tau = {tau!r}: must be a list of positive, increasing numbers")
    _check_parameters(sweep, problems)
    _check_block(sweep, "numerics", problems)
    _check_block(sweep, "accuracy", problems)
    if not problems and (count := designs(sweep)) > MOST:
        problems.append(f"parameters, samples: give {count} designs: at most {MOST} are allowed")
    return sweep


def _check_parameters(sweep, problems):
    for block in ("parameters", "fixed"):
        if not isinstance(sweep[block], Mapping):
            problems.append(f"{block} = {sweep[block]!r}: must be a mapping of {list(PARAMETERS)}")
            return
        for key in sorted(set(sweep[block]) - set(PARAMETERS)):
            problems.append(
                f"{block}.{key} = {sweep[block][key]!r}: no such key; allowed: {list(PARAMETERS)}"
            )
    if not sweep["parameters"]:
        problems.append("parameters = {}: at least one must vary")
    for key in sorted(set(sweep["parameters"]) & set(sweep["fixed"])):
        problems.append(f"fixed.{key} = {sweep['fixed'][key]!r}: varies in parameters.{key}")
    for key, value in sweep["fixed"].items():
        _check_values(f"fixed.{key}", key, [value], problems)
    for key, value in sweep["parameters"].items():
        name = f"parameters.{key}"
        if sweep["method"] == "grid":
            if not _numbers(value) or not value or sorted(set(value)) != list(value):
                problems.append(f"{name} = {value!r}: must be a list of increasing numbers")
                continue
            _check_values(name, key, value, problems)
            continue
        if not isinstance(value, Mapping) or not set(value) <= {"between", "spaced"}:
            problems.append(f"{name} = {value!r}: must have `between` and may have `spaced`")
            continue
        ends = value.get("between")
        if not _numbers(ends) or len(ends) != 2 or not ends[0] < ends[1]:
            problems.append(f"{name}.between = {ends!r}: must be [least, largest]")
            continue
        if value.get("spaced", "evenly") not in ("evenly", "log"):
            problems.append(f"{name}.spaced = {value['spaced']!r}: must be evenly or log")
        if value.get("spaced") == "log" and not ends[0] > 0:
            problems.append(f"{name}.between = {ends!r}: must be positive if spaced by log")
        _check_values(f"{name}.between", key, ends, problems)


def _check_values(name, key, values, problems):
    if key not in PARAMETERS:
        return  # said before
    _, text, allowed = PARAMETERS[key]
    for value in values:
        if not _numbers([value]) or not allowed(value):
            problems.append(f"{name} = {value!r}: must be a number with {text}")


def _check_block(sweep, block, problems):
    given = sweep[block]
    if not isinstance(given, Mapping) or not set(given) <= set(DEFAULTS[block]):
        problems.append(f"{block} = {given!r}: must be a mapping of {list(DEFAULTS[block])}")
        return
    value = sweep[block] = {**DEFAULTS[block], **given}
    if block == "accuracy":
        if type(value["designs"]) is not int or not 0 <= value["designs"] <= 1000:
            problems.append(f"accuracy.designs = {value['designs']!r}: must be from 0 to 1000")
        if not _numbers([value["error"]]) or not 0 < value["error"] < 1:
            problems.append(f"accuracy.error = {value['error']!r}: must be between 0 and 1")
        return
    cells = value["cells"]
    if not (
        isinstance(cells, list)
        and len(cells) == 2
        and all(type(n) is int and 8 <= n <= 1000 for n in cells)
    ):
        problems.append(f"numerics.cells = {cells!r}: must be two numbers from 8 to 1000")
    if not _numbers([value["tolerance"]]) or not 1e-8 <= value["tolerance"] <= 1e-2:
        problems.append(f"numerics.tolerance = {value['tolerance']!r}: must be from 1e-8 to 1e-2")
    if not _numbers([value["reach"]]) or not 4 <= value["reach"] <= 100:
        problems.append(f"numerics.reach = {value['reach']!r}: must be from 4 to 100")


def _numbers(values):
    return isinstance(values, list) and all(
        isinstance(v, int | float) and not isinstance(v, bool) and abs(v) < 1e100 for v in values
    )
