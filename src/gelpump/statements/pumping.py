"""Tubes that conserve water, what they pump, and walls resolved in r: beyond the paper.

What they rest on is `gelpump.tube.closure`, `pump` and `wall`; docs/pump.md tells it.
"""

import numpy as np

from gelpump.statements.statement import Collection, Computed, Evidence, holds

statements = Collection()
states = statements.states
BALANCE, WALL, NEEDS = "pump_balance", "wall_times", "gelpump.tube.closure"
CONSERVING = ["conservative", "balanced"]
EARLY, LATE = 0.01, 0.1  # tau


def _conserving(e, **at):
    if BALANCE not in e.data:
        return None
    here = e.data[BALANCE]
    here = here.isel(closure=np.isin(here.closure.values, CONSERVING))
    return here.sel(**at, method="nearest") if at else here


@states("beyond-conservation", NEEDS, f"{BALANCE}: water_balance_error, water_balance_step")
def conservation(e: Evidence) -> Computed | None:
    """With the conservative and the balanced closure all that the wall has lost has gone through
    its edges: the largest difference over Z_C, of all tubes and times, is rounding."""
    if (here := _conserving(e)) is None:
        return None
    worst = float(here.water_balance_error.max())
    printed = float(e.data[BALANCE].water_balance_error.sel(closure="printed").max())
    return Computed(
        worst,
        float(here.water_balance_step.max()),
        printed,
        "of the printed closure:",
        paper={"value": 0.0, "resolution": 1e-10},
    )


@states("beyond-pump-direction", "section 3.6.2", f"{BALANCE}: V_far")
def direction(e: Evidence) -> Computed | None:
    """A tube that conserves water pumps away from its heated end, at all times and whatever ell."""
    if (here := _conserving(e)) is None:
        return None
    least = (here.V_far / here.V_far_geometry).min()
    doubt = float((here.V_far_uncertainty / here.V_far_geometry).max())
    return Computed(
        holds(float(least), doubt),
        doubt,
        float(least),
        "least V far ahead, over that by geometry:",
        paper={"value": True},
    )


@states("beyond-pump-geometry", "section 3.6.2", f"{BALANCE}: V_far, V_far_geometry")
def geometry(e: Evidence) -> Computed | None:
    """Late, at tau = 0.1, V far ahead of the conservative closure is Z_C' (1 - q + sigma (1-ell^2)
    (p - q)/ell^2), p = Phi_inf^(1/3), q = Phi_inf^(-2/3): over that it is 1, for each ell."""
    if (here := _conserving(e, tau=LATE)) is None:
        return None
    late, early = (each.sel(closure="conservative") for each in (here, _conserving(e, tau=EARLY)))
    return Computed(
        (late.V_far / late.V_far_geometry).values,
        (late.V_far_uncertainty / late.V_far_geometry).values,
        (early.V_far / early.V_far_geometry).values,
        "at tau = 0.01:",
        paper={"value": 1.0, "resolution": 0.005},
    )


@states("beyond-pump-early", "section 3.6.2", f"{BALANCE}: V_far, V_far_geometry")
def early(e):
    """At tau = 0.01 V far ahead of the conservative closure is already that by geometry: over it,
    1 to 2 per cent, for each ell."""
    if (here := _conserving(e)) is None:
        return None
    one = here.sel(closure="conservative")
    ratio, doubt = one.V_far / one.V_far_geometry, one.V_far_uncertainty / one.V_far_geometry
    tau, first = (each.sel(tau=[EARLY, LATE], method="nearest") for each in (one.tau, ratio))
    without = (first * tau).diff("tau") / tau.diff("tau")
    return Computed(
        first[:, 0].values,
        doubt.sel(tau=EARLY, method="nearest").values,
        without[:, 0].values,
        "less what falls as 1/tau, from tau = 0.01 and 0.1:",
        "thick walls are later: the excess is a fifth of w^2/tau",
        {"value": 1.0, "resolution": 0.02},
    )


@states("beyond-pump-order", "section 3.6.2", f"{BALANCE}: V_far_order")
def order(e: Evidence) -> Computed | None:
    """V far ahead tends to that by geometry as 1/tau, for each ell (conservative closure)."""
    if (here := _conserving(e)) is None:
        return None
    one = here.sel(closure="conservative")
    return Computed(
        one.V_far_order.values,
        one.V_far_order_uncertainty.values,
        paper={"value": 1.0, "resolution": 0.05},
    )


@states("beyond-pump-printed", "eqn:lumen", f"{BALANCE}: V_far")
def printed(e: Evidence) -> Computed | None:
    """V of eqn:lumen far ahead of the printed tube at tau = 0.1 is that of a tube that conserves
    water: over it, 1, for each ell."""
    if (here := _conserving(e, tau=LATE)) is None:
        return None
    as_printed = e.data[BALANCE].sel(closure="printed").sel(tau=LATE, method="nearest")
    conserved = here.sel(closure="conservative")
    ratio = (as_printed.V_far / conserved.V_far).values
    doubt = (as_printed.V_far_uncertainty / as_printed.V_far).values
    doubt = doubt + (conserved.V_far_uncertainty / conserved.V_far).values
    return Computed(
        ratio,
        ratio * doubt,
        follows="it is larger: a front that stands still goes on pumping as printed",
        paper={"value": 1.0, "resolution": 0.05},
    )


def _walls(e, varied: str):
    if WALL not in e.data:
        return None
    return e.data[WALL].isel(tube=e.data[WALL].varied.values == varied)


@states("beyond-wall-time", "section 3.4", f"{WALL}: tau99, tau99_printed")
def wall_time(e: Evidence) -> Computed | None:
    """tau_99 on the midline of a wall resolved in r with Phi = Phi_0 on its surfaces is that of the
    slender tube: over that as printed it is 1, for each ell."""
    if (here := _walls(e, "ell")) is None:
        return None
    one = here.sel(surface="conservative", place="midline")
    ratio, doubt = (
        (one[name] / here.tau99_printed).values for name in ("tau99", "tau99_uncertainty")
    )
    return Computed(
        ratio,
        doubt,
        (here.tau99.sel(surface="balanced", place="midline") / here.tau99_printed).values,
        "with no force on the surfaces:",
        "the wall takes longer",
        {"value": 1.0, "resolution": 0.01},
    )


@states("beyond-wall-stiffness", "section 3.4", f"{WALL}: tau99, M")
def stiffness(e: Evidence) -> Computed | None:
    """Stiffer gels are faster: the power of M in tau_99 from M = 1 to 10 of a wall whose surfaces
    bear no force is that of the printed equation."""
    if (here := _walls(e, "M")) is None:
        return None
    pair = here.isel(tube=[int(np.argmin(np.abs(here.M.values - M))) for M in (1.0, 10.0)])
    ln_M = np.diff(np.log(pair.M.values)).item()

    def power(times):
        return float(np.diff(np.log(times)).item() / ln_M)

    free, held = (
        pair.sel(surface=surface, place="midline") for surface in ("balanced", "conservative")
    )
    doubt = float((free.tau99_uncertainty / free.tau99).sum() / ln_M)
    return Computed(
        power(free.tau99),
        doubt,
        power(held.tau99),
        "with Phi = Phi_0 on the surfaces:",
        "the speed comes from the surface condition",
        {"value": power(pair.tau99_printed), "resolution": 0.05},
    )
