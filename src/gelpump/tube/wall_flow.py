"""Flow through the wall of the tube (section 3.6.1), given Phi_1 in the middle of the wall.

A point of the wall is told by the radius s that it had in the swollen tube, ell <= s <= 1, where it
now is at R = s Phi_1^{-1/3}; the wall's edges are B_0 = ell Phi_1^{-1/3} and B_1 = Phi_1^{-1/3}.
Radii are in units of a_1, radial velocities in a_1 and axial ones in L per poroelastic time.

Radial structure, Phi = Phi_1 + eps^2 Phi_2. The paper asks three things of Phi_2: it is of the form
(f/4D) R^2 + g ln R + h; it vanishes on the midline s = m = (1+ell)/2; it equals
(Phi_0 - Phi_1)/eps^2, here `drive`, on both edges. It then prints (eqn:phi2)

    Phi_2 = 4 drive (s - m)^2 / (1-ell)^2,     f = 16 D drive Phi_1^{2/3} / (1-ell)^2 ,

which is not of that form. What the three conditions do give is

    Phi_2 = drive (alpha s^2 + gamma ln s + 1 - alpha),    gamma = -alpha (1-ell^2)/ln(1/ell)
    1/alpha = 1 - m^2 - (1-ell^2) ln(1/m)/ln(1/ell)
    f = kappa D drive Phi_1^{2/3} / (1-ell)^2,             kappa = 4 (1-ell)^2 alpha

(s = 1: alpha + 1 - alpha = 1; s = ell: alpha ell^2 + alpha (1-ell^2) + 1 - alpha = 1; s = m: the
bracket is 1 - alpha/alpha = 0). kappa, `source_coefficient`, stands where F of eqn:tube_model has
16; it is below 8 and tends to 8 for thin walls. The printed square has 8 too when its Laplacian is
averaged over the wall.

Interstitial velocity (eqn:ug), relative to the polymer:

    V_g = (D/Phi_1) dPhi_1/dZ,     U_g = (D/Phi_1) dPhi_2/dR .

The section on the lumen prints U_g again, without the factor 1/Phi_1.

Of the water that a radial source sheds, a share goes to the lumen: with equal Phi_2 on both edges
it is [(1-ell^2)/ln(1/ell) - 2 ell^2] / [2 (1-ell^2)], whatever the amplitude.

If kappa replaces 16, only w = eps (1-ell)/4 changes, to w sqrt(16/kappa).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray as xr

PRINTED_SOURCE_COEFFICIENT = 16.0


def source_coefficient(ell: float | NDArray) -> NDArray:
    """kappa, the consistent counterpart of the 16 in F."""
    return 4 * (1 - ell) ** 2 * _alpha(ell)


def mean_source_coefficient(ell: float | NDArray) -> NDArray:
    """The counterpart of kappa for the mean over the section in place of the midline: 12, thin.

    On both edges Phi_2 is `drive` above its mean. With (R^2, ln R, 1) and <s^2> = (1+ell^2)/2,
    <ln s> = -1/2 - ell^2 ln(ell)/(1-ell^2) it is again alpha = kappa/(4 (1-ell)^2).
    """
    square = (1 - ell**2) / 2
    log = (1 - ell**2) / np.log(1 / ell) * (0.5 + ell**2 * np.log(ell) / (1 - ell**2))
    return 4 * (1 - ell) ** 2 / (square - log)


def lumen_share(ell: float | NDArray) -> NDArray:
    """Part of the water shed by the radial source that enters the lumen; the rest goes outwards."""
    return (1 / np.log(1 / ell) - 2 * ell**2 / (1 - ell**2)) / 2


def _alpha(ell):
    m = (1 + ell) / 2
    return 1 / (1 - m**2 - (1 - ell**2) * np.log(1 / m) / np.log(1 / ell))


def Phi2_printed(s: NDArray, drive: NDArray, ell: float | NDArray) -> NDArray:
    """Phi_2 of eqn:phi2."""
    return 4 * drive * (s - (1 + ell) / 2) ** 2 / (1 - ell) ** 2


def Phi2_consistent(s: NDArray, drive: NDArray, ell: float | NDArray) -> NDArray:
    """Phi_2 of the three conditions above eqn:phi2."""
    alpha = _alpha(ell)
    gamma = -alpha * (1 - ell**2) / np.log(1 / ell)
    return drive * (alpha * s**2 + gamma * np.log(s) + 1 - alpha)


def _slope_printed(s, ell):
    """dPhi_2/ds per drive."""
    return 8 * (s - (1 + ell) / 2) / (1 - ell) ** 2


def _slope_consistent(s, ell):
    return _alpha(ell) * (2 * s - (1 - ell**2) / np.log(1 / ell) / s)


@dataclass(frozen=True)
class Wall:
    """A tube's wall at one or several times, from a dataset of `gelpump.tube.slender`.

    Arrays are (..., cell) or (..., face); ell and eps are (..., 1), so that they go with both.
    """

    ell: np.ndarray
    eps: np.ndarray
    Phi1: np.ndarray
    Phi1_face: np.ndarray
    Phi_0: np.ndarray
    F: np.ndarray
    flux: np.ndarray
    Z_face: np.ndarray
    behind: int
    """Number of cells behind the front, and so the front's face."""
    conserves_water: bool = False
    """Whether the wall is that of a closure that conserves water."""

    @classmethod
    def of(cls, pulse: xr.Dataset) -> Wall:
        """The wall of `pulse`, with the dimensions (ell, tau) or none of them, then the cells."""
        column = {name: pulse[name].values[..., np.newaxis] for name in ("ell", "eps", "Phi_inf")}
        if "tau" in pulse.dims:
            column = {name: value[..., np.newaxis] for name, value in column.items()}
        Phi1, Z_face = pulse.Phi1.values, pulse.Z_face.values
        length = np.diff(Z_face)
        share = length[..., :-1] / (length[..., :-1] + length[..., 1:])
        inner = Phi1[..., :-1] + share * np.diff(Phi1)
        inner[..., int(pulse.hot.sum()) - 1] = pulse.Phi1_front.values
        return cls(
            ell=column["ell"],
            eps=column["eps"],
            Phi1=Phi1,
            Phi1_face=np.concatenate([Phi1[..., :1], inner, Phi1[..., -1:]], axis=-1),
            Phi_0=np.where(pulse.hot.values, column["Phi_inf"], 1.0),
            F=pulse.F.values,
            flux=pulse.flux.values,
            Z_face=Z_face,
            behind=int(pulse.hot.sum()),
            conserves_water="wall_length" in pulse,
        )

    @property
    def cell_length(self) -> NDArray:
        """Axial length of the cells."""
        return np.diff(self.Z_face)

    def integral(self, density: NDArray) -> NDArray:
        """Integral over Z of a density in the cells, from 0 to each face."""
        running = np.cumsum(density * self.cell_length, axis=-1)
        return np.concatenate([np.zeros_like(running[..., :1]), running], axis=-1)

    @property
    def drive(self) -> NDArray:
        """(Phi_0 - Phi_1)/eps^2, what Phi_2 is on the edges."""
        return (self.Phi_0 - self.Phi1) / self.eps**2

    @property
    def axial_velocity(self) -> NDArray:
        """V_g in the cells."""
        return (self.flux[..., 1:] + self.flux[..., :-1]) / 2 / self.Phi1

    @property
    def axial_velocity_face(self) -> NDArray:
        """V_g on the faces."""
        return self.flux / self.Phi1_face

    @property
    def shrinkage(self) -> NDArray:
        """DPhi_1/Dtau of the material in the cells, F + Phi_1 dV_g/dZ."""
        return self.F + self.Phi1 * np.diff(self.axial_velocity_face) / self.cell_length

    @property
    def polymer_velocity_face(self) -> NDArray:
        """Axial velocity of the polymer on the faces; the section Z = 0 does not move."""
        if self.conserves_water:
            outflow = np.diff(self.Phi1_face ** (-2 / 3) * self.axial_velocity_face)
            along = self.Phi1 ** (2 / 3) * outflow / self.cell_length
            return -self.integral(self.F / self.Phi1 + along) / 3
        return -(self.integral(self.F / self.Phi1) + self.axial_velocity_face) / 3

    @property
    def largest_axial_velocity(self) -> NDArray:
        """Largest |V_g| along the tube."""
        return np.abs(self.axial_velocity_face).max(axis=-1)

    @property
    def largest_radial_velocity(self) -> NDArray:
        """Largest |U_g| of eqn:ug with eqn:phi2: at the outer edge, in a cell or on a side of the
        front, where it jumps and the nearest two cells are extrapolated to."""
        speed = np.abs(self.radial_velocity_printed(np.ones(1))[..., 0])
        sides = [
            self._at_front(speed, self.behind - 1, self.behind - 2),
            self._at_front(speed, self.behind, self.behind + 1),
        ]
        return np.max([speed.max(axis=-1), *sides], axis=0)

    def _at_front(self, values, nearest, next_one):
        length = self.cell_length
        share = length[..., nearest] / (length[..., nearest] + length[..., next_one])
        return values[..., nearest] + share * (values[..., nearest] - values[..., next_one])

    @property
    def radial_to_axial_velocity(self) -> NDArray:
        """The one over the other, in the same units."""
        return self.eps[..., 0] * self.largest_radial_velocity / self.largest_axial_velocity

    def radial_velocity(self, s: NDArray) -> NDArray:
        """U_g of the wall's own closure: printed, or (F/4) Phi_1^(-4/3) (2s - (1-ell^2)/(ln(1/ell)
        s)) of a wall that conserves water, whatever its kappa."""
        if not self.conserves_water:
            return self.radial_velocity_printed(s)
        ell = self.ell[..., np.newaxis]
        slope = 2 * s - (1 - ell**2) / np.log(1 / ell) / s
        return (self.F * self.Phi1 ** (-4 / 3) / 4)[..., np.newaxis] * slope

    def radial_velocity_printed(self, s: NDArray) -> NDArray:
        """U_g of eqn:ug with eqn:phi2 in the cells, at the swollen radius s, along a new axis."""
        return self._radial_velocity(_slope_printed, s)

    def radial_velocity_consistent(self, s: NDArray) -> NDArray:
        """U_g of eqn:ug with the Phi_2 of the three conditions."""
        return self._radial_velocity(_slope_consistent, s)

    def _radial_velocity(self, slope, s):
        # D drive = F (1-ell)^2 / (16 Phi_1^{2/3}), dPhi_2/dR = Phi_1^{1/3} dPhi_2/ds
        amplitude = (
            (1 - self.ell) ** 2 / PRINTED_SOURCE_COEFFICIENT * self.F * self.Phi1 ** (-4 / 3)
        )
        return amplitude[..., np.newaxis] * slope(s, self.ell[..., np.newaxis])
