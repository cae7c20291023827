"""Four steps through gelpump: a gel, a bead, a tube, a device.

    pip install "gelpump[design]"
    python docs/tutorial.py

It takes some seconds and no file but itself; what it makes it leaves in a folder that is removed.
"""

import tempfile
from pathlib import Path

import numpy as np

from gelpump import bead, design, gels, open_dataset, tube

# 1. A gel.  It gives its osmotic pressure Pi(phi, T), the diffusivity D(phi, T) of its polymer and
# the polymer fraction phi_0(T) at which it rests.  This one is the paper's HHT (table 2); pressures
# are in k_B T/Omega_p.

HHT = gels.EnergyBasedGel(
    "HHT",
    A0=-62.22,
    A1=-58.28,
    B0=0.20470,
    B1=0.19044,
    Omega=720.0,
    temperature_range=(290.0, 320.0),
)
cold, hot = 304.0, 307.6  # K, on either side of its volume transition
phi_cold, phi_hot = (HHT.equilibrium_polymer_fraction(T) for T in (cold, hot))
print(f"gel: phi_0 = {phi_cold:.4f} at {cold} K and {phi_hot:.4f} at {hot} K")
spinodal = HHT.spinodal_polymer_fractions(308.0)
print(f"gel: D < 0 between phi = {spinodal[0]:.3f} and {spinodal[-1]:.3f} at 308 K")

# 2. A bead.  Swollen at 304 K it is put into water of 307.6 K and dries (section 2.1): lengths are
# in the radius of the dry bead, times in t_BMJ.  The LENS model runs on FiPy, the fully nonlinear
# one on CVODE; both return an xarray.Dataset with dims t and cell.

times = np.linspace(0.0, 1.0, 81) ** 2 * 8.0
lens = bead.lens.solve(HHT, hot, phi_cold, times, cells=48, tolerance=4e-4)
nonlinear = bead.nonlinear.solve(HHT, hot, phi_cold, times, cells=48, tolerance=1e-6)
for name, run in (("LENS", lens), ("nonlinear", nonlinear)):
    first, last = (float(run.radius[i]) for i in (0, -1))
    print(f"bead, {name}: its radius falls from {first:.3f} to {last:.3f} R_dry")
print(f"bead: polymer is kept to {float(abs(lens.polymer_volume_error).max()):.0e}")

# Datasets are saved as xarray saves them, and read again whole.  The ones that a build of the paper
# leaves in results/data open the same way.

with tempfile.TemporaryDirectory() as folder:
    path = Path(folder, "bead.nc")
    lens.to_netcdf(path)
    again = open_dataset(path)
print(f"bead: dims {dict(again.sizes)}, stopped: {again.attrs['stopped'] or 'no'}")

# To run a case with its refinement, and so with its numerical uncertainty, as the paper's figures
# do, give a block such as those of config/config.yaml.

case = {
    "temperature_initial": 304.0,
    "temperature_final": 307.6,
    "branch": "swollen",
    "end": 8.0,
    "published_times": [1.0],
    "profile_times": [],
}
numerics = {"cells": 32, "tolerance": 1e-3, "output_times": 60}
production, refinement = bead.run(bead.lens, HHT, case, numerics)
radius, error = (
    float(each.sel(t=1.0)) for each in (production.radius, refinement.radius_uncertainty)
)
print(f"bead: radius at t = 1: {radius:.3f}, to {error:.1g}")

# 3. A tube.  Heat moves along it from one end and the wall behind the front collapses (section
# 3.5).  Z is in units of the tube's length, tau in poroelastic times; several tubes are solved at
# once, here of a thick and of a thin wall.

tubes = tube.Tubes(ell=[0.25, 0.75], eps=0.1, M=1.0, Pi_ratio=1.0, Phi_inf=2.0)
pulse = tube.solve(
    tubes, tube.StepHeating(Le=10.0), tau=[1e-3, 1e-2], cells=(32, 20), tolerance=3e-4
)
for thickness, A in zip(("thick", "thin"), tube.sharpness(pulse)[0][:, -1], strict=True):
    print(f"tube, {thickness} wall: the front is {2.2 / A:.3f} L wide at tau = 0.01")
print(f"tube: heated everywhere it takes tau_99 = {tube.deswelling_time(tubes).round(5)}")

# 4. A device.  The same in millimetres and seconds, and whether the model holds for it.

block = {
    "kind": "tube",
    "a_0": "50 um",
    "a_1": "100 um",
    "heated_length": "2 mm",
    "gel": {
        "osmotic_modulus": "10 kPa",
        "osmotic_modulus_hot": "10 kPa",
        "shear_modulus": "10 kPa",
        "polymer_fraction": 0.05,
        "polymer_fraction_hot": 0.1,
    },
    "permeability": "1e-15 m^2",
    "viscosity": "0.89 mPa*s",
    "thermal_diffusivity": "1.43e-7 m^2/s",
    "critical_temperature": "32 degC",
    "heating_step": "3 K",
    "surrounding": "bath",
}
pump = design.checked("microtube", block, gels={})
for result in design.results(pump):
    if result.key in ("response_time", "travel_time", "Lewis_number"):
        print(f"device: {result.text}: {result.value:.3g} {result.unit}")
lights = design.before_solving(pump)
for light in lights:
    if light.light != "green":
        print(f"device: {light.light}: {light.criterion.text}: {light.reason}")
print(f"device: {sum(each.light == 'green' for each in lights)} of {len(lights)} lights are green")
