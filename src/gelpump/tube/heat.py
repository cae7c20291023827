"""The temperature that drives the tube: a pulse of heat from a sudden step at Z = 0.

The tube knows of temperature only which of its parts are hot, that is the position Z_C(tau) of the
front behind which T > T_C. In the limit of a large Lewis number heat spreads by conduction alone
(eqn:temp_field), with theta = (T - T_C)/Delta T, a length L and the poroelastic time:

    theta_tau = Le theta_ZZ,    theta(0, tau) = 1,    theta(infinity, tau) = theta(Z, 0) = -1

    theta = 2 erfc( Z / (2 sqrt(Le tau)) ) - 1                       (eqn:temp_field_sol)
    Z_C   = 2 erfcinv(1/2) sqrt(Le tau)                              (section 3.5)

Another boundary history is another object with `front` and `front_speed`; the tube solver asks
for the front alone.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erfcinv

FRONT_CONSTANT = 2 * erfcinv(0.5)  # Z_C / sqrt(Le tau)


class Heat(Protocol):
    """What a temperature field has to offer; one front, at Z = 0 when tau = 0."""

    def front(self, tau: ArrayLike) -> NDArray:
        """Z_C(tau), where theta = 0."""

    def front_speed(self, tau: ArrayLike) -> NDArray:
        """dZ_C/dtau."""


@dataclass(frozen=True)
class StepHeating:
    """The end Z = 0 is brought to T_C + Delta T at tau = 0 and kept there.

    Le is a number, or a column (tubes, 1) for tubes that differ in it.
    """

    Le: float | np.ndarray = 10.0

    def __post_init__(self):
        if not (np.isfinite(self.Le) & (np.asarray(self.Le) > 0)).all():
            raise ValueError(f"Le = {self.Le!r} is not allowed: it must be positive and finite")

    def front(self, tau: ArrayLike) -> NDArray:
        """Position Z_C where theta = 0."""
        return FRONT_CONSTANT * np.sqrt(self.Le * np.asarray(tau, float))

    def front_speed(self, tau: ArrayLike) -> NDArray:
        """Speed dZ_C/dtau."""
        return 0.5 * FRONT_CONSTANT * np.sqrt(self.Le / np.asarray(tau, float))
