"""Pulses of many designs by the cheapest solver that is accurate enough, each with its accuracy.

tau_99 of a tube heated everywhere is a quadrature. A late pulse is a travelling wave
(`gelpump.tube.wave`), which says how accurate it is: where that is enough, at every time that is
asked for, the design is done. The others are solved as pulses (`gelpump.tube.slender`), up to the
last time that needs it: `solver` and `uncertainty` say for each design and time which of the two
gave it and how accurate it is.

Pulses are solved in families of at most FAMILY, each on one mesh; larger ones would hardly be
cheaper (docs/sweeps.md). Should a family fail, it is divided into
halves until the tube that fails is alone; alone it is tried once more, with more cells and other
steps, and flagged if that fails too. A result that breaks its own conservation of water, or leaves
[1, Phi_inf], by more than DOUBTFUL is kept and flagged. Why a design is flagged is in the attribute
`reasons`, by its number.
"""

import json
from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import lumen, scaling
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.front import sharpness
from gelpump.tube.heat import StepHeating
from gelpump.tube.late_pump import conserved
from gelpump.tube.pump import volumes
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import Wall
from gelpump.tube.wave import late_pulse

NEWTON_SHARE = 0.03  # a tenth stalls some tubes with Phi_inf above 6
# what is pumped early needs smaller steps: alone, a tube is out by 1.2 per cent otherwise
TOLERANCE_SHARE = {"printed": 1.0, "conservative": 0.25}
FAMILY = 500  # tubes
TRIALS = 3000  # a family takes some hundred steps
DOUBTFUL = 1e-2
WAVE, PULSE = range(2)
SOLVERS = ("travelling_wave", "pulse")
# of pulses on the default mesh, measured by `gelpump.sweep.accuracy`; of second order in the cells
PULSE_UNCERTAINTY, ITS_CELLS = 1e-2, 52
SOLVED, REFINED, INACCURATE, FAILED = range(4)
STATUS = ("solved", "solved_alone_and_finer", "doubtful", "failed")

OUTPUTS = {
    "A": ("sharpness of the front", "in units of 1/L"),
    "front_width": ("width 1/A of the front", scaling.AXIAL),
    "Phi1_front": ("polymer fraction in the middle of the wall at Z_C", scaling.POLYMER),
    "V_peak": (
        "largest axial velocity in the lumen, as printed in eqn:lumen",
        scaling.AXIAL_VELOCITY,
    ),
    "V_far": (
        "axial velocity far ahead in the lumen, as printed in eqn:lumen",
        scaling.AXIAL_VELOCITY,
    ),
    "departed_length": ("length over which Phi_1 is not near its equilibrium", scaling.AXIAL),
    "pulse_flux": (
        "V of eqn:lumen integrated over the pulse, less V far ahead in front of Z_C",
        "in units of L^2 per poroelastic time mu_l L^2/(k Pi_00)",
    ),
    # beside those of the printed equation, those of the closure that conserves water
    "V_far_conservative": (
        "axial velocity far ahead in the lumen, away from the heated end, water conserved",
        scaling.AXIAL_VELOCITY,
    ),
    "pumped_conservative": (
        "volume that has gone along the lumen past a fixed station far ahead, water conserved",
        scaling.VOLUME,
    ),
}


def solve_designs(designs: xr.Dataset, tau, numerics: Mapping, error: float = 0.0) -> xr.Dataset:
    """Outputs of the designs (dimension `index`) at the times tau, tau_99, solver and status.

    `error` is the relative error that waves may have; 0 lets none be used.
    """
    tubes, tau = _tubes(designs), np.asarray(tau, float)
    found, uncertainty = _waves(designs, tau)
    solver = np.where(uncertainty <= error, WAVE, PULSE).astype(np.int8)
    status, reasons = np.zeros(len(solver), np.int8), {}
    # how many of the times a pulse has to reach, from the first on
    reach = (len(tau) - np.argmax(solver[:, ::-1] == PULSE, axis=1)) * (solver == PULSE).any(axis=1)
    for times in np.unique(reach[reach > 0]):
        _pulses(
            designs, np.flatnonzero(reach == times), tau[:times], numerics, found, status, reasons
        )
    by_pulse = np.arange(len(tau)) < reach[:, np.newaxis]
    solver[by_pulse] = PULSE
    uncertainty[by_pulse] = PULSE_UNCERTAINTY * (ITS_CELLS / sum(numerics["cells"])) ** 2
    data = {name: variable(("index", "tau"), found[name], *text) for name, text in OUTPUTS.items()}
    data["tau99"] = variable(
        "index",
        deswelling_time(tubes),
        "time until a tube heated everywhere has made 99 per cent of its change",
        "in units of mu_l L^2/(k Pi_00)",
    )
    data["uncertainty"] = variable(
        ("index", "tau"), uncertainty, "relative uncertainty of the outputs"
    )
    for name, dims, values, meanings, text in (
        ("solver", ("index", "tau"), solver, SOLVERS, "what gave the outputs"),
        ("status", "index", status, STATUS, "how the design ended"),
    ):
        data[name] = variable(dims, values, text)
        data[name][2].update(
            flag_values=np.arange(len(meanings), dtype=np.int8), flag_meanings=" ".join(meanings)
        )
    solved = designs.assign(data).assign_coords(tau=scaling.tau(tau))
    number = designs.design.values
    return solved.assign_attrs(
        reasons=json.dumps({str(number[at]): why for at, why in sorted(reasons.items())})
    )


def _waves(designs, tau):
    """All outputs by travelling waves, (design, time), and the largest uncertainty of them."""
    given = _tubes(designs.expand_dims(time=1, axis=1)), designs.Le.values[:, np.newaxis], tau
    printed, conservative = late_pulse(*given), conserved(*given)
    found = printed.values | {
        "front_width": 1 / printed.values["A"],
        "V_far_conservative": conservative.values["V_far"],
        "pumped_conservative": np.pi * conservative.values["pumped_station"],
    }
    stated = [
        *printed.uncertainty.values(),
        *(conservative.uncertainty[name] for name in ("V_far", "pumped_station")),
    ]
    uncertainty = np.max(stated, axis=0)
    finite = np.all([np.isfinite(each) for each in found.values()], axis=0)
    return found, np.where(finite, uncertainty, np.inf)


def _pulses(designs, which, tau, numerics, found, status, reasons):
    """Solve the pulses of the designs `which`, into found[:, times], status and reasons."""
    times = len(tau)
    pending = [which[start : start + FAMILY] for start in range(0, len(which), FAMILY)]
    while pending:
        these = pending.pop()
        try:
            values, defect = _family(designs.isel(index=these), tau, numerics)
        except (ArithmeticError, RuntimeError) as failure:
            if len(these) > 1:
                middle = len(these) // 2
                pending += [these[middle:], these[:middle]]
                continue
            [alone] = these
            values, defect = _alone(designs.isel(index=these), tau, numerics)
            status[alone] = REFINED
            reasons[alone] = f"with the family: {failure}"
            if values is None:
                status[alone] = FAILED
                reasons[alone] = f"{failure}; alone, on a finer mesh: {defect}"
                for name in OUTPUTS:
                    found[name][alone] = np.nan
                continue
        for name in OUTPUTS:
            found[name][these, :times] = values[name]
        for place in np.flatnonzero(defect > DOUBTFUL):
            status[these[place]] = INACCURATE
            reasons[these[place]] = (
                f"breaks conservation of water, or the bounds of Phi_1, by {defect[place]:.1e}"
            )


def _tubes(designs):
    return Tubes(*(designs[key].values for key in ("ell", "eps", "M", "Pi_ratio", "Phi_inf")))


def _alone(design, tau, numerics):
    behind, ahead = numerics["cells"]
    finer = {
        **numerics,
        "cells": [2 * behind, 2 * ahead],
        "tolerance": numerics["tolerance"] / 3,
    }
    try:
        return _family(design, tau, finer)
    except (ArithmeticError, RuntimeError) as failure:
        return None, failure


def _family(designs, tau, numerics):
    """The outputs, (tube, tau), and each tube's defect, (tube,)."""
    tubes, heat = _tubes(designs), StepHeating(designs.Le.values[:, np.newaxis])
    given = {**numerics, "cells": tuple(numerics["cells"])}
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # looked at below
        pulse, conserving = (
            solve(
                tubes,
                heat,
                tau,
                closure=closure,
                newton_share=NEWTON_SHARE,
                trials=TRIALS,
                **given | {"tolerance": share * numerics["tolerance"]},
            )
            for closure, share in TOLERANCE_SHARE.items()
        )
        lumen_area = np.pi * tubes.ell[:, np.newaxis] ** 2
        A, _ = sharpness(pulse)
        wall = Wall.of(pulse)
        V = lumen.velocity_printed(wall)
        values = {
            "A": A,
            "front_width": 1 / A,
            "Phi1_front": pulse.Phi1_front.values,
            "V_peak": V.max(axis=-1),
            "V_far": V[..., -1],
            "departed_length": pulse.departed_length.values,
            "pulse_flux": lumen.pulse_flux(wall, pulse.hot.values),
            "V_far_conservative": volumes(conserving, rate=True)["pumped_station"] / lumen_area,
            "pumped_conservative": volumes(conserving)["pumped_station"],
        }
    if not all(np.isfinite(each).all() for each in values.values()):
        raise ArithmeticError("an output is not finite")
    return values, np.maximum(_defect(pulse), _defect(conserving))


def _defect(pulse):
    """By how much a tube breaks its conservation of water, or the bounds of Phi_1."""
    outside = np.maximum(1 - pulse.Phi1, pulse.Phi1 - pulse.Phi_inf).max(("tau", "cell"))
    return np.maximum(pulse.water_balance_error.max("tau"), outside / (pulse.Phi_inf - 1)).values
