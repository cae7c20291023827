"""The dataset of where phases coexist and where a bead's surface separates, over temperature."""

from typing import TYPE_CHECKING

import numpy as np

from gelpump.netcdf import variable
from gelpump.separation.coexistence import (
    OnePhase,
    critical_hoop_stretch,
    equal_area,
    loss_temperature,
    spinodal,
)
from gelpump.separation.energy import ENERGIES, Nonlinear

if TYPE_CHECKING:
    import xarray as xr

HOOP_STRETCHES = (1.5, 2.0, 2.5)
RADII = 21


def dataset(gel, temperatures: np.ndarray, radii: tuple[float, float]) -> "xr.Dataset":
    """Dims (model, hoop_stretch, temperature): the swollen and the dry side of a front and the two
    spinodals; (temperature,): the nonlinear bead's critical hoop stretch; (model, radius): T*(a);
    (radius,): the temperature from which on a uniform bead of that radius has D < 0 itself, so that
    its core decomposes.

    ``radii``: those of the beads before and after.  Where there is one phase only all of it is 0,
    and ``two_phases`` says so.
    """
    import xarray as xr

    models = list(ENERGIES)
    shape = len(models), len(HOOP_STRETCHES), temperatures.size
    values = {name: np.zeros(shape) for name in ("swollen", "dry", "inner", "outer")}
    critical = np.zeros(temperatures.size)
    for k, T in enumerate(temperatures):
        for i, model in enumerate(models):
            for j, l_t in enumerate(HOOP_STRETCHES):
                energy = ENERGIES[model](gel, float(T))
                try:
                    sides, ends = equal_area(energy, l_t), spinodal(energy, l_t)
                except OnePhase:
                    continue
                for name, value in zip(values, [*sides, *ends], strict=True):
                    values[name][i, j, k] = value
        try:
            critical[k] = critical_hoop_stretch(Nonlinear(gel, float(T)), 1.0, max(radii))
        except OnePhase:
            continue
    a = np.linspace(*sorted(radii), RADII)
    low, high = temperatures[[0, -1]]
    loss = np.zeros((len(models), RADII))
    for i, model in enumerate(models):
        for n, radius in enumerate(a):
            try:
                loss[i, n] = loss_temperature(ENERGIES[model], gel, float(radius), low, high)
            except OnePhase:
                continue
    dims = ("model", "hoop_stretch", "temperature")
    what = {
        "swollen": "polymer fraction of the swollen side of a front",
        "dry": "polymer fraction of the dry side of a front",
        "inner": "least polymer fraction at which E = 0",
        "outer": "largest polymer fraction at which E = 0",
    }
    kelvin = {"units": "K"}
    return xr.Dataset(
        {name: variable(dims, values[name], text) for name, text in what.items()}
        | {
            "two_phases": variable(
                dims, (values["dry"] > 0).astype(float), "whether two phases coexist"
            ),
            "critical_hoop_stretch": variable(
                "temperature", critical, "least hoop stretch with two phases, nonlinear; 0 if none"
            ),
            "loss_temperature": (
                ("model", "radius"),
                loss,
                kelvin | {"long_name": "T*(a), where a swollen surface separates, or 0"},
            ),
            "core_loss_temperature": (
                "radius",
                gel.spinodal_temperature(a**-3.0),
                kelvin | {"long_name": "temperature above which a uniform bead has D < 0"},
            ),
        },
        coords={
            "model": ("model", models, {"long_name": "model of the bead"}),
            "hoop_stretch": variable("hoop_stretch", list(HOOP_STRETCHES), "hoop stretch r/R"),
            "temperature": ("temperature", temperatures, kelvin | {"long_name": "temperature"}),
            "radius": variable("radius", a, "radius of the bead", "lengths in R_dry"),
        },
        attrs={"gel": gel.name},
    )
