"""The bead with an energy of interfaces: its flow, linear theory, the sharp limit, refusals."""

from functools import cache

import numpy as np
import pytest

from gelpump.bead import nonlinear
from gelpump.materials import EnergyBasedGel
from gelpump.separation import diffuse, observed, stability
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
        _, states = diffuse._integrate(flow, SWOLLEN ** (-1 / 3) * flow.R[1:], times, 1e-7)
        away.append(np.abs(states[1:, -1] / whole[1:] - 1).max())
    assert away[1] < 2e-3
    assert away[1] < 0.7 * away[0]


@pytest.mark.parametrize(("width", "cells"), [(0.001, 640), (0.3, 640), (0.02, 100)])
def test_unresolved_and_too_wide_interfaces_are_refused(width, cells):
    with pytest.raises(ValueError, match="width"):
        diffuse.solve(ENERGIES["nonlinear"](HHT, 308.0), SWOLLEN, TIMES, cells, width=width)


def test_layers_are_said():
    """A uniform bead with D < 0 decomposes in layers: a run in words, not a smooth radius."""
    energy = ENERGIES["nonlinear"](HHT, 308.0)
    with pytest.raises(diffuse.UnderResolved, match="fronts"):
        diffuse.solve(energy, 0.3, np.linspace(0.0, 0.01, 21), 640, width=0.03)
