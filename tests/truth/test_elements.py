import numpy as np
import pytest
from skfem import MeshQuad

from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.truth.elements import Elements
from gelpump.truth.gel import two_states

GEL = PiecewiseLinearGel(2.0, 0.7, 1.3)


def body(unknown, c=0.0):
    elements = Elements(MeshQuad.init_tensor(np.linspace(0.5, 1, 3), np.linspace(0, 1, 3)), unknown)
    hot = elements.mesh.p[1][elements.mesh.t].mean(axis=0) < 0.5
    return elements, two_states(GEL, hot, c)


def distorted(elements):
    rng = np.random.default_rng(1)
    R, Z = elements.nodes
    fields = {"R": R, "Z": 1.1 * Z, "r": 0.9 * R, "z": 0.95 * Z}
    fields = {k: v + 0.01 * rng.normal(size=v.size) for k, v in fields.items()}
    return fields | {"p": rng.normal(size=elements.pressures.N)}


@pytest.mark.parametrize("unknown", ["z", "Z"])
def test_the_tangent_is_the_derivative_of_the_residual(unknown):
    elements, material = body(unknown, c=0.3)
    fields, h = distorted(elements), 1e-6
    _, tangent = elements.residual_and_tangent(fields, material, 2.0, 0.3)
    direction = np.random.default_rng(2).normal(size=elements.size)

    def moved(step):
        shifted = {
            k: v + step * direction[elements.blocks[k]] if k in elements.blocks else v
            for k, v in fields.items()
        }
        return elements.residual_and_tangent(shifted, material, 2.0, 0.3, tangent=False)[0]

    slope = (moved(h) - moved(-h)) / (2 * h)
    assert tangent @ direction == pytest.approx(slope, abs=1e-7 * np.abs(slope).max())


@pytest.mark.parametrize("unknown", ["z", "Z"])
def test_a_gel_that_is_free_to_swell_has_no_osmotic_pressure(unknown):
    """Both halves at the stretch of the hot gel: no force on hot nodes, -Pi(Phi_inf) when cold."""
    elements, material = body(unknown)
    R, Z = elements.nodes
    stretch = GEL.Phi_inf ** (-1 / 3)
    fields = {"R": R, "Z": Z, "r": stretch * R, "z": stretch * Z}
    fields["p"] = np.zeros(elements.pressures.N)
    residual, _ = elements.residual_and_tangent(fields, material, tangent=False)
    radial = residual[elements.blocks["r"]]
    assert np.abs(radial[Z < 0.45]).max() < 1e-14
    top = np.isclose(R, 1) & (Z > 0.55)
    load = stretch * 0.5 * stretch * GEL.osmotic_pressure(2.0, -1.0)
    middle = np.isclose(R, 1) & (Z == 0.5)
    assert -radial[top | middle].sum() == pytest.approx(load, rel=1e-12)


def test_the_volume_is_that_of_the_tube():
    elements, _ = body("z")
    R, Z = elements.nodes
    assert elements.volumes({"r": R, "z": Z}).sum() == pytest.approx((1 - 0.5**2) / 2, rel=1e-14)


def test_a_mesh_that_slides_through_a_gel_at_rest_moves_no_water():
    """Skewed elements whose labels change in time, in a gel that is uniformly stretched."""
    elements, material = body("Z")
    xi, share = elements.nodes
    R, stretch, alpha = xi * (1 + 0.2 * share), 0.9, 5.0
    before, now = share, share + 0.1 * share * (1 + share) - 0.05 * xi

    def state(Z):
        return {"R": R, "Z": Z, "r": stretch * R, "z": stretch * Z}

    fields = state(now) | {"p": np.zeros(elements.pressures.N)}
    rows, _ = elements.residual_and_tangent(fields, material, alpha, -alpha * before, False)
    water = rows[elements.blocks["p"]] - alpha * elements.volumes(state(before))
    inside = np.all(
        (elements.pressure_nodes > [[0.5], [0]]) & (elements.pressure_nodes < 1), axis=0
    )
    assert (
        np.abs(alpha * np.diff([elements.volumes(state(Z)) for Z in (before, now)], axis=0)).max()
        > 0.01
    )
    assert np.abs(water[inside]).max() < 1e-14
