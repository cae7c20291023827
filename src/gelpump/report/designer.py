"""What the designer of the page takes from Python: gels, rules, labels and the numbers of waves.

Formulae stand twice, in `gelpump.design` and in the page's scripts; everything else stands once.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gelpump.design import device, heat, late, units, validity
from gelpump.design.description import Design, checked
from gelpump.design.solve_tube import TIMES
from gelpump.materials import EnergyBasedGel, FloryRehnerGel, PiecewiseLinearGel, from_config
from gelpump.tube import late_pump, wave
from gelpump.tube.heat import FRONT_CONSTANT

FIELDS = (  # key, text, unit of the file, of the page, its size in SI, ends of the slider
    ("a_0", "inner radius, swollen", "um", "µm", 1e-6, 1, 5000),
    ("a_1", "outer radius, swollen", "um", "µm", 1e-6, 1, 5000),
    ("heated_length", "heated length", "mm", "mm", 1e-3, 0.01, 1000),
    ("osmotic_modulus", "osmotic modulus, swollen", "kPa", "kPa", 1e3, 0.01, 1e4),
    ("osmotic_modulus_hot", "osmotic modulus, collapsed", "kPa", "kPa", 1e3, 0.01, 1e4),
    ("shear_modulus", "shear modulus", "kPa", "kPa", 1e3, 0.01, 1e4),
    ("polymer_fraction", "polymer fraction, swollen", "", "", 1.0, 0.002, 0.5),
    ("polymer_fraction_hot", "polymer fraction, collapsed", "", "", 1.0, 0.01, 0.9),
    ("permeability", "permeability", "m^2", "m²", 1.0, 1e-20, 1e-13),
    ("viscosity", "viscosity of the liquid", "mPa*s", "mPa s", 1e-3, 0.1, 100),
    ("thermal_diffusivity", "thermal diffusivity", "mm^2/s", "mm²/s", 1e-6, 0.03, 1),
    ("critical_temperature", "critical temperature", "K", "K", 1.0, 280, 350),
    ("heating_step", "heating step ΔT, to either side", "K", "K", 1.0, 0.05, 30),
    ("density", "density of the liquid", "kg/m^3", "kg/m³", 1.0, 500, 2000),
    ("enthalpy", "enthalpy of the collapse, empty if unknown", "kJ/mol", "kJ/mol", 1e3, 0.1, 50),
    ("pipe_section", "section of the pipe", "mm^2", "mm²", 1e-6, 1e-3, 1e3),
    ("wanted_time", "respond within", "s", "s", 1.0, 1e-3, 1e4),
    ("wanted_volume", "pump at least", "nL", "nL", 1e-12, 1e-4, 1e4),
    ("wanted_wall", "wall at least", "um", "µm", 1e-6, 1, 2000),
)
LINEAR = ("critical_temperature", "density")
WANTED = {
    "wanted_time": 0.05,
    "wanted_volume": 5,
    "wanted_wall": 20,
    "pipe_section": 1,
}  # of the first design
EMPTY: Mapping[str, str] = {}
MODELS = ("energy-based", "piecewise-linear", "flory-rehner")


def designer(
    gels: Mapping[str, Any], designs: Mapping[str, Any], files: Mapping[str, str] = EMPTY
) -> dict[str, Any]:
    """gels: blocks of the configuration; designs: blocks of tubes by name, of which the first is
    shown at the start; files: where gels stand that are not in the configuration."""
    found = {name: checked(name, block, gels) for name, block in designs.items()}
    heated = {"surrounding": "insulated", "enthalpy": heat.USUAL_MOST}  # of which most is told
    told_of = [checked(name, block | heated, gels) for name, block in designs.items()]
    formulae = {name: block for name, block in gels.items() if block.get("model") in MODELS}
    told = {name: gel(from_config(name, block)) for name, block in formulae.items()}
    return {
        "gels": {name: each | {"file": files.get(name)} for name, each in told.items()},
        "fields": [_field(*each) for each in FIELDS],
        "designs": {name: _given(each, designs[name]) for name, each in found.items()},
        "quantities": {k: v for each in told_of for k, v in _quantities(each).items()},
        "usual_enthalpy": units.si(units.parsed(heat.USUAL_MOST, "J/mol"), "J/mol"),
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
        "mismatch": wave.MISMATCH,
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


def _field(key, text, unit, shown, factor, low, high) -> dict[str, Any]:
    return {
        "key": key,
        "text": text,
        "unit": unit,
        "shown": shown,
        "factor": factor,
        "low": low,
        "high": high,
        "linear": key in LINEAR,
        "start": WANTED.get(key),
    }


def _given(design: Design, block: Mapping[str, Any]) -> dict[str, Any]:
    """The inputs of a design in SI units, with its gel by name or as ``own``."""
    told = {key: float(value.magnitude) for key, value in design.given.items()}
    own = block["gel"]
    if isinstance(own, Mapping):
        told |= {
            key: units.si(units.parsed(value, "Pa"), "Pa") if isinstance(value, str) else value
            for key, value in own.items()
        }
    latent = told.pop("latent_heat", None)
    if latent is not None:
        told["enthalpy"] = latent * told["repeat_unit"] / told["polymer_density"]
    told |= {"title": design.title, "surrounding": design.surrounding}
    return told | {"gel": own if isinstance(own, str) else "own"}


def _quantities(design: Design) -> dict[str, list[str]]:
    """Meaning, unit and source of each number, in their order."""
    return {
        each.key: [each.text, each.unit, each.source]
        for each in [*device.results(design), *late.late_results(design)]
    }
