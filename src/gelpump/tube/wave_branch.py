r"""One side of a travelling wave (`gelpump.tube.wave`), from its state of rest to the front.

With lambda as the variable, the flux j obeys

    printed        j dj/dlambda = K S - c j ,                      j = K lambda_xi
    conservative   j dj/dlambda = lambda^4 K S - lambda^2 c j ,    j = lambda^2 K lambda_xi

from j = 0 at either state of rest; the front is where the two branches meet. The term in c is taken
by the trapezoidal rule and K S by Gauss's, so that each step is the root of a quadratic,

    (j_1^2 - j_0^2)/2 = Integral K S dlambda - c (j_0 + j_1)(lambda_1 - lambda_0)/2 ,

exact for a front at rest and stable for any c; nodes cluster at the states of rest. Arrays are
(nodes, waves).
"""

import numpy as np
from numpy.typing import NDArray

SEARCH = (4, 4, 8, 24)  # intervals in the search for the front
GRADING = 3  # nodes at (i/n)^3 of the way from rest to the front
POINT, WEIGHT = np.polynomial.legendre.leggauss(3)


class Branch:
    """One side of waves: the stretch `rest` at rest, s, m = 4M/3 and c, each (waves,)."""

    def __init__(
        self, rest: NDArray, s: NDArray, m: NDArray, c: NDArray, conservative: bool
    ) -> None:
        self.rest, self.s, self.m, self.c = rest, s, m, c
        self.conservative = conservative

    def rho(self, stretch):
        """(s/lambda + 4M/3 lambda)."""
        return self.s / stretch + self.m * stretch

    def source_over_distance(self, stretch):
        """S/(lambda - rest), which does not vanish at rest; Phi_0 = rest^-3."""
        product = stretch * self.rest
        squares = stretch * stretch + product + self.rest**2
        return self.rho(stretch) * squares / (3 * product * product * product)

    def drive(self, stretch):
        """d(j^2/2)/dlambda at c = 0: K S, or lambda^4 K S."""
        square = stretch * stretch
        cube, rest_cube = square * stretch, self.rest**3
        rho_lambda = self.s + self.m * square
        drive = rho_lambda * rho_lambda * (cube - rest_cube)
        drive /= cube * square if self.conservative else cube * cube * cube
        return drive / (3 * rest_cube)

    def solve(self, front: NDArray, intervals: int) -> tuple[NDArray, NDArray]:
        """Nodes and flux from rest to lambda = front."""
        share = (np.arange(intervals + 1)[:, np.newaxis] / intervals) ** GRADING
        stretch = self.rest + (front - self.rest) * share
        step = np.diff(stretch, axis=0)
        driven = sum(
            weight * self.drive(stretch[:-1] + (1 + point) / 2 * step)
            for point, weight in zip(POINT, WEIGHT, strict=True)
        )
        driven *= step
        cubes = stretch * stretch * stretch
        drag = self.c / 2 * (np.diff(cubes, axis=0) / 3 if self.conservative else step)
        flux = np.zeros_like(stretch)
        for i in range(intervals):
            flux[i + 1] = np.sqrt((flux[i] - drag[i]) ** 2 + driven[i]) - drag[i]
        return stretch, flux

    def end(self, front: NDArray, intervals: int) -> tuple[NDArray, NDArray]:
        """Extrapolated flux at the front, and its slope dj/dlambda there."""
        fine, coarse = (self.solve(front, n)[1][-1] for n in (intervals, intervals // 2))
        flux = fine + (fine - coarse) / 3
        drag = self.c * front**2 if self.conservative else self.c
        return flux, self.drive(front) / flux - drag

    def along(self, stretch: NDArray, flux: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """K and j/|lambda - rest| at the nodes, and the steps |dlambda|: |dxi| = K |dlambda|/j.

        With lambda^2 K in the place of K where j is lambda^2 K lambda_xi.
        """
        square = stretch * stretch
        K = self.rho(stretch) / (square if self.conservative else square * square)
        slope = np.empty_like(flux)  # tends to a root of its own at rest
        slope[1:] = flux[1:] / np.abs(stretch[1:] - self.rest)
        slope[0] = self.slope_at_rest(np.sign(stretch[-1] - self.rest))
        return K, slope, np.abs(np.diff(stretch, axis=0))

    def carried(self, stretch: NDArray, flux: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """Of each step, |dZ| over w; w V and the integral of V dZ from rest to the front.

        V here is what this branch adds from rest on, so that all integrands stay finite at rest.
        """
        K, slope, step = self.along(stretch, flux)
        gain = 1.5 * self.source_over_distance(stretch) * K / (slope * stretch**2 * stretch**2)
        V = _running(gain, step)
        V_over_distance = np.empty_like(V)
        V_over_distance[1:] = V[1:] / np.abs(stretch[1:] - self.rest)
        V_over_distance[0] = gain[0]
        volume = _running(V_over_distance * stretch * K / slope, step)
        # nearly exponential from node to node; infinite to the state of rest
        with np.errstate(divide="ignore"):
            ratio = np.diff(np.log(flux), axis=0) / np.diff(flux, axis=0)
        length = stretch * K
        return (length[1:] + length[:-1]) / 2 * step * ratio, V[-1], volume[-1]

    def displaced(self, stretch: NDArray, flux: NDArray) -> tuple[NDArray, NDArray]:
        """Integrals of lambda and of lambda^3 over xi, less those at rest."""
        K, slope, step = self.along(stretch, flux)
        sign = np.sign(stretch[-1] - self.rest)
        per_step = K / slope
        cubes = per_step * (stretch * stretch + stretch * self.rest + self.rest**2)
        return tuple(sign * _running(each, step)[-1] for each in (per_step, cubes))

    def slope_at_rest(self, sign):
        """j/|lambda - rest|: g^2 + sign c g = drive', of hot (sign 1) and cold (-1) branches."""
        scale = self.rest**2 if self.conservative else 1.0
        curvature = self.rho(self.rest) * self.source_over_distance(self.rest)
        curvature = curvature if self.conservative else curvature / self.rest**4
        b = sign * self.c * scale
        return np.sqrt(b**2 / 4 + curvature) - b / 2


def meeting(hot: Branch, cold: Branch) -> NDArray:
    """lambda at the front, where the branches' fluxes agree, by Newton's method.

    It starts where the chord of the hot branch meets the tangent of the cold one.
    """
    low, high = hot.rest, cold.rest
    chord = hot.solve(high, 4)[1][-1] / (high - low)
    tangent = cold.slope_at_rest(-1.0)
    front = (tangent * high + chord * low) / (tangent + chord)
    for intervals in SEARCH:
        (flux_hot, slope_hot), (flux_cold, slope_cold) = (
            branch.end(front, intervals) for branch in (hot, cold)
        )
        new = front - (flux_hot - flux_cold) / (slope_hot - slope_cold)
        front = np.clip(new, front + 0.8 * (low - front), front + 0.8 * (high - front))
    return front


def _running(values, step):
    """Trapezoidal integral from rest to each node."""
    total = np.zeros_like(values)
    total[1:] = (values[1:] + values[:-1]) / 2 * step
    for i in range(1, len(step)):  # several times as fast as numpy's cumsum along this axis
        total[i + 1] += total[i]
    return total
