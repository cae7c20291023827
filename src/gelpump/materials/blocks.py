"""A gel of the literature from its config block: what `flory_rehner` calls p, q, Omega and kappa.

`chi` has chi_1 to chi_3, each a number or one pair of FORMS; `network` the kind of the chains,
where they are relaxed, and one of DENSITIES; `ions`, if there are any, the charges and the salt.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .flory_rehner import GAS_CONSTANT, LOGARITHM, WATER, FloryRehnerGel
from .validation import non_negative, positive, real_number

OF = {"osmotic-pressure": np.eye(3), "free-energy": np.array([[1, -1, 0], [0, 2, -2], [0, 0, 3.0]])}
FORMS = ({"constant", "slope"}, {"A", "Theta"}, {"enthalpy", "entropy"})
DENSITIES = ("chain_length", "chain_density", "crosslink_density", "shear_modulus")


def from_block(name: str, block: Mapping[str, Any]) -> FloryRehnerGel:
    """The gel of a config block with ``chi`` and ``network``, and perhaps ``ions``.

    SI units: J/mol, J/(mol K), mol/m^3, Pa, m^3/mol.  ValueError, with the key, for what is
    missing, unknown, given twice or out of bounds.
    """
    take = _Taker(name, block)
    volume = positive(*take("solvent_molar_volume", WATER))
    span = take("temperature_range")[1]
    chi, network = take.inside("chi"), take.inside("network")
    ions = take.inside("ions") if "ions" in block else None
    constant, slope, inverse = _interaction(chi)
    prefactor, chains, phi_ref, kappa = _chains(network, volume)
    charge = salt = 0.0
    if ions:
        charge = positive(*ions("charges_per_chain")) * chains / phi_ref
        salt = non_negative(*ions("salt", 0.0)) * volume
    for each in (chi, network, ions, take):
        if each:
            each.require_all_taken()
    return FloryRehnerGel(
        name, constant, slope, inverse, float(np.cbrt(phi_ref)) / prefactor, kappa, charge, salt,
        volume, span,
    )  # fmt: skip


class _Taker:
    """Values of a block by key, each with its whole name; what is left over is unknown."""

    def __init__(self, name: str, block: Any) -> None:
        if not isinstance(block, Mapping):
            raise ValueError(f"{name} = {block!r}: must be a block of keys")
        self.name, self.block, self.taken = name, block, {"model", "source"}

    def __call__(self, key: str, *default: Any) -> tuple[str, Any]:
        self.taken.add(key)
        if key not in self.block and not default:
            raise ValueError(f"{self.name}.{key} is missing")
        return f"{self.name}.{key}", self.block.get(key, *default)

    def inside(self, key: str) -> _Taker:
        return _Taker(*self(key))

    def require_all_taken(self) -> None:
        for key in sorted(set(self.block) - self.taken, key=str):
            raise ValueError(
                f"{self.name}.{key} = {self.block[key]!r}: unknown key; it takes "
                f"{sorted(self.taken - {'model', 'source'})}"
            )


def _interaction(take: _Taker):
    """p, q of c_1 to c_3, and whether s = 1/T."""
    key, of = take("of", "osmotic-pressure")
    if not isinstance(of, str) or of not in OF:
        raise ValueError(f"{key} = {of!r}: must be one of {list(OF)}")
    p, q, kinds = np.zeros(3), np.zeros(3), {}
    for k in range(3):
        key, given = take(f"chi_{k + 1}", *([0.0] if k else []))
        if not isinstance(given, Mapping):
            p[k] = real_number(key, given)
            continue
        if set(given) not in FORMS:
            raise ValueError(f"{key} = {dict(given)!r}: must be a number or have one of the pairs "
                             f"{[sorted(form) for form in FORMS]}")  # fmt: skip
        a, b = (real_number(f"{key}.{each}", given[each]) for each in sorted(given))
        kinds[key] = "constant" not in given
        if "constant" in given:
            p[k], q[k] = a, b
        elif "A" in given:
            p[k], q[k] = 0.5 - a, a * positive(f"{key}.Theta", b)
        else:
            p[k], q[k] = -b / GAS_CONSTANT, a / GAS_CONSTANT
    if len(set(kinds.values())) > 1:
        raise ValueError(f"{', '.join(kinds)}: must all be linear in T or all in 1/T")
    return tuple(OF[of] @ p), tuple(OF[of] @ q), any(kinds.values())


def _chains(take: _Taker, volume: float) -> tuple[float, float, float, float]:
    """Prefactor of the chains' pressure and their number, per v when relaxed; phi_ref; kappa."""
    key, kind = take("elasticity")
    if not isinstance(kind, str) or kind not in LOGARITHM:
        raise ValueError(f"{key} = {kind!r}: must be one of {list(LOGARITHM)}")
    key, phi_ref = take("reference_polymer_fraction", 1.0)
    if not positive(key, phi_ref) <= 1:
        raise ValueError(f"{key} = {phi_ref!r}: must be at most 1 (dry)")
    key, f = take("functionality", 4)
    if not real_number(key, f) > 2:
        raise ValueError(f"{key} = {f!r}: must be greater than 2")
    given = [each for each in DENSITIES if each in take.block]
    if len(given) != 1:
        raise ValueError(f"{take.name}: has {given}: must have one of {list(DENSITIES)}")
    value = positive(*take(given[0]))
    share = 1 - 2 / f if kind == "phantom" else 1.0
    if given[0] == "shear_modulus":
        T = positive(*take("shear_modulus_temperature"))
        n = value * volume / (GAS_CONSTANT * T) / share
    else:
        n = {"chain_length": phi_ref / value, "chain_density": value * volume,
             "crosslink_density": f / 2 * value * volume}[given[0]]  # fmt: skip
    return n * share, n, phi_ref, LOGARITHM[kind] * phi_ref ** (-2 / 3)
