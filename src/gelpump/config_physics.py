"""What the models ask of a configuration beyond its schema: gels that exist and equilibria that do,
times in order, and choices of figures and tables among what is solved.

Each refusal names the key as a path, the value given and what is allowed, as `gelpump.config` does.
"""

import sys
import warnings
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

THICK = 0.5  # a slenderness that is of order one
VALUES = 100_000_000  # of one variable of a dataset


def problems(config: Mapping[str, Any]) -> Iterator[str]:
    """What is refused of a configuration that keeps to its schema and has all defaults."""
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
    for case, block in config["cycles"]["beads"]["cases"].items():
        yield from _cycle_problems(f"cycles.beads.cases.{case}", block, gels, config["gels"])
    yield from _tube_problems(config)
    yield from _truth_problems(config)
    yield from _choice_problems(config)
    yield from _published_problems(config)


def explicit_gels(blocks: Mapping[str, Any]) -> list[str]:
    """Names of the gels that have a free energy, so that T(phi) is explicit."""
    return [n for n, b in blocks.items() if b["model"] in ("energy-based", "flory-rehner")]


def _cycle_problems(key, block, gels, blocks) -> Iterator[str]:
    from gelpump.cycles.programme import Programme

    energy_based = sorted(explicit_gels(blocks))
    name = block["gel"]
    if name not in energy_based:
        yield f"{key}.gel = {name!r}: must be one of the energy-based gels {energy_based}"
        return
    try:
        Programme.cycles(
            *(block[end] for end in ("cold", "hot", "period", "cycles")), ramp=block["ramp"]
        )
    except ValueError as refusal:
        yield f"{key}.{refusal}"
    if name not in gels:  # refused above
        return
    lowest, highest = gels[name].temperature_range
    if not lowest <= block["cold"] < block["hot"] <= highest:
        yield (
            f"{key}: cold = {block['cold']}, hot = {block['hot']}: must increase, within "
            f"gels.{name}.temperature_range, {lowest} to {highest} K"
        )


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


def _truth_problems(config) -> Iterator[str]:
    truth = config["truth"]
    waves, pulses, bead = truth["waves"], truth["pulses"], truth["bead"]
    increasing = {
        "truth.ell": truth["ell"],
        "truth.M": truth["M"],
        "truth.waves.Pe": waves["Pe"],
        "truth.pulses.ell": pulses["ell"],
        "truth.pulses.T": pulses["T"],
        "truth.bead.t": bead["t"],
    }
    for key, values in increasing.items():
        if any(b <= a for a, b in pairwise(values)):
            yield f"{key} = {values}: must increase"
    if waves["Pe"][0] != 0:
        yield f"truth.waves.Pe = {waves['Pe']}: must begin with 0, a front at rest"
    for name, block in (("waves", waves), ("pulses", pulses)):
        if block["cells"][0] % 4:
            yield f"truth.{name}.cells = {block['cells']}: the first must be a multiple of 4"
    known = sorted(explicit_gels(config["gels"]))
    if bead["gel"] not in known:
        yield f"truth.bead.gel = {bead['gel']!r}: must be one of the gels with an energy, {known}"


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
