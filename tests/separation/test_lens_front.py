"""The sharp front of a LENS bead on FiPy, against the same front on CVODE."""

from functools import cache

import numpy as np

from gelpump.materials import EnergyBasedGel
from gelpump.separation import lens_front, sharp
from gelpump.separation.energy import Lens

HHT = EnergyBasedGel("HHT", A0=-62.22, A1=-58.28, B0=0.20470, B1=0.19044, Omega=720.0)
SWOLLEN = HHT.equilibrium_polymer_fraction(304.0)
TIMES = np.linspace(0.0, 0.5, 201)


@cache
def on_fipy(cells=(80, 40), tolerance=5e-5):
    return lens_front.solve(HHT, 308.0, SWOLLEN, TIMES, cells, tolerance=tolerance)


def test_two_solvers_agree():
    other = sharp.solve(Lens(HHT, 308.0), SWOLLEN, TIMES, (120, 60), tolerance=1e-6)
    run = on_fipy()
    late = TIMES[run.attrs["birth_t"] + 0.005 < TIMES]
    np.testing.assert_allclose(run.radius.sel(t=late), other.radius.sel(t=late), rtol=1e-3)
    front = [each.front_dry_radius.sel(t=late) for each in (run, other)]
    within = front[1] > 0.1  # then it runs into the centre
    np.testing.assert_allclose(front[0][within], front[1][within], atol=1e-3)
    np.testing.assert_allclose(run.attrs["completion_t"], other.attrs["completion_t"], rtol=1e-3)


def test_laws():
    run = on_fipy()
    moving = (run.front_present > 0) & (run.front_present.shift(t=1) > 0)
    assert np.diff(run.energy, prepend=np.inf)[moving.values].max() < 1e-7
    assert abs(run.polymer_volume_error).max() < 1e-10
    dry = HHT.equilibrium_polymer_fraction(308.0, "dry")
    np.testing.assert_allclose(run.radius[-1], dry ** (-1 / 3), rtol=1e-5)
