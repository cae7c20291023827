"""The numbers of the figures as CSV: those of the datasets, with their units."""

import re

import numpy as np
import pandas as pd
import pytest

from gelpump import netcdf
from gelpump.figures import style
from gelpump.figures.style import Quantity


def told(built, figure):
    return pd.read_csv(built.path / f"results/figures/{figure}.csv", comment="#")


def series(table, panel, name):
    """The rows of one series, without the columns that it has not."""
    rows = table[(table.panel == panel) & (table.series == name)]
    return rows.dropna(axis="columns", how="all")


def test_every_figure_tells_its_numbers_with_their_units(built):
    files = sorted((built.path / "results/figures").glob("fig*.csv"))
    assert len(files) == 21
    for file in files:
        text = file.read_text(encoding="utf-8")
        table = pd.read_csv(file, comment="#")
        assert list(table)[:2] == ["panel", "series"]
        for column in list(table)[2:]:
            assert re.fullmatch(r"\S.* \[\S.*\]", column), (file.name, column)
            assert np.isfinite(table[column].dropna()).all()
        rows = re.findall(r"^# panel (\w), (.*?); (\d+) rows: .*$", text, re.M)
        assert sum(int(count) for *_, count in rows) == len(table) > 10, file.name
        assert {(panel, name) for panel, name, _ in rows} == set(
            zip(table.panel, table.series, strict=True)
        )
        assert np.genfromtxt(file, delimiter=",", comments="#").shape == (
            len(table) + 1,
            len(table.columns),
        )


def test_a_beads_radius_is_that_of_its_dataset(built):
    table = told(built, "fig04_dry_bead")
    for model, name in (("lens", "LENS"), ("nonlinear", "nonlinear")):
        bead = netcdf.read(built.path / f"results/data/bead_drying_{model}.nc")
        radius = series(table, "a", f"radius {name}")
        assert np.allclose(radius[Quantity.BEAD_TIME], bead.t, rtol=1e-7)
        assert np.allclose(radius[Quantity.BEAD_RADIUS], bead.radius, rtol=1e-7)


def test_a_map_is_that_of_its_dataset(built):
    times = netcdf.read(built.path / "results/data/deswelling_map.nc")
    name = f"time to deswell at ell = {float(times.map_ell):g}"
    points = series(told(built, "fig07_deswelling"), "a", name)
    for point in points.sample(20, random_state=1).itertuples(index=False):
        _, _, *(M, Pi_ratio, tau99) = point
        expected = times.tau99.sel(M=M, Pi_ratio=Pi_ratio, method="nearest")
        assert tau99 == pytest.approx(float(expected), rel=1e-7)


def test_folds_are_those_of_the_gel(built):
    gel = netcdf.read(built.path / "results/data/materials_ANB.nc")
    folds = series(told(built, "fig14_equilibrium"), "a", "folds of ANB")
    assert np.allclose(sorted(folds[Quantity.TEMPERATURE]), sorted(gel.fold_temperature))


def test_quantities_that_a_series_has_not_are_empty():
    fig = style.figure(height=2.0)
    style.tell(fig, "a", "one 5 %", {"x [1]": [1.0, 2.0], "y [m]": 0.5})
    style.tell(fig.subplots(), "b", "other", {"z [s]": 1 / 3})
    lines = style.csv(fig.series, "example").splitlines()
    assert lines[3:] == [
        "panel,series,x [1],y [m],z [s]",
        "a,one 5 %,1,0.5,",
        "a,one 5 %,2,0.5,",
        "b,other,,,0.33333333",
    ]
