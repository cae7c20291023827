r"""The two stages of a bead that separates, as equations of its faces: one block of shells, or two.

    core     R in [0, R_f] ,  its outer state one side of the coexistence at l_t = r_f/R_f
    skin     R in [R_f, 1] ,  its inner state the other side, its surface free of stress
    front    dR_f/dt = -[dr/dt] / [l_r]      (r is continuous: [dr/dt + l_r dR_f/dt] = 0)

with dr/dt|_R of ``gelpump.separation.energy`` on either side.  Faces move with the front, R = R_f X
in the core and R_f^(1-s) in the skin, where dr/dt = dr/dt|_R + l_r dR/dt.
"""

import numpy as np
from numpy.typing import NDArray

from gelpump.separation.coexistence import Coexistence, Surface
from gelpump.separation.shells import clustered_outside, graded, interpolated, motion

AHEAD = 0.1  # of the layer ahead of the first front: the core's shell there
CORE = 0.01
DIFFERENCE = 1e-4  # of a Jacobian, over the thickness of a shell
MERGED = 1e-6  # hoop stretch above the critical one, relative, at which a front has no sides


class Whole:
    """One block: the whole bead in one phase; y holds r of its faces."""

    def __init__(self, energy, surface: Surface, cells: int):
        self.energy, self.surface = energy, surface
        self.R = clustered_outside(cells)

    def faces(self, y: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces."""
        return self.R, np.append(0.0, y)

    def rate(self, y: NDArray) -> NDArray:
        """dy/dt."""
        R, r = self.faces(y)
        return motion(self.energy, R, r, None, self.surface.state(r[-1])).rate[1:]

    def jacobian(self, y: NDArray) -> NDArray:
        """d(rate)/dy, dense."""
        return banded(self.rate, y, np.diff(y, prepend=0.0))

    def margins(self, y: NDArray) -> dict[str, float]:
        """Positive each, until the surface has no state of its phase."""
        return {"surface": self.surface.margin(y[-1])}

    def between(self, R: NDArray, r: NDArray) -> NDArray:
        """The state y with the course r(R) of other faces."""
        return interpolated(R, r, self.R)[1:]


class Divided:
    """Two blocks: y holds r of the core's faces, the last of them r_f, of the skin's, and R_f."""

    def __init__(
        self, energy, sides: Coexistence, surface: Surface, dry: bool, core: int, skin: int
    ):
        self.energy, self.sides, self.surface, self.dry = energy, sides, surface, dry
        self.X, self.s = clustered_outside(core), np.linspace(0.0, 1.0, skin + 1)
        self.core = core

    def blocks(self, y: NDArray) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """R and r of the core's faces, R and r of the skin's."""
        core, skin = y[: self.core], y[self.core - 1 : -1]
        return y[-1] * self.X, np.append(0.0, core), y[-1] ** (1 - self.s), skin

    def faces(self, y: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces."""
        R_core, r_core, R_skin, r_skin = self.blocks(y)
        return np.append(R_core, R_skin[1:]), np.append(r_core, r_skin[1:])

    def at_hoop_stretch(self, l_t: float) -> tuple[float, float]:
        """Polymer fractions of the core's and the skin's side of a front."""
        swollen, dry = self.sides.sides(l_t)
        return (swollen, dry) if self.dry else (dry, swollen)

    def at_front(self, y: NDArray) -> tuple[float, float]:
        """Polymer fractions of the core's and the skin's side of the front."""
        return self.at_hoop_stretch(y[self.core - 1] / y[-1])

    def layer(self, r: float, phi: float, skin: float) -> float:
        """Thickness in R of the core's layer ahead of the front of a skin that is as thin as
        ``skin``, at radius r, phi the core's polymer fraction: that of a front that moves steadily,
        (E/l_r^2) / |dR_f/dt|, the skin's stress falling evenly; at most the skin's own."""
        inside, outside = self.at_hoop_stretch(r)
        at_surface = self.surface.state(r)
        drop = self.energy.radial_stress(at_surface, r) - self.energy.radial_stress(outside, r)
        stretch = 1 / (np.array([inside, outside, phi]) * r**2)
        speed = drop / (skin * stretch[1]) / (stretch[2] - stretch[1])
        diffusivity = self.energy.stiffness(inside, r) / stretch[0] ** 2
        return float(min(abs(diffusivity / speed), skin))

    def rate(self, y: NDArray) -> NDArray:
        """dy/dt."""
        fixed, drift, speed = self.parts(y)
        return fixed + drift * speed

    def parts(self, y: NDArray) -> tuple[NDArray, NDArray, float]:
        """dy/dt at fixed R, dy/dR_f of faces that move with the front, and dR_f/dt."""
        R_core, r_core, R_skin, r_skin = self.blocks(y)
        inside, outside = self.at_front(y)
        core = motion(self.energy, R_core, r_core, None, inside)
        skin = motion(self.energy, R_skin, r_skin, outside, self.surface.state(r_skin[-1]))
        speed = -(skin.rate[0] - core.rate[-1]) / (skin.radial_stretch[0] - core.radial_stretch[-1])
        fixed = np.concatenate([core.rate[1:], skin.rate[1:], [0.0]])
        moving = self.X[1:], (1 - self.s[1:]) * R_skin[1:] / y[-1]
        stretch = core.radial_stretch[1:], skin.radial_stretch[1:]
        drift = np.concatenate(
            [*(l_r * dR for l_r, dR in zip(stretch, moving, strict=True)), [1.0]]
        )
        return fixed, drift, speed

    def jacobian(self, y: NDArray) -> NDArray:
        """d(rate)/dy, dense: five diagonals, what the front's speed adds, and R_f's column."""
        _, drift, speed = self.parts(y)
        thickness = np.append(np.diff(y[:-1], prepend=0.0), min(y[-1], 1 - y[-1]))

        def at_speed(radii):
            fixed, drift, _ = self.parts(np.append(radii, y[-1]))
            return (fixed + drift * speed)[:-1]

        J = np.zeros((y.size, y.size))
        J[:-1, :-1] = banded(at_speed, y[:-1], thickness[:-1])
        for j in (*range(self.core - 3, self.core + 2), y.size - 1):
            step = np.zeros_like(y)
            step[j] = DIFFERENCE * thickness[j : j + 2].min()
            (fixed, drifts, speeds), low = self.parts(y + step), self.parts(y - step)
            J[:, j] += drift * (speeds - low[2]) / (2 * step[j])
            if j == y.size - 1:
                J[:, j] += (fixed - low[0] + (drifts - low[1]) * speed) / (2 * step[j])
        return J

    def margins(self, y: NDArray) -> dict[str, float]:
        """Positive each, until no core or no skin is left, the sides are one, or the surface is
        lost."""
        return {
            "core": y[-1] - CORE,
            "bead": 1.0 - y[-1],
            "front": y[self.core - 1] / y[-1] - self.sides.hoop_stretch[0] * (1 + MERGED),
            "surface": self.surface.margin(y[-2]),
        }

    def born(self, R: NDArray, r: NDArray, skin: float, layer: float) -> NDArray:
        """The state y of a bead r(R) in one phase that a skin of the other is put on.

        Along the skin J is linear; towards the front the core's J tends to the front's within
        ``layer``, exponentially, as it would ahead of a front that moves steadily.
        """
        front = 1.0 - skin
        cube = interpolated(R, r, front * self.X) ** 3
        l_t = np.cbrt(cube[-1]) / front
        inside, outside = (1 / phi for phi in self.at_hoop_stretch(l_t))
        drawn = inside - np.diff(cube)[-1] / np.diff((front * self.X) ** 3)[-1]
        cube[1:] += 3 * front**2 * layer * drawn * np.exp(front * (self.X[1:] - 1) / layer)
        R_skin = front ** (1 - self.s)
        J = outside + self.s * (1 / self.surface.state(np.cbrt(cube[-1])) - outside)
        swept = np.cumsum(0.5 * (J[1:] + J[:-1]) * np.diff(R_skin**3))
        return np.concatenate([np.cbrt(cube[1:]), np.cbrt(cube[-1] + swept), [front]])

    def completed(self, y: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces, what is left of the core having the skin's phase."""
        R, r = self.faces(y)
        phi = self.at_front(y)[1]
        inner = y[-1] >= R
        lost = y[self.core - 1] ** 3 - y[-1] ** 3 / phi
        return R, np.cbrt(np.where(inner, R**3 / phi, r**3 - lost))

    def completion(self, t: float, y: NDArray) -> float:
        """When R_f = 0: R_f^2 falls in proportion to time in the end."""
        return float(t - 0.5 * y[-1] / self.parts(y)[2])


def graded_core(cells: int, layer: float) -> NDArray:
    """Faces X of a core that resolves the ``layer`` ahead of its first front."""
    return graded(cells, AHEAD * layer)


def banded(rate, y: NDArray, thickness: NDArray) -> NDArray:
    """Central differences of a rate of which each row depends on two neighbours on either side."""
    J = np.zeros((y.size, y.size))
    step = DIFFERENCE * np.minimum(thickness, np.append(thickness[1:], np.inf))
    for first in range(5):
        j = np.arange(first, y.size, 5)
        shift = np.zeros(y.size)
        shift[j] = step[j]
        change = rate(y + shift) - rate(y - shift)
        for offset in range(-2, 3):
            column = j[(j + offset >= 0) & (j + offset < y.size)]
            J[column + offset, column] = change[column + offset] / (2 * step[column])
    return J
