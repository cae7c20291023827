"""Beads that are heated into their spinodal: from t = 0 on, what was solved is kept and told of.

Scanned: both gels, temperatures from where nothing separates to where it does in the first instant,
meshes, tolerances and output times; LENS against its second solver.
"""

from functools import cache

import numpy as np
import pytest
import xarray as xr

from gelpump import bdf
from gelpump.bead import lens, nonlinear, production
from gelpump.bead.dataset import Loss, bead_dataset
from gelpump.bead.sensitivity import sensitivity
from gelpump.figures import bead_panels, fig01_lens_schematic, fig05_spinodal, style
from gelpump.materials import EnergyBasedGel, tables
from gelpump.second_solvers import cross_check, lens_bead
from gelpump.second_solvers.course import observed

GELS = {
    "HHT": (EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720.0, (290.0, 320.0)), 304.0),
    "ANB": (EnergyBasedGel("ANB", -12.947, 17.92, 0.04496, -0.0569, 100.0, (290.0, 320.0)), 303.0),
}
HEATED = [
    *(("HHT", T) for T in (307.6, 307.62, 307.65, 307.7, 308.0, 308.1, 308.2, 308.5)),
    *(("ANB", T) for T in (305.5, 306.0, 306.3, 307.0, 308.0)),
]
EVEN, LOGARITHMIC = np.linspace(0.0, 8.0, 17), np.r_[0.0, np.geomspace(1e-5, 8.0, 12)]
CASE = {
    "gel": "HHT",
    "temperature_initial": 304.0,
    "branch": "swollen",
    "end": 8.0,
    "published_times": [0.2, 1.0, 5.0],
    "profile_times": [0.0, 1.0, 2.0],
}
STOPPING = [307.7, 308.0, 308.5]  # LENS on the way, the nonlinear bead at once, both at once


@cache
def second(name, T):
    gel, cold = GELS[name]
    phi = gel.equilibrium_polymer_fraction(cold)
    return lens_bead.solve(gel, T, phi, np.array([0.0, 8.0]), 60, rtol=1e-7).stop


@pytest.mark.parametrize(("name", "T"), HEATED)
@pytest.mark.parametrize(("cells", "tolerance"), [(24, 1e-3), (40, 4e-4)])
@pytest.mark.parametrize("times", [EVEN, LOGARITHMIC], ids=["even", "logarithmic"])
def test_a_lens_bead_stops_where_its_second_solver_does(name, T, cells, tolerance, times):
    gel, cold = GELS[name]
    phi = gel.equilibrium_polymer_fraction(cold)
    run = lens.solve(gel, T, phi, times, cells, tolerance=tolerance)
    stop = second(name, T)
    assert ("stopped_t" in run.attrs) == (stop is not None)
    if stop is None:
        assert run.stopped == ""
        assert float(run.t[-1]) == 8.0
        return
    assert run.stopped.startswith(f"phase separation at t = {run.stopped_t:.6g}, r = ")
    # what the mesh leaves of the start, and what a step resolves
    assert run.stopped_t == pytest.approx(stop, rel=1e-2, abs=1.5e-3)
    assert (run.stopped_t == 0) == (stop == 0)
    assert float(run.t[-1]) == run.stopped_t
    assert np.all(np.diff(run.t) > 0)
    kept = times[times < run.stopped_t]
    np.testing.assert_array_equal(run.t.values[: kept.size], kept)
    low, high = run.polymer_fraction.values.min(), run.polymer_fraction.values.max()
    ends = gel.spinodal_polymer_fractions(T)
    assert (low >= ends[-1] * (1 - 1e-9)) or (high <= ends[0] * (1 + 1e-9))
    assert run.stopped_polymer_fraction == pytest.approx(ends[0], rel=1e-6)
    assert run.stopped_r == pytest.approx(float(run.radius[-1]), rel=1e-3)


def test_shells_that_no_gel_can_have_are_no_separation(hht):
    """An iterate of Newton's method that tangles shells is tried again, with a shorter step."""
    shells = lens.Shells([8])
    surface = lens.Surface.around(hht, 308.0, 0.05)
    bead = lens.Bead(hht, surface, shells, lens.NewtonSweep(8), 1e-4)
    volume = shells.volume / 0.05
    for tangled in (-volume[3], 0.5 * shells.volume[3]):
        wrong = volume.copy()
        wrong[3] = tangled
        with pytest.raises(bdf.NotConverged):
            bead.require_one_phase(np.cumsum(wrong))


def test_a_surface_past_its_end_is_no_state(hht):
    surface = lens.Surface.around(hht, 308.0, 0.05)
    shells = lens.Shells([8])
    bead = lens.Bead(hht, surface, shells, lens.NewtonSweep(8), 1e-4)
    radius = 0.99 * 4.0 / surface.load(surface.upper)
    volume = shells.volume * radius**3
    with pytest.raises(lens.PhaseSeparation):
        bead.require_one_phase(np.cumsum(volume))
    assert surface.polymer_fraction(np.array([radius]))[0] == pytest.approx(surface.upper)


@pytest.mark.parametrize(("name", "T"), [("HHT", 308.5), ("ANB", 308.0)])
def test_the_second_solver_stops_at_once_too(name, T):
    assert second(name, T) == 0.0
    gel, _ = GELS[name]
    inside = float(np.mean(gel.spinodal_polymer_fractions(T)))
    assert lens_bead.solve(gel, T, inside, np.array([0.0, 1.0]), 8).stop == 0.0


def test_a_stop_within_rounding_of_an_output_time_is_one_time():
    R = np.linspace(0.0, 1.0, 4)
    faces = np.array([2.0, 1.9, 1.8])[:, np.newaxis] * R
    loss = Loss(0.5, 1.8, 0.2, "D < 0")
    times = np.array([0.0, 0.5 - 1e-13, 0.5])
    run = bead_dataset(times, R, faces, np.array([0.1, 0.2, 0.3]), loss)
    assert run.t.values.tolist() == [0.0, 0.5]
    assert run.radius.values.tolist() == [2.0, 1.8]
    assert run.surface_polymer_fraction.values.tolist() == [0.1, 0.3]
    assert bead_dataset(times, R, faces, np.array([0.1, 0.2, 0.3])).sizes["t"] == 3


@cache
def stopped(T):
    """Both models of a case, each with its refinement, as the rules make them."""
    gel, _ = GELS["HHT"]
    case = CASE | {"temperature_final": T}
    coarse = {"lens": (lens, 1e-3), "nonlinear": (nonlinear, 1e-5)}
    return case, {
        name: production.run(
            model, gel, case, {"cells": 16, "tolerance": tolerance, "output_times": 30}
        )
        for name, (model, tolerance) in coarse.items()
    }


@pytest.mark.parametrize("T", STOPPING)
def test_a_case_that_stops_is_refined(T):
    for bead, refinement in stopped(T)[1].values():
        assert bead.attrs["stopped"]
        assert refinement.stop_time.values[0] == bead.attrs["stopped_t"]
        assert float(refinement.stop_time_uncertainty) >= 0
        assert (refinement.t < refinement.stop_time.values.min()).all()
        for each in (bead, refinement):
            for values in each.variables.values():
                assert values.dtype.kind != "f" or np.isfinite(values).all()


@pytest.mark.parametrize("T", STOPPING)
def test_a_case_that_stops_is_cross_checked(T):
    gel, _ = GELS["HHT"]
    case, runs = stopped(T)
    temperature, phi, times = production.start(gel, case, {"output_times": 30})
    other = observed(lens_bead.solve, gel, temperature, phi, times, 60, 1e-6)
    bounds = {"radius": 5e-2, "stop_time": 5e-2}
    rows = cross_check.bead_rows("drying", *runs["lens"], other, bounds)
    names = [row["quantity"] for row in rows]
    assert names == ["radius, drying", "stop time, drying"][0 if T < 308.5 else 1 :]
    assert rows[-1]["agrees"]
    later = other.assign(stop_time=other.stop_time + 0.1)
    assert not cross_check.bead_rows("drying", *runs["lens"], later, bounds)[-1]["agrees"]


@pytest.mark.parametrize("T", STOPPING)
@pytest.mark.parametrize("scale", ["log", "linear"])
def test_figures_of_a_case_that_stops(T, scale, tmp_path):
    gel, _ = GELS["HHT"]
    case, runs = stopped(T)
    beads = {model: bead for model, (bead, _) in runs.items()}
    material = tables.tabulated(gel, [300.0, 310.0], 401)
    with style.styled():
        drawn = {
            "panels": bead_panels.draw(beads, case, {"lens": [2.4, 2.0, 1.5]}, scale),
            "plane": fig05_spinodal.draw(material, {"drying": beads["lens"]}, {"drying": case}),
            "schematic": fig01_lens_schematic.draw(beads["lens"], 1.0),
        }
        for name, fig in drawn.items():
            style.save(fig, [tmp_path / f"{name}.png", tmp_path / f"{name}.csv"])
    told = (tmp_path / "panels.csv").read_text()
    for model in ("LENS", "nonlinear"):
        assert f"phases separate {model}" in told
    said = drawn["panels"].get_supxlabel()
    for bead in beads.values():
        assert bead.attrs["stopped"] in said
    assert "bead drying: phases separate" in (tmp_path / "plane.csv").read_text()


def test_sensitivity_ends_where_the_first_run_does():
    def radius(gel, temperature):
        count = 4 if temperature > 308 else 2
        t = np.arange(float(count))
        return xr.DataArray(t * temperature, coords={"t": t}, dims="t")

    gel, _ = GELS["HHT"]
    found = sensitivity(radius, gel, 308.0, {"Omega": 0.5, "temperature_final": 0.05})
    assert found.t.values.tolist() == [0.0, 1.0]
    assert found.radius_change.shape == (2, 2)
    np.testing.assert_allclose(found.radius_change[1], [0.0, 0.05], atol=1e-9)
