"""What the paper states about tubes, their fronts and their flows (section 3, appendix B)."""

from collections.abc import Iterator, Mapping

import numpy as np

from gelpump.claims.finding import Finding, holds

ROUNDING = 1e-12  # of closed formulae and of quadratures to the last digits
CONSTANT = 0.05  # relative spread up to which something counts as constant


def findings(data: Mapping, scales: Mapping) -> Iterator[Finding]:
    """data: datasets of the tubes; scales: typical values with their units, from the config."""
    yield from _deswelling(data["deswelling_map"], data["deswelling_curves"])
    yield from _heat(data["tube_pulse"], scales)
    yield from _front(data)
    yield from _wall_flow(data["water_budget"])
    yield from _lumen_flow(data["lumen_pulse"], data["refinement/tube_pulse"])
    yield _coupling(scales)


def _slope(x, y) -> float:
    """d ln y / d ln x by least squares."""
    return float(np.polyfit(np.log(np.asarray(x)), np.log(np.asarray(y)), 1)[0])


def _decreasing(values, axis: int = 0) -> float:
    """Smallest relative fall from one entry to the next along an axis; negative if one rises."""
    return float(np.min(-np.diff(np.log(np.asarray(values)), axis=axis)))


def _deswelling(table, curves) -> Iterator[Finding]:
    thickness, times = 1.0 - table.ell.values, table.tau99_compared.values
    evidence = "data/deswelling_map.nc: tau99"
    exponent = _slope(thickness, times)
    yield Finding(
        "tpore-scaling",
        "section 3",
        "the response time scales as this power of the length over which water diffuses "
        "(the wall's thickness)",
        exponent,
        ROUNDING * abs(exponent),
        f"{evidence}_compared",
    )
    yield Finding(
        "radial-adjustment-thin",
        "section 3.6",
        "the deswelling time scales as this power of 1 - ell",
        exponent,
        ROUNDING * abs(exponent),
        f"{evidence}_compared",
    )
    for claim, where, what, values, axis, name in (
        (
            "faster-with-contrast",
            "section 3.4",
            "a gel with a larger Phi_inf deswells faster, for every M of the map",
            table.tau99_contrast.values,
            1,
            "_contrast",
        ),
        (
            "faster-with-M",
            "section 3.4, figure 7a",
            "a stiffer gel (larger M) deswells faster, for every Pi~ of the map",
            table.tau99.transpose("M", "Pi_ratio").values,
            0,
            "",
        ),
        (
            "faster-with-Pi",
            "section 3.4, figure 7a",
            "a gel with a larger Pi~ deswells faster, for every M of the map",
            table.tau99.transpose("M", "Pi_ratio").values,
            1,
            "",
        ),
    ):
        margin = _decreasing(values, axis)
        yield Finding(
            claim,
            where,
            what,
            holds(margin, ROUNDING),
            ROUNDING,
            evidence + name,
            measure=margin,
            measured="smallest relative fall of tau_99 between neighbours:",
        )
    drawn = curves.Phi1.sel(ell=[0.01, 0.1, 0.25, 0.5]).sel(tau=1e-4, method="nearest")
    yield Finding(
        "deswelling-curves",
        "figure 7b",
        "Phi_1 at tau = 1e-4 for ell = 0.01, 0.1, 0.25, 0.5",
        drawn.values.tolist(),
        [ROUNDING] * drawn.size,
        "data/deswelling_curves.nc: Phi1",
    )


def _heat(pulse, scales) -> Iterator[Finding]:
    ratio = pulse.Z_C / np.sqrt(pulse.Le * pulse.tau)
    missed = float((pulse.front_error / pulse.Z_C).max() * ratio[0])
    yield Finding(
        "front-position",
        "section 3.5",
        "Z_C / sqrt(Le tau) of the deswelling front",
        float(ratio[0]),
        missed + ROUNDING,
        "data/tube_pulse.nc: Z_C, front_error",
    )
    fronts = pulse.Z_C.sel(tau=[0.025, 0.05], method="nearest").values
    yield Finding(
        "front-fig8",
        "figure 8",
        "position of the front at tau = 0.025 and 0.05",
        fronts.tolist(),
        (missed * fronts).tolist(),
        "data/tube_pulse.nc: Z_C",
    )
    lewis = scales["thermal_diffusivity"] / scales["compositional_diffusivity"]
    yield Finding(
        "lewis-number",
        "section 3.5",
        "thermal over compositional diffusivity, from their typical values",
        lewis,
        ROUNDING * lewis,
        "config: scales",
    )


def _front(data) -> Iterator[Finding]:
    fit, pulse = data["front_fit"], data["tube_pulse"]
    drawn = [0.1, 0.25, 0.5, 0.75, 0.9]
    tau = float(fit.fit_tau)
    of_figure = fit.sel(ell=drawn, method="nearest")
    yield Finding(
        "tanh-form",
        "eqn:tanh_fit",
        "Phi_1 around the front is a tanh: misfit in the root mean square, and largest Phi_1 at "
        f"Z_C where the tanh has {float(1 + pulse.Phi_inf[0]) / 2:g}",
        None,
        [
            float(fit.fit_rms.max()) * float((fit.A_uncertainty / fit.A).max()),
            float(data["refinement/tube_pulse"].Phi1_front_uncertainty.max()),
        ],
        "data/front_fit.nc: fit_rms, Phi1_front",
        measure=[float(fit.fit_rms.max()), float(fit.Phi1_front.max())],
        measured="misfit, Phi_1 at Z_C:",
    )
    yield Finding(
        "A-values",
        "figure 9b",
        f"A(ell) at tau = {tau:g} for ell = " + ", ".join(f"{ell:g}" for ell in drawn),
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
        float(data["refinement/tube_pulse"].Phi1_difference.max()),
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
        + ", ".join(f"{ell:g}" for ell in drawn),
        None,
        float(data["refinement/tube_pulse"].Phi1_front_uncertainty.max()) / jump,
        "data/front_fit.nc: departure_front",
        measure=departure.tolist(),
        measured="largest |Phi_0 - Phi_1| over the jump Phi_inf - 1:",
    )


def _wall_flow(budget) -> Iterator[Finding]:
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
    yield Finding(
        "radial-dominates-thin",
        "section 3.6.1, figure 11",
        "radial velocities dominate axial ones more in the thinner wall",
        holds(thin / thick - 1.0, float(balance)),
        [float(balance) * thick, float(balance) * thin],
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
    quadrature = 1e-8  # to which the integrals of the tanh form are converged
    for claim, what, value in (
        ("lumen-peak-height", "largest", at_A.V_max_plotted),
        ("lumen-far-nonzero", "far ahead of the front", at_A.V_far_plotted),
    ):
        yield Finding(
            claim,
            "section 3.6.2, figure 12a",
            f"axial velocity {what}, for A = {float(lumen.drawn_A):g}, without the prefactor",
            float(value),
            quadrature * float(value),
            "data/lumen_pulse.nc: " + str(value.name),
        )
    product = (lumen.A * lumen.V_max_plotted).values
    yield Finding(
        "lumen-peak-product",
        "figure 12b",
        "A V_max without the prefactor, mean over A",
        float(product.mean()),
        float(np.ptp(product)) + quadrature,
        "data/lumen_pulse.nc: V_max_plotted",
    )
    yield Finding(
        "Vmax-exponent",
        "figure 12b",
        "power of A that V_max follows, without the prefactor",
        _slope(lumen.A, lumen.V_max_plotted),
        quadrature,
        "data/lumen_pulse.nc: V_max_plotted",
    )
    drawn = [0.1, 0.25, 0.5, 0.75, 0.9]
    late = lumen.sel(tau=0.1, method="nearest").sel(ell=drawn, method="nearest")
    flux = late.pulse_flux.values
    doubt = float((refinement.V_front_printed_uncertainty / refinement.V_front_printed[0]).max())
    spread = float(np.ptp(flux) / flux.mean())
    yield Finding(
        "pulse-flux-constant",
        "section 3.6.2",
        f"the flux of the pulse depends on ell by less than {CONSTANT:.0%} (tau = 0.1, eqn:lumen)",
        holds(CONSTANT - spread, doubt),
        doubt,
        "data/lumen_pulse.nc: pulse_flux",
        measure=spread,
        measured="relative spread over ell = 0.1 to 0.9:",
    )
    exponent = _slope(1.0 - late.ell, late.V_front_printed)
    yield Finding(
        "lumen-height-vs-ell",
        "section 3.6.2, figure 12",
        "sign of the power of 1 - ell that the height of the pulse follows, from eqn:lumen "
        "(text: grows with ell; figure: falls)",
        float(np.sign(exponent)),
        doubt,
        "data/lumen_pulse.nc: V_front_printed",
        measure=exponent,
        measured="the power:",
    )


def _coupling(scales) -> Finding:
    G = scales["permeability"] / scales["smallest_radius"] ** 2
    return Finding(
        "coupling-G",
        "appendix B",
        "k / a_1^2 is small for every a_1 above the stated smallest one",
        None,
        ROUNDING * G,
        "config: scales",
        measure=G,
        measured=f"at a_1 = {scales['smallest_radius']:g} m:",
    )
