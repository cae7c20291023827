"""A gel known by measured equilibria: its table is read, forms are fitted, the best one is taken.

Of the forms (`fitting.FORMS`) that go through the points with each on a stable branch, the one with
the least k ln n + chi^2 is taken: Bayes' information criterion for n points and k parameters, with
n ln chi^2 where errors are not given.
"""

import warnings
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from .fitting import FORMS, NAMES, Fit, bootstrap, fit, names
from .flory_rehner import LOGARITHM
from .measurements import KEYS, Points, read

__all__ = ["FORMS", "NAMES", "Fit", "Points", "bootstrap", "choose", "find", "fit", "measured",
           "read", "resolve"]  # fmt: skip


SPARE = 2  # points beyond the parameters that a form needs to be chosen: fewer are gone through


def choose(name: str, points: Points, block: Mapping[str, Any]) -> Fit:
    """The fit of the form that ``block`` names, or the one that Bayes' criterion takes of all.

    ValueError if no form goes through the points.
    """
    forms, network = block.get("form", "best"), block.get("network", {})
    if forms not in ("best", *FORMS):
        raise ValueError(f"{name}.form = {forms!r}: must be 'best' or one of {list(FORMS)}")
    if not isinstance(network, Mapping) or set(network) - {
        "elasticity",
        "reference_polymer_fraction",
    }:
        raise ValueError(f"{name}.network = {network!r}: a measured gel's takes elasticity and "
                         "reference_polymer_fraction; its chains are fitted")  # fmt: skip
    kind, phi_ref = (
        network.get("elasticity", "neo-Hookean"),
        network.get("reference_polymer_fraction", 1.0),
    )
    if kind not in list(LOGARITHM) or not isinstance(phi_ref, int | float) or not 0 < phi_ref <= 1:
        raise ValueError(
            f"{name}.network = {network!r}: elasticity must be one of {list(LOGARITHM)}, "
            "reference_polymer_fraction greater than 0 and at most 1"
        )
    fits, refusals = [], {}
    for form in FORMS if forms == "best" else [forms]:
        if form == "appendix-A" and (kind, phi_ref) != ("neo-Hookean", 1.0):
            continue
        if forms == "best" and len(points.T) - len(names(form)) < SPARE:
            refusals[form] = f"{len(points.T)} points are too few for {len(names(form))} parameters"
            continue
        try:
            fits.append(fit(name, points, block.get("temperature_range"), form, (kind, phi_ref)))
        except ValueError as refusal:
            refusals[form] = str(refusal).removeprefix(f"{name}: ")
    if not fits:
        if len(set(refusals.values())) == 1:
            raise ValueError(f"{name}: {next(iter(refusals.values()))}")
        each = "; ".join(f"{form}: {why}" for form, why in refusals.items())
        raise ValueError(f"{name}: no form goes through the points: {each}")
    best = min(fits, key=lambda each: each.criterion)
    said = [f"form {form}: {why}" for form, why in refusals.items()]
    said += [
        f"form {each.form}: Bayes' criterion is larger by {each.criterion - best.criterion:.3g}"
        for each in fits
        if each is not best
    ]
    return replace(best, passed_over=tuple(said))


def find(points: str, folders) -> Path:
    """The file of points, relative to the first of the folders that has it."""
    for folder in folders:
        if (path := Path(folder) / points).is_file():
            return path
    raise ValueError(f"points = {points!r}: no such file in {[str(f) for f in folders]}")


def measured(name: str, block: Mapping[str, Any]) -> tuple[Points, Fit]:
    """Points and fit of the config block of a measured gel whose ``points`` is a path."""
    points = read(block["points"], {key: block[key] for key in KEYS & set(block)})
    return points, choose(name, points, block)


def resolve(
    gels: dict, folders=(".",), warn: Callable[[str], None] = warnings.warn
) -> dict[str, dict[str, Any]]:
    """Put the block of the fitted gel in place of each measured one; the measured blocks by name.

    ``warn`` gets what there is to beware of. ValueError, with the gel, for points that are refused.
    """
    blocks = {}
    for name, block in gels.items():
        if not isinstance(block, dict) or block.get("model") != "measured":
            continue
        takes = {"model", "points", "temperature_range", "form", "network", "source", *KEYS}
        extra = set(block) - takes
        if extra or not isinstance(block.get("points"), str):
            raise ValueError(
                f"{name}: measured takes points, the path of a CSV, and {sorted(takes)}, "
                f"not {sorted(extra)}"
            )
        try:
            blocks[name] = block | {"points": find(block["points"], folders).as_posix()}
            _, found = measured(name, blocks[name])
        except ValueError as refusal:
            said = str(refusal).removeprefix(f"{name}: ")
            raise ValueError(f"{name}: {said}") from refusal
        for text in found.warnings:
            warn(f"gel {name}: {text}")
        gels[name] = found.block()
    return blocks
