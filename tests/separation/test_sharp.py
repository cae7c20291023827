"""A bead that separates, in the sharp limit: a reference course, independence, laws."""

import re
from functools import cache

import numpy as np
import pytest

from gelpump.bead import lens, nonlinear
from gelpump.materials import EnergyBasedGel
from gelpump.separation import blocks, sharp, shells
from gelpump.separation.coexistence import Coexistence, Surface
from gelpump.separation.energy import ENERGIES

HHT = EnergyBasedGel("HHT", A0=-62.22, A1=-58.28, B0=0.20470, B1=0.19044, Omega=720.0)
ANB = EnergyBasedGel("ANB", A0=-12.947, A1=17.92, B0=0.04496, B1=-0.0569, Omega=100.0)
SWOLLEN = HHT.equilibrium_polymer_fraction(304.0)
TIMES = np.unique(np.concatenate([np.linspace(0.0, 0.5, 201), np.geomspace(1e-5, 0.5, 60)]))


@cache
def bead(model, cells=(80, 40), skin=1e-3, temperature=308.0):
    energy = ENERGIES[model](HHT, temperature)
    return sharp.solve(energy, SWOLLEN, TIMES, cells, tolerance=1e-6, skin=skin)


def passage(run, R):
    """When the front is at the dry radius R."""
    front = run.front_dry_radius.where(run.front_present > 0).dropna("t")
    return float(np.interp(-R, -front.values, front.t.values))


def test_reference_course():
    """Computed once before, by another hand with another code; to 0.2 %."""
    run = bead("nonlinear")
    np.testing.assert_allclose(run.radius.interp(t=0.1), 1.5289, rtol=2e-3)
    np.testing.assert_allclose(run.radius.interp(t=0.2), 1.2163, rtol=2e-3)
    np.testing.assert_allclose(passage(run, 0.3), 0.1664, rtol=2e-3)
    np.testing.assert_allclose(bead("lens").attrs["completion_t"], 0.354, rtol=2e-3)


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_skin_that_the_front_is_born_with_does_not_matter(model):
    thin, thick = bead(model), bead(model, skin=5e-3)
    for R in (0.7, 0.3):
        np.testing.assert_allclose(passage(thick, R), passage(thin, R), rtol=1e-3)


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_refinement(model):
    coarse, fine = bead(model, cells=(40, 20)), bead(model)
    for R in (0.7, 0.3):
        np.testing.assert_allclose(passage(coarse, R), passage(fine, R), rtol=4e-3)
    np.testing.assert_allclose(coarse.attrs["completion_t"], fine.attrs["completion_t"], rtol=1e-2)


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_energy_falls_and_polymer_is_kept(model):
    run = bead(model)
    # it may rise where a skin is put on or a core is given up, by what that skin or core holds
    moving = (run.front_present > 0) & (run.front_present.shift(t=1) > 0)
    rise = np.diff(run.energy, prepend=np.inf)[moving.values]
    assert rise.max() < 1e-9
    assert abs(run.polymer_volume_error).max() < 1e-10
    assert np.all(run.r_face.diff("face") > 0)
    assert run.smallest_stiffness.min() > 0


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_ends_in_the_dry_equilibrium(model):
    run = bead(model)
    dry = HHT.equilibrium_polymer_fraction(308.0, "dry")
    np.testing.assert_allclose(run.radius[-1], dry ** (-1 / 3), rtol=1e-6)


@pytest.mark.parametrize(("model", "solver"), [("nonlinear", nonlinear), ("lens", lens)])
def test_below_separation_it_is_the_bead_of_one_phase(model, solver):
    times = np.array([0.0, 0.05, 0.2, 1.0])
    energy = ENERGIES[model](HHT, 307.5)
    run = sharp.solve(energy, SWOLLEN, times, (60, 30), tolerance=1e-8)
    whole = solver.solve(HHT, 307.5, SWOLLEN, times, 90, tolerance=1e-7)
    assert "birth_t" not in run.attrs
    np.testing.assert_allclose(run.radius, whole.radius, rtol=2e-4)


def test_born_when_the_bead_of_one_phase_stops():
    whole = lens.solve(HHT, 308.0, SWOLLEN, TIMES, 120, tolerance=1e-5)
    np.testing.assert_allclose(bead("lens").attrs["birth_t"], whole.stopped_t, rtol=2e-3)


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"skin": 0.2}, "skin"),
        ({"cells": (3, 40)}, "cells"),
        ({"times": [0.1, 0.2]}, "times"),
    ],
)
def test_refusals(change, named):
    arguments = {"times": TIMES, "cells": (40, 20), "skin": 1e-3} | change
    times, cells = arguments.pop("times"), arguments.pop("cells")
    energy = ENERGIES["lens"](HHT, 308.0)
    with pytest.raises(ValueError, match=named):
        sharp.solve(energy, SWOLLEN, times, cells, tolerance=1e-6, **arguments)


def test_unstable_start_is_refused():
    run = sharp.solve(ENERGIES["lens"](HHT, 308.0), 0.3, TIMES, (40, 20), tolerance=1e-6)
    assert "not stable" in run.stopped
    np.testing.assert_allclose(run.polymer_fraction, np.full((1, 60), 0.3), rtol=1e-12)


def test_front_born_at_the_critical_point_is_refused():
    """ANB swelling from 310 to 303 K: its surface leaves where the two sides of a front are one."""
    energy, dry = ENERGIES["nonlinear"](ANB, 303.0), ANB.equilibrium_polymer_fraction(310.0)
    run = sharp.solve(energy, dry, TIMES, (40, 20), tolerance=1e-6)
    assert "born at the critical point, which is not solved" in run.stopped
    assert run.t[-1] < TIMES[-1]
    assert not run.front_present.any()


def test_block_that_passes_through_its_spinodal_is_said():
    """ANB swelling to 304.5 K: the outermost shell overshoots its surface in the first instant, and
    a smooth course to a plausible end would follow."""
    energy, dry = ENERGIES["nonlinear"](ANB, 304.5), ANB.equilibrium_polymer_fraction(310.0)
    run = sharp.solve(energy, dry, TIMES, (40, 20), tolerance=1e-6)
    assert re.search(r"E = .*, not positive", run.stopped)
    assert run.t[-1] < TIMES[-1]
    assert "completion_t" not in run.attrs


def test_tangled_shells_stop_a_run(monkeypatch):
    """One face is driven into its neighbour: the first accepted state beyond it ends the run."""
    follow = sharp.Course.follow

    def pushed(course, stage, start, tolerance):
        rate = stage.rate

        def tangling(y):
            dydt = rate(y)
            dydt[10] += 1e5
            return dydt

        stage.rate = tangling
        return follow(course, stage, start, tolerance)

    monkeypatch.setattr(sharp.Course, "follow", pushed)
    energy = ENERGIES["nonlinear"](HHT, 307.5)
    run = sharp.solve(energy, SWOLLEN, TIMES, (20, 10), tolerance=1e-6)
    assert "tangled" in run.stopped
    assert run.t[-1] < TIMES[-1]


@pytest.mark.parametrize(
    ("broken", "said"),
    [
        (lambda R, r: (R, np.where(R[7] == R, r[9], r)), "shells are tangled"),
        (lambda R, r: (R, 0.3 * r), "tangled: its volume is"),
        (lambda R, r: (R, r * np.nan), "tangled"),
        (lambda R, r: (np.where(R == 1.0, 1.01, R), r), "of the bead's polymer"),
        (lambda R, r: (R, 0.3 ** (-1 / 3) * R), "E = "),
    ],
)
def test_states_that_no_bead_is_in_are_said(broken, said):
    energy, R = ENERGIES["nonlinear"](HHT, 308.0), shells.clustered_outside(20)
    r = SWOLLEN ** (-1 / 3) * R
    shells.require_sound(energy, 0.0, R, r)
    with pytest.raises(shells.Unsound, match=said):
        shells.require_sound(energy, 0.1, *broken(R, r))


def test_the_bead_stays_whole_at_the_front():
    """[dr/dt] + [l_r] dR_f/dt = 0, where neither side is at rest."""
    energy = ENERGIES["nonlinear"](HHT, 308.0)
    R = shells.clustered_outside(40)
    r = SWOLLEN ** (-1 / 3) * R * (1.0 - 0.05 * R**2)
    a = float(r[-1])
    dry = Surface.between(energy, "dry", 1.0, 1.01 * a, a)
    divided = blocks.Divided(energy, Coexistence.between(energy, 1.0, 2.0), dry, True, 20, 10)
    y = divided.born(R, r, 0.1, 0.05)
    _, _, speed = divided.parts(y)
    R_core, r_core, R_skin, r_skin = divided.blocks(y)
    inside, outside = divided.at_front(y)
    core = shells.motion(energy, R_core, r_core, None, inside)
    skin = shells.motion(energy, R_skin, r_skin, outside, dry.state(r_skin[-1]))
    within = core.rate[-1] + core.radial_stretch[-1] * speed
    without = skin.rate[0] + skin.radial_stretch[0] * speed
    assert within == pytest.approx(without, rel=1e-9)
    assert abs(core.rate[-1]) > 1e-2 * abs(skin.rate[0])
    assert divided.rate(y)[19] == pytest.approx(within, rel=1e-9)
    assert divided.rate(y)[-1] == speed < 0
