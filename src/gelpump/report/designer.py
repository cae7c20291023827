"""What the designer of the page takes from Python: gels, rules, labels and the numbers of waves.

Formulae stand twice, in `gelpump.design` and in the page's scripts; everything else stands once.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gelpump.design import device, late, units, validity
from gelpump.design.description import Design, checked, schema
from gelpump.design.solve_tube import TIMES
from gelpump.materials import EnergyBasedGel, FloryRehnerGel, PiecewiseLinearGel, from_config
from gelpump.tube import late_pump, wave
from gelpump.tube.heat import FRONT_CONSTANT


def designer(gels: Mapping[str, Any], designs: Mapping[str, Any]) -> dict[str, Any]:
    """gels: blocks of the configuration; designs: blocks of tubes by name, of which the first is
    shown at the start."""
    found = {name: checked(name, block, gels) for name, block in designs.items()}
    told = {name: gel(from_config(name, block)) for name, block in gels.items()}
    return {
        "gels": told,
        "designs": {name: _given(each, designs[name]) for name, each in found.items()},
        "quantities": _quantities(next(iter(found.values()))),
        "criteria": {
            each.key: {
                "text": each.text,
                "symbol": each.symbol,
                "green": each.green,
                "amber": each.amber,
                "large": each.large,
                "source": each.source,
            }
            for each in validity.CRITERIA
        },
        "usual": validity.USUAL,
        "stated": wave.STATED
        | {f"pump_{k}" if k in wave.STATED else k: v for k, v in late_pump.STATED.items()},
        "front_constant": float(FRONT_CONSTANT),
        "delay": wave.DELAY,
        "mismatch": late_pump.MISMATCH,
        "step": late_pump.STEP,
        "nodes": [late_pump.NODES, late_pump.FEWER_NODES],
        "quadrature": device.QUADRATURE,
        "times": TIMES,
    }


def gel(found: Any) -> dict[str, Any]:
    """A gel as the page takes it: ratios, or c_k = p_k + q_k s of `materials.flory_rehner`."""
    if isinstance(found, PiecewiseLinearGel):
        ratios = {"M": found.M, "Pi_ratio": found.Pi_ratio, "Phi_inf": found.Phi_inf}
        return {"kind": "ratios", "name": found.name, **ratios}
    told = {
        "kind": "energy",
        "name": found.name,
        "Omega": found.Omega,
        "range": list(found.temperature_range),
        "poles": found._equilibrium_poles.tolist(),
        "kappa": 1.0,
        "charge": 0.0,
        "salt": 0.0,
        "molecule_volume": None,
        "inverse": False,
    }
    if isinstance(found, EnergyBasedGel):
        told["constant"] = [found.A0 - found.A1, 2 * found.A1, 0.0]
        told["slope"] = [found.B0 - found.B1, 2 * found.B1, 0.0]
    elif isinstance(found, FloryRehnerGel):
        keys = ("constant", "slope", "inverse", "kappa", "charge", "salt", "molecule_volume")
        told |= {key: getattr(found, key) for key in keys}
    return told


def _given(design: Design, block: Mapping[str, Any]) -> dict[str, Any]:
    """The inputs of a design in SI units, with its gel by name or as ``own``."""
    told = {key: float(value.magnitude) for key, value in design.given.items()}
    own = block["gel"]
    if isinstance(own, Mapping):
        told |= {
            key: units.si(units.parsed(value, "Pa"), "Pa") if isinstance(value, str) else value
            for key, value in own.items()
        }
    return told | {"title": design.title, "gel": own if isinstance(own, str) else "own"}


def _quantities(design: Design) -> dict[str, list[str]]:
    """Meaning, unit and source of each number, in their order."""
    return {
        each.key: [each.text, each.unit, each.source]
        for each in [*device.results(design), *late.late_results(design)]
    }
