"""What tells slender tubes apart: their shape, and the piecewise-linear gel they are made of."""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Tubes:
    """A family of tubes; each field is a number or an array, broadcast to one length.

    ell      ratio of the inner to the outer radius, a_0/a_1
    eps      slenderness a_1/L
    M        shear modulus over the osmotic pressure of the swollen state, mu_s/Pi_00
    Pi_ratio osmotic pressure scale when hot over that when cold, Pi_0inf/Pi_00
    Phi_inf  equilibrium polymer fraction when hot over that when cold
    """

    ell: np.ndarray
    eps: np.ndarray = 0.1
    M: np.ndarray = 1.0
    Pi_ratio: np.ndarray = 1.0
    Phi_inf: np.ndarray = 2.0

    def __post_init__(self):
        allowed = {
            "ell": ("0 < ell < 1", lambda v: (v > 0) & (v < 1)),
            "eps": ("eps > 0", lambda v: v > 0),
            "M": ("M >= 0", lambda v: v >= 0),
            "Pi_ratio": ("Pi_ratio > 0", lambda v: v > 0),
            "Phi_inf": ("Phi_inf >= 1", lambda v: v >= 1),
        }
        values = np.broadcast_arrays(*(np.asarray(getattr(self, k), float) for k in allowed))
        for (key, (text, inside)), value in zip(allowed.items(), values, strict=True):
            bad = ~(inside(value) & np.isfinite(value))
            if bad.any():
                raise ValueError(f"{key} = {value[bad].flat[0]:g} is not allowed: {text}, finite")
            object.__setattr__(self, key, value)
        if (self.eps >= 0.5).any():
            warnings.warn(
                f"eps = {self.eps.max():g} is of order one: the slender tube needs eps^2 << 1",
                stacklevel=3,
            )

    @property
    def wall_length(self):
        """w = eps (1-ell)/4, the axial length over which radial flow heals a disturbance."""
        return self.eps * (1 - self.ell) / 4


def one_by_one(gel, tube: Mapping, settings: Mapping) -> tuple[Tubes, list[str]]:
    """Tubes that differ from one another in one number at a time, and which that is of each.

    `settings` holds ell, and in `varied` the values of ell, M, Pi_ratio or Phi_inf; what is not
    varied is that of `gel` and `tube`.
    """
    base = {"ell": settings["ell"], "eps": tube["eps"], "M": gel.M, "Pi_ratio": gel.Pi_ratio}
    base["Phi_inf"] = gel.Phi_inf
    rows = [
        (key, base | {key: float(value)})
        for key, values in settings["varied"].items()
        for value in values
    ]
    return Tubes(**{key: [row[key] for _, row in rows] for key in base}), [key for key, _ in rows]
