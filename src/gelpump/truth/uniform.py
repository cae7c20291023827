"""Bodies that are heated everywhere at once: a wall of a long tube, and a bead.

The wall is one layer of elements between the plane of symmetry Z = 0 and a plane that stays plane,
free of axial force: the tube resolved in the radius, with moving surfaces.
The bead is a quarter of its section, meshed in polar coordinates; nothing makes it stay a sphere.
"""

import numpy as np
from skfem import MeshQuad

from gelpump.truth.body import Body, free_moves
from gelpump.truth.elements import Elements, Material
from gelpump.truth.mesh import wall_radii


def wall(ell: float, material: Material, cells: int, tolerance: float = 1e-5) -> Body:
    """A wall of the inner radius `ell`, the outer radius 1 and the length 1."""
    elements = Elements(MeshQuad.init_tensor(wall_radii(ell, cells), np.linspace(0, 1, 2)), "z")
    R, Z = elements.nodes
    radius, _ = elements.pressure_nodes
    inner, outer = np.isclose(radius, ell), np.isclose(radius, 1)
    moves = free_moves(
        elements,
        {"z": np.isclose(Z, 0), "p": inner | outer},
        tied=elements.blocks["z"][np.isclose(Z, 1)],
    )
    fixed = {"R": R, "Z": Z}
    surfaces = {"inner": inner, "outer": outer}
    return Body(elements, material, lambda t: fixed, surfaces, moves, tolerance=tolerance)


def bead(material: Material, cells: tuple[int, int], tolerance: float = 1e-5) -> Body:
    """A bead of radius 1 with `cells` from its centre to the surface and from pole to equator."""
    radii = np.sin(np.pi / 2 * np.linspace(0, 1, cells[0] + 1))
    elements = Elements(MeshQuad.init_tensor(radii, np.linspace(0, 1, cells[1] + 1)), "z")
    rho, angle = elements.nodes
    R, Z = rho * np.sin(np.pi / 2 * angle), rho * np.cos(np.pi / 2 * angle)
    centre = np.isclose(rho, 0)
    surface = np.isclose(elements.pressure_nodes[0], 1)
    moves = free_moves(
        elements,
        {"r": centre | np.isclose(angle, 0), "z": centre | np.isclose(angle, 1), "p": surface},
    )
    fixed = {"R": R, "Z": Z}
    return Body(
        elements, material, lambda t: fixed, {"surface": surface}, moves, tolerance=tolerance
    )


def undeformed(body: Body) -> np.ndarray:
    """Unknowns of the state that deformation is measured from."""
    y = np.zeros(body.elements.size)
    fixed = body.prescribed(0.0)
    y[body.elements.blocks["r"]] = fixed["R"]
    y[body.elements.blocks["z"]] = fixed["Z"]
    return y
