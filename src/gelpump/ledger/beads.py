"""Disagreements about swelling and drying beads (section 2.1)."""

from collections.abc import Iterator, Mapping

import numpy as np

from gelpump.ledger.entry import Entry
from gelpump.uncertainty import rounding_error


def entries(data: Mapping, gels: Mapping, cases: Mapping, published: Mapping) -> Iterator[Entry]:
    """data: ``bead_{case}_{model}``, ``refinement/bead_{case}_{model}``, ``sensitivity_drying``."""
    for case, verb in (("swelling", "swell"), ("drying", "dry")):
        if cases[case]["published_times"]:
            yield lens_curves(case, verb, data, cases, published)
    yield lens_speed(data)
    yield separation_criterion(data, gels["HHT"])
    yield printed_digits(data, cases, published)


def lens_curves(case: str, verb: str, data: Mapping, cases: Mapping, published: Mapping) -> Entry:
    """The drawn LENS radius against the solution of the stated equations."""
    at = {"t": cases[case]["published_times"], "method": "nearest"}
    drawn = published[f"{verb}-radius-lens"]
    nonlinear = published[f"{verb}-radius-nonlinear"]["value"]
    solved = data[f"bead_{case}_lens"].radius.sel(**at).values
    doubt = data[f"refinement/bead_{case}_lens"].radius_uncertainty.sel(**at).values
    difference = np.subtract(drawn["value"], solved)
    closer = np.abs(np.subtract(nonlinear, solved)).max()
    apart = np.abs(np.subtract(drawn["value"], nonlinear)).max()
    return Entry(
        f"lens-curve-{case}",
        "figure 3a" if case == "swelling" else "figure 4a",
        f"the LENS radius is drawn up to {apart:.3g} away from the fully nonlinear one",
        f"the stated LENS equations give a radius within {closer:.2g} of the drawn nonlinear one; "
        "the cause is unknown",
        difference.tolist(),
        "drawn minus solved LENS radius, R_dry",
        (drawn["resolution"] + doubt).tolist(),
        lens_curves,
        f"data/bead_{case}_lens.nc: radius",
    )


def lens_speed(data: Mapping) -> Entry:
    """Whether LENS swells marginally slower than the nonlinear model."""
    lens, nonlinear = (data[f"bead_swelling_{model}"] for model in ("lens", "nonlinear"))
    doubts = sum(
        data[f"refinement/bead_swelling_{model}"].radius_uncertainty
        for model in ("lens", "nonlinear")
    )
    ahead = (lens.radius - nonlinear.radius).values
    first = int(np.argmax(ahead))
    return Entry(
        "lens-swells-slower",
        "section 2.1",
        "LENS swells marginally slower than the nonlinear model",
        f"it is ahead at first, by most at t_BMJ = {float(lens.t[first]):.2g}, and falls behind by "
        f"{-ahead.min():.1g} later",
        float(ahead[first]),
        "largest lead of the LENS radius, R_dry",
        float(doubts[first]),
        lens_speed,
        "data/bead_swelling_{lens,nonlinear}.nc: radius",
    )


def separation_criterion(data: Mapping, gel) -> Entry:
    """LENS's D where the nonlinear model has already stopped being parabolic."""
    bead = data["bead_separating_nonlinear"]
    phi, T = bead.attrs["stopped_polymer_fraction"], bead.attrs["temperature"]

    def diffusivity(phi, T):
        return gel.diffusivity(phi, T) / gel.shear_modulus(1.0)

    D = float(diffusivity(phi, T))
    return Entry(
        "separation-criterion",
        "section 2.1.1",
        "D < 0 is the criterion for phases to separate",
        f"the nonlinear model loses its parabolic type at t_BMJ = {bead.attrs['stopped_t']:.2g}, "
        f"phi = {phi:.3f}, where D is still positive; LENS goes on until t_BMJ = "
        f"{data['bead_separating_lens'].attrs['stopped_t']:.3g}",
        max(D, 0.0),
        "LENS's D at the nonlinear model's loss (304 to 308 K), in k mu_s/mu_l",
        float(rounding_error(diffusivity, phi, T)),
        separation_criterion,
        "data/bead_separating_nonlinear.nc: stopped_polymer_fraction",
    )


def printed_digits(data: Mapping, cases: Mapping, published: Mapping) -> Entry:
    """What half a unit of the last printed digit of each parameter makes of the drying radius."""
    change = data["sensitivity_drying"].radius_change
    last = max(cases["drying"]["published_times"], default=cases["drying"]["end"])
    half = change.sel(t=last, method="nearest")
    largest = half.parameter_name.values[np.argmax(np.abs(half.values))]
    return Entry(
        "printed-digits-of-table-2",
        "table 2, figure 4",
        "the parameters are printed to four or five digits",
        f"drying passes so near the spinodal's tip that half a unit of the last digit of {largest} "
        f"moves the radius at t_BMJ = {last:g} by more than the bead's own change, to first order",
        np.abs(half.values).tolist(),
        "change of the radius for half a unit of "
        + ", ".join(str(name) for name in half.parameter_name.values),
        published["dry-radius-nonlinear"]["resolution"],
        printed_digits,
        "data/sensitivity_drying.nc: radius_change",
    )
