"""Meshes of the tube's wall: graded to its two surfaces and to the front."""

import numpy as np
from numpy.typing import NDArray
from skfem import MeshQuad


def wall_radii(ell: float, cells: int) -> NDArray:
    """Edges of `cells` (even) cells from ell to 1, finest at both; the mid-wall is one of them."""
    return (1 + ell) / 2 + (1 - ell) / 2 * np.sin(np.pi / 2 * np.linspace(-1, 1, cells + 1))


def from_front(length: float, scale: float, shares: NDArray) -> NDArray:
    """Distances from the front of the points with `shares` 0 ... 1 of the cells up to `length`.

    Uniform where length << scale, else graded: the first cell has about scale/cells, times the
    logarithm of length/scale. A smooth function of `length`, so meshes may follow a front in time.
    """
    b = np.arcsinh(length / scale)
    return length * np.sinh(b * shares) / np.sinh(b)


def wall_mesh(ell: float, cells: tuple[int, int, int]) -> MeshQuad:
    """Radius times share: cells across the wall, behind the front (-1 to 0), ahead of it (0 to 1).

    The second coordinate becomes a distance by `from_front`.
    """
    across, behind, ahead = cells
    if across % 2:
        raise ValueError(f"{across} cells across the wall are not allowed: an even number")
    shares = np.r_[np.linspace(-1, 0, behind + 1)[:-1], np.linspace(0, 1, ahead + 1)]
    return MeshQuad.init_tensor(wall_radii(ell, across), shares)
