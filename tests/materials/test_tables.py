"""Tables of a gel: what does not exist is left out and said; temperatures are the gel's."""

import itertools

import numpy as np
import pytest

from gelpump import netcdf
from gelpump.figures import fig13_osmotic, fig14_equilibrium, style
from gelpump.figures import gel as gel_figure
from gelpump.materials import EnergyBasedGel, sheet, tables

CONFIGURED = [300.0, 302.5, 305.0, 307.5, 310.0, 312.5, 315.0]
FORMS = {
    "ANB": (-12.947, 17.92, 0.04496, -0.0569, 100.0),
    "HHT": (-62.22, -58.28, 0.2047, 0.19044, 720.0),
    "sameB": (-12.0, 0.0, 0.0415, 0.0415, 100.0),
    "reversed": (12.9, -17.9, -0.0415, 0.05, 100.0),
    "collapsed": (0.9, 0.0, 1e-4, 0.0, 50.0),
    "swollen": (0.2, 0.1, 1e-6, 0.0, 50.0),
}
RANGES = [(290.0, 320.0), (310.0, 320.0), (280.0, 298.0), (306.0, 307.0), (299.0, 309.15)]
ASYMPTOTE = {"swollen_polymer_fraction", "asymptotic_polymer_fraction", "singular_temperature"}


@pytest.mark.parametrize(("form", "span"), itertools.product(FORMS, RANGES))
def test_every_form_over_every_range_has_a_sheet(form, span, tmp_path):
    gel = EnergyBasedGel(form, *FORMS[form], span)
    data = sheet.assembled(gel, CONFIGURED, 401)
    netcdf.write(data, tmp_path / "gel.nc", form, {})  # which refuses what is not finite
    T = data.temperature.values
    assert span[0] <= T.min() <= T.max() <= span[1]
    assert len(T) > 1
    inside = [each for each in CONFIGURED if span[0] <= each <= span[1]]
    assert len(inside) < 2 or T.tolist() == inside
    for missing in ASYMPTOTE - set(data):
        assert data.attrs["left_out"], missing
    if set(CONFIGURED) - set(T):
        assert "outside the gel's range" in data.attrs["left_out"]
    rows = list(sheet.rows(data, gel))
    assert sum(row[0] == "left out" for row in rows) == len(sheet.said(data))
    with style.styled():
        gel_figure.draw(data).draw_without_rendering()


def test_gels_of_unlike_temperatures_share_figures():
    gels = {
        name: tables.tabulated(EnergyBasedGel(name, *FORMS["ANB"], span), CONFIGURED, 401)
        for name, span in zip(("warm", "hot", "cold"), RANGES, strict=False)
    }
    with style.styled():
        fig13_osmotic.draw(gels).draw_without_rendering()
        fig = fig14_equilibrium.draw(gels, {})
        fig.draw_without_rendering()
    for series in fig.series:  # what is told is what is drawn
        for T in series.columns[style.Quantity.TEMPERATURE]:
            assert 279.0 < T < 321.0
    assert fig.axes[2].get_xlim() == pytest.approx((280.0, 298.0))
    assert np.allclose(fig.axes[0].get_xlim(), fig14_equilibrium.RANGE)
