"""Statements about the tube in two dimensions, and about the slender one as measured by it.

Their data are those of `snakemake pump_truth`, below results/truth, or as `gelpump.truth.record`
keeps them for a build without it. What a statement expects stands where the paper's value would.
"""

from functools import wraps

import numpy as np

from gelpump.statements.statement import Collection, Computed, Evidence, holds
from gelpump.tube.front import power_law
from gelpump.tube.wall_flow import lumen_share

statements = Collection()
WAVES, PULSES, SLENDER = "truth/waves", "truth/pulses", "truth/slenderness"
VERIFICATION = "truth/verification"
DOCS = "docs/truth.md"
ORDER = 1.9  # least that is asked of the elements
BALANCE = 1e-8  # of the water, at most
MOVING = 1.0  # Pe of a front like that of figure 9
FIGURE_9 = 1.0  # T of table 1 at tau = 0.01


def states(id, where, evidence, text=""):
    """As `Collection.states`; without the datasets of its evidence a statement is left out."""
    needed = {evidence.partition(": ")[0]} | ({VERIFICATION} if "water" in id else set())

    def of(compute):
        @wraps(compute)
        def if_there(e):
            return compute(e) if needed <= e.data.keys() else None

        return statements.states(id, where, evidence, text=text)(if_there)

    return of


def _resting(waves, name):
    return waves[name].sel(Pe=0.0).values, waves[f"{name}_uncertainty"].sel(Pe=0.0).values


def _exponent(x, values, errors):
    """n of values ~ (1-ell)^-n between the two thinnest tubes, and what their errors make of it."""
    span = np.log((1 - x[-2]) / (1 - x[-1]))
    slope = np.log(values[-1] / values[-2]) / span
    return float(slope), float(np.sum(errors[-2:] / values[-2:]) / span)


@states("beyond-rest-no-flow", DOCS, f"{WAVES}: shed")
def front_at_rest(e: Evidence) -> Computed:
    """A front at rest moves no water anywhere: the wall is in equilibrium, p = 0 throughout."""
    shed = float(np.abs(e.data[WAVES].shed.sel(Pe=0.0)).max())
    text = "largest rate at which a wall with a front at rest sheds water"
    return Computed(holds(BALANCE - shed, 0.0), 0.0, shed, text)


@states("beyond-front-jump", DOCS, f"{WAVES}: jump")
def jump_at_front(e: Evidence) -> Computed:
    """By how much Phi jumps at a front at rest, in the middle of the wall, at each ell; expected:
    it is continuous, as in the slender tube."""
    jump, error = _resting(e.data[WAVES], "jump")
    return Computed(jump, error, paper={"value": 0.0 * jump, "resolution": 0.0})


@states("beyond-front-width", DOCS, f"{WAVES}: width_Phi")
def width_of_front(e: Evidence) -> Computed:
    """Length from 10 to 90 % of Phi in the middle of the wall at a front at rest, over the wall's
    thickness, at each ell."""
    waves = e.data[WAVES]
    width, error = _resting(waves, "width_Phi")
    thickness = 1 - waves.ell.values
    return Computed(width / thickness, error / thickness)


@states("beyond-front-left-behind", DOCS, f"{WAVES}: width_Phi")
def front_left_behind(e: Evidence) -> Computed:
    """The length of the front is what the moving front leaves behind, and vanishes with its
    speed."""
    waves = e.data[WAVES]
    rest, error = _resting(waves, "width_Phi")
    moving = waves.width_Phi.sel(Pe=MOVING, method="nearest").values
    share, error = (float(np.min(x / moving)) for x in (rest, error))
    return Computed(
        not holds(share - 0.5, error),
        error,
        share,
        f"least length at rest over that at Pe = {MOVING:g}",
        "bending of the wall, not motion, sets the length",
        {"value": True},
    )


@states("beyond-sharpness-law", "section 3.6, figure 9b", f"{PULSES}: A")
def sharpness_law(e: Evidence) -> Computed:
    """n of A ~ (1-ell)^-n, fitted to the two-dimensional tubes at the time of figure 9."""
    pulses = e.data[PULSES].sel(T=FIGURE_9, method="nearest")
    law = power_law(pulses.ell.values, pulses.A.values, pulses.A_uncertainty.values)
    expected = {"value": 1.0, "resolution": 0.05}
    return Computed(law.exponent, law.exponent_uncertainty, paper=expected)


@states("beyond-sharpness-thin", "section 3.6, figure 9b", f"{WAVES}: A")
def sharpness_of_thin_walls(e: Evidence) -> Computed:
    """n of A ~ (1-ell)^-n between the two thinnest walls, front at rest."""
    waves = e.data[WAVES]
    n, error = _exponent(waves.ell.values, *_resting(waves, "A"))
    return Computed(n, error, paper={"value": 1.0, "resolution": 0.05})


@states("beyond-shape-bends", DOCS, f"{WAVES}: width_radius")
def shape_of_thin_walls(e: Evidence) -> Computed:
    """n of the length over which the radius changes, ~ (1-ell)^n, between the two thinnest walls at
    rest: that of a shell that bends, 1/2, which no closure of the slender tube has."""
    waves = e.data[WAVES]
    n, error = _exponent(waves.ell.values, *_resting(waves, "width_radius"))
    return Computed(-n, error, paper={"value": 0.5, "resolution": 0.06})


@states("beyond-sheds-ahead", "section 3.6.1, figures 10 and 11", f"{PULSES}: shed_ahead")
def wall_sheds_ahead(e: Evidence) -> Computed:
    """The tube draws water inwards ahead of the front."""
    pulses = e.data[PULSES]
    least = pulses.shed_ahead.values.ravel().argmin()
    share = float(pulses.shed_ahead.values.ravel()[least])
    error = float(pulses.shed_ahead_uncertainty.values.ravel()[least])
    return Computed(
        not holds(share, error),
        error,
        share,
        "least share of the water shed that leaves ahead of the front, of all tubes and times",
        "the wall sheds water on both sides",
        {"value": True},
    )


@states("beyond-lumen-share", DOCS, f"{WAVES}: share")
def share_of_lumen(e: Evidence) -> Computed:
    """Share of the water shed that enters the lumen, slowest moving wave, at each ell; expected:
    the closed formula of the slender tube."""
    waves = e.data[WAVES]
    slow = waves.isel(Pe=int(np.flatnonzero(waves.Pe.values > 0)[0]))
    expected = {"value": lumen_share(waves.ell.values), "resolution": 0.005}
    return Computed(slow.share.values, slow.share_uncertainty.values, paper=expected)


def _late_error(e, quantity, closure):
    slender = e.data[SLENDER].sel(closure=closure)
    late = slender[f"{quantity}_error"].values[:, slender["T"].values >= FIGURE_9]
    error = slender[f"{quantity}_error_uncertainty"].values[:, slender["T"].values >= FIGURE_9]
    worst = np.abs(late).argmax()
    return float(late.ravel()[worst]), float(error.ravel()[worst])


def _late_statements():
    texts = {
        "V_far": "velocity far ahead in the lumen",
        "pumped": "volume pumped",
        "width": "length of the front",
    }
    for closure in ("printed", "conservative", "balanced"):
        for quantity, text in texts.items():
            said = (
                f"largest relative error of the {text}, slender tube ({closure}) against two "
                f"dimensions, T = tau/eps^2 >= {FIGURE_9:g}"
            )

            @states(
                f"beyond-slender-{quantity.lower().replace('_', '-')}-{closure}",
                DOCS,
                f"{SLENDER}: {quantity}_error",
                text=said,
            )
            def late_error(e, quantity=quantity, closure=closure):
                return Computed(*_late_error(e, quantity, closure))


_late_statements()


@states("beyond-slender-tau99", DOCS, f"{SLENDER}: tau99_error")
def collapse_time(e: Evidence) -> Computed:
    """Relative error of tau_99 of a tube heated everywhere (printed, conservative, balanced), mean
    over ell."""
    slender = e.data[SLENDER]
    error = slender.tau99_error_uncertainty.mean("wall_ell").values
    return Computed(slender.tau99_error.mean("wall_ell").values, error)


@states("beyond-truth-wall", DOCS, f"{SLENDER}: tau99_resolved_error")
def wall_of_truth(e: Evidence) -> Computed:
    """tau_99 of walls heated everywhere (middle and mean, each ell), LENS resolved in the radius
    with force balance at the surface, over that of these elements."""
    error = e.data[SLENDER].tau99_resolved_error.sel(surface="balanced").values.ravel()
    doubt = e.data[SLENDER].tau99_resolved_error_uncertainty.sel(surface="balanced")
    expected = {"value": np.ones(error.size), "resolution": 0.02}
    return Computed(1 + error, doubt.values.ravel(), paper=expected)


@states("beyond-energy", DOCS, f"{WAVES}: jump_energy_M")
def other_energy(e: Evidence) -> Computed:
    """Change of Phi's jump, over the jump, if the energy's second invariant stands for the first,
    at each M: what LENS leaves open at finite deviatoric strain."""
    waves = e.data[WAVES]
    error = 2 * waves.jump_uncertainty_M.values / waves.jump_M.values
    return Computed(waves.jump_energy_M.values / waves.jump_M.values, error)


@states("beyond-truth-order", DOCS, f"{VERIFICATION}: order")
def order_of_elements(e: Evidence) -> Computed:
    """Radius at the front and share of the lumen converge at second order."""
    order = float(e.data[VERIFICATION].order.values[:2].min())
    return Computed(holds(order - ORDER, 0.0), 0.0, order, "lower of the two orders measured")


@states("beyond-truth-water", DOCS, f"{PULSES}: water_balance_error")
def water_of_truth(e: Evidence) -> Computed:
    """The two-dimensional tube keeps its water at all times."""
    verification = e.data[VERIFICATION]
    worst = max(
        float(e.data[PULSES].water_balance_error),
        float(verification.wall_balance_error),
        float(verification.wave_balance_error.max()),
    )
    text = "largest share of the water unaccounted for"
    return Computed(holds(BALANCE - worst, 0.0), 0.0, worst, text)


@states("beyond-truth-bead", DOCS, f"{VERIFICATION}: bead_radius, bead_radius_nonlinear")
def bead_of_truth(e: Evidence) -> Computed:
    """Radius of a swelling bead by these elements; expected: the nonlinear bead's own solver."""
    verification = e.data[VERIFICATION]
    radius = verification.bead_radius.values
    error = np.abs(np.diff(radius, axis=1)[:, -1]) if radius.shape[1] > 1 else 1e-3 * radius[:, -1]
    expected = {"value": verification.bead_radius_nonlinear.values, "resolution": 0.0}
    return Computed(radius[:, -1], error, paper=expected)
