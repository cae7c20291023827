"""What is read off a solved wall with a front: profiles, jump, widths, sharpness, fluxes.

Profiles have two values at every interior line of elements, since F, and with it Phi, jumps there
(at the front because the temperature does, elsewhere by discretisation only).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded
from scipy.optimize import least_squares

from gelpump.bdf import interpolation_weights
from gelpump.truth.elements import Elements, Material, deformation
from gelpump.truth.energy import polymer_stress
from gelpump.tube.front import WINDOW, tanh_profile

LEVELS = (0.1, 0.5, 0.9)  # of the way from swollen to collapsed
_x, _w = np.polynomial.legendre.leggauss(3)
GAUSS = list(zip((1 + _x) / 2, _w / 2, strict=True))


@dataclass(frozen=True)
class Section:
    """Fields on the elements of `wall_mesh`, (axial line, line across), elements side by side.

    z, r, Z, R: where the gel is and was; p; Phi; stresses with p in them; u_r, u_z: Darcy flux.
    """

    r: NDArray
    z: NDArray
    R: NDArray
    Z: NDArray
    p: NDArray
    Phi: NDArray
    sigma_rr: NDArray
    sigma_rz: NDArray
    sigma_zz: NDArray
    sigma_hoop: NDArray
    u_r: NDArray
    u_z: NDArray

    @property
    def middle(self) -> int:
        """The line across that is the outer side of the mid-wall; the inner one is before it."""
        return self.R.shape[1] // 2

    def along_middle(self, name: str) -> NDArray:
        """A field in the middle of the wall, the mean of its two sides."""
        values = getattr(self, name)
        return (values[:, self.middle - 1] + values[:, self.middle]) / 2


def section(elements: Elements, fields: dict, material: Material) -> Section:
    """Everything at the nodes of all elements, one-sided."""
    order = _tensor_order(elements)
    s = {name: elements.at_points(name, value, lattice=True) for name, value in fields.items()}
    F, det_a = deformation(s)
    Phi = 1 / F.J
    pressure, _ = material.osmotic_pressure(Phi)
    sigma = polymer_stress(F, pressure, material.M, material.c)
    p = s["p"]
    (_, a11, a12), (_, a21, a22) = s["r"], s["z"]
    values = {name: s[name][0] for name in ("r", "z", "R", "Z", "p")} | {
        "Phi": Phi,
        "sigma_rr": sigma.rr - p[0],
        "sigma_rz": sigma.rz,
        "sigma_zz": sigma.zz - p[0],
        "sigma_hoop": sigma.hoop - p[0],
        "u_r": -(p[1] * a22 - p[2] * a21) / det_a,
        "u_z": -(p[2] * a11 - p[1] * a12) / det_a,
    }
    return Section(**{name: order(value) for name, value in values.items()})


def _tensor_order(elements):
    """Puts (element, lattice point) into (3 axial elements, 3 elements across)."""
    R, share = elements.mesh.p[:, elements.mesh.t].mean(axis=1).round(12)
    which = np.lexsort((R, share))
    across = np.unique(R).size
    lattice = [elements.at_points("R", nodes, lattice=True)[0][0] for nodes in elements.nodes]
    inside = np.lexsort([each.round(12) for each in lattice])

    def order(values):
        sorted_ = values[which][:, inside].reshape(-1, across, 3, 3)
        return sorted_.transpose(0, 2, 1, 3).reshape(-1, 3 * across)

    return order


def mean_polymer_fraction(elements: Elements, fields: dict) -> tuple[NDArray, NDArray]:
    """z of the planes through the quadrature points, and Phi averaged over the wall there."""
    s = {name: elements.at_points(name, fields[name]) for name in ("r", "z", "R", "Z")}
    F, det_a = deformation(s)
    wet = s["r"][0] * det_a * elements.weights
    station = s["z"][0].round(10)
    z, which = np.unique(station, return_inverse=True)
    which = which.ravel()
    total = np.bincount(which, wet.ravel())
    return z, np.bincount(which, (wet / F.J).ravel()) / total


def mean_width(elements: Elements, fields: dict) -> float:
    """Length from 10 to 90 % of the wall's mean polymer fraction."""
    z, Phi = mean_polymer_fraction(elements, fields)
    places = crossings(z, Phi, Phi[0], 1.0)
    return places[0] - places[-1]


def crossings(z: NDArray, values: NDArray, behind: float, ahead: float) -> NDArray:
    """z where a profile last is on its way from `behind` to `ahead`, at each of LEVELS.

    Within an element z is taken as a parabola in the value, within a jump as the jump's place.
    """
    found = []
    for level in LEVELS:
        target = ahead + level * (behind - ahead)
        k = np.flatnonzero((values - target) * np.sign(behind - ahead) >= 0)[-1]
        if k % 3 == 2:
            found.append(z[k])
            continue
        at = slice(k - k % 3, k - k % 3 + 3)
        x, y = values[at] - target, z[at]
        steep = np.diff(x)
        if steep[0] * steep[1] > 0:
            found.append(float(interpolation_weights(x, 0.0) @ y))
        else:
            found.append(float(np.interp(0.0, *_sorted(values[k : k + 2] - target, z[k : k + 2]))))
    return np.array(found)


def sharpness(z: NDArray, Phi: NDArray, Phi_inf: float, window: float) -> float:
    """A of eqn:tanh_fit about z = 0, with the least squared misfit.

    `window` is the half width of what is fitted, as in `gelpump.tube.front`. Simpson's rule in each
    element; at the window's edge an element counts as a whole or not at all.
    """
    length = np.repeat(z[2::3] - z[::3], 3) * np.tile([1, 4, 1], z.size // 3) / 6
    inside = np.repeat(np.abs(z[1::3]) < window, 3)
    x, value = z[inside], Phi[inside]
    weight = np.sqrt(length[inside] / length[inside].sum())
    fit = least_squares(
        lambda log: weight * (value - tanh_profile(np.exp(log[0]) * x, Phi_inf)),
        [-np.log(np.ptp(crossings(z, Phi, Phi[0], 1.0)) + 1e-3 * np.ptp(z))],
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-12,
    )
    return float(np.exp(fit.x[0]))


def front_numbers(seen: Section, front: float, Phi_inf: float, ell: float) -> dict[str, float]:
    """What is told of a front at z = `front`; lengths in a_1.

    Lengths of the front are from what is reached at the first line, far behind.
    """
    z, Phi = seen.z[:, 0] - front, seen.along_middle("Phi")
    radius = 2 * seen.along_middle("r") / (1 + ell)
    at = int(np.abs(z).argmin())  # the first of the two lines at the front is the one behind
    places = crossings(z, Phi, Phi[0], 1.0)
    bent = crossings(z, radius, radius[0], 1.0)
    return {
        "Phi_behind": Phi[at],
        "Phi_ahead": Phi[at + 1],
        "jump": Phi[at] - Phi[at + 1],
        "radius_front": radius[at],
        "width_Phi": places[0] - places[-1],
        "width_radius": bent[0] - bent[-1],
        "A": sharpness(z, Phi, Phi_inf, np.inf),
        "A_window": sharpness(z, Phi, Phi_inf, WINDOW * (1 - ell) / 4),
        "overshoot": Phi.max() - Phi_inf,
        "hoop_tension": seen.sigma_hoop.max(),
        "hoop_compression": -seen.sigma_hoop.min(),
    }


def lumen(elements: Elements, fields: dict, leaving: NDArray, nodes: NDArray) -> dict[str, NDArray]:
    """Along the inner surface, `nodes` of p: z, b_0, the volume of the lumen up to there and the
    water that `leaving`, by pressure node, brings into it per time; 2 pi left out."""
    order = np.flatnonzero(nodes)[np.argsort(elements.pressure_nodes[1][nodes])]
    wall = elements.pressure_nodes[0][order[0]]
    inside = np.flatnonzero(np.isclose(elements.nodes[0], wall))
    inside = inside[np.argsort(elements.nodes[1][inside])]
    z, b = fields["z"][inside], fields["r"][inside]
    volume = sum(
        weight * np.diff(z[::2], axis=0) * (_parabola(b, x) ** 2) / 2 for x, weight in GAUSS
    )
    share = elements.pressure_nodes[1][order]
    return {
        "z": z[::2],
        "b": b[::2],
        "volume": np.r_[0.0, np.cumsum(volume)],
        "inflow": running_loss(share, leaving[order]),
    }


def running_loss(share: NDArray, leaving: NDArray) -> NDArray:
    """What leaves through a surface up to each of its pressure nodes, which lie at `share`.

    `leaving` is what the rows of these nodes say, the integrals of shape functions times a density;
    the density that is linear in each element and has these integrals is integrated.
    """
    length = np.diff(share)
    mass = np.zeros((3, share.size))
    mass[0, 1:] = mass[2, :-1] = length / 6
    mass[1] = (np.r_[length, 0] + np.r_[0, length]) / 3
    density = solve_banded((1, 1), mass, leaving)
    return np.r_[0.0, np.cumsum(length * (density[1:] + density[:-1]) / 2)]


def _parabola(values, x):
    """Values in each element at x in (0, 1), from two ends and the middle."""
    left, middle, right = values[:-2:2], values[1::2], values[2::2]
    return left * (1 - x) * (1 - 2 * x) + 4 * middle * x * (1 - x) + right * x * (2 * x - 1)


def _sorted(x, y):
    order = np.argsort(x)
    return x[order], y[order]
