r"""Material shells between two moving ends, in either model: the rate of their faces.

The unknowns are the radii r of shell faces at the dry radii R, so that polymer is conserved
exactly; phi of a shell is its dry volume over its volume.  Stresses live at the mean square dry
radius of a shell, where l_t is taken linear in R^2, and are differenced in r^2: exact for a
parabola, second order at the centre.  An end is the centre, or has a polymer fraction of its own (a
stress-free surface, one side of a front), where the difference is that of a one-sided parabola: a
face sees two shells on either side.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


def clustered_outside(cells: int) -> NDArray:
    """Faces on [0, 1] that cluster at 1: a core's, the centre at 0."""
    return np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, cells + 1))


def graded(cells: int, finest: float) -> NDArray:
    """Faces on [0, 1], the shell at 1 ``finest`` thick and others in proportion to their distance.

    1 - x = sinh(b (1 - s)) / sinh(b), s uniform.
    """
    from scipy.optimize import brentq

    wanted = 1.0 / (cells * finest)
    if wanted <= 1.0:
        raise ValueError(f"finest = {finest}: must be less than 1/{cells}, the uniform thickness")
    b = brentq(lambda b: np.log(np.sinh(b) / b / wanted), 1e-3, 50.0)
    x = 1.0 - np.sinh(b * np.linspace(1.0, 0.0, cells + 1)) / np.sinh(b)
    x[0] = 0.0
    return x


DENSEST = 1 - 1e-9  # trial steps of an integrator may tangle shells
LOST = 1e-10  # share of the polymer that rounding may lose


class Unsound(RuntimeError):
    """A state that no bead is in: its words say what was met, when and where."""


class Motion(NamedTuple):
    """At each face: dr/dt at fixed R, and l_r."""

    rate: NDArray
    radial_stretch: NDArray


def polymer_fraction(R: NDArray, r: NDArray) -> NDArray:
    """phi of each shell between its faces; one that is turned inside out counts as densest."""
    dry, volume = np.diff(R**3), np.diff(r**3)
    return np.clip(dry / np.where(volume > 0, volume, dry), 1 - DENSEST, DENSEST)


def at_means(R, r):
    """Mean square R of each shell, and l_t there."""
    square = R**2
    mean = 0.6 * np.diff(R**5) / np.diff(R**3)
    with np.errstate(invalid="ignore"):
        stretch = r / R
    rise = np.diff(stretch) / np.diff(square)
    if R[0] == 0.0:
        rise[0] = rise[1]
    return mean, stretch[1:] + rise * (mean - square[1:])


def motion(energy, R: NDArray, r: NDArray, phi_inner: float | None, phi_outer: float) -> Motion:
    """Of the faces R, r, shape (faces,), with the polymer fractions of the ends.

    ``phi_inner`` None: the block reaches the centre, R = r = 0.
    """
    phi = polymer_fraction(R, r)
    mean, l_t = at_means(R, r)
    stress, place = energy.radial_stress(phi, l_t), l_t**2 * mean
    square = R**2
    at_faces = np.empty_like(R)
    between = (square[1:-1] - mean[:-1]) / np.diff(mean)
    at_faces[1:-1] = phi[:-1] + between * np.diff(phi)
    at_faces[-1] = phi_outer
    at_faces[0] = phi[0] if phi_inner is None else phi_inner
    ends = slice(1 if phi_inner is None else 0, None)
    stretch = r[ends] / R[ends]
    s = np.append(stress, energy.radial_stress(phi_outer, stretch[-1]))
    x = np.append(place, r[-1] ** 2)
    if phi_inner is not None:
        s = np.append(energy.radial_stress(phi_inner, stretch[0]), s)
        x = np.append(r[0] ** 2, x)
    faces = at_faces[ends]
    slope = np.diff(s) / np.diff(x)
    slope[-1] = _slope_at_end(s[:-4:-1], x[:-4:-1])
    if phi_inner is not None:
        slope[0] = _slope_at_end(s[:3], x[:3])
    rate = np.zeros_like(R)
    rate[ends] = 2 * r[ends] * slope + 2 * energy.stress_difference(faces, stretch) / r[ends]
    radial = np.empty_like(R)
    radial[ends] = 1 / (faces * stretch**2)
    if phi_inner is None:
        radial[0] = np.cbrt(1 / phi[0])
    return Motion(rate, radial)


def _slope_at_end(s, x):
    """ds/dx at x[0] of the parabola through three points."""
    near, far = (s[1] - s[0]) / (x[1] - x[0]), (s[2] - s[0]) / (x[2] - x[0])
    return near + (near - far) * (x[1] - x[0]) / (x[2] - x[1])


def interpolated(R, r, faces):
    """r at the dry radii ``faces``, from r^3 as a monotone function of R^3."""
    from scipy.interpolate import PchipInterpolator

    return np.cbrt(PchipInterpolator(R**3, r**3)(np.minimum(faces, 1.0) ** 3))


def soundness(energy, R: NDArray, r: NDArray) -> dict[str, float]:
    """Of shells with faces R, r, positive each while the shells are in order (J > 1: less
    polymer than volume) and while they are stable: the least J - 1 and the least E."""
    J, E = _state(energy, R, r)
    return {"order": float(J.min() - 1), "stiffness": float(E.min())}


def require_sound(energy, t: float, R: NDArray, r: NDArray) -> None:
    """Unsound for shells that do not hold the bead's polymer, are tangled or have E <= 0."""
    dry = np.diff(R**3)
    if not (dry.min() > 0 and abs(dry.sum() - 1) <= LOST):
        raise Unsound(f"at t = {t:.6g} the shells hold {dry.sum():.12g} of the bead's polymer")
    if not min(soundness(energy, R, r).values()) > 0:
        raise unsound(energy, t, R, r)


def unsound(energy, t: float, R: NDArray, r: NDArray) -> Unsound:
    """What is wrong with the worst shell."""
    J, E = _state(energy, R, r)
    tangled = not J.min() - 1 > min(E.min(), 0.0)
    i = int(np.argmin(J if tangled else E))
    where = f"at t = {t:.6g} in the shell between R = {R[i]:.6g} and {R[i + 1]:.6g}"
    if tangled:
        return Unsound(f"{where} shells are tangled: its volume is {J[i]:.6g} of its dry volume")
    return Unsound(
        f"{where} E = {E[i]:.3g}, not positive: inside the block a front is born, or its cells "
        "do not resolve the layer ahead of one"
    )


def _state(energy, R, r):
    """J of each shell, and its E."""
    return np.diff(r**3) / np.diff(R**3), energy.stiffness(
        polymer_fraction(R, r), at_means(R, r)[1]
    )
