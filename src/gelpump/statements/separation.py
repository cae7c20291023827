"""Beads that separate, in the sharp limit: what section 2.1.1 expects of them, as numbers."""

from typing import TYPE_CHECKING

import numpy as np

from gelpump.statements.statement import Collection, Computed, Evidence, holds

if TYPE_CHECKING:
    import xarray as xr

statements = Collection()
states = statements.states
MODELS = ("nonlinear", "lens")
TRAVELS = (0.9, 0.1)  # dry radii between which the front is looked at


def runs(e: Evidence) -> list["xr.Dataset"] | None:
    """The bead `separating` in both models; None where either has no front that travels."""
    names = [f"separation_separating_{model}" for model in MODELS]
    found = [e.data[name] for name in names if name in e.data]
    travel = len(found) == len(names) and all(travelling(run).t.size > 1 for run in found)
    return found if travel else None


def travelling(run: "xr.Dataset") -> "xr.Dataset":
    """The times at which the front travels within the bead."""
    front, (high, low) = run.front_dry_radius, TRAVELS
    return run.isel(t=np.flatnonzero((run.front_present > 0) & (front < high) & (front > low)))


@states(
    "separation-front-inwards",
    "section 2.1.1",
    "separation_separating_{nonlinear,lens}: front_dry_radius",
)
def front_inwards(e: Evidence) -> Computed | None:
    """A drying front forms at the surface and travels inwards, without turning, to the centre."""
    if (beads := runs(e)) is None:
        return None
    fall = [-np.diff(run.front_dry_radius.values[run.front_present.values > 0]) for run in beads]
    ends = all("completion_t" in run.attrs for run in beads)
    done = [run.attrs.get("completion_t", np.inf) for run in beads] if ends else None
    doubt = [run.attrs.get("completion_t_uncertainty", 0.0) for run in beads]
    return Computed(
        ends and holds(min(each.min() for each in fall), 0.0),
        doubt if ends else None,
        done,
        "t_BMJ at which it is complete (fully nonlinear, LENS):",
        paper={"value": True},
    )


@states(
    "separation-outside-final",
    "section 2.1.1",
    "separation_separating_{nonlinear,lens}: polymer_fraction",
)
def outside_final(e: Evidence) -> Computed | None:
    """Outside the front the gel is at its final state: largest relative distance of the polymer
    fraction from the final one (fully nonlinear, LENS)."""
    if (beads := runs(e)) is None:
        return None
    found = []
    for run in beads:
        final, then = float(run.polymer_fraction[-1, 0]), travelling(run)
        outside = then.r.values > then.front_radius.values[:, None]
        found.append(float(np.abs(then.polymer_fraction.values[outside] / final - 1).max()))
    return Computed(found, [run.attrs["radius_uncertainty"] for run in beads])


@states(
    "separation-core-swollen",
    "section 2.1.1",
    "separation_separating_{nonlinear,lens}: polymer_fraction",
)
def core_swollen(e: Evidence) -> Computed | None:
    """Inside the front the gel stays swollen: largest polymer fraction there, over the initial one
    (fully nonlinear, LENS)."""
    if (beads := runs(e)) is None:
        return None
    most, least = [], []
    for run in beads:
        then = travelling(run)
        inside = then.r.values < then.front_radius.values[:, None]
        share = then.polymer_fraction.values[inside] / run.attrs["phi_initial"]
        most.append(float(share.max()))
        least.append(float(share.min()))
    return Computed(
        most,
        [run.attrs["radius_uncertainty"] for run in beads],
        follows="just ahead of the front it swells: the least share is "
        + " and ".join(f"{share:.2g}" for share in least),
    )


@states(
    "separation-lens-vs-nonlinear",
    "section 2.1.1",
    "separation_separating_{nonlinear,lens}: passage_time",
)
def lens_against_nonlinear(e: Evidence) -> Computed | None:
    """LENS's front against the fully nonlinear one: its time from R = 0.7 to 0.3 and the completion
    of the collapse, LENS over fully nonlinear."""
    if (beads := runs(e)) is None:
        return None
    time = [
        float(run.passage_time.sel(passage=0.3) - run.passage_time.sel(passage=0.7))
        for run in beads
    ]
    done = [run.attrs["completion_t"] for run in beads]
    doubt = [
        sum(float(run.passage_time_uncertainty.max()) for run in beads) / time[0],
        sum(run.attrs["completion_t_uncertainty"] for run in beads) / done[0],
    ]
    late = beads[1].attrs["birth_t"]
    return Computed(
        [time[1] / time[0], done[1] / done[0]],
        doubt,
        follows=f"LENS's front sets out at t_BMJ = {late:.3g}, the nonlinear one at "
        f"{beads[0].attrs['birth_t']:.3g}",
    )


@states("separation-onset", "section 2.1.1, figure 5", "coexistence_HHT: loss_temperature")
def onset(e: Evidence) -> Computed | None:
    """The temperature at which a bead begins to separate, T*(a), against the criterion D < 0 of
    figure 5: range of T* over the radii of a drying bead, minus the spinodal's tip, K (LENS, fully
    nonlinear)."""
    if "coexistence_HHT" not in e.data:
        return None
    phases, tip = e.data["coexistence_HHT"], e.data["materials_HHT"].spinodal_tip_temperature
    above = [
        float(value)
        for model in ("lens", "nonlinear")
        for T in [phases.loss_temperature.sel(model=model).values]
        for value in (T[T > 0].min() - tip, T[T > 0].max() - tip)
    ]
    return Computed(above, [1e-6] * 4, follows="D < 0 is where phases can separate, not when")
