"""Diffuse beads towards the sharp limit: the extrapolation, and what it calls agreement."""

import numpy as np
import pytest
import xarray as xr

from gelpump.separation import limit

WIDTHS = np.array([0.05, 0.03, 0.02])


@pytest.mark.parametrize("order", [0.5, 1.0, 1.7])
def test_a_power_of_the_width_is_found(order):
    q_0, doubt, p = limit.at_zero(WIDTHS, 2.0 - 3.0 * WIDTHS**order)
    assert q_0 == pytest.approx(2.0, abs=1e-9)
    assert p == pytest.approx(order, abs=1e-9)
    assert doubt == pytest.approx(abs(2.0 - line(2.0 - 3.0 * WIDTHS**order)), abs=1e-9)


def line(q):
    return q[2] + (q[2] - q[1]) * WIDTHS[2] / (WIDTHS[1] - WIDTHS[2])


@pytest.mark.parametrize("q", [[1.0, 2.0, 1.5], [1.0, 1.0, 1.0], [1.0, 1.001, 2.0]])
def test_what_is_no_power_has_the_lines_correction(q):
    q_0, doubt, p = limit.at_zero(WIDTHS, np.array(q))
    assert (q_0, p) == (pytest.approx(line(q)), 0.0)
    assert doubt == pytest.approx(abs(q_0 - q[2]))


def run(width, speed):
    """A front that falls evenly, in a bead of one polymer fraction on either side."""
    t = np.linspace(0.0, 1.0, 101)
    front = np.clip(0.99 - speed * t, 0.0, 1.0)
    inside = 2.0 * front
    a = np.cbrt(inside**3 + (1 - front**3) / 0.6)
    return xr.Dataset(
        {
            "front_dry_radius": ("t", front),
            "front_radius": ("t", inside),
            "front_present": ("t", (front > 0).astype(float)),
            "radius": ("t", a),
            "energy": ("t", -t),
        },
        coords={"t": t},
        attrs={"width": width, "completion_t": 1 / speed, "model": "lens", "gel": "HHT",
               "temperature": 308.0, "phi_initial": 0.05},
    )  # fmt: skip


def test_runs_are_extrapolated_and_compared():
    runs = [run(width, 1.0 / (0.9 + width)) for width in WIDTHS]
    found = limit.towards(runs, run(0.0, 1.0 / 0.9))
    assert found.travel_at_zero == pytest.approx(0.4 * 0.9, rel=1e-6)
    assert found.travel_order == pytest.approx(1.0, abs=1e-3)
    assert found.completion_at_zero == pytest.approx(0.9)
    np.testing.assert_allclose(found.core_at_zero, 1 / 8, rtol=1e-6)
    np.testing.assert_allclose(found.skin_at_zero, 0.6, rtol=1e-4)
    assert all(found[name].all() for name in found if name.endswith("_agrees"))
    other = limit.towards(runs, run(0.0, 1.0 / 0.95))
    assert not other.travel_agrees.any()


def test_a_front_that_does_not_arrive_is_refused():
    with pytest.raises(ValueError, match="must pass them"):
        limit.numbers(run(0.05, 0.5))
