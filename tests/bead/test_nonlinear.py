"""Fully nonlinear bead: published radii, convergence, equilibrium, relaxation, stops."""

from functools import cache

import numpy as np
import pytest

from gelpump.bead import nonlinear, stress_free
from gelpump.bead.dataset import Loss
from gelpump.materials import EnergyBasedGel, PiecewiseLinearGel

HHT = EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720, (290, 320))
SWELLING = (0, 1e-3, 0.01, 0.05, 0.1, 1)
DRYING = (0, 0.2, 1, 2, 3, 4, 5, 8)


@cache
def bead(before, after, times, cells=100, tolerance=1e-8):
    phi = HHT.equilibrium_polymer_fraction(before)
    return nonlinear.solve(HHT, after, phi, times, cells, tolerance=tolerance)


@pytest.mark.parametrize(
    ("case", "published"),
    [
        ((308, 304, SWELLING), (1.495, 1.823, 2.102, 2.229, 2.596)),
        ((304, 307.6, DRYING), (2.474, 2.160, 1.929, 1.809, 1.733, 1.629)),
    ],
    ids=["swelling", "drying"],
)
def test_published_radii(case, published):
    """Figures 3 and 4, read off to three decimals."""
    radius = bead(*case).radius.values[1 : 1 + len(published)]
    np.testing.assert_allclose(radius, published, atol=1e-3)


@pytest.mark.parametrize(
    ("case", "late"), [((308, 304, SWELLING), 1), ((304, 307.6, DRYING[:-1]), 1)]
)
def test_second_order_in_space(case, late):
    radius = [bead(*case, cells, 1e-10).radius.values[late:] for cells in (25, 50, 100)]
    coarse, fine = np.abs(radius[1] - radius[0]), np.abs(radius[2] - radius[1])
    assert np.log2(coarse.max() / fine.max()) >= 1.9
    assert fine.max() / 3 < 1e-4


def test_time_tolerance():
    for case in ((308, 304, SWELLING), (304, 307.6, DRYING)):
        loose, tight = bead(*case).radius, bead(*case, tolerance=1e-10).radius
        assert abs(loose - tight).max() < 1e-5


@pytest.mark.parametrize(("before", "after"), [(308, 304), (304, 307.6)])
def test_polymer_is_conserved_and_shells_keep_their_order(before, after):
    run = bead(before, after, SWELLING if after == 304 else DRYING)
    assert abs(run.polymer_volume_error).max() < 1e-12
    assert (run.r_face.diff("face") > 0).all()
    assert (run.r.diff("cell") > 0).all()


@pytest.mark.parametrize(("before", "after"), [(308, 304), (304, 307.6)])
def test_tends_to_equilibrium(before, after):
    phi = HHT.equilibrium_polymer_fraction(after)
    end = bead(before, after, (0, 1, 40)).isel(t=-1)
    np.testing.assert_allclose(end.polymer_fraction, phi, rtol=1e-6)
    assert end.surface_polymer_fraction == pytest.approx(phi, rel=1e-6)
    assert end.radius == pytest.approx(phi ** (-1 / 3), rel=1e-7)


@pytest.mark.parametrize("T", [300, 304, 307.6, 309])
def test_equilibrium_is_stationary(T):
    phi = HHT.equilibrium_polymer_fraction(T)
    state = nonlinear.Bead(HHT, T, phi, 50)
    assert np.abs(state.rate(state.R[1:] * phi ** (-1 / 3))).max() < 1e-6
    run = nonlinear.solve(HHT, T, phi, (0, 1, 10), 50, tolerance=1e-9)
    np.testing.assert_allclose(run.radius, phi ** (-1 / 3), rtol=1e-9)


@pytest.mark.parametrize("T", [304, 307.6])
def test_slowest_relaxation_rate(T):
    """Small displacements u of an isotropic state: u_t = (2 mu + lambda) grad div u.

    With x = q a, u ~ j_1(q r) and sigma_rr(a) = 0 give x^2 sin x = 4 k (sin x - x cos x), where
    k is the shear over the longitudinal modulus; the rate is q^2 times the longitudinal one.
    """
    from scipy.optimize import brentq

    phi = HHT.equilibrium_polymer_fraction(T)
    a = phi ** (-1 / 3)
    longitudinal = HHT.diffusivity(phi, T) * HHT.Omega
    ratio = phi ** (1 / 3) / longitudinal
    x = brentq(lambda x: x**2 * np.sin(x) - 4 * ratio * (np.sin(x) - x * np.cos(x)), 0.5, np.pi)
    analytic = longitudinal * (x / a) ** 2

    times = np.linspace(0, 2, 5) / analytic
    run = nonlinear.solve(HHT, T, phi * (1 + 1e-5), times, 100, tolerance=1e-11)
    excess = np.log(np.abs(run.radius.values - a))
    rates = -np.diff(excess) / np.diff(times)
    assert rates[-1] == pytest.approx(analytic, rel=2e-3)


def test_surface_is_free_of_stress_and_parabolic():
    run = bead(304, 307.6, DRYING)
    state = nonlinear.Bead(HHT, 307.6, 0.05, 100)
    f, a = run.surface_polymer_fraction.values, run.radius.values
    np.testing.assert_allclose(state.surface.radial_stress(f, a), 0, atol=1e-10)
    assert (state.surface.stiffness(f, a) > 0).all()
    assert run.stopped == ""


@pytest.mark.parametrize("T", [307.65, 308])
def test_phase_separation_stops_the_run(T):
    """Beyond the spinodal tip the swollen surface loses its stress-free state, at 308 K at once."""
    run = bead(304, T, (0, 0.01, 0.1, 0.5, 1, 2, 5, 40))
    assert run.stopped.startswith("phase separation at t = ")
    assert run.t[-1] == run.stopped_t
    assert (run.stopped_t == 0) == (T == 308)
    assert run.stopped_r == pytest.approx(run.radius.values[-1])
    assert np.isfinite(run.polymer_fraction).all()
    assert run.polymer_fraction.values.max() <= run.stopped_polymer_fraction + 1e-9
    state = nonlinear.Bead(HHT, T, 0.05, 100)
    assert abs(state.surface.stiffness(run.stopped_polymer_fraction, run.stopped_r)) < 0.05


def test_stop_does_not_depend_on_the_mesh():
    stops = [bead(304, 307.65, (0, 1, 40), cells).stopped_t for cells in (50, 100, 200)]
    assert abs(stops[2] - stops[1]) < 1e-3 * stops[2]


@pytest.mark.parametrize(
    ("T", "stop"), [(307.65, 1.8797), (307.75, 0.7419), (307.93, 0.01926), (308.0, 0.0)]
)
@pytest.mark.parametrize("outputs", [np.linspace(0, 8, 81), (0, 8), (0, 0.0298, 8)])
@pytest.mark.parametrize(("cells", "tolerance"), [(50, 1e-5), (200, 1e-7), (320, 1e-6)])
def test_a_stop_is_that_of_the_bead(T, stop, outputs, cells, tolerance):
    """Whatever the mesh, the tolerance and the output times: CVODE's mean-square norm lets a step
    end with one collapsed shell, which is no separation."""
    run = bead(304, T, tuple(outputs), cells, tolerance)
    assert run.stopped_t == pytest.approx(stop, rel=1e-2 if stop < 0.1 else 2e-4)
    state = nonlinear.Bead(HHT, T, run.polymer_fraction.values[0, 0], cells)
    if stop:  # what is reported holds there
        assert abs(state.margin(run.r_face.values[-1, 1:])) < 1e-4
        # the surface, or by the mesh the shell beneath it
        assert run.stopped_r == pytest.approx(float(run.radius[-1]), rel=1e-3)
        assert run.stopped_polymer_fraction == pytest.approx(state.surface.branch[1], rel=1e-3)
    margins = [state.margin(faces) for faces in run.r_face.values[:-1, 1:]]
    assert min(margins, default=1.0) > 0


def test_an_end_that_a_tighter_tolerance_moves_is_not_believed(monkeypatch):
    ends = iter([0.1, 0.5, 0.50001])
    loss = Loss(0.0, 1.0, 0.1, "")
    monkeypatch.setattr(
        nonlinear,
        "integrated",
        lambda bead, start, times, rtol: nonlinear.Course([0.0, next(ends)], [], loss, 0),
    )
    state = nonlinear.Bead(HHT, 307.75, 0.05, 4)
    assert nonlinear.confirmed(state, np.ones(4), np.array([0, 1]), 1e-6).t[-1] == 0.50001
    ends = iter(np.arange(1.0, 20.0))
    with pytest.raises(RuntimeError, match=r"t = 8 or 9: it depends on CVODE's tolerance"):
        nonlinear.confirmed(state, np.ones(4), np.array([0, 1]), 1e-6)


@pytest.mark.parametrize("T", [304.0, 307.6, 307.75])
def test_the_surface_does_not_remember_what_was_tried(T):
    """f_s depends on the hoop stretch alone: on the branch, at its ends and far beyond."""
    phi = HHT.equilibrium_polymer_fraction(304.0)
    fresh, tried = (stress_free.StressFreeSurface(HHT, T, phi) for _ in range(2))
    low, high = (load ** (-1 / 4) for load in reversed(fresh.loads))
    for l_t in (2.6, 2.7, 2.2, -0.3, 1.05, 40.0, low * (1 - 1e-9), low * (1 + 1e-9), 2.6):
        tried.at(l_t)
        fresh.restart()
        there, again = fresh.at(l_t), tried.at(l_t)
        assert again.polymer_fraction == pytest.approx(there.polymer_fraction, rel=1e-9)
        on_branch = low < abs(l_t) < high
        assert (there.margin > 0) == on_branch
        if on_branch:
            left = fresh.radial_stress(there.polymer_fraction, l_t) / there.stiffness
            assert abs(left) < 1e-9  # as a change of ln f
            # at its ends the rounding of the stretch may exceed what is left of the branch
            assert fresh.branch[0] <= there.polymer_fraction <= fresh.branch[1]


def test_any_gel():
    """The piecewise-linear gel swells from Phi_inf to 1."""
    gel = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)
    run = nonlinear.solve(gel, -1.0, 2.0, (0, 0.1, 20), 50, tolerance=1e-9)
    assert run.radius[-1] == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"phi_initial": 1.2}, r"phi_initial = 1.2"),
        ({"times": (0.1, 1)}, r"must increase from 0"),
        ({"times": (0, 1, 0.5)}, r"must increase from 0"),
        ({"cells": 2}, r"cells = 2: must be at least 3"),
    ],
)
def test_refusals(change, message):
    arguments = {"phi_initial": 0.05, "times": (0, 1), "cells": 20} | change
    with pytest.raises(ValueError, match=message):
        nonlinear.solve(HHT, 304, **arguments, tolerance=1e-6)


def stretched(R):
    """A made-up bead r(R) with its stretches r' and r/R."""
    return R * (1.5 + 0.2 * R**2 - 0.1 * R**4), 1.5 + 0.6 * R**2 - 0.5 * R**4


def test_shells_are_those_of_the_text():
    state = nonlinear.Bead(HHT, 304, 0.1, 8)
    np.testing.assert_allclose(state.R, np.sin(np.pi / 2 * np.arange(9) / 8), atol=1e-15)
    nodes, weights = np.polynomial.legendre.leggauss(4)
    R = (state.R[:-1, None] + state.R[1:, None]) / 2 + np.diff(state.R)[:, None] / 2 * nodes
    mean_square = (weights * R**4).sum(1) / (weights * R**2).sum(1)
    np.testing.assert_allclose(state.mean_square, mean_square, rtol=1e-13)
    r = state.R[1:] * (1.5 + 0.2 * state.R[1:] ** 2)  # a hoop stretch linear in R^2: exact
    np.testing.assert_allclose(state.hoop_stretch(r), 1.5 + 0.2 * mean_square, rtol=1e-13)
    f = 0.3 + 0.1 * mean_square
    faces = f[:-1] + state.between * np.diff(f)
    np.testing.assert_allclose(faces, 0.3 + 0.1 * state.R[1:-1] ** 2, rtol=1e-13)


def test_the_rate_is_that_of_the_printed_equation():
    """ds_r/dr + 2 (s_r - s_t)/r of a made-up bead, to second order in the shells."""

    def s_r(R):
        r, l_r = stretched(R)
        l_t = r / R
        f = 1 / (l_r * l_t**2)
        return -HHT.osmotic_pressure(f, 304) * HHT.Omega + f * l_r**2 - np.cbrt(f)

    worst = []
    for cells in (50, 100):
        state = nonlinear.Bead(HHT, 304, 0.1, cells)
        R = state.R[1:]
        r, l_r = stretched(R)
        l_t = r / R
        f = 1 / (l_r * l_t**2)
        slope = (s_r(R + 1e-5) - s_r(R - 1e-5)) / 2e-5
        exact = slope / l_r + 2 / r * f * (l_r**2 - l_t**2)
        inner = slice(None, -2)  # this bead's surface is not free of stress
        worst.append(np.abs(state.rate(r) - exact)[inner].max() / np.abs(exact[inner]).max())
    assert worst[1] < 1e-3
    assert np.log2(worst[0] / worst[1]) > 1.7
