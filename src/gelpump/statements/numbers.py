"""The numbers that each figure shows, with their numerical uncertainty.

Of solutions it comes from their refinement in space and time; of closed formulae, roots and
quadratures from these themselves.  What is derived from such numbers inherits it to first order.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

import numpy as np

from gelpump.statements.beads import MODELS, bead, spread
from gelpump.statements.materials import fold_uncertainty, root_uncertainty
from gelpump.statements.tubes import front_constant
from gelpump.statements.views import number
from gelpump.tables import page
from gelpump.tube import lumen
from gelpump.tube.wall_flow import Wall
from gelpump.uncertainty import rounding_error

REFINED, ROUNDED, INTEGRATED = "refinement", "rounding", "quadrature"
FOLLOWED = "the mesh that follows the front"
FLAT = 1e-3  # relative step over which the curvature at an extremum is taken
LENGTH, TIME = "R_dry", "t_BMJ"


@dataclass(frozen=True)
class KeyNumber:
    """A number, or a list of them, that a figure shows.

    figure: its rule.  quantity: what it is, in plain words.  uncertainty: numerical, of the shape
    of the value.  unit: empty for scaled quantities.  source: what the uncertainty was taken from.
    evidence: the file and variable it was read from.
    """

    figure: str
    quantity: str
    value: float | Sequence[float]
    uncertainty: float | Sequence[float]
    source: str
    evidence: str
    unit: str = ""

    def record(self) -> dict[str, Any]:
        """The row of ``figure_numbers.json``; ValueError if a number in it is not finite."""
        value = np.asarray(self.value, dtype=float).tolist()
        uncertainty = np.asarray(self.uncertainty, dtype=float).tolist()
        if not (np.all(np.isfinite(value)) and np.all(np.isfinite(uncertainty))):
            raise ValueError(f"{self.figure}, {self.quantity}: {value} ± {uncertainty}")
        return {
            "figure": self.figure,
            "quantity": self.quantity,
            "value": value,
            "uncertainty": uncertainty,
            "printed": number(value, uncertainty),
            "unit": self.unit,
            "source": self.source,
            "evidence": self.evidence,
        }


def key_numbers(data: Mapping, gels: Mapping, config) -> Iterator[KeyNumber]:
    """data: all datasets of the paper's figures; gels: energy-based ones, by name; config: has the
    blocks ``figures``, ``beads``, ``tube_flow`` and ``lumen_pulse`` of the configuration."""
    figures, cases = config.figures, config.beads
    yield from _deformed_bead(data, gels, cases, **figures["fig01_lens_schematic"])
    yield from _heated_gel(gels, **figures["fig02_osmotic_schema"])
    for figure in ("fig03_swell_bead", "fig04_dry_bead"):
        yield from _bead(data, figure, **figures[figure])
    yield from _spinodal(data, gels, **figures["fig05_spinodal"])
    yield from _collapsed_tube(data, **figures["fig06_tube_schematic"])
    yield from _deswelling(data)
    yield from _profiles(data, **figures["fig08_profiles"])
    yield from _fronts(data, figures["fig09_relax"]["ell"])
    for figure in ("fig10_flow", "fig11_flow_close"):
        for view in figures[figure]["views"]:
            yield from _flow(data, figure, **config.tube_flow[view])
    yield from _pulse(data, config.lumen_pulse)
    for name in figures["fig13_osmotic"]["gels"]:
        yield from _equilibria(data, gels[name], name)
    for name in figures["fig14_equilibrium"]["gels"]:
        yield from _transitions(data, gels[name], name)


def markdown(rows: Sequence[Mapping[str, Any]]) -> str:
    """A row a number, the figures in order."""
    keys = {"value": "printed", "uncertainty from": "source"}
    columns = "figure", "quantity", "value", "unit", "uncertainty from", "evidence"
    intro = f"{len(rows)} numbers, each to the digits that its numerical uncertainty leaves."
    getters = {name: itemgetter(keys.get(name, name)) for name in columns}
    return page("Key numbers of the figures", intro, getters, rows)


def _listed(values) -> str:
    return ", ".join(f"{value:g}" for value in values)


# beads


def _refined_bead(data, case, model):
    """Production run and refinement on their common times; None where the run stopped at once."""
    return bead(data, case, model) if data[f"refinement/bead_{case}_{model}"].t.size else None


def _deformed_bead(data, gels, cases, case: str, time: float) -> Iterator[KeyNumber]:
    figure, evidence = "fig01_lens_schematic", f"data/bead_{case}_lens.nc"
    gel = gels[cases[case]["gel"]]
    phi_00 = float(data[f"bead_{case}_lens"].polymer_fraction[0, 0])
    of_root = root_uncertainty(gel, phi_00, cases[case]["temperature_initial"])
    yield KeyNumber(
        figure, "phi_00 of the reference state", phi_00, of_root, ROUNDED,
        f"{evidence}: polymer_fraction at t = 0",
    )  # fmt: skip
    bead, refined = (
        each.sel(t=time, method="nearest") for each in _refined_bead(data, case, "lens")
    )
    a_00 = float(data[f"bead_{case}_lens"].radius[0])
    a, of_a = float(bead.radius), float(refined.radius_uncertainty)
    phi = float(bead.surface_polymer_fraction)
    of_phi = float(refined.surface_polymer_fraction_uncertainty)
    yield KeyNumber(
        figure, f"radius in the reference state and at t_BMJ = {time:g}", [a_00, a],
        [a_00 / 3.0 * of_root / phi_00, of_a], REFINED, f"{evidence}: radius", LENGTH,
    )  # fmt: skip
    stretch = np.cbrt(phi / phi_00)
    yield KeyNumber(
        figure, f"deviatoric strain along the circle at the surface, t_BMJ = {time:g}",
        stretch - a_00 / a, stretch / 3.0 * of_phi / phi + a_00 / a**2 * of_a, REFINED,
        f"{evidence}: radius, surface_polymer_fraction",
    )  # fmt: skip


def _bead(data, figure: str, case: str) -> Iterator[KeyNumber]:
    for model, name in MODELS.items():
        if (runs := _refined_bead(data, case, model)) is None:
            continue
        bead, refined = runs
        evidence = f"data/bead_{case}_{model}.nc"
        ends = bead.radius.values[[0, -1]]
        doubts = refined.radius_uncertainty.values[[0, -1]] + np.spacing(ends)  # no run moves a_00
        yield KeyNumber(
            figure, f"{name} radius at t_BMJ = {_listed(bead.t.values[[0, -1]])}", ends, doubts,
            REFINED, f"{evidence}: radius", LENGTH,
        )  # fmt: skip
        halves, between = zip(
            *(half_time(refined.t.values, radius) for radius in refined.radius.values), strict=True
        )
        yield KeyNumber(
            figure, f"time of half the change of the {name} radius", halves[0],
            spread(np.array(halves)) + between[0], REFINED, f"{evidence}: radius", TIME,
        )  # fmt: skip
        yield KeyNumber(
            figure, f"{name} polymer fraction at the surface, t_BMJ = {float(bead.t[-1]):g}",
            bead.surface_polymer_fraction.values[-1],
            refined.surface_polymer_fraction_uncertainty.values[-1], REFINED,
            f"{evidence}: surface_polymer_fraction",
        )  # fmt: skip
    both = [_refined_bead(data, case, model) for model in MODELS]
    if all(both):
        t = both[0][0].t.values[: min(bead.t.size for bead, _ in both)]
        apart = np.subtract(*(bead.radius.sel(t=t).values for bead, _ in both))
        doubt = sum(refined.radius_uncertainty.sel(t=t).values for _, refined in both)
        most = int(np.argmax(np.abs(apart)))
        yield KeyNumber(
            figure, "largest distance of the two radii", abs(apart[most]), doubt[most], REFINED,
            f"data/bead_{case}_{{nonlinear,lens}}.nc: radius", LENGTH,
        )  # fmt: skip


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


# energy-based gels


def _heated_gel(gels, gel: str, temperatures: Sequence[float]) -> Iterator[KeyNumber]:
    figure, evidence, material = "fig02_osmotic_schema", f"data/materials_{gel}.nc", gels[gel]
    cold, hot = temperatures
    roots = []
    for T in temperatures:
        phi, stable = material.equilibrium_polymer_fractions(T)
        roots.append((phi[stable], [root_uncertainty(material, each, T) for each in phi[stable]]))
        yield KeyNumber(
            figure, f"stable equilibrium phi_0 of {gel} at {T:g} K", *roots[-1], ROUNDED,
            f"{evidence}: equilibrium_polymer_fraction",
        )  # fmt: skip
    phi, doubt = roots[0][0][0], roots[0][1][0]
    slope = float(material.osmotic_modulus(phi, hot)) / phi
    yield KeyNumber(
        figure, f"Pi at {hot:g} K of the gel that was in equilibrium at {cold:g} K",
        float(material.osmotic_pressure(phi, hot)),
        float(rounding_error(material.osmotic_pressure, phi, hot)) + abs(slope) * doubt, ROUNDED,
        f"{evidence}: osmotic_pressure", "k_B T/Omega_f",
    )  # fmt: skip


def _spinodal(data, gels, gel: str, cases: Sequence[str]) -> Iterator[KeyNumber]:
    figure, table, material = "fig05_spinodal", data[f"materials_{gel}"], gels[gel]
    if "spinodal_tip_temperature" in table:
        T, phi = float(table.spinodal_tip_temperature), float(table.spinodal_tip_polymer_fraction)
        for quantity, value, doubt in (
            ("temperature", T, rounding_error(material.spinodal_temperature, phi)),
            ("polymer fraction", phi, _located(material.spinodal_temperature, phi)),
        ):
            yield KeyNumber(
                figure, f"{quantity} of the tip of the spinodal of {gel}", value, float(doubt),
                ROUNDED,
                f"data/materials_{gel}.nc: spinodal_tip_{quantity.replace(' ', '_')}",
                "K" if quantity == "temperature" else "",
            )  # fmt: skip
    for case in cases:
        bead, refined = data[f"bead_{case}_lens"], data[f"refinement/bead_{case}_lens"]
        if "stop_time" in refined:
            yield KeyNumber(
                figure, f"time at which phases begin to separate, {case}",
                float(refined.stop_time[0]), float(refined.stop_time_uncertainty), REFINED,
                f"data/refinement/bead_{case}_lens.nc: stop_time", TIME,
            )  # fmt: skip
        else:
            least = int(np.argmin(bead.smallest_diffusivity.values))
            yield KeyNumber(
                figure, f"smallest diffusivity, {case}", float(bead.smallest_diffusivity[least]),
                float(refined.smallest_diffusivity_uncertainty[least]), REFINED,
                f"data/bead_{case}_lens.nc: smallest_diffusivity", "k mu_s/mu_l",
            )  # fmt: skip


def _located(curve, phi: float) -> float:
    """How far an extremum may be from phi, where the curve is flat to rounding: the curve's error
    and its curvature tell."""
    step = FLAT * phi * (1.0 - phi)
    before, there, after = curve(np.array([phi - step, phi, phi + step]))
    curvature = abs(before - 2.0 * there + after) / step**2
    return float(np.sqrt(2.0 * rounding_error(curve, phi) / curvature))


def _equilibria(data, material, gel: str) -> Iterator[KeyNumber]:
    table = data[f"materials_{gel}"]
    stable = table.equilibrium_stable.values == 1
    T = table.equilibrium_temperature.values[stable]
    phi = table.equilibrium_polymer_fraction.values[stable]
    for drawn in (T.min(), T.max()):
        here = phi[drawn == T]
        yield KeyNumber(
            "fig13_osmotic", f"phi where Pi of {gel} vanishes at {drawn:g} K", here,
            [root_uncertainty(material, each, drawn) for each in here], ROUNDED,
            f"data/materials_{gel}.nc: equilibrium_polymer_fraction",
        )  # fmt: skip


def _transitions(data, material, gel: str) -> Iterator[KeyNumber]:
    figure, table = "fig14_equilibrium", data[f"materials_{gel}"]
    phi = table.fold_polymer_fraction.values
    for quantity, name, doubts, unit in (
        ("temperatures", "fold_temperature", [fold_uncertainty(material, x) for x in phi], "K"),
        (
            "polymer fractions",
            "fold_polymer_fraction",
            [_located(material.equilibrium_temperature, x) for x in phi],
            "",
        ),
    ):
        yield KeyNumber(
            figure, f"{quantity} of the folds of {gel}", table[name].values, doubts, ROUNDED,
            f"data/materials_{gel}.nc: {name}", unit,
        )  # fmt: skip
    parameters = material.A0 - material.A1, material.B0 - material.B1
    yield KeyNumber(
        figure, f"temperature at which the asymptote of {gel} diverges",
        float(table.singular_temperature),
        float(rounding_error(lambda A, B: (0.5 - A) / B, *parameters)), ROUNDED,
        f"data/materials_{gel}.nc: singular_temperature", "K",
    )  # fmt: skip


# tubes


def _relative(refinement, name: str, ell) -> np.ndarray:
    """Relative uncertainty of a refined quantity: the largest of the refined times, between the
    refined tubes by ln(1-ell)."""
    share = refinement[f"{name}_uncertainty"] / abs(refinement[name].isel(level=0))
    thickness = np.log(1.0 - refinement.ell.values)
    order = np.argsort(thickness)
    return np.interp(
        np.log(1.0 - np.asarray(ell)), thickness[order], share.max("tau").values[order]
    )


def _front(data, figure: str, tau: Sequence[float]) -> KeyNumber:
    pulse = data["tube_pulse"]
    constant, doubt = front_constant(pulse)
    Z_C = pulse.Z_C.sel(tau=tau, method="nearest").values
    return KeyNumber(
        figure, f"Z_C at tau = {_listed(tau)}", Z_C, doubt / constant * Z_C, FOLLOWED,
        "data/tube_pulse.nc: Z_C, front_error",
    )  # fmt: skip


def _collapsed_tube(data, ell: float, tau: float) -> Iterator[KeyNumber]:
    figure, pulse = "fig06_tube_schematic", data["tube_pulse"]
    yield _front(data, figure, [tau])
    Phi1 = float(pulse.Phi1_front.sel(ell=ell, tau=tau, method="nearest"))
    share = float(_relative(data["refinement/tube_pulse"], "Phi1_front", ell))
    radii = np.array([ell, 1.0]) * Phi1 ** (-1 / 3)
    yield KeyNumber(
        figure, f"B_0 and B_1 at the front, ell = {ell:g}", radii, share / 3.0 * radii, REFINED,
        "data/tube_pulse.nc: Phi1_front", "a_1",
    )  # fmt: skip


def _deswelling(data) -> Iterator[KeyNumber]:
    figure, table, curves = "fig07_deswelling", data["deswelling_map"], data["deswelling_curves"]
    for word, corner in (("longest", 0), ("shortest", -1)):
        at = table.isel(M=corner, Pi_ratio=corner)
        yield KeyNumber(
            figure, f"tau_99 at M = {float(at.M):g}, Pi~ = {float(at.Pi_ratio):g}, the {word}",
            float(at.tau99), float(at.tau99_uncertainty), INTEGRATED,
            "data/deswelling_map.nc: tau99",
        )  # fmt: skip
    yield KeyNumber(
        figure, f"tau_99 for ell = {_listed(curves.ell.values)}", curves.tau99.values,
        curves.tau99_uncertainty.values, INTEGRATED, "data/deswelling_curves.nc: tau99",
    )  # fmt: skip


def _profiles(data, ell: float, tau: Sequence[float]) -> Iterator[KeyNumber]:
    figure = "fig08_profiles"
    yield _front(data, figure, tau)
    Phi1 = data["tube_pulse"].Phi1_front.sel(ell=ell, method="nearest")
    Phi1 = Phi1.sel(tau=tau, method="nearest").values
    yield KeyNumber(
        figure, f"Phi_1 at Z_C for ell = {ell:g}, tau = {_listed(tau)}", Phi1,
        _relative(data["refinement/tube_pulse"], "Phi1_front", ell) * Phi1, REFINED,
        "data/tube_pulse.nc: Phi1_front",
    )  # fmt: skip


def _fronts(data, ell: Sequence[float]) -> Iterator[KeyNumber]:
    figure, fit = "fig09_relax", data["front_fit"]
    drawn = fit.sel(ell=ell, method="nearest")
    at = f"for ell = {_listed(ell)}, tau = {float(fit.fit_tau):g}"
    yield KeyNumber(
        figure, f"A {at}", drawn.A.values, drawn.A_uncertainty.values, REFINED,
        "data/front_fit.nc: A", "1/L",
    )  # fmt: skip
    share = _relative(data["refinement/tube_pulse"], "Phi1_front", ell)
    yield KeyNumber(
        figure, f"Phi_1 at Z_C {at}", drawn.Phi1_front.values, share * drawn.Phi1_front.values,
        REFINED, "data/front_fit.nc: Phi1_front",
    )  # fmt: skip
    yield KeyNumber(
        figure, "n of A = c (1-ell)^(-n)", float(fit.exponent), float(fit.exponent_uncertainty),
        REFINED, "data/front_fit.nc: exponent",
    )  # fmt: skip
    c = float(fit.prefactor)
    yield KeyNumber(
        figure, "c of A = c (1-ell)^(-n)", c, c * _of_prefactor(fit), REFINED,
        "data/front_fit.nc: prefactor", "1/L",
    )  # fmt: skip


def _of_prefactor(fit) -> float:
    """Relative uncertainty of c: its logarithm is the mean of ln A + n ln(1-ell)."""
    in_law = fit.isel(ell=np.flatnonzero(fit.in_power_law.values))
    lever = abs(float(np.log(1.0 - in_law.ell).mean()))
    of_A = float((in_law.A_uncertainty / in_law.A).max())
    return of_A + lever * float(fit.exponent_uncertainty)


def _flow(data, figure: str, ell: float, tau: float) -> Iterator[KeyNumber]:
    refinement = data["refinement/tube_pulse"]
    here = data["tube_pulse"].sel(ell=ell, tau=tau, method="nearest")
    wall, V = Wall.of(here), lumen.velocity_printed(Wall.of(here))
    for quantity, name, value, unit in (
        ("axial velocity in the wall", "axial_velocity", wall.largest_axial_velocity, "L"),
        ("radial velocity in the wall", "radial_velocity", wall.largest_radial_velocity, "a_1"),
        ("axial velocity in the lumen", "V_front_printed", V[int(here.hot.sum())], "L"),
    ):
        yield KeyNumber(
            figure, f"largest {quantity}, ell = {ell:g}, tau = {tau:g}", float(value),
            float(_relative(refinement, name, ell) * value), REFINED,
            "data/tube_pulse.nc: F, flux, Phi1", f"{unit}/T",
        )  # fmt: skip


def _pulse(data, settings: Mapping) -> Iterator[KeyNumber]:
    figure, pulse, fit = "fig12_axial_flow", data["lumen_pulse"], data["front_fit"]
    yield _front(data, figure, settings["tau"])
    A = float(pulse.drawn_A)
    at = pulse.sel(A=A, method="nearest")
    for quantity, name in (("at Z_C", "V_max"), ("far ahead", "V_far")):
        yield KeyNumber(
            figure, f"V {quantity} for A = {A:g}, without the prefactor",
            float(at[f"{name}_plotted"]), float(at[f"{name}_plotted_uncertainty"]), INTEGRATED,
            f"data/lumen_pulse.nc: {name}_plotted", "L/T",
        )  # fmt: skip
    n, of_n = float(fit.exponent), float(fit.exponent_uncertainty)
    # V ~ (1-ell)^-2 with 1-ell = (A/c)^(-1/n)
    lever = abs(np.log(A / float(fit.prefactor))) / n**2
    share = 2.0 * (_of_prefactor(fit) / n + lever * of_n)
    yield KeyNumber(
        figure, f"V at Z_C for A = {A:g}, with the prefactor", float(at.V_max),
        share * float(at.V_max), REFINED, "data/lumen_pulse.nc: V_max", "L/T",
    )  # fmt: skip
    product = (pulse.A * pulse.V_max_plotted).values
    doubt = float((pulse.A * pulse.V_max_plotted_uncertainty).max())
    yield KeyNumber(
        figure, "A V_max without the prefactor, mean over A", float(product.mean()),
        doubt, INTEGRATED, "data/lumen_pulse.nc: V_max_plotted", "1/T",
    )  # fmt: skip
