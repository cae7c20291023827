"""How much a bead's course depends on the printed digits of its parameters.

Each parameter p is shifted by a small share of half a unit h of its last printed digit, on both
sides, and the initial equilibrium with it; the central difference, scaled back to h, is the change
of the radius that the printed digits leave open,

    delta a(t) = h da/dp .

Near a spinodal the course is far more sensitive than its printed digits can fix.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gelpump.bead import nonlinear, production

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.materials import EnergyBasedGel

SHARE = 2e-3  # of half a unit: small enough for the course to change in proportion


def of_case(
    gel: "EnergyBasedGel",
    case: Mapping[str, Any],
    numerics: Mapping[str, Any],
    half_units: Mapping[str, float],
) -> "xr.Dataset":
    """`sensitivity` of a bead of the configuration, in the fully nonlinear model.

    case, numerics: as `gelpump.bead.run` takes them.
    """
    temperature, _, times = production.start(gel, case, numerics)
    # differences of one mesh: a quarter of the cells is enough
    cells = max(numerics["cells"] // 4, 24)

    def radius(gel: "EnergyBasedGel", temperature: float) -> "xr.DataArray":
        start = production.initial_polymer_fraction(gel, case)
        return nonlinear.solve(
            gel, temperature, start, times, cells, tolerance=numerics["tolerance"]
        ).radius

    return sensitivity(radius, gel, temperature, half_units)


def sensitivity(
    radius: Callable[[object, float], "xr.DataArray"],
    gel: "EnergyBasedGel",
    temperature: float,
    half_units: Mapping[str, float],
) -> "xr.Dataset":
    """Dims (parameter, t): change of the radius for half a unit of each parameter's last digit, at
    the times that all runs reach.

    radius(gel, temperature) runs a case with the gel and the temperature after the jump;
    half_units: by name, of the gel's parameters and of ``temperature_final``.
    """
    import xarray as xr

    changes = []
    for name, half in half_units.items():
        runs = []
        for step in (SHARE * half, -SHARE * half):
            if name == "temperature_final":
                runs.append(radius(gel, temperature + step))
            else:
                shifted = replace(gel, **{name: getattr(gel, name) + step})
                runs.append(radius(shifted, temperature))
        changes.append((runs[0] - runs[1]) / (2.0 * SHARE))
    changes = xr.align(*changes)  # runs in which phases separate end early
    attrs = {"units": "1", "long_name": "change of the radius for half a unit of the last digit"}
    return xr.Dataset(
        {
            "radius_change": (
                ("parameter", "t"),
                np.array([each.values for each in changes]),
                attrs,
            ),
            "half_unit": (
                "parameter",
                np.array(list(half_units.values())),
                {
                    "units": "1",
                    "long_name": "half a unit of the last printed digit",
                    "comment": "A0, A1, Omega: 1; B0, B1: 1/K; temperature_final: K",
                },
            ),
        },
        coords={
            "t": ("t", changes[0].t.values, runs[0].t.attrs),
            "parameter_name": (
                "parameter",
                list(half_units),
                {"long_name": "name of the parameter"},
            ),
        },
    )
