"""What the paper states about tubes, their fronts and their flows (section 3, appendix B)."""

from collections.abc import Iterator, Mapping

import numpy as np

from gelpump.claims.finding import Finding, holds
from gelpump.uncertainty import rounding_error

DRAWN_ELL = [0.1, 0.25, 0.5, 0.75, 0.9]  # the tubes of figure 9


def findings(data: Mapping, scales: Mapping) -> Iterator[Finding]:
    """data: datasets of the tubes; scales: typical values with their units, from the config."""
    yield from _deswelling(data["deswelling_map"], data["deswelling_curves"])
    yield from _heat(data["tube_pulse"], scales)
    yield from _front(data)
    yield from _wall_flow(data["water_budget"], data["refinement/tube_pulse"])
    yield from _lumen_flow(data["lumen_pulse"], data["refinement/tube_pulse"])
    yield _coupling(scales)


def slope(x, y, relative_error=0.0) -> tuple[float, float]:
    """d ln y / d ln x by least squares, and the most that errors of y, of any sign, make of it.

    The rounding of y and of logarithms adds to relative_error, a number or one for each y.
    """
    ln_x, ln_y = np.log(np.asarray(x)), np.log(np.asarray(y))
    leverage = (ln_x - ln_x.mean()) / ((ln_x - ln_x.mean()) ** 2).sum()
    rounding = np.spacing(np.abs(ln_x)) + np.spacing(np.abs(ln_y)) + np.finfo(float).eps
    return float(leverage @ ln_y), float(np.abs(leverage) @ (np.asarray(relative_error) + rounding))


def _decreasing(values, axis: int = 0) -> float:
    """Smallest relative fall from one entry to the next along an axis; negative if one rises."""
    return float(np.min(-np.diff(np.log(np.asarray(values)), axis=axis)))


def _relative(dataset, name: str) -> float:
    """Largest relative uncertainty of a variable that has one."""
    values = dataset[name].isel(level=0) if "level" in dataset[name].dims else dataset[name]
    return float((dataset[f"{name}_uncertainty"] / abs(values)).max())


def _deswelling(table, curves) -> Iterator[Finding]:
    thickness, times = 1.0 - table.ell.values, table.tau99_compared.values
    evidence = "data/deswelling_map.nc: tau99"
    exponent, doubt = slope(thickness, times, _relative(table, "tau99_compared"))
    yield Finding(
        "tpore-scaling",
        "section 3",
        "the response time scales as this power of the length over which water diffuses "
        "(the wall's thickness)",
        exponent,
        doubt,
        f"{evidence}_compared",
    )
    yield Finding(
        "radial-adjustment-thin",
        "section 3.6",
        "the deswelling time scales as this power of 1 - ell",
        exponent,
        doubt,
        f"{evidence}_compared",
    )
    for claim, where, what, name, axis in (
        (
            "faster-with-contrast",
            "section 3.4",
            "a gel with a larger Phi_inf deswells faster, for every M of the map",
            "tau99_contrast",
            1,
        ),
        (
            "faster-with-M",
            "section 3.4, figure 7a",
            "a stiffer gel (larger M) deswells faster, for every Pi~ of the map",
            "tau99",
            0,
        ),
        (
            "faster-with-Pi",
            "section 3.4, figure 7a",
            "a gel with a larger Pi~ deswells faster, for every M of the map",
            "tau99",
            1,
        ),
    ):
        margin = _decreasing(table[name].transpose("M", ...).values, axis)
        doubt = 2.0 * _relative(table, name)
        yield Finding(
            claim,
            where,
            what,
            holds(margin, doubt),
            doubt,
            f"data/deswelling_map.nc: {name}",
            measure=margin,
            measured="smallest relative fall of tau_99 between neighbours:",
        )
    drawn = curves.sel(ell=[0.01, 0.1, 0.25, 0.5]).sel(tau=1e-4, method="nearest")
    yield Finding(
        "deswelling-curves",
        "figure 7b",
        "Phi_1 at tau = 1e-4 for ell = 0.01, 0.1, 0.25, 0.5",
        drawn.Phi1.values.tolist(),
        drawn.Phi1_uncertainty.values.tolist(),
        "data/deswelling_curves.nc: Phi1",
    )


def _heat(pulse, scales) -> Iterator[Finding]:
    scaled, doubt = front_constant(pulse)
    yield Finding(
        "front-position",
        "section 3.5",
        "Z_C / sqrt(Le tau) of the deswelling front",
        scaled,
        doubt,
        "data/tube_pulse.nc: Z_C, front_error",
    )
    fronts = pulse.Z_C.sel(tau=[0.025, 0.05], method="nearest").values
    yield Finding(
        "front-fig8",
        "figure 8",
        "position of the front at tau = 0.025 and 0.05",
        fronts.tolist(),
        (doubt / scaled * fronts).tolist(),
        "data/tube_pulse.nc: Z_C",
    )
    diffusivities = scales["thermal_diffusivity"], scales["compositional_diffusivity"]
    yield Finding(
        "lewis-number",
        "section 3.5",
        "thermal over compositional diffusivity, from their typical values",
        np.divide(*diffusivities),
        float(rounding_error(np.divide, *diffusivities)),
        "config: scales",
    )


def front_constant(pulse) -> tuple[float, float]:
    """Z_C / sqrt(Le tau), and its uncertainty: how far solved fronts are from where the stated
    temperature is that of the transition, and rounding."""

    def scaled(Z_C, Le, tau):
        return Z_C / np.sqrt(Le * tau)

    first = float(pulse.Z_C[0]), float(pulse.Le), float(pulse.tau[0])
    missed = float((pulse.front_error / pulse.Z_C).max()) * scaled(*first)
    return float(scaled(*first)), missed + float(rounding_error(scaled, *first))


def _front(data) -> Iterator[Finding]:
    fit, pulse, refinement = data["front_fit"], data["tube_pulse"], data["refinement/tube_pulse"]
    tau = float(fit.fit_tau)
    of_figure = fit.sel(ell=DRAWN_ELL, method="nearest")
    yield Finding(
        "tanh-form",
        "eqn:tanh_fit",
        "Phi_1 around the front is a tanh: misfit in the root mean square, and largest Phi_1 at "
        f"Z_C where the tanh has {float(1 + pulse.Phi_inf[0]) / 2:g}",
        None,
        [
            float(fit.fit_rms.max()) * float((fit.A_uncertainty / fit.A).max()),
            float(refinement.Phi1_front_uncertainty.max()),
        ],
        "data/front_fit.nc: fit_rms, Phi1_front",
        measure=[float(fit.fit_rms.max()), float(fit.Phi1_front.max())],
        measured="misfit, Phi_1 at Z_C:",
    )
    yield Finding(
        "A-values",
        "figure 9b",
        f"A(ell) at tau = {tau:g} for ell = " + ", ".join(f"{ell:g}" for ell in DRAWN_ELL),
        of_figure.A.values.tolist(),
        of_figure.A_uncertainty.values.tolist(),
        "data/front_fit.nc: A",
    )
    yield Finding(
        "A-exponent",
        "section 3.6, figure 9b",
        "power of 1 - ell that A(ell) follows",
        -float(fit.exponent),
        float(fit.exponent_uncertainty),
        "data/front_fit.nc: exponent",
    )
    late = fit.profile_change.sel(ell=0.25, method="nearest").where(fit.tau >= tau, drop=True)
    yield Finding(
        "travelling-wave",
        "section 3.6",
        f"the profile around Z_C keeps its shape while tau grows (ell = 0.25, from tau = {tau:g})",
        None,
        float(refinement.Phi1_difference.sel(ell=0.25, method="nearest").max()),
        "data/front_fit.nc: profile_change",
        measure=float(late.max()),
        measured="largest change of Phi_1 at the same Z - Z_C:",
    )
    jump = float(pulse.Phi_inf[0]) - 1.0
    departure = of_figure.departure_front.sel(tau=tau, method="nearest").values / jump
    yield Finding(
        "phi1-near-equilibrium",
        "section 3.3",
        "Phi_1 is everywhere close to Phi_0: it is not at the front, for ell = "
        + ", ".join(f"{ell:g}" for ell in DRAWN_ELL),
        None,
        float(refinement.Phi1_front_uncertainty.max()) / jump,
        "data/front_fit.nc: departure_front",
        measure=departure.tolist(),
        measured="largest |Phi_0 - Phi_1| over the jump Phi_inf - 1:",
    )


def _wall_flow(budget, refinement) -> Iterator[Finding]:
    balance = np.abs(budget.shed_volume_error / budget.shed_volume).max()
    outer = budget.outer_rate_printed.where(budget.tau >= 1e-3, drop=True)
    behind, ahead = outer.isel(side=0), outer.isel(side=1)
    scale = float(np.abs(outer).max())
    margin = float(min(behind.min(), -ahead.max())) / scale
    yield Finding(
        "flow-out-behind-in-ahead",
        "section 3.6.1, figures 10, 11",
        "water leaves through the outer wall behind the front and enters ahead of it",
        holds(margin, float(balance)),
        float(balance),
        "data/water_budget.nc: outer_rate_printed",
        measure=margin,
        measured="smaller of the two flows over the largest flow:",
    )
    ratio = budget.radial_to_axial_velocity.sel(tau=0.025, method="nearest")
    thick, thin = (float(ratio.sel(ell=ell, method="nearest")) for ell in (0.25, 0.75))
    doubt = _relative(refinement, "radial_to_axial_velocity")
    yield Finding(
        "radial-dominates-thin",
        "section 3.6.1, figure 11",
        "radial velocities dominate axial ones more in the thinner wall",
        holds(thin / thick - 1.0, 2.0 * doubt),
        [doubt * thick, doubt * thin],
        "data/water_budget.nc: radial_to_axial_velocity",
        measure=[thick, thin],
        measured="largest radial over largest axial velocity for ell = 0.25, 0.75:",
    )


def _lumen_flow(lumen, refinement) -> Iterator[Finding]:
    at_A = lumen.sel(A=float(lumen.drawn_A), method="nearest")
    highest = lumen.V_plotted.sel(tau=0.01, method="nearest")
    Z_C = float(lumen.Z_C.sel(tau=0.01, method="nearest"))
    offset = abs(float(lumen.Z[int(highest.argmax("Z"))]) - Z_C)
    spacing = float(np.median(np.diff(lumen.Z)))
    yield Finding(
        "lumen-peak-at-front",
        "section 3.6.2, figure 12a",
        "the axial velocity in the lumen is largest at Z_C",
        holds(spacing - offset, 0.0),
        spacing,
        "data/lumen_pulse.nc: V_plotted",
        measure=offset,
        measured="distance of the largest V from Z_C:",
    )
    for claim, what, name in (
        ("lumen-peak-height", "largest", "V_max_plotted"),
        ("lumen-far-nonzero", "far ahead of the front", "V_far_plotted"),
    ):
        yield Finding(
            claim,
            "section 3.6.2, figure 12a",
            f"axial velocity {what}, for A = {float(lumen.drawn_A):g}, without the prefactor",
            float(at_A[name]),
            float(at_A[f"{name}_uncertainty"]),
            f"data/lumen_pulse.nc: {name}",
        )
    product = (lumen.A * lumen.V_max_plotted).values
    quadrature = _relative(lumen, "V_max_plotted")
    yield Finding(
        "lumen-peak-product",
        "figure 12b",
        "A V_max without the prefactor, mean over A",
        float(product.mean()),
        float(np.ptp(product) + quadrature * product.max()),
        "data/lumen_pulse.nc: V_max_plotted",
    )
    exponent, doubt = slope(lumen.A, lumen.V_max_plotted, quadrature)
    yield Finding(
        "Vmax-exponent",
        "figure 12b",
        "power of A that V_max follows, without the prefactor",
        exponent,
        doubt,
        "data/lumen_pulse.nc: V_max_plotted",
    )
    late = lumen.sel(tau=0.1, method="nearest").sel(ell=DRAWN_ELL, method="nearest")
    flux, doubt = slope(1.0 - late.ell, late.pulse_flux, _relative(refinement, "pulse_flux"))
    yield Finding(
        "pulse-flux-constant",
        "section 3.6.2",
        "power of 1 - ell that the flux of the pulse follows: none, it is constant (tau = 0.1, "
        "eqn:lumen)",
        flux,
        doubt,
        "data/lumen_pulse.nc: pulse_flux",
        measure=float(np.ptp(late.pulse_flux.values) / late.pulse_flux.mean()),
        measured="relative spread over ell = 0.1 to 0.9:",
    )
    height, doubt = slope(
        1.0 - late.ell, late.V_front_printed, _relative(refinement, "V_front_printed")
    )
    yield Finding(
        "lumen-height-vs-ell",
        "section 3.6.2, figure 12",
        "sign of the power of 1 - ell that the height of the pulse follows, from eqn:lumen "
        "(text: grows with ell; figure: falls)",
        float(np.sign(height)) if abs(height) > doubt else 0.0,
        doubt,
        "data/lumen_pulse.nc: V_front_printed",
        measure=height,
        measured="the power:",
    )


def _coupling(scales) -> Finding:
    def coupling(permeability, radius):
        return permeability / radius**2

    known = scales["permeability"], scales["smallest_radius"]
    return Finding(
        "coupling-G",
        "appendix B",
        "k / a_1^2 is small for every a_1 above the stated smallest one",
        None,
        float(rounding_error(coupling, *known)),
        "config: scales",
        measure=coupling(*known),
        measured=f"at a_1 = {scales['smallest_radius']:g} m:",
    )
