"""The library alone, as installed: what its README shows, a tube, a dataset, and no Snakemake.

Run by tests/install/run.py in an environment of its own, from an empty folder.
"""

import importlib.util
import sys
import tempfile
from pathlib import Path

import numpy as np

import gelpump
from gelpump import netcdf
from gelpump.bead import lens
from gelpump.materials import EnergyBasedGel, PiecewiseLinearGel
from gelpump.tube import slender
from gelpump.tube.heat import StepHeating
from gelpump.tube.tubes import Tubes

# matplotlib comes with FiPy
for absent in ("snakemake", "typst", "pint", "SALib", "jinja2"):
    assert importlib.util.find_spec(absent) is None, f"{absent} is not for the library"
assert Path(gelpump.__file__).is_relative_to(sys.prefix), gelpump.__file__

gel = EnergyBasedGel("HHT", A0=-62.22, A1=-58.28, B0=0.20470, B1=0.19044, Omega=720.0)
phi = gel.equilibrium_polymer_fraction(308.0)
bead = lens.solve(gel, 304.0, phi, np.linspace(0.0, 1.0, 11), cells=80, tolerance=1e-3)
assert abs(bead.radius.values[-1] - 2.596) < 5e-3

with tempfile.TemporaryDirectory() as folder:
    netcdf.write(bead, Path(folder, "bead.nc"), "A bead", {})
    assert netcdf.read(Path(folder, "bead.nc")).radius.equals(bead.radius)
print("bead", float(bead.radius[-1]), "numpy", np.__version__)

tubes = Tubes(ell=[0.25, 0.5])
pulse = slender.solve(tubes, StepHeating(Le=10.0), [1e-3, 1e-2], cells=(32, 20), tolerance=1e-3)
assert pulse.Phi1.dims == ("ell", "tau", "cell")
assert np.allclose(pulse.Phi1.values[..., 0], 2.0, rtol=0.05)  # hot and collapsed at its end
assert PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0).equilibrium_polymer_fraction(1.0) == 2.0
print("tubes", pulse.Phi1.shape)
