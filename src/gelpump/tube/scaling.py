"""What the numbers in the tube's datasets are scaled with (eqn:nondimensionalisation)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from gelpump.netcdf import variable

if TYPE_CHECKING:
    from gelpump.netcdf import Variable

AXIAL = "in units of L, the length over which the temperature varies"
RADIAL = "in units of a_1, the outer radius of the swollen tube"
POLYMER = "in units of phi_00, the polymer fraction of the swollen tube"
RATE = "per poroelastic time mu_l L^2/(k Pi_00)"
AXIAL_VELOCITY = "in units of L per poroelastic time mu_l L^2/(k Pi_00)"
RADIAL_VELOCITY = "in units of a_1 per poroelastic time mu_l L^2/(k Pi_00)"
VOLUME = "in units of a_1^2 L"
VOLUME_RATE = "in units of a_1^2 L per poroelastic time mu_l L^2/(k Pi_00)"


def ell(values: ArrayLike) -> Variable:
    """The coordinate ell."""
    return variable("ell", values, "ratio of inner to outer radius, a_0/a_1")


def tau(values: ArrayLike) -> Variable:
    """The coordinate tau."""
    return variable("tau", values, "elapsed time", "in units of mu_l L^2/(k Pi_00)")
