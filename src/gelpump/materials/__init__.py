"""Gels: what the models need to know about a material, and how one is built from the config.

A gel gives its osmotic pressure Pi(phi, T), polymer diffusivity D(phi, T), shear modulus mu_s and
equilibrium polymer fraction phi_0(T). Each gel states its own units; within one gel they agree:

    (mu_l/k) D = phi dPi/dphi + (4/3) mu_s (phi/phi_00)^{1/3}             (eqn:lens_transport)
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from numpy.typing import ArrayLike, NDArray

from . import blocks
from .energy_based import EnergyBasedGel
from .explicit import ExplicitGel
from .flory_rehner import FloryRehnerGel
from .piecewise_linear import PiecewiseLinearGel

__all__ = [
    "EnergyBasedGel",
    "ExplicitGel",
    "FloryRehnerGel",
    "Gel",
    "PiecewiseLinearGel",
    "from_config",
]


class Gel(Protocol):
    """What every gel offers; phi and T broadcast against each other."""

    name: str
    polymer_fraction_bounds: tuple[float, float]
    """Open interval that polymer fractions lie in."""

    def osmotic_pressure(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Pi(phi, T)."""

    def osmotic_modulus(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """phi dPi/dphi."""

    def shear_modulus(self, phi_00: float) -> float:
        """mu_s, for strains measured from the state of polymer fraction phi_00."""

    def diffusivity(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """(mu_l/k) D, whatever the reference phi_00."""

    def flux_potential(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Integral of (mu_l/k) D over the polymer fraction, from 0 to phi."""

    def spinodal_polymer_fractions(self, T: float) -> NDArray:
        """All phi with D(phi, T) = 0, sorted."""

    def equilibrium_polymer_fraction(self, T: float) -> float:
        """phi_0(T), at which Pi = 0 and the gel is stable."""


# model -> (gel, the keys its config block takes beside `model`)
_MODELS: dict[str, tuple[type, frozenset[str]]] = {
    "energy-based": (
        EnergyBasedGel,
        frozenset({"A0", "A1", "B0", "B1", "Omega", "temperature_range"}),
    ),
    "piecewise-linear": (PiecewiseLinearGel, frozenset({"Phi_inf", "Pi_ratio", "M"})),
}


def from_config(name: str, block: Mapping[str, Any]) -> Gel:
    """Build the gel `name` from its config block.

    Raises ValueError, with the key, its value and what is allowed, for an unknown model, a key
    that is missing or unknown, and a value the gel refuses.
    """
    model = block.get("model")
    if model == "flory-rehner":
        return blocks.from_block(name, block)
    if not isinstance(model, str) or model not in _MODELS:
        known = ", ".join([*_MODELS, "flory-rehner"])
        raise ValueError(f"{name}.model = {model!r}: must be one of {known}")
    gel, keys = _MODELS[model]
    given = set(block) - {"model", "source"}
    for key in sorted(given - keys):
        raise ValueError(
            f"{name}.{key} = {block[key]!r}: unknown key; {model} takes {sorted(keys)}"
        )
    for key in sorted(keys - given):
        raise ValueError(f"{name}.{key} is missing; {model} takes {sorted(keys)}")
    return gel(name=name, **{key: block[key] for key in keys})
