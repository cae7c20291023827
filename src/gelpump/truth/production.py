"""Production runs of the truth, waves and pulses, each on three meshes.

The value is that of the middle mesh; its uncertainty is the grid-convergence index of the three
and, where there is a time, that of three time tolerances.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from gelpump import progress
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.netcdf import variable
from gelpump.truth.numbers import (
    FIELDS,
    LENGTH,
    MEANING,
    TIME,
    VELOCITY,
    pulse_numbers,
    wave_numbers,
)
from gelpump.truth.pulse import Pulse
from gelpump.truth.wave import Wave
from gelpump.tube.heat import StepHeating
from gelpump.tube.scaling import ell as ell_coordinate
from gelpump.uncertainty import convergence_index


def waves(
    gel: PiecewiseLinearGel,
    ells: Sequence[float],
    Pe: Sequence[float],
    cells: Sequence[int],
    c: float = 0.0,
) -> xr.Dataset:
    """Waves on `cells` halved, taken and doubled; dims (ell, Pe)."""
    meshes = _three(cells)

    def numbers(mesh, ell):
        wave = Wave(ell, gel, mesh, c, max(Pe))
        found = [wave_numbers(wave, y, each) for each, y in zip(Pe, wave.solve(Pe), strict=True)]
        return _stacked(found)

    levels = []
    for i, mesh in enumerate(meshes):
        levels.append(_stacked([numbers(mesh, ell) for ell in ells]))
        progress.at(i + 1.0, len(meshes))
    return _with_uncertainty(
        levels, ("ell", "Pe"), {"ell": ell_coordinate(np.array(ells)), "Pe": peclet(Pe)}
    )


def other_gels(
    block: Mapping, M: Sequence[float], ell: float, Pe: float, cells: Sequence[int]
) -> xr.Dataset:
    """A wave of gels with other shear moduli, and with the energy's second invariant; dims (M,).

    The energy's change of a number is what it gains with c = 1 in place of c = 0.
    """
    gels = [PiecewiseLinearGel(block["Phi_inf"], block["Pi_ratio"], each) for each in M]

    def numbers(mesh, c=0.0):
        found = []
        for gel in gels:
            wave = Wave(ell, gel, mesh, c, Pe)
            found.append(wave_numbers(wave, wave.solve([Pe])[-1], Pe))
        return _stacked(found)

    levels = [numbers(mesh) for mesh in _three(cells)]
    other = numbers(_three(cells)[1], c=1.0)
    coords = {"M": variable("M", np.array(M, float), "shear modulus over Pi_00")}
    data = _with_uncertainty(levels, ("M",), coords)
    for name, value in levels[1].items():
        text = f"{MEANING[name][0]}: change with the energy's second invariant"
        data[f"{name}_energy"] = variable("M", other[name] - value, text, MEANING[name][1])
    named = {name: f"{name}_M" for name in data.data_vars}
    return data.rename(named).assign(verified_ell=variable((), ell, "ell of the waves of other M"))


def peclet(values):
    """The coordinate Pe."""
    return variable(
        "Pe",
        np.array(values, float),
        "speed of the front in the swollen tube times the thickness of its wall",
        "in units of k Pi_00/mu_l: Phi_inf^(1/3) eps (1-ell) dZ_C/dtau",
    )


def pulses(
    gel: PiecewiseLinearGel,
    Le: float,
    ell: Sequence[float],
    T: Sequence[float],
    drawn: float,
    cells: Sequence[int],
    tolerance: float,
) -> xr.Dataset:
    """Tubes behind the printed front at the times T; dims (ell, T).

    Meshes are compared at the third of three tolerances, which are sqrt(10) and 10 times the first.
    FIELDS are those of the first at the time of T nearest to `drawn`.
    """
    coarse, middle, fine = _three(cells)
    loose, looser = 10**0.5 * tolerance, 10 * tolerance
    plan = [
        (middle, tolerance),
        (middle, loose),
        (middle, looser),
        (coarse, looser),
        (fine, looser),
    ]
    shown = int(np.abs(np.asarray(T) - drawn).argmin())
    runs, worst, pictures = [], 0.0, []
    for i, (mesh, each) in enumerate(plan):
        rows = []
        for j, each_ell in enumerate(ell):
            seen, error = pulse_at(Pulse(each_ell, gel, StepHeating(Le), T[-1], mesh, each), T)
            rows.append(_stacked([numbers for numbers, _ in seen]))
            worst = max(worst, error)
            if i == 0:
                pictures.append(seen[shown][1])
            progress.at(i + (j + 1.0) / len(ell), len(plan))
        runs.append(_stacked(rows))
    best, middle_run, loosest, rough, dense = runs
    coords = {
        "ell": ell_coordinate(np.array(ell)),
        "T": variable("T", np.array(T, float), "elapsed time", TIME),
    }
    data = {"Le": variable((), Le, "Lewis number")}
    for name, value in best.items():
        error = convergence_index(rough[name], loosest[name], dense[name])
        error = error + convergence_index(loosest[name], middle_run[name], value)
        data |= _variables(name, ("ell", "T"), value, error)
    picture = _stacked(pictures)
    for name, (long_name, comment) in FIELDS.items():
        data[name] = variable(("ell", "line", "across"), picture[name], long_name, comment)
    for name, text, comment in (
        ("lumen_z", "axial position along the inner surface less that of the front", LENGTH),
        ("lumen_b", "radius of the lumen", LENGTH),
        ("lumen_V", "mean axial velocity in the lumen", VELOCITY),
    ):
        data[name] = variable(("ell", "node"), picture[name], text, comment)
    data["drawn_T"] = variable((), T[shown], "time of the fields", TIME)
    data["water_balance_error"] = variable((), worst, "largest share of water unaccounted for")
    return xr.Dataset(data, coords)


def pulse_at(pulse: Pulse, T: Sequence[float]) -> tuple[list[tuple[dict, dict]], float]:
    """`pulse_numbers` at each of T, and the largest share of the water unaccounted for."""
    roots = np.sqrt(np.asarray(T)) - pulse.root
    if not roots[0] > 0:
        raise ValueError(f"T = {T[0]} is not allowed: the run begins at {pulse.root**2:.3g}")
    found, worst = [], 0.0
    for step in pulse.steps():
        now, before = pulse.water(step.solution)
        worst = max(worst, abs(now - before) / before)
        while len(found) < len(roots) and roots[len(found)] <= step.time * (1 + 1e-12):
            found.append(pulse_numbers(pulse, step, min(roots[len(found)], step.time)))
    return found, worst


def _three(cells):
    across, behind, ahead = cells
    if across % 4:
        raise ValueError(f"{across} cells across the wall are not allowed: a multiple of four")
    return [tuple(int(factor * n) for n in (across, behind, ahead)) for factor in (0.5, 1, 2)]


def _stacked(rows: list[Mapping]) -> dict[str, np.ndarray]:
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _with_uncertainty(levels, dims, coords):
    data = {}
    for name, value in levels[1].items():
        error = convergence_index(levels[0][name], value, levels[2][name])
        data |= _variables(name, dims, value, error)
        data[f"{name}_levels"] = variable(
            ("level", *dims), np.array([level[name] for level in levels]), f"{name} on each mesh"
        )
    return xr.Dataset(data, coords)


def _variables(name, dims, value, error):
    long_name, comment = MEANING[name]
    return {
        name: variable(dims, value, long_name, comment),
        f"{name}_uncertainty": variable(
            dims, error, f"numerical uncertainty: {long_name}", comment
        ),
    }
