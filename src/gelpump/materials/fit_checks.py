"""Whether a fitted gel represents its points, and what to beware of in it."""

from collections.abc import Iterator

import numpy as np

from .explicit import ExplicitGel
from .measurements import BRANCHES, USUAL_ERROR, Points

COLLAPSED = 0.25  # polymer fraction: above it a gel counts as collapsed
FAR = 5.0  # standard errors, or scatters, from a stable branch, at which a point is not on it


def missing_state(points: Points) -> str:
    """In words, which of the two states no point is in; "" if both are there."""
    for state, missing in (
        ("collapsed", np.all(points.phi < COLLAPSED)),
        ("swollen", np.all(points.phi > COLLAPSED)),
    ):
        if missing:
            return (
                f"the {state} state is missing (phi from {points.phi.min():.3g} to "
                f"{points.phi.max():.3g}, none {'above' if state == 'collapsed' else 'below'} "
                f"{COLLAPSED:g})"
            )
    return ""


def require_stable(gel: ExplicitGel, points: Points, scatter: float, missing: str) -> None:
    """ValueError unless each point lies within FAR times its error of a stable branch.

    The distance is that to the drawn curve, in errors; they are multiplied by ``scatter``.
    """
    phi = np.concatenate([np.geomspace(1e-5, 0.05, 2000), np.linspace(0.05, 0.9999, 8000)])
    phi = np.sort(np.concatenate([phi, points.phi]))
    T = gel.equilibrium_temperature(phi)
    real = np.isfinite(T) & (T > 0)
    phi, T = phi[real], T[real]
    stable = gel.osmotic_modulus(phi, T) > 0
    for t, f, *errors in zip(points.T, points.phi, points.T_error, points.phi_error, strict=True):
        distance = np.hypot((T - t) / errors[0], (phi - f) / errors[1]) / scatter
        nearest = distance[stable].min(initial=np.inf)
        if nearest > FAR and not stable[distance.argmin()]:
            raise ValueError(
                f"{gel.name}: the point at {t:g} K, phi = {f:g} lies on the unstable branch of the "
                f"best fit, {nearest:.3g} errors away from a stable one: what is measured is "
                "stable, so this form cannot represent these points" + (missing and f"; {missing}")
            )


def warnings(found, points: Points, missing: str) -> Iterator[str]:
    """What there is to beware of in a fit."""
    yield from points.notes
    for name, value, error in zip(found.names, found.parameters, found.errors, strict=True):
        if error > abs(value) / 2:
            yield f"{name} = {value:.4g} is not identified: its standard error is {error:.2g}"
    if missing:
        yield f"{missing}: what the fit says of it is extrapolated"
    chi2 = found.reduced_chi2
    if points.errors_given and not 0.3 < chi2 < 3:
        yield f"chi^2 per degree of freedom is {chi2:.2g}: the form or the errors do not fit"
    if not points.errors_given:
        yield "errors were not given for both columns: they are estimated from the scatter"
        if chi2 > 3:
            yield (
                f"the points lie {chi2**0.5:.2g} times their errors away from the fit{usual()}: "
                "the points scatter or the form does not fit"
            )
    yield from _hysteresis(found.gel, points)


def usual() -> str:
    """Which errors are assumed where none are given."""
    usual = "{temperature_error:g} K and {polymer_fraction_error:.0%}".format(**USUAL_ERROR)
    return f" (errors of {usual} are assumed, none are given)"


def _hysteresis(gel, points):
    """What the points say of the fit's hysteresis."""
    T, phi = gel.folds()
    if len(T) < 2:
        return
    middle, within = phi.mean(), (T.min() <= points.T) & (T.max() >= points.T)
    if len(set(points.phi[within] > middle)) != 2:
        yield (
            f"the fit has a hysteresis from {T.min():.2f} to {T.max():.2f} K, but no temperature "
            "is measured in both states there"
        )
    for branch in BRANCHES:
        left = (points.phi > middle) == (gel.collapses_when_heated == (branch == "heating"))
        early = points.on(branch) & left & within
        if early.any():
            yield (
                f"on {branch} the gel has jumped at {points.T[early][0]:.2f} K, before the fit's "
                "fold: folds are limits of stability, a real gel may leave a branch earlier"
            )
