"""Data of the explorers, small enough to be put into a page.

An array is base64 of little-endian Float32, or of Uint16 between its own least and largest value:

    value = low + (high - low) n / 65535,    an error of at most (high - low)/131070.

A tube's arrays are quantised one (ell, tau) at a time, and keep every second cell, counted from the
front on either side; a bead's keep every second shell, counted from the surface.  The numbers that
an explorer prints are not taken from these but from lists of the datasets' own, to six digits.
"""

import base64
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gelpump.tube import lumen
from gelpump.tube.front import sharpness
from gelpump.tube.wall_flow import Wall

if TYPE_CHECKING:
    import xarray as xr

DIGITS = 6


def float32(values) -> dict[str, Any]:
    """An array with the precision of Float32."""
    values = np.asarray(values)
    return {"shape": list(values.shape), "float32": _base64(values, "<f4")}


def uint16(values, rows: int = 0) -> dict[str, Any]:
    """An array of which each row, told by the first ``rows`` dimensions, has its own range."""
    values = np.asarray(values, dtype=float)
    lines = values.reshape(int(np.prod(values.shape[:rows])), -1)
    low, high = lines.min(axis=1), lines.max(axis=1)
    span = np.where(high > low, high - low, 1.0)
    steps = np.rint((lines - low[:, np.newaxis]) / span[:, np.newaxis] * 65535)
    return {
        "shape": list(values.shape),
        "uint16": _base64(steps, "<u2"),
        "low": float32(low),
        "span": float32(span),
    }


def _base64(values, kind):
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def digits(values) -> Any:
    """Numbers to six significant digits, in nested lists."""
    if np.ndim(values):
        return [digits(each) for each in np.asarray(values)]
    return float(f"{float(values):.{DIGITS}g}")


def tubes(
    printed: "xr.Dataset", fit: "xr.Dataset", conserving: "xr.Dataset"
) -> dict[str, dict[str, Any]]:
    """Tubes behind a pulse of heat by closure, with the flow in wall and lumen.

    printed: of ``tube.slender``; fit: of ``tube.front_fit``, for its A(ell, tau).  conserving: of
    ``tube.pump.joined``.
    """
    A = fit.A_tau.sel(ell=printed.ell, tau=printed.tau, method="nearest").values
    found = {"printed": _tubes(printed, A, lumen.velocity_printed)}
    for closure in conserving.closure.values:
        pulse = conserving.sel(closure=closure)
        found[str(closure)] = _tubes(pulse, sharpness(pulse)[0], lumen.velocity_conserving)
    return found


def _tubes(pulse, A, velocity) -> dict[str, Any]:
    """Velocities are those of ``tube.wall_flow`` and ``tube.lumen`` in the cells: axial ones in L,
    radial ones in a_1 per poroelastic time."""
    wall = Wall.of(pulse)
    front = int(pulse.hot.sum())
    kept = np.r_[(front - 1) % 2 : front : 2, front : pulse.sizes["cell"] : 2]
    V = velocity(wall)
    cells = {
        "Phi1": pulse.Phi1.values,
        "U_outer": wall.radial_velocity(np.ones(1))[..., 0],
        "V_g": wall.axial_velocity,
        "V": (V[..., 1:] + V[..., :-1]) / 2,
    }
    late = V[:, pulse.sizes["tau"] // 2 :]
    return {
        "ell": digits(pulse.ell),
        "tau": digits(pulse.tau),
        "Z_C": digits(pulse.Z_C),
        "eps": digits(pulse.eps),
        "Phi_inf": digits(pulse.Phi_inf),
        "Phi1_front": digits(pulse.Phi1_front),
        "A": digits(A),
        "V_front": digits(V[..., front]),
        "V_far": digits(V[..., -1]),
        "highest": digits(late.max(axis=(1, 2))),
        "Z": float32(pulse.Z.values[..., kept]),
        **{name: uint16(values[..., kept], rows=2) for name, values in cells.items()},
    }


def bead(data: "xr.Dataset") -> dict[str, Any]:
    """A bead of ``bead.dataset`` or ``separation.observed``: its course, and its shells in the
    times that were stored; of the latter its front too, 0 before and after it."""
    kept = slice((data.sizes["cell"] - 1) % 2, None, 2)
    return {
        "t": digits(data.t),
        "radius": digits(data.radius),
        "surface": digits(data.surface_polymer_fraction),
        "centre": digits(data.polymer_fraction[:, 0]),
        "stopped": data.attrs.get("stopped"),
        "front": digits(data.front_radius * data.front_present) if "front_radius" in data else [],
        "r": uint16(data.r.values[:, kept], rows=1),
        "phi": uint16(data.polymer_fraction.values[:, kept], rows=1),
    }


def beads(
    data: Mapping[str, Mapping[str, "xr.Dataset"]],
    cases: Mapping[str, Mapping[str, Any]],
    published: Mapping[str, Mapping[str, Sequence[float]]],
) -> dict[str, Any]:
    """Beads by case and model; published: radii read off the paper, by case and model."""
    return {
        case: {
            "gel": cases[case]["gel"],
            "from": cases[case]["temperature_initial"],
            "to": cases[case]["temperature_final"],
            "published_t": cases[case]["published_times"],
            "published": published.get(case, {}),
            "models": {name: bead(each) for name, each in models.items()},
        }
        for case, models in data.items()
    }


def gel(data: "xr.Dataset") -> dict[str, Any]:
    """A gel of ``materials.tables``.

    In k_B T/Omega_f, Pi is linear in T at each polymer fraction, since chi is: its values at the
    lowest and the highest temperature are all of it.
    """
    tip = "spinodal_tip_temperature" in data
    return {
        "temperature": digits(data.temperature),
        "fold_T": digits(data.fold_temperature),
        "fold_phi": digits(data.fold_polymer_fraction),
        "tip": [float(data.spinodal_tip_temperature), float(data.spinodal_tip_polymer_fraction)]
        if tip
        else None,
        "phi": float32(data.polymer_fraction),
        "T_equilibrium": float32(data.temperature_equilibrium),
        "stable": [int(each) for each in data.equilibrium_is_stable],
        "T_spinodal": float32(data.temperature_spinodal),
        "falls": [int(each) for each in data.diffusivity[-1] < data.diffusivity[0]],
        "Pi_coldest": float32(data.osmotic_pressure[0]),
        "Pi_hottest": float32(data.osmotic_pressure[-1]),
    }
