"""The drying front: how sharp it is, and how that depends on the thickness of the wall.

Near the front the solved Phi_1 is described by one number A, the sharpness (eqn:tanh_fit):

    Phi_1 ~ Phi_inf - (Phi_inf - 1)/2 { 1 + tanh[A (Z - Z_C)] }

A is the value with the least integral of the squared misfit over |Z - Z_C| <= window. The cells are
graded, so each is weighted with its length inside the window: a sum over unweighted cells would
count the front many times over. The profile is a function of Z/w and tau/w^2 only, with
w = eps (1-ell)/4, so a window in units of w is the same for all tubes.

A power law A = c (1-ell)^-n is fitted to the logarithms.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    import xarray as xr

WINDOW = 8.0  # in units of w: a wider one changes A by less than 1e-4


def tanh_profile(x: ArrayLike, Phi_inf: ArrayLike) -> NDArray:
    """Phi_1 of eqn:tanh_fit at x = A (Z - Z_C)."""
    return Phi_inf - (Phi_inf - 1) / 2 * (1 + np.tanh(x))


def wall_length(pulse: "xr.Dataset") -> NDArray:
    """w = eps (1-ell)/4 of each tube, shape (ell,)."""
    return pulse.eps.values * (1 - pulse.ell.values) / 4


def sharpness(
    pulse: "xr.Dataset", window: float = WINDOW, in_units_of_A: bool = False
) -> tuple[NDArray, NDArray]:
    """A of eqn:tanh_fit, in 1/L, and the root-mean-square misfit of Phi_1, shapes (ell, tau).

    `pulse` is what `gelpump.tube.solve` gives, `window` in units of w, or of 1/A. Gauss-Newton's
    iteration for ln A, all tubes and times at once; RuntimeError if it does not converge.
    """
    Phi_inf = pulse.Phi_inf.values[:, np.newaxis, np.newaxis]
    w = wall_length(pulse)[:, np.newaxis, np.newaxis]
    ahead, faces = (pulse.Z - pulse.Z_C).values, (pulse.Z_face - pulse.Z_C).values
    A = 0.8 / w * np.ones((1, pulse.sizes["tau"], 1))
    for _ in range(60):
        half = window / A if in_units_of_A else window * w
        inside = np.diff(np.clip(faces, -half, half), axis=-1)
        misfit = pulse.Phi1.values - tanh_profile(A * ahead, Phi_inf)
        slope = -(Phi_inf - 1) / 2 * A * ahead / np.cosh(np.minimum(A * np.abs(ahead), 300.0)) ** 2
        step = (inside * slope * misfit).sum(axis=-1, keepdims=True) / (inside * slope**2).sum(
            axis=-1, keepdims=True
        )
        A = A * np.exp(np.clip(step, -1.0, 1.0))
        if np.abs(step).max() < 1e-12:
            rms = np.sqrt((inside * misfit**2).sum(axis=-1) / inside.sum(axis=-1))
            return A[..., 0], rms
    raise RuntimeError(f"the fit of A still moves by {np.abs(step).max():.1e}")


class PowerLaw(NamedTuple):
    """A = prefactor (1-ell)^-exponent."""

    exponent: float
    exponent_uncertainty: float
    prefactor: float

    def sharpness(self, ell: ArrayLike) -> NDArray:
        """A of a tube."""
        return self.prefactor * (1 - np.asarray(ell)) ** -self.exponent

    def one_minus_ell(self, A: ArrayLike) -> NDArray:
        """1-ell of the tube that has this A."""
        return (np.asarray(A) / self.prefactor) ** (-1 / self.exponent)


def power_law(ell: ArrayLike, A: ArrayLike, A_uncertainty: ArrayLike) -> PowerLaw:
    """Least squares in logarithms.

    The exponent's uncertainty joins the standard error from the scatter with the largest change
    that errors of A within `A_uncertainty`, of whatever sign, can make.
    """
    x = -np.log(1 - np.asarray(ell))
    leverage = (x - x.mean()) / ((x - x.mean()) ** 2).sum()
    y = np.log(A)
    exponent = leverage @ y
    intercept = y.mean() - exponent * x.mean()
    scatter = y - intercept - exponent * x
    from_scatter = np.sqrt((scatter @ scatter) / (len(x) - 2) * (leverage @ leverage))
    from_numerics = np.abs(leverage) @ (np.asarray(A_uncertainty) / A)
    return PowerLaw(
        float(exponent), float(np.hypot(from_scatter, from_numerics)), float(np.exp(intercept))
    )


def local_exponent(ell: ArrayLike, A: ArrayLike) -> NDArray:
    """-d ln A / d ln(1-ell), which is n at every ell where a power law holds."""
    return -np.gradient(np.log(A), np.log(1 - np.asarray(ell)))


def profile(tube: "xr.Dataset") -> Callable[[NDArray], NDArray]:
    """Phi_1 as a function of Z - Z_C, of one tube at one time.

    Splines on either side of the front, where the slope jumps. Phi_1 is an even function of Z, and
    one beyond the last cell.
    """
    from scipy.interpolate import CubicSpline

    hot, Z_C, front = tube.hot.values, float(tube.Z_C), float(tube.Phi1_front)
    Z, Phi = tube.Z.values - Z_C, tube.Phi1.values
    mirrored = -2 * Z_C - Z[0]
    behind = CubicSpline(np.r_[mirrored, Z[hot], 0.0], np.r_[Phi[0], Phi[hot], front])
    ahead = CubicSpline(np.r_[0.0, Z[~hot]], np.r_[front, Phi[~hot]])

    def Phi1(distance):
        on_mesh = np.where(distance <= 0, behind(distance), ahead(distance))
        return np.where(distance > Z[-1], 1.0, on_mesh)

    return Phi1


def largest_difference(pulse: "xr.Dataset", other: "xr.Dataset") -> NDArray:
    """Largest difference of Phi_1 at the same Z - Z_C, in the cells of `pulse`, dims (ell, tau).

    `other` has the same tubes, at the same times or at one time only.
    """
    distance = pulse.Z.values - pulse.Z_C.values[:, np.newaxis]
    found = np.empty(distance.shape[:2])
    for i, j in np.ndindex(*found.shape):
        if j < other.sizes["tau"]:
            there = profile(other.isel(ell=i, tau=j))
        found[i, j] = np.abs(pulse.Phi1.values[i, j] - there(distance[i, j])).max()
    return found
