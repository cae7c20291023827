"""What a collapsing tube pumps: the balance of all its water, and what geometry says of it.

Volumes since tau = 0 on one side of Z = 0, from the books of the wall (`gelpump.tube.ledger`). The
lumen of a slice dX has the volume pi ell^2 lambda^3 dX: it shrinks as the wall does, and the tube
with it. With `loss`, `source`, `axial`, `swept`, `shorter` of the books, p = Phi_inf^(1/3) and
q = Phi_inf^(-2/3),

    collapse   of the lumen up to a fixed station far ahead       pi ell^2 (loss - shorter)
               up to the tube's own end, which is drawn in        pi ell^2 loss
    inner      water out of the wall into the lumen               pi sigma (1-ell^2) source
    outer      water out of the wall into the bath                pi (1-sigma) (1-ell^2) source
    along      water through the wall past the front, hotwards    pi (1-ell^2) axial
    pumped     past the station, or out of the end                collapse + inner

sigma is `wall_flow.lumen_share`. The wall's loss is what has gone through its edges:

    pi (1-ell^2) loss = inner + outer -+ along +- swept   behind (ahead of) the front,
    pi (1-ell^2) loss = inner + outer                     altogether;

where water is not conserved, what remains is `unaccounted`. For the printed wall, inner and outer
are those of eqn:ug with eqn:phi2 (`gelpump.tube.budget`), and what is pumped is V of eqn:lumen.

Long after the start, tau >> w^2, all that happens while the front advances by dZ_C = lambda_hot dX
is that swollen slices have become collapsed ones, lambda_hot^3 = 1/Phi_inf. If the wall conserves
water, so that a front at rest sheds nothing, then per pi dZ_C

    collapse   ell^2 (1-q) at the station, ell^2 (p-q) at the end
    inner      sigma (1-ell^2) (p-q)              outer   (1-sigma) (1-ell^2) (p-q)

and the velocity of the lumen's water far ahead, of area pi ell^2, is

    V = Z_C' [ 1 - q + sigma (1-ell^2) (p-q)/ell^2 ] > 0 :

away from the heated end, whatever the closure and the gel.
"""

from collections.abc import Mapping, Sequence
from dataclasses import fields

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from gelpump.netcdf import variable
from gelpump.tube import scaling
from gelpump.tube.closure import CLOSURES, WATER
from gelpump.tube.heat import StepHeating
from gelpump.tube.ledger import SIDES
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import lumen_share

SAFETY = 1.25  # of the grid-convergence index
LINES = {
    "collapse_station": "volume that the lumen has lost up to a fixed station far ahead",
    "collapse_end": "volume that the lumen has lost up to the tube's own end",
    "inner": "water that has gone out of the wall into the lumen",
    "outer": "water that has gone out of the wall into the bath",
    "pumped_station": "water that has gone along the lumen past a fixed station far ahead",
    "pumped_end": "water that has gone out of the tube's own end",
    "loss": "water that the wall has lost",
}
WHOLE = {
    "source_loss": "water that the source of the solved equation has taken from the wall",
    "along": "water that has gone through the wall past the front, to its hot side",
}
BY_SIDE = {
    "loss_side": "water that the wall has lost on this side of the front",
    "inner_side": "water that has gone into the lumen on this side of the front",
    "outer_side": "water that has gone into the bath on this side of the front",
    "unaccounted": "loss of the wall on this side of the front that no flow accounts for",
}


def per_advance(ell, Phi_inf) -> dict[str, np.ndarray]:
    """Each of LINES per pi dZ_C, long after the start, of a wall that conserves water."""
    p, q, sigma = np.cbrt(Phi_inf), Phi_inf ** (-2 / 3), lumen_share(ell)
    wall = (1 - ell**2) * (p - q)
    station, end = ell**2 * (1 - q), ell**2 * (p - q)
    inner = sigma * wall
    return {
        "collapse_station": station,
        "collapse_end": end,
        "inner": inner,
        "outer": wall - inner,
        "pumped_station": station + inner,
        "pumped_end": end + inner,
        "loss": wall,
    }


def velocity_far(ell, Phi_inf, front_speed) -> np.ndarray:
    """V far ahead of the front, long after the start, of a wall that conserves water."""
    return front_speed * per_advance(ell, Phi_inf)["pumped_station"] / ell**2


def shares(ell, closure: str) -> tuple[np.ndarray, np.ndarray]:
    """What of the source (per pi a_1^2 L) goes into the lumen, and what into the bath."""
    if CLOSURES[closure].conserves_water:
        sigma = lumen_share(ell)
        return sigma * (1 - ell**2), (1 - sigma) * (1 - ell**2)
    return ell * (1 - ell) / 2, (1 - ell) / 2


def volumes(pulse: xr.Dataset, rate: bool = False) -> dict[str, np.ndarray]:
    """LINES, (ell, tau), and BY_SIDE, (ell, tau, side), of a pulse with books; or their rates."""
    suffix = "_rate" if rate else ""
    loss, source, axial, swept, shorter, printed = (
        np.pi * pulse[f"{name}{suffix}"].values
        for name in ("loss", "source", "axial", "swept", "shorter", "printed")
    )
    ell = pulse.ell.values[:, np.newaxis]
    to_lumen, to_bath = shares(ell, pulse.attrs["closure"])
    conserves = CLOSURES[pulse.attrs["closure"]].conserves_water
    whole, through = loss.sum(axis=-1), source.sum(axis=-1)
    station, end, inner = ell**2 * (whole - shorter), ell**2 * whole, to_lumen * through
    pumped = station + inner if conserves else ell**2 * printed
    section = (1 - ell**2)[..., np.newaxis]
    passed = np.stack([swept - axial, axial - swept], axis=-1)
    inner_side, outer_side = (share[..., np.newaxis] * source for share in (to_lumen, to_bath))
    return {
        "collapse_station": station,
        "collapse_end": end,
        "inner": inner,
        "outer": to_bath * through,
        "pumped_station": pumped,
        "pumped_end": pumped + ell**2 * shorter,
        "loss": (1 - ell**2) * whole,
        "source_loss": (1 - ell**2) * through,
        "along": (1 - ell**2) * axial,
        "loss_side": section * loss,
        "inner_side": inner_side,
        "outer_side": outer_side,
        "unaccounted": section * (loss - passed) - inner_side - outer_side,
    }


def balance(
    pulses: Mapping[str, xr.Dataset], heat: StepHeating, coarse: Mapping[str, xr.Dataset]
) -> xr.Dataset:
    """Volumes and rates of pulses by closure, dims (closure, ell, tau), against geometry.

    coarse: the same with half the cells and four times the tolerance, for the uncertainty of V.
    """
    pulses, coarse = ({name: each[name] for name in CLOSURES} for each in (pulses, coarse))
    one = pulses["printed"]
    ell, Phi_inf = one.ell.values, one.Phi_inf.values
    data = {}
    for rate, suffix, what, unit in (
        (False, "", "", scaling.VOLUME),
        (True, "_rate", "rate of: ", scaling.VOLUME_RATE),
    ):
        found = [volumes(pulse, rate) for pulse in pulses.values()]
        texts = LINES | WHOLE | BY_SIDE
        for name, text in texts.items():
            dims = ("closure", "ell", "tau", *(["side"] if name in BY_SIDE else []))
            values = np.stack([each[name] for each in found])
            data[f"{name}{suffix}"] = variable(dims, values, f"{what}{text}", unit)
    tau = one.tau.values
    for name, per in per_advance(ell, Phi_inf).items():
        data[f"{name}_geometry"] = variable(
            ("ell", "tau"),
            np.pi * per[:, np.newaxis] * heat.front(tau),
            f"long after the start, by geometry: {LINES[name]}",
            scaling.VOLUME,
        )
    lumen = np.pi * ell[:, np.newaxis] ** 2
    V = data["pumped_station_rate"][1] / lumen
    other = [volumes(pulse, rate=True)["pumped_station"] / lumen for pulse in coarse.values()]
    error = SAFETY * np.abs(V - np.stack(other)) / 3
    expected = velocity_far(ell[:, np.newaxis], Phi_inf[:, np.newaxis], heat.front_speed(tau))
    dims = ("closure", "ell", "tau")
    data |= {
        "V_far": variable(dims, V, "velocity in the lumen far ahead", scaling.AXIAL_VELOCITY),
        "V_far_uncertainty": variable(
            dims,
            error,
            "numerical uncertainty: velocity in the lumen far ahead",
            scaling.AXIAL_VELOCITY,
        ),
        "V_far_geometry": variable(
            dims[1:], expected, "the same by geometry, long after the start", scaling.AXIAL_VELOCITY
        ),
        "V_far_order": variable(
            dims[:2],
            _order(tau, V / expected - 1),
            "order in 1/tau at which V far ahead tends to that by geometry",
            "fitted to the last third of the times",
        ),
        "V_far_order_uncertainty": variable(
            dims[:2],
            np.abs(_order(tau, V / expected - 1) - _order(tau, np.stack(other) / expected - 1)),
            "numerical uncertainty of the order: its change by a coarser mesh",
        ),
        "water_balance_error": variable(
            dims,
            np.stack([pulse.water_balance_error.values for pulse in pulses.values()]),
            "loss of the wall less what has gone through its edges, over Z_C",
        ),
        "water_balance_step": variable(
            "closure",
            [float(pulse.attrs["water_balance_step"]) for pulse in pulses.values()],
            "most of that in one step of time",
        ),
        "Phi1_front": variable(
            dims,
            np.stack([pulse.Phi1_front.values for pulse in pulses.values()]),
            "polymer fraction in the middle of the wall at Z_C",
            scaling.POLYMER,
        ),
        "Z_C": variable("tau", heat.front(tau), "position of the front", scaling.AXIAL),
        "Phi_inf": one.Phi_inf,
    }
    coords = {
        "closure": ("closure", list(pulses), {"long_name": "closure of the slender tube"}),
        "ell": scaling.ell(ell),
        "tau": scaling.tau(tau),
        "side": ("side", list(SIDES), {"long_name": "side of the front"}),
    }
    return xr.Dataset(data, coords)


def _order(tau, error):
    """-d ln|error|/d ln tau over the last third of the times."""
    late = slice(2 * len(tau) // 3, None)
    x = np.log(tau[late])
    x = x - x.mean()
    return -(np.log(np.abs(error[..., late])) * x).sum(axis=-1) / (x**2).sum()


def closures(
    tubes: Tubes, heat: StepHeating, tau, numerics: Mapping, others: Tubes | None = None
) -> dict[str, xr.Dataset]:
    """The tubes by each closure, with books, and "others" by the conservative one.

    All that conserve water are one family, which is solved at once.
    """
    given = {**numerics, "cells": tuple(numerics["cells"]), "books": True}
    blocks = dict.fromkeys(WATER, tubes) | ({} if others is None else {"others": others})
    names = [name if name in WATER else "conservative" for name in blocks]
    counts = [block.ell.size for block in blocks.values()]
    whole = Tubes(
        *(
            np.concatenate([np.ravel(getattr(block, key.name)) for block in blocks.values()])
            for key in fields(Tubes)
        )
    )
    run = solve(whole, heat, tau, closure=np.repeat(names, counts).tolist(), **given)
    parts = zip(blocks, names, np.cumsum(counts), counts, strict=True)
    return {"printed": solve(tubes, heat, tau, closure="printed", **given)} | {
        block: run.isel(ell=slice(end - count, end)).assign_attrs(closure=name)
        for block, name, end, count in parts
    }


def coarser(numerics: Mapping) -> dict:
    """Numerics of which the errors of space and time are four times as large."""
    cells = [count // 2 for count in numerics["cells"]]
    return {**numerics, "cells": cells, "tolerance": 4 * numerics["tolerance"]}


def response(pulse: xr.Dataset, varied: Sequence[str], tau: ArrayLike) -> xr.Dataset:
    """What the conservative closure pumps per advance of the front, dims (tube, tau).

    pulse: tubes of `gelpump.tube.tubes.one_by_one` with what is varied of each, solved with books
    at times among which are `tau`.
    """
    pulse = pulse.sel(tau=tau)
    ell, Phi_inf = pulse.ell.values, pulse.Phi_inf.values
    found, expected = volumes(pulse), per_advance(ell, Phi_inf)
    advance, unit = np.pi * pulse.Z_C.values, "in units of a_1^2"
    data = {}
    for name, text in LINES.items():
        per = variable(("tube", "tau"), found[name] / advance, f"{text}, per pi Z_C", unit)
        geometry = variable("tube", expected[name], f"by geometry: {text}, per pi Z_C", unit)
        data |= {name: per, f"{name}_geometry": geometry}
    for key in ("ell", "M", "Pi_ratio", "Phi_inf"):
        data[key] = variable("tube", pulse[key].values, f"{key} of the tube")
    coords = {
        "varied": ("tube", varied, {"long_name": "number that is varied"}),
        "tau": scaling.tau(pulse.tau.values),
    }
    return xr.Dataset(data, coords)


def joined(pulses: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Pulses that conserve water as one dataset, dims (closure, ell, tau, cell)."""
    conserving = {name: pulses[name] for name in WATER}
    attrs = {
        key: next(iter(conserving.values())).attrs[key] for key in ("cells_behind", "cells_ahead")
    }
    names = xr.Variable("closure", list(conserving), {"long_name": "closure of the slender tube"})
    same = ("Z_C", "hot", "eps", "M", "Pi_ratio", "Phi_inf")
    parts = [pulse.drop_vars(same) for pulse in conserving.values()]
    whole = xr.concat(parts, names, data_vars="all", combine_attrs="override")
    shared = {key: next(iter(conserving.values()))[key] for key in same}
    return whole.drop_attrs(deep=False).assign(shared).assign_attrs(attrs)
