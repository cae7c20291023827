"""An entry of the ledger is decided by its number, not by its author."""

import numpy as np
import pytest
import xarray as xr

from gelpump.ledger import beads, materials, table, tubes
from gelpump.ledger.entry import Entry
from gelpump.materials.tables import tabulated


def entry(size, allowed):
    return Entry("id", "where", "prints", "follows", size, "size", allowed, entry, "evidence")


@pytest.mark.parametrize(
    ("size", "allowed", "verdict"),
    [
        (0.2, 0.1, "disagreement"),
        (-0.2, 0.1, "disagreement"),
        (0.05, 0.1, "no disagreement found"),
        ([0.05, -0.2], [0.1, 0.1], "disagreement"),
        ([0.05, -0.2], [0.1, 0.3], "no disagreement found"),
    ],
)
def test_the_number_decides(size, allowed, verdict):
    record = entry(size, allowed).record()
    assert record["verdict"] == verdict
    assert record["code"] == f"{__name__}.entry"


def test_a_number_that_is_not_finite_is_an_error():
    with pytest.raises(ValueError, match="ledger id"):
        entry(np.nan, 0.1).record()


def test_the_table_counts_disagreements():
    page = table.markdown([entry(0.2, 0.1).record(), entry(0.0, 0.1).record()])
    assert "1 of 2 suspected disagreements found" in page
    assert page.count("\n| id |") == 2


def claim(value, resolution=0.01, **rest):
    return {"value": value, "resolution": resolution, **rest}


@pytest.fixture(scope="module")
def tables():
    from gelpump.materials import EnergyBasedGel

    anb = EnergyBasedGel("ANB", -12.947, 17.92, 0.04496, -0.0569, 100.0, (290.0, 320.0))
    hht = EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720.0, (290.0, 320.0))
    return {f"materials_{gel.name}": tabulated(gel, [300.0, 310.0], 301) for gel in (anb, hht)}


@pytest.mark.parametrize(
    ("up", "down", "disagrees"), [(304.5, 306.0, True), (304.738, 305.805, False)]
)
def test_transition_temperatures_are_compared_with_the_folds(tables, up, down, disagrees):
    published = {"tc-up-anb": claim(up), "tc-down-anb": claim(down)}
    found = materials.transition_temperatures(tables["materials_ANB"], published)
    assert found.disagrees is disagrees


@pytest.mark.parametrize(("value", "disagrees"), [(0.01, True), (0.054, False)])
def test_low_temperature_fractions_are_those_at_300_K(tables, value, disagrees):
    published = {"phi0-low-temperature": claim(value, 0.02)}
    assert materials.low_temperature_fraction(tables, published).disagrees is disagrees


@pytest.mark.parametrize(("scale", "disagrees"), [(2 / 3, True), (1.0, False)])
def test_the_drawn_front_is_compared_with_Z_C(scale, disagrees):
    tau = np.array([0.025, 0.05])
    Z_C = 0.953873 * np.sqrt(10.0 * tau)
    pulse = xr.Dataset({"Z_C": ("tau", Z_C)}, coords={"tau": tau})
    published = {"front-fig8": claim((scale * Z_C).tolist())}
    assert tubes.drawn_front(pulse, published).disagrees is disagrees


@pytest.mark.parametrize(("drawn", "disagrees"), [(0.5, True), (0.25, False)])
def test_the_caption_is_compared_with_the_drawing(drawn, disagrees):
    published = {"figure-10-ell": claim(0.25, drawn=drawn, drawn_resolution=0.01)}
    assert tubes.caption_of_figure_10(published).disagrees is disagrees


@pytest.mark.parametrize(("shift", "disagrees"), [(0.04, True), (0.0005, False)])
def test_drawn_lens_curves_are_compared_with_the_solution(shift, disagrees):
    t, radius = np.array([0.1, 1.0]), np.array([2.0, 2.5])
    data = {
        "bead_swelling_lens": xr.Dataset({"radius": ("t", radius)}, coords={"t": t}),
        "refinement/bead_swelling_lens": xr.Dataset(
            {"radius_uncertainty": ("t", np.full(2, 1e-4))}, coords={"t": t}
        ),
    }
    published = {
        "swell-radius-lens": claim((radius + shift).tolist(), 1e-3),
        "swell-radius-nonlinear": claim(radius.tolist(), 1e-3),
    }
    cases = {"swelling": {"published_times": t.tolist()}}
    assert beads.lens_curves("swelling", "swell", data, cases, published).disagrees is disagrees


def test_the_coupling_of_lumen_and_gel_falls_with_the_radius():
    tube = {"M": 1.0, "eps": 0.1}
    near = tubes.lumen_coupling({"permeability": 1e-15, "smallest_radius": 1e-7}, tube)
    far = tubes.lumen_coupling({"permeability": 1e-15, "smallest_radius": 1e-5}, tube)
    assert near.disagrees
    assert not far.disagrees
    assert near.size == pytest.approx(1e4 * far.size)
