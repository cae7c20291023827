"""The numbers that each figure shows beside those that the paper states, with their uncertainty.

Of solutions it comes from their refinement in space and time; of closed formulae, roots and
quadratures from these themselves.  What is derived from such numbers inherits it to first order.
A number is told as quantity, value, uncertainty, what that was taken from, "dataset: variables"
and, unless it is scaled, its unit; value and uncertainty may be several.

Longer than 300 lines: a list of the figures' numbers, one short function a figure.
"""

from collections.abc import Iterator, Mapping, Sequence
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from gelpump.statements.beads import MODELS, bead, spread
from gelpump.statements.materials import fold_uncertainty, root_uncertainty
from gelpump.statements.statement import where_from
from gelpump.statements.tubes import front_constant, of_prefactor
from gelpump.statements.views import number
from gelpump.tables import page
from gelpump.tube import lumen
from gelpump.tube.wall_flow import Wall
from gelpump.uncertainty import rounding_error

REFINED, ROUNDED, INTEGRATED = "refinement", "rounding", "quadrature"
FOLLOWED = "the mesh that follows the front"
FLAT = 1e-3  # relative step over which the curvature at an extremum is taken
LENGTH, TIME = "R_dry", "t_BMJ"
Told = Iterator[tuple]


class Shown(NamedTuple):
    """What the numbers of a figure are taken from."""

    data: Mapping[str, Any]
    gels: Mapping[str, Any]
    config: Any


def key_numbers(data: Mapping, gels: Mapping, config: Any) -> Iterator[dict[str, Any]]:
    """The rows of ``figure_numbers.json``; ValueError if a number is not finite.

    data: all datasets of the paper's figures; gels: energy-based ones, by name; config: has the
    blocks ``figures``, ``beads``, ``tube_flow`` and ``lumen_pulse`` of the configuration.
    """
    for figure, told in FIGURES.items():
        for each in told(Shown(data, gels, config), **config.figures.get(figure, {})):
            yield row(figure, *each)


def row(
    figure: str, quantity: str, value: Any, uncertainty: Any, source: str, evidence: str, unit=""
) -> dict[str, Any]:
    """A row of ``figure_numbers.json``; ValueError if a number in it is not finite."""
    value, uncertainty = (np.asarray(each, float).tolist() for each in (value, uncertainty))
    if not (np.all(np.isfinite(value)) and np.all(np.isfinite(uncertainty))):
        raise ValueError(f"{figure}, {quantity}: {value} ± {uncertainty}")
    return {
        "figure": figure,
        "quantity": quantity,
        "value": value,
        "uncertainty": uncertainty,
        "printed": number(value, uncertainty),
        "unit": unit,
        "source": source,
        "evidence": where_from(evidence),
    }


def markdown(rows: Sequence[Mapping[str, Any]]) -> str:
    """A row a number, the figures in order."""
    keys = {"value": "printed", "uncertainty from": "source"}
    columns = "figure", "quantity", "value", "unit", "uncertainty from", "evidence"
    intro = f"{len(rows)} numbers, each to the digits that its numerical uncertainty leaves."
    getters = {name: itemgetter(keys.get(name, name)) for name in columns}
    return page("Key numbers of the figures", intro, getters, rows)


def _listed(values) -> str:
    return ", ".join(f"{value:g}" for value in values)


def _own(dataset, name: str) -> tuple:
    """Of a variable that has its uncertainty beside it: both."""
    return dataset[name], dataset[f"{name}_uncertainty"]


SURFACE, PRESSURE = "surface_polymer_fraction", "osmotic_pressure"
FEWEST = 4  # times from which numbers of a course are told


def _deformed_bead(e, case: str, time: float) -> Told:
    whole, block = f"bead_{case}_lens", e.config.beads[case]
    run, of_phi, of_radius = e.data[whole], f"{whole}: polymer_fraction", f"{whole}: radius"
    phi_00, a_00 = float(run.polymer_fraction[0, 0]), float(run.radius[0])
    of_root = root_uncertainty(e.gels[block["gel"]], phi_00, block["temperature_initial"])
    yield "phi_00 of the reference state", phi_00, of_root, ROUNDED, of_phi
    if run.attrs.get("stopped_t", np.inf) <= time:
        return
    run, refined = (each.sel(t=time, method="nearest") for each in bead(e.data, case, "lens"))
    a, phi = float(run.radius), float(run.surface_polymer_fraction)
    doubt, doubt_phi = (float(refined[f"{name}_uncertainty"]) for name in ("radius", SURFACE))
    doubts = [a_00 / 3.0 * of_root / phi_00, doubt]
    here = f"radius in the reference state and at t_BMJ = {time:g}"
    yield here, [a_00, a], doubts, REFINED, of_radius, LENGTH
    stretch, here = np.cbrt(phi / phi_00), f"at the surface, t_BMJ = {time:g}"
    doubt = stretch / 3.0 * doubt_phi / phi + a_00 / a**2 * doubt
    strain, evidence = stretch - a_00 / a, f"{of_radius}, {SURFACE}"
    yield f"deviatoric strain along the circle {here}", strain, doubt, REFINED, evidence


def _bead(e, case: str) -> Told:
    runs = {  # none where a run stopped at once
        model: bead(e.data, case, model)
        for model in MODELS
        if e.data[f"refinement/bead_{case}_{model}"].t.size >= FEWEST
    }
    for model, (run, refined) in runs.items():
        name, whole, t = MODELS[model], f"bead_{case}_{model}", run.t.values
        ends, told = run.radius.values[[0, -1]], (REFINED, f"{whole}: radius")
        doubts = refined.radius_uncertainty.values[[0, -1]] + np.spacing(ends)  # a_00 is given
        yield f"{name} radius at t_BMJ = {_listed(t[[0, -1]])}", ends, doubts, *told, LENGTH
        halves, between = np.transpose([half_time(t, each) for each in refined.radius.values])
        doubt = spread(halves) + between[0]
        yield f"time of half the change of the {name} radius", halves[0], doubt, *told, TIME
        here, doubt = f"at the surface, t_BMJ = {t[-1]:g}", refined[f"{SURFACE}_uncertainty"][-1]
        value, evidence = run[SURFACE][-1], f"{whole}: {SURFACE}"
        yield f"{name} polymer fraction {here}", value, doubt, REFINED, evidence
    if len(runs) == len(MODELS):
        t = min((run.t.values for run, _ in runs.values()), key=len)
        apart = np.subtract(*(run.radius.sel(t=t).values for run, _ in runs.values()))
        most, evidence = int(np.argmax(np.abs(apart))), f"bead_{case}_{{nonlinear,lens}}: radius"
        doubt = sum(float(each.radius_uncertainty.sel(t=t)[most]) for _, each in runs.values())
        size = abs(apart[most])
        yield "largest distance of the two radii", size, doubt, REFINED, evidence, LENGTH


def half_time(t: np.ndarray, radius: np.ndarray) -> tuple[float, float]:
    """When a bead has first made half of the change of its radius, and the error of interpolation.

    A cubic through the four outputs around it; the error is the change from a parabola.
    """
    done = (radius - radius[0]) / (radius[-1] - radius[0])
    after = int(np.clip(np.argmax(done >= 0.5), 2, t.size - 2))
    nearby = slice(after - 2, after + 2)
    x, y = done[nearby] - 0.5, t[nearby]
    cubic, parabola = np.polyfit(x, y, 3)[-1], np.polyfit(x[:3], y[:3], 2)[-1]
    return float(cubic), float(abs(cubic - parabola))


def _heated_gel(e, gel: str, temperatures: Sequence[float]) -> Told:
    material, (cold, hot), known = e.gels[gel], temperatures, {}
    for T in temperatures:
        phi, stable = material.equilibrium_polymer_fractions(T)
        known[T] = phi[stable], [root_uncertainty(material, x, T) for x in phi[stable]]
        evidence = f"materials_{gel}: equilibrium_polymer_fraction"
        yield f"stable equilibrium phi_0 of {gel} at {T:g} K", *known[T], ROUNDED, evidence
    phi, doubt = (each[0] for each in known[cold])
    slope = abs(float(material.osmotic_modulus(phi, hot)) / phi)
    doubt = float(rounding_error(material.osmotic_pressure, phi, hot)) + slope * doubt
    here = f"Pi at {hot:g} K of the gel that was in equilibrium at {cold:g} K"
    value, evidence = float(material.osmotic_pressure(phi, hot)), f"materials_{gel}: {PRESSURE}"
    yield here, value, doubt, ROUNDED, evidence, "k_B T/Omega_f"


def _spinodal(e, gel: str, cases: Sequence[str]) -> Told:
    table, T_sp = e.data[f"materials_{gel}"], e.gels[gel].spinodal_temperature
    tip, least = f"materials_{gel}: spinodal_tip", "smallest_diffusivity"
    if "spinodal_tip_temperature" in table:
        phi, at = float(table.spinodal_tip_polymer_fraction), f"of the tip of the spinodal of {gel}"
        T, doubt = table.spinodal_tip_temperature, rounding_error(T_sp, phi)
        yield f"temperature {at}", T, doubt, ROUNDED, f"{tip}_temperature", "K"
        located = _located(T_sp, phi)
        yield f"polymer fraction {at}", phi, located, ROUNDED, f"{tip}_polymer_fraction"
    for case in cases:
        run, name = e.data[f"bead_{case}_lens"], f"refinement/bead_{case}_lens"
        refined = e.data[name]
        if "stop_time" in refined:
            stop, doubt = _own(refined, "stop_time")
            here, evidence = f"time at which phases begin to separate, {case}", f"{name}: stop_time"
            yield here, stop[0], doubt, REFINED, evidence, TIME
        elif refined.t.size:
            D, doubt = run.sel(t=refined.t)[least], refined[f"{least}_uncertainty"]
            at, evidence = int(np.argmin(D.values)), f"bead_{case}_lens: {least}"
            here = f"smallest diffusivity, {case}"
            yield here, D[at], doubt[at], REFINED, evidence, "k mu_s/mu_l"


def _located(curve, phi: float) -> float:
    """How far an extremum may be from phi, where the curve is flat to rounding: the curve's error
    and its curvature tell."""
    step = FLAT * phi * (1.0 - phi)
    before, there, after = curve(np.array([phi - step, phi, phi + step]))
    curvature = abs(before - 2.0 * there + after) / step**2
    return float(np.sqrt(2.0 * rounding_error(curve, phi) / curvature))


def _equilibria(e, gels: Sequence[str]) -> Told:
    for name in gels:
        table, variable = e.data[f"materials_{name}"], "equilibrium_polymer_fraction"
        stable = table.equilibrium_stable.values == 1
        T, phi = table.equilibrium_temperature.values[stable], table[variable].values[stable]
        for drawn in (T.min(), T.max()):
            here = phi[drawn == T]
            doubts = [root_uncertainty(e.gels[name], each, drawn) for each in here]
            quantity = f"phi where Pi of {name} vanishes at {drawn:g} K"
            yield quantity, here, doubts, ROUNDED, f"materials_{name}: {variable}"


def _transitions(e, gels: Sequence[str]) -> Told:
    for name in gels:
        table, gel, whole = e.data[f"materials_{name}"], e.gels[name], f"materials_{name}"
        T, phi = table.fold_temperature, table.fold_polymer_fraction
        folds, of_T = f"of the folds of {name}", [fold_uncertainty(gel, x) for x in phi.values]
        of_phi = [_located(gel.equilibrium_temperature, x) for x in phi.values]
        yield f"temperatures {folds}", T, of_T, ROUNDED, f"{whole}: {T.name}", "K"
        yield f"polymer fractions {folds}", phi, of_phi, ROUNDED, f"{whole}: {phi.name}"
        known, T = (gel.A0 - gel.A1, gel.B0 - gel.B1), table.singular_temperature
        doubt = rounding_error(lambda A, B: (0.5 - A) / B, *known)
        here = f"temperature at which the asymptote of {name} diverges"
        yield here, T, doubt, ROUNDED, f"{whole}: {T.name}", "K"


def _relative(refinement, name: str, ell) -> np.ndarray:
    """Relative uncertainty of a refined quantity: the largest of the refined times, between the
    refined tubes by ln(1-ell)."""
    share = refinement[f"{name}_uncertainty"] / abs(refinement[name].isel(level=0))
    thickness = np.log(1.0 - refinement.ell.values)
    order = np.argsort(thickness)
    there = np.log(1.0 - np.asarray(ell))
    return np.interp(there, thickness[order], share.max("tau").values[order])


def _front(pulse, tau: Sequence[float]) -> tuple:
    constant, doubt = front_constant(pulse)
    Z_C = pulse.Z_C.sel(tau=tau, method="nearest").values
    evidence = "tube_pulse: Z_C, front_error"
    return f"Z_C at tau = {_listed(tau)}", Z_C, doubt / constant * Z_C, FOLLOWED, evidence


def _collapsed_tube(e, ell: float, tau: float) -> Told:
    pulse, evidence = e.data["tube_pulse"], "tube_pulse: Phi1_front"
    yield _front(pulse, [tau])
    Phi1 = float(pulse.Phi1_front.sel(ell=ell, tau=tau, method="nearest"))
    radii = np.array([ell, 1.0]) * Phi1 ** (-1 / 3)
    doubt = _relative(e.data["refinement/tube_pulse"], "Phi1_front", ell) / 3.0 * radii
    yield f"B_0 and B_1 at the front, ell = {ell:g}", radii, doubt, REFINED, evidence, "a_1"


def _deswelling(e) -> Told:
    table, curves = e.data["deswelling_map"], e.data["deswelling_curves"]
    for word, corner in (("longest", 0), ("shortest", -1)):
        at = table.isel(M=corner, Pi_ratio=corner)
        here = f"tau_99 at M = {float(at.M):g}, Pi~ = {float(at.Pi_ratio):g}, the {word}"
        yield here, *_own(at, "tau99"), INTEGRATED, "deswelling_map: tau99"
    here = f"tau_99 for ell = {_listed(curves.ell.values)}"
    yield here, *_own(curves, "tau99"), INTEGRATED, "deswelling_curves: tau99"


def _profiles(e, ell: float, tau: Sequence[float]) -> Told:
    yield _front(e.data["tube_pulse"], tau)
    at = {"tau": tau, "method": "nearest"}
    Phi1 = e.data["tube_pulse"].Phi1_front.sel(ell=ell, method="nearest").sel(**at).values
    doubt = _relative(e.data["refinement/tube_pulse"], "Phi1_front", ell) * Phi1
    here = f"Phi_1 at Z_C for ell = {ell:g}, tau = {_listed(tau)}"
    yield here, Phi1, doubt, REFINED, "tube_pulse: Phi1_front"


def _law(e, **_) -> Told:
    fit = e.data["front_fit"]
    c = float(fit.prefactor)
    doubt = c * of_prefactor(fit)
    yield "c of A = c (1-ell)^(-n)", c, doubt, REFINED, "front_fit: prefactor", "1/L"


def _flows(e, views: Sequence[str], **_) -> Told:
    for view in views:
        ell, tau = (e.config.tube_flow[view][key] for key in ("ell", "tau"))
        here = e.data["tube_pulse"].sel(ell=ell, tau=tau, method="nearest")
        wall, V = Wall.of(here), lumen.velocity_printed(Wall.of(here))
        for quantity, name, value, unit in (
            ("axial velocity in the wall", "axial_velocity", wall.largest_axial_velocity, "L"),
            ("radial velocity in the wall", "radial_velocity", wall.largest_radial_velocity, "a_1"),
            ("axial velocity in the lumen", "V_front_printed", V[int(here.hot.sum())], "L"),
        ):  # fmt: skip
            doubt = _relative(e.data["refinement/tube_pulse"], name, ell) * value
            at = f"largest {quantity}, ell = {ell:g}, tau = {tau:g}"
            yield at, value, doubt, REFINED, "tube_pulse: F, flux, Phi1", f"{unit}/T"


def _pulses(e) -> Told:
    yield _front(e.data["tube_pulse"], e.config.lumen_pulse["tau"])


FIGURES = {
    "fig01_lens_schematic": _deformed_bead,
    "fig02_osmotic_schema": _heated_gel,
    "fig03_swell_bead": _bead,
    "fig04_dry_bead": _bead,
    "fig05_spinodal": _spinodal,
    "fig06_tube_schematic": _collapsed_tube,
    "fig07_deswelling": _deswelling,
    "fig08_profiles": _profiles,
    "fig09_relax": _law,
    "fig10_flow": _flows,
    "fig11_flow_close": _flows,
    "fig12_axial_flow": _pulses,
    "fig13_osmotic": _equilibria,
    "fig14_equilibrium": _transitions,
}
