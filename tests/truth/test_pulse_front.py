"""The wave that the front carries, and the tube from the first instant."""

import numpy as np
import pytest

from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.truth.observables import crossings, mean_polymer_fraction, section, sharpness
from gelpump.truth.pulse import Pulse
from gelpump.truth.wave import Wave
from gelpump.tube.heat import StepHeating
from gelpump.tube.wall_flow import lumen_share

GEL = PiecewiseLinearGel(2.0, 1.0, 1.0)
ELL = 0.5


def jump(wave, y):
    """Phi in the middle of the wall behind and ahead of the front."""
    seen = section(wave.elements, wave.body.fields(y), wave.body.material)
    front = np.flatnonzero(seen.z[:, 0] == 0)
    return seen.along_middle("Phi")[front]


def test_a_resting_front_sheds_nothing_and_phi_jumps_there():
    wave = Wave(ELL, GEL, (4, 12, 12))
    (y,) = wave.solve([0.0])
    assert np.abs(wave.outflow(y, 0.0)).max() < 1e-10
    assert np.abs(y[wave.elements.blocks["p"]]).max() < 1e-10
    behind, ahead = jump(wave, y)
    assert 0.3 < behind - ahead < 0.5


def test_forces_balance_along_the_wall():
    """No plane across the tube carries an axial force; its hoop stress does not vanish."""
    wave = Wave(ELL, GEL, (8, 24, 24))
    (y,) = wave.solve([1.0])
    s = section(wave.elements, wave.body.fields(y), wave.body.material)
    edges = np.diff(s.r[:, ::3] ** 2, append=s.r[:, -1:] ** 2)
    weights = np.repeat(edges, 3, axis=1) * np.tile([1, 4, 1], edges.shape[1]) / 6
    force = (s.sigma_zz * weights).sum(axis=1)
    scale = (np.abs(s.sigma_zz) * weights).sum(axis=1).max()
    assert np.abs(s.sigma_hoop).max() > 0.2
    assert np.abs(force).max() < 0.03 * scale


def test_what_the_wave_sheds_is_geometry_and_its_order_is_two():
    shares, fronts = [], []
    for k in (1, 2, 4):
        wave = Wave(ELL, GEL, (4 * k, 8 * k, 8 * k), largest_Pe=1.0)
        (y,) = wave.solve([1.0])
        leaving = wave.outflow(y, 1.0)
        shed = (1 - ELL**2) / 2 * (1 - 1 / GEL.Phi_inf) / (1 - ELL)
        assert leaving.sum() == pytest.approx(shed, rel=1e-8)
        shares.append(leaving[wave.inner].sum() / leaving.sum())
        middle = np.isclose(wave.elements.nodes[0], (1 + ELL) / 2) & (wave.elements.nodes[1] == 0)
        fronts.append(y[wave.elements.blocks["r"]][middle][0])
    for values in (shares, fronts):
        # the corners where the front meets the surfaces keep coarse meshes below two
        assert np.log2((values[0] - values[1]) / (values[1] - values[2])) > 1.7
    assert shares[-1] == pytest.approx(lumen_share(ELL), rel=0.03)


def test_profiles_are_measured_as_drawn():
    faces = np.linspace(-6, 6, 61)
    z = np.column_stack([faces[:-1], (faces[1:] + faces[:-1]) / 2, faces[1:]]).ravel()
    Phi = 1.5 - 0.5 * np.tanh(1.3 * z)
    assert sharpness(z, Phi, 2.0, np.inf) == pytest.approx(1.3, rel=1e-7)
    at = np.arctanh([0.8, 0.0, -0.8]) / 1.3
    assert crossings(z, Phi, 2.0, 1.0) == pytest.approx(at, abs=1e-3)
    step = np.where(np.arange(z.size) < 90, 1.95, 1.05)
    assert np.abs(crossings(z, step, 2.0, 1.0)).max() < 1e-12


def test_the_pulse_keeps_its_water_and_becomes_the_wave():
    heat = StepHeating(0.4)
    pulse = Pulse(ELL, GEL, heat, 10.0, (4, 14, 10), tolerance=2e-3)
    for step in pulse.steps():
        y = step.solution
        now, before = pulse.water(y)
        assert now == pytest.approx(before, rel=1e-11)
    fields = pulse.body.fields(y[: pulse.elements.size], step.time)
    assert pulse.elements.volumes(fields) == pytest.approx(y[pulse.elements.size : -2], abs=1e-15)
    p, q = GEL.Phi_inf ** (1 / 3), GEL.Phi_inf ** (-2 / 3)
    shed = (1 - ELL**2) / 2 * (p - q) * heat.front(10.0)
    assert y[-2:].sum() == pytest.approx(shed, rel=0.15)  # but for what is being shed
    T = (pulse.root + step.time) ** 2
    assert abs(T - 10.0) < 1e-9
    Pe = GEL.Phi_inf ** (1 / 3) * heat.front_speed(T) * (1 - ELL)
    wave = Wave(ELL, GEL, (4, 12, 12))
    (steady,) = wave.solve([Pe])
    middle = np.isclose(pulse.R, (1 + ELL) / 2) & (pulse.share == 0)
    there = np.isclose(wave.elements.nodes[0], (1 + ELL) / 2) & (wave.elements.nodes[1] == 0)
    r = y[pulse.elements.blocks["r"]][middle][0]
    assert r == pytest.approx(steady[wave.elements.blocks["r"]][there][0], rel=2e-3)
    z, mean = mean_polymer_fraction(pulse.elements, fields)
    assert mean[0] == pytest.approx(GEL.Phi_inf, abs=0.01)
    assert mean[-1] == pytest.approx(1.0, abs=0.01)
    assert (np.diff(z) > 0).all()


def test_an_odd_number_of_cells_across_is_refused():
    with pytest.raises(ValueError, match="5 cells across the wall are not allowed: an even number"):
        Wave(ELL, GEL, (5, 4, 4))
