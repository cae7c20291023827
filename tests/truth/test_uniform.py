import numpy as np
import pytest

from gelpump.bead import nonlinear
from gelpump.materials.energy_based import EnergyBasedGel
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.truth.elements import Material
from gelpump.truth.gel import two_states
from gelpump.truth.uniform import bead, undeformed, wall

GEL = PiecewiseLinearGel(2.0, 1.0, 1.0)


def last(body, end):
    *_, step = body.evolve(undeformed(body), end)
    return step.solution


def test_a_heated_wall_collapses_to_the_free_gel_and_keeps_its_water():
    body = wall(0.5, two_states(GEL, np.ones(6, bool)), 6, tolerance=1e-3)
    before = body.elements.volumes(body.fields(undeformed(body))).sum()
    y = last(body, 1.0)
    fields = body.fields(y[: body.size])
    stretch = GEL.Phi_inf ** (-1 / 3)
    R, Z = body.elements.nodes
    assert fields["r"] == pytest.approx(stretch * R, abs=1e-6)
    assert fields["z"] == pytest.approx(stretch * Z, abs=1e-6)
    lost = y[-2:]
    assert lost.sum() == pytest.approx(before / 2, rel=1e-5)
    after = body.elements.volumes(fields).sum()
    assert after + lost.sum() == pytest.approx(before, rel=1e-12)


def test_a_bead_of_the_energy_based_gel_is_the_nonlinear_bead():
    gel = EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720.0, (290.0, 320.0))
    T, phi = 303.0, gel.equilibrium_polymer_fraction(304.0)
    mu, radius = gel.shear_modulus(1.0), phi ** (-1 / 3)

    def osmotic_pressure(Phi):
        f = np.clip(phi * Phi, 1e-6, 1 - 1e-9)
        return gel.osmotic_pressure(f, T) / mu, gel.osmotic_modulus(f, T) / mu / Phi

    end = 0.3
    known = nonlinear.solve(gel, T, phi, [0, end], 400, tolerance=1e-8).radius.values[-1] / radius
    material = Material(osmotic_pressure, gel.shear_modulus(phi) / mu)
    body = bead(material, (8, 2), tolerance=1e-5)
    y = last(body, end / radius**2)
    surface = body.elements.nodes[0] == 1
    fields = body.fields(y[: body.size])
    found = np.hypot(fields["r"], fields["z"])[surface]
    assert abs(known - 1) > 0.01
    assert found == pytest.approx(known, abs=0.005 * abs(known - 1))
