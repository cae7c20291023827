"""The two-state gel of the paper on elements that are hot or cold."""

import numpy as np
from numpy.typing import NDArray

from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.truth.elements import Material


def two_states(gel: PiecewiseLinearGel, hot: NDArray, c: float = 0.0) -> Material:
    """`gel`, whose elements are `hot` (boolean, element): theta = 1 there, else -1."""
    theta = np.where(hot, 1.0, -1.0)[:, np.newaxis]

    def osmotic_pressure(Phi):
        with np.errstate(invalid="ignore"):
            Phi = np.where(Phi > 0, Phi, np.nan)  # an element that is turned over
        slope = gel.osmotic_strength(theta) / gel.equilibrium_polymer_fraction(theta)
        return slope * Phi - gel.osmotic_strength(theta), slope + 0 * Phi

    return Material(osmotic_pressure, gel.M, c)
