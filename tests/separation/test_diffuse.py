"""The bead with an energy of interfaces: its flow, linear theory, the sharp limit, refusals."""

from functools import cache

import numpy as np
import pytest

from gelpump.bead import nonlinear
from gelpump.materials import EnergyBasedGel
from gelpump.separation import diffuse, diffuse_lens, observed, shells, stability, watch
from gelpump.separation.energy import ENERGIES

HHT = EnergyBasedGel("HHT", A0=-62.22, A1=-58.28, B0=0.20470, B1=0.19044, Omega=720.0)
SWOLLEN = HHT.equilibrium_polymer_fraction(304.0)
TIMES = np.unique(np.append(np.linspace(0.0, 0.4, 201), np.geomspace(1e-6, 2e-3, 20)))


@cache
def bead(width, cells):
    energy = ENERGIES["nonlinear"](HHT, 308.0)
    return diffuse.solve(energy, SWOLLEN, TIMES, cells, width=width)


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_rate_is_the_flow_of_the_energy(model):
    flow = diffuse.Bead(ENERGIES[model](HHT, 308.0), 1e-3, 12)
    r = SWOLLEN ** (-1 / 3) * flow.R[1:] * (1 + 0.1 * np.sin(3 * flow.R[1:]))
    slope = [(flow.energy_of(r + d) - flow.energy_of(r - d)) / 2e-6 for d in 1e-6 * np.eye(r.size)]
    faces = np.append(0.0, r)
    middle = np.append(0.5 * (faces[1:] + faces[:-1]), faces[-1])
    rate = flow.rate(r)
    np.testing.assert_allclose(
        rate, -3 * np.array(slope) / np.diff(middle**3), atol=2e-6 * abs(rate).max()
    )


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_growth_rates_are_those_of_linear_theory(model):
    """Spherical modes j_1(k r) about a uniform state with D < 0."""
    phi, kappa = 0.3, 4e-3
    flow = diffuse.Bead(ENERGIES[model](HHT, 308.0), kappa, 800)
    uniform = phi ** (-1 / 3) * flow.R[1:]
    fastest = stability.fastest_wavelength(HHT, 308.0, phi, kappa)
    inside = slice(40, 700)
    for wavelength in (fastest, 1.4 * fastest, 2.0 * fastest):
        k = 2 * np.pi / wavelength
        x = k * uniform
        mode = 1e-7 * (np.sin(x) / x**2 - np.cos(x) / x)
        change = 0.5 * (flow.rate(uniform + mode) - flow.rate(uniform - mode))
        found = (change[inside] @ mode[inside]) / (mode[inside] @ mode[inside])
        expected = stability.growth_rate(HHT, 308.0, phi, kappa, k)
        np.testing.assert_allclose(found, expected, rtol=1e-2)


def test_width_is_that_of_the_flat_interface():
    energy = ENERGIES["nonlinear"](HHT, 308.0)
    np.testing.assert_allclose(diffuse.width_per_root_kappa(energy), 0.2520, rtol=1e-3)


def test_reference_course():
    """Computed once before, by another hand with another code, on 1600 shells: to 0.5 %."""
    run = bead(0.05, 640)
    np.testing.assert_allclose(
        run.radius.interp(t=[0.05, 0.1, 0.2]), [2.5471, 2.4641, 1.4951], rtol=1e-3
    )
    np.testing.assert_allclose(observed.passage(run, 0.7), 0.1391, rtol=5e-3)
    np.testing.assert_allclose(observed.passage(run, 0.3), 0.2584, rtol=5e-3)


def test_laws():
    run = bead(0.05, 640)
    assert np.diff(run.energy).max() < 1e-9
    assert abs(run.polymer_volume_error).max() < 1e-10


def test_below_separation_it_tends_to_the_bead_of_one_phase():
    times = np.array([0.0, 0.1, 0.5])
    whole = nonlinear.solve(HHT, 307.5, SWOLLEN, times, 100, tolerance=1e-8).radius
    energy = ENERGIES["nonlinear"](HHT, 307.7)  # whose interface gives kappa
    away = []
    for width in (0.08, 0.04):
        kappa = (width / diffuse.width_per_root_kappa(energy)) ** 2
        flow = diffuse.Bead(ENERGIES["nonlinear"](HHT, 307.5), kappa, 400)
        start = SWOLLEN ** (-1 / 3) * flow.R[1:]
        states = [
            step.at(t)[-1]
            for step, t in zip(reached(flow, start, times[1:]), times[1:], strict=True)
        ]
        away.append(np.abs(states / whole[1:] - 1).max())
    assert away[1] < 2e-3
    assert np.log2(away[0] / away[1]) > 0.7  # the order in the width, that of its layer


def reached(flow, start, times):
    """The steps within which the times lie."""
    due = list(times)
    for step in diffuse.steps(flow, start, times[-1]):
        if due and due[0] <= step.time:
            due.pop(0)
            yield step


@pytest.mark.parametrize(("width", "cells"), [(0.001, 640), (0.3, 640), (0.02, 100)])
def test_unresolved_and_too_wide_interfaces_are_refused(width, cells):
    with pytest.raises(ValueError, match="width"):
        diffuse.solve(ENERGIES["nonlinear"](HHT, 308.0), SWOLLEN, TIMES, cells, width=width)


def test_layers_are_said_and_told_of():
    """A uniform bead with D < 0 decomposes, at about the wavelength that grows fastest."""
    energy, times = ENERGIES["nonlinear"](HHT, 308.0), np.linspace(0.0, 0.01, 21)
    with pytest.raises(watch.UnderResolved, match="fronts, not one"):
        diffuse.solve(energy, 0.3, times, 340, width=0.05)
    run = diffuse.solve(energy, 0.3, times, 340, width=0.05, layers=True)
    assert run.attrs["fronts"] > 3
    fastest = stability.fastest_wavelength(HHT, 308.0, 0.3, run.attrs["kappa"])
    assert run.attrs["wavelength"] == pytest.approx(fastest, rel=0.2)


def test_a_run_on_too_few_shells_ends_in_words():
    """Its mesh would be refused before; here it is what is seen at the steps that ends it."""
    energy = ENERGIES["nonlinear"](HHT, 308.0)
    bead = diffuse.Bead(energy, diffuse.kappa_of(energy, 0.02), 100)
    steps = diffuse.steps(bead, SWOLLEN ** (-1 / 3) * bead.R[1:], 0.3)
    with pytest.raises(watch.UnderResolved, match="cells across a width"):
        watch.course(energy, bead, steps, np.array([0.0, 0.3]), layers=False)


R = shells.clustered_outside(40)
UNIFORM = SWOLLEN ** (-1 / 3) * R


@pytest.mark.parametrize(
    ("state", "energy", "said"),
    [
        ((R, np.where(R[7] == R, UNIFORM[9], UNIFORM)), -1.0, "tangled"),
        ((1.01 * R, UNIFORM), -1.0, "of the polymer"),
        ((R, UNIFORM), 1e-9, "the energy rises by 1e-09"),
        ((R, np.where(R < 0.8, UNIFORM, UNIFORM - 0.9 * (R - 0.8))), -1.0, None),
    ],
)
def test_what_is_seen_at_a_step(state, energy, said):
    seen = watch.Watch((0.06, 0.6), False)
    seen.see(0.0, R, UNIFORM, 0.0)
    if said is None:
        seen.see(0.1, *state, energy)
    else:
        with pytest.raises(watch.UnderResolved, match=said):
            seen.see(0.1, *state, energy)


class TestLensOnFiPy:
    """The LENS bead by another discretisation and another integrator."""

    def bead(self, cells=30, width=0.05):
        energy = ENERGIES["lens"](HHT, 308.0)
        return diffuse_lens.Bead(energy, diffuse.kappa_of(energy, width), cells, 1e-3)

    def test_one_sweep_is_newtons_step(self):
        flow = self.bead()
        start = flow.start(SWOLLEN)
        y = start * (1 + 0.1 * np.append(np.cos(5 * flow.x[1:]), 0.0))
        alpha, history = 30.0, -30.0 * start

        def residual(z):
            return flow.residual(z, alpha * z + history)

        columns = [(residual(y + d) - residual(y - d)) / 2e-6 for d in 1e-6 * np.eye(y.size)]
        expected = -np.linalg.solve(np.transpose(columns), residual(y))
        np.testing.assert_allclose(
            flow.newton(y, alpha, history), expected, atol=1e-5 * abs(expected).max()
        )

    def test_two_solvers_agree(self):
        """Until the front is well inside; at width 0.02 it is the target separation's."""
        times = np.linspace(0.0, 0.29, 59)
        run = diffuse_lens.solve(HHT, 308.0, SWOLLEN, times, 200, width=0.05, tolerance=1e-3)
        other = diffuse.solve(ENERGIES["lens"](HHT, 308.0), SWOLLEN, times, 640, width=0.05)
        np.testing.assert_allclose(run.radius, other.radius, rtol=3e-3)
        np.testing.assert_allclose(run.front_dry_radius[-1], other.front_dry_radius[-1], atol=4e-3)
        assert run.front_dry_radius[-1] < 0.8
        assert run.energy.diff("t").max() < 0
        assert abs(run.polymer_volume_error).max() < 1e-10

    def test_refusals(self):
        with pytest.raises(ValueError, match="of 100 cells"):
            diffuse_lens.solve(HHT, 308.0, SWOLLEN, TIMES, 100, width=0.02, tolerance=1e-3)
        with pytest.raises(ValueError, match="as large as the bead"):
            diffuse_lens.solve(HHT, 308.0, SWOLLEN, TIMES, 100, width=0.3, tolerance=1e-3)
