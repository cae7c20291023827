"""Deswelling, heat and the drying front of tubes (sections 3.3 to 3.6)."""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gelpump.statements.derivations import (
    edge_coefficient,
    heat_front,
    radial_term,
    refined,
)
from gelpump.statements.statement import IDENTITY, LINE, Collection, Computed, Evidence, holds
from gelpump.uncertainty import rounding_error

if TYPE_CHECKING:
    import xarray as xr

statements = Collection()
states = statements.states
DRAWN_ELL = [0.1, 0.25, 0.5, 0.75, 0.9]  # the tubes of figure 9
FOR_ELL = "for ell = " + ", ".join(f"{ell:g}" for ell in DRAWN_ELL)
MAP = "deswelling_map: tau99"


def slope(x: ArrayLike, y: ArrayLike, relative_error: ArrayLike = 0.0) -> tuple[float, float]:
    """d ln y / d ln x by least squares, and the most that errors of y, of any sign, make of it.

    The rounding of y and of logarithms adds to relative_error, a number or one for each y.
    """
    ln_x, ln_y = np.log(np.asarray(x)), np.log(np.asarray(y))
    leverage = (ln_x - ln_x.mean()) / ((ln_x - ln_x.mean()) ** 2).sum()
    rounding = np.spacing(np.abs(ln_x)) + np.spacing(np.abs(ln_y)) + np.finfo(float).eps
    return float(leverage @ ln_y), float(np.abs(leverage) @ (np.asarray(relative_error) + rounding))


def relative(dataset: "xr.Dataset", *names: str) -> float:
    """Largest relative uncertainty of a variable, of a product or of a quotient of several."""

    def of(name):
        values = dataset[name].isel(level=0) if "level" in dataset[name].dims else dataset[name]
        return float((dataset[f"{name}_uncertainty"] / abs(values)).max())

    return sum(map(of, names))


def of_figure(dataset: "xr.Dataset", **at: float) -> "xr.Dataset":
    """The tubes of figure 9, at a time if one is given."""
    dataset = dataset.sel(ell=DRAWN_ELL, method="nearest")
    return dataset.sel(**at, method="nearest") if at else dataset


@states("tpore-scaling", "section 3", f"{MAP}_compared", IDENTITY)
def poroelastic_time(e: Evidence) -> Computed:
    """The response time scales as this power of the length: the equations have no other one."""
    table = e.data["deswelling_map"]
    return Computed(
        *slope(1.0 - table.ell, table.tau99_compared, relative(table, "tau99_compared"))
    )


@states("radial-adjustment-thin", "section 3.6", "wall_times: tau99 (conservative, midline)")
def thin_walls(e: Evidence) -> Computed:
    """The deswelling time of a wall that is resolved in r scales as this power of 1 - ell."""
    walls = e.data["wall_times"].sel(surface="conservative", place="midline")
    walls = walls.isel(tube=np.flatnonzero(walls.varied == "ell"))
    share = walls.tau99_uncertainty / walls.tau99
    over = (walls.tau99 / walls.tau99_printed).values
    measured = (
        f"times those of eqn:tube_model, for ell = {', '.join(f'{x:g}' for x in walls.ell.values)}:"
    )
    return Computed(*slope(1.0 - walls.ell, walls.tau99, share), over, measured)


def falls(e: Evidence, name: str, axis: int) -> Computed:
    """Whether a time of the map falls from each parameter to the next."""
    table, measured = e.data["deswelling_map"], "smallest relative fall of tau_99 of neighbours:"
    values = np.log(table[name].transpose("M", ...).values)
    margin, doubt = float(np.min(-np.diff(values, axis=axis))), 2.0 * relative(table, name)
    return Computed(holds(margin, doubt), doubt, margin, measured)


for _id, _where, _what, _name, _axis in (
    ("contrast", "", "gel with a larger Phi_inf deswells faster, for every M", "tau99_contrast", 1),
    ("M", ", figure 7a", "stiffer gel (larger M) deswells faster, for every Pi~", "tau99", 0),
    ("Pi", ", figure 7a", "gel with a larger Pi~ deswells faster, for every M", "tau99", 1),
):
    _at, _text = (f"section 3.4{_where}", f"deswelling_map: {_name}"), f"a {_what} of the map"
    states(f"faster-with-{_id}", *_at, text=_text)(partial(falls, name=_name, axis=_axis))


@states("deswelling-curves", "figure 7b", "deswelling_curves: Phi1")
def deswelling_curves(e: Evidence) -> Computed:
    """Phi_1 at tau = 1e-4 for ell = 0.01, 0.1, 0.25, 0.5."""
    curves = e.data["deswelling_curves"]
    drawn = curves.sel(ell=[0.01, 0.1, 0.25, 0.5]).sel(tau=1e-4, method="nearest")
    return Computed(drawn.Phi1.values, drawn.Phi1_uncertainty.values)


HEAT = "gelpump.statements.derivations.heat_front: eqn:temp_field, data/tube_pulse.nc: Z_C"


@states("front-position", "section 3.5", HEAT)
def front_position(e: Evidence) -> Computed:
    """Z_C / sqrt(Le tau) of the deswelling front."""
    pulse = e.data["tube_pulse"]
    used = float((pulse.Z_C / np.sqrt(pulse.Le * pulse.tau))[0])
    value, doubt = refined(heat_front, 160)
    return Computed(value, doubt, used, "that of the tubes:")


def front_constant(pulse: "xr.Dataset") -> tuple[float, float]:
    """Z_C / sqrt(Le tau), and its uncertainty: how far solved fronts are from where the stated
    temperature is that of the transition, and rounding."""

    def scaled(Z_C, Le, tau):
        return Z_C / np.sqrt(Le * tau)

    first = float(pulse.Z_C[0]), float(pulse.Le), float(pulse.tau[0])
    missed = float((pulse.front_error / pulse.Z_C).max()) * scaled(*first)
    return float(scaled(*first)), missed + float(rounding_error(scaled, *first))


def of_prefactor(fit: "xr.Dataset") -> float:
    """Relative uncertainty of c in A = c (1-ell)^-n: ln c is the mean of ln A + n ln(1-ell)."""
    in_law = fit.isel(ell=np.flatnonzero(fit.in_power_law.values))
    lever = abs(float(np.log(1.0 - in_law.ell).mean()))
    return relative(in_law, "A") + lever * float(fit.exponent_uncertainty)


@states("front-fig8", "figure 8", "tube_pulse: Z_C")
def drawn_front(e: Evidence) -> Computed:
    """Position of the front at tau = 0.025 and 0.05."""
    pulse = e.data["tube_pulse"]
    Z_C, (constant, doubt) = (
        pulse.Z_C.sel(tau=[0.025, 0.05], method="nearest").values,
        front_constant(pulse),
    )
    share = float((e.read("front-fig8") / Z_C).mean())
    follows = f"drawn at {share:.2f} of Z_C, as if a domain of length 1.5 were labelled 0 to 1"
    return Computed(Z_C, doubt / constant * Z_C, follows=follows)


@states("lewis-number", "section 3.5", "config: scales", IDENTITY)
def lewis_number(e: Evidence) -> Computed:
    """Thermal over compositional diffusivity, from their typical values in the same sentence."""
    known = e.scales["thermal_diffusivity"], e.scales["compositional_diffusivity"]
    return Computed(np.divide(*known), float(rounding_error(np.divide, *known)))


@states("tanh-form", "eqn:tanh_fit", "front_fit: Phi1_front, fit_rms")
def tanh_form(e: Evidence) -> Computed:
    """Phi_1 around the front is a tanh, and so halfway between 1 and Phi_inf at Z_C."""
    fit, middle = e.data["front_fit"], float(1.0 + e.data["tube_pulse"].Phi_inf[0]) / 2.0
    solved = of_figure(fit).Phi1_front.values
    doubt = float(e.data["refinement/tube_pulse"].Phi1_front_uncertainty.max())
    return Computed(
        solved,
        np.full(solved.shape, doubt),
        float(fit.fit_rms.max()),
        "largest misfit of the best tanh in the root mean square:",
        f"Phi_1 at Z_C is {solved.min():.3f} to {solved.max():.3f}: the front is not symmetric",
        {"value": middle, "resolution": 0.0},
    )


@states("front-phi", "figure 9a", "front_fit: Phi1_front")
def polymer_fraction_at_the_front(e: Evidence) -> Computed:
    """Phi_1 at Z_C for ell = 0.25, 0.5."""
    doubt = e.data["refinement/tube_pulse"].Phi1_front_uncertainty.max("tau")
    here = {"ell": [0.25, 0.5], "method": "nearest"}
    return Computed(e.data["front_fit"].Phi1_front.sel(**here).values, doubt.sel(**here).values)


@states("A-values", "figure 9b", "front_fit: A", text=f"A(ell) {FOR_ELL}")
def sharpness(e: Evidence) -> Computed:
    """A(ell) at the time of figure 9."""
    fit, solved = e.data["front_fit"], of_figure(e.data["front_fit"])
    scaled = (fit.A * (1.0 - fit.ell)).values
    follows = (
        f"converged, A is {float(solved.A[-1]):.1f} at ell = {DRAWN_ELL[-1]:g}, and A (1-ell) is "
        f"constant to {float(np.ptp(scaled) / scaled.mean()):.1%}"
    )
    return Computed(solved.A.values, solved.A_uncertainty.values, follows=follows)


@states("A-exponent", "section 3.6, figure 9b", "front_fit: exponent")
def sharpness_law(e: Evidence) -> Computed:
    """Power of 1 - ell that A(ell) follows; the figure has that of the points which it draws."""
    fit, drawn = e.data["front_fit"], e.published["A-values"]
    share = np.divide(drawn["resolution"], drawn["value"])
    power, read = slope(1.0 - np.array(DRAWN_ELL), drawn["value"], share)
    follows = (
        "the law holds better than the figure shows: Phi_1 depends on Z/w and tau/w^2 only, "
        "w = eps (1-ell)/4, so that it is exact for w small against Z_C"
    )
    paper = {"drawn": power, "drawn_resolution": read}
    return Computed(
        -float(fit.exponent), float(fit.exponent_uncertainty), follows=follows, paper=paper
    )


@states("travelling-wave", "section 3.6", "front_fit: profile_change")
def travelling_wave(e: Evidence) -> Computed:
    """The profile around Z_C keeps its shape while tau grows (ell = 0.25, from the time of figure
    9)."""
    fit = e.data["front_fit"].sel(ell=0.25, method="nearest")
    doubt = e.data["refinement/tube_pulse"].Phi1_difference.sel(ell=0.25, method="nearest").max()
    change = fit.profile_change.where(fit.tau >= fit.fit_tau, drop=True).max()
    return Computed(
        None, float(doubt), float(change), "largest change of Phi_1 at the same Z - Z_C:"
    )


@states("phi1-near-equilibrium", "section 3.3, appendix B", "front_fit: departure_front")
def closeness_to_equilibrium(e: Evidence) -> Computed:
    """Phi_1 is everywhere close to Phi_0, to order eps^2, as the scaling needs."""
    fit, pulse = e.data["front_fit"], e.data["tube_pulse"]
    departure = of_figure(fit, tau=float(fit.fit_tau)).departure_front.values
    doubt = float(e.data["refinement/tube_pulse"].Phi1_front_uncertainty.max())
    return Computed(
        not holds(float(departure.max()) - float(pulse.eps[0]) ** 2, doubt),
        np.full(departure.shape, doubt),
        departure,
        f"largest |Phi_0 - Phi_1| {FOR_ELL}:",
        f"at the front it is {departure.min():.2f} to {departure.max():.2f} away",
    )


@states(
    "radial-structure",
    "eqn:phi2, eqn:tube_model",
    "gelpump.statements.derivations.edge_coefficient",
    LINE,
)
def radial_structure(e: Evidence) -> Computed:
    """F holds 16, from a Phi_2 that is said to be of the form R^2, ln R, 1 and to meet the
    conditions on midline and edges."""
    kappa, doubt = np.transpose([edge_coefficient(ell) for ell in DRAWN_ELL])
    follows = (
        f"the conditions give {kappa[0]:.2f} to {kappa[-1]:.4f} {FOR_ELL}, tending to 8 for thin "
        "walls; the printed square has 8 too in the mean over the wall.  Times are twice as long"
    )
    return Computed(kappa, doubt, follows=follows, paper={"value": 16.0, "resolution": 0.0})


@states(
    "scaled-equation", "eqn:evolution_scaled", "gelpump.statements.derivations.radial_term", LINE
)
def scaled_equation(e: Evidence) -> Computed:
    """The radial term is (1/R) [R D dphi_2/dR], which for D phi_2 = R^2/4 ought to be the f = 1 of
    the line beneath; here on the edges and the midline."""
    R, D = np.array([0.25, 0.625, 1.0]), float(e.gels["tube"].diffusivity(1.0, 1.0))

    def phi_2(R):
        return R**2 / (4.0 * D)

    value, doubt = refined(lambda n: radial_term(D, phi_2, R, n), 8)
    printed = R * D * (phi_2(R + 0.125) - phi_2(R - 0.125)) / 0.25 / R  # exact for a square
    return Computed(
        value,
        doubt + 1e-12,
        follows="a d/dR is missing in front of the bracket",
        paper={"value": printed, "resolution": 0.0},
    )
