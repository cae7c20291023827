"""Whether the assumptions of the model hold for a design, as traffic lights with reasons.

The paper states what must be small or large and gives examples, not limits; the limits are ours.
Green is where the paper works itself (eps = 0.1, Le = 10), red where a correction is of order one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from gelpump.design import heat, units
from gelpump.design.description import Design
from gelpump.design.device import diffusivity, lewis_number
from gelpump.design.result import Criterion, Light, Result
from gelpump.design.units import told

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.materials.measured import Fit

SLENDER = Criterion("slenderness", "the tube is slender", "ε²", 0.01, 0.1, "section 3.3")
LEWIS = Criterion("lewis", "heat is faster than water in the gel", "Le", 10.0, 2.0,
                  "section 3.5", large=True)  # fmt: skip
COUPLING = Criterion("coupling", "lumen and wall are uncoupled", "G", 1e-2, 1e-1, "appendix B")
CONTINUUM = Criterion("continuum", "the gel is many pores thick", "thickness/√k", 100.0, 10.0,
                      "Darcy's law, eqn:fluid_flux", large=True)  # fmt: skip
ONE_PHASE = Criterion("one_phase", "phases do not separate on the way", "min D/D", 0.1, 1e-12,
                      "section 2.1.1", large=True)  # fmt: skip
LINEAR = Criterion("linearisation", "the gel is as linear as the tube takes it", "error", 0.1, 0.5,
                   "eqn:piecewise_osmotic_pressure")  # fmt: skip
CLOSE = Criterion("closeness", "Φ₁ is close to Φ₀ but for the front", "share", 0.1, 0.3,
                  "section 3.3, below eqn:tube_model")  # fmt: skip
LUMEN_PRESSURE = Criterion("lumen_pressure", "the lumen's pressure is small", "Δp/Π₀₀", 1e-2, 1e-1,
                           "appendix B, with no slip")  # fmt: skip
REYNOLDS = Criterion("reynolds", "the lumen's flow is slow", "Re a₀/L", 0.1, 1.0,
                     "section 3.6.2, Stokes flow")  # fmt: skip
PLAUSIBLE = Criterion("plausible", "the inputs are those of gels and water", "factor", 1.0, 10.0,
                      "usual ranges, ours")  # fmt: skip
FIT = Criterion("fit", "the gel's curve goes through its points", "χ²/ν", 3.0, 10.0,
                "measured equilibria, ours")  # fmt: skip
CRITERIA = (
    PLAUSIBLE,
    FIT,
    SLENDER,
    LEWIS,
    heat.HEAT,
    CLOSE,
    ONE_PHASE,
    LINEAR,
    COUPLING,
    LUMEN_PRESSURE,
    REYNOLDS,
    CONTINUUM,
)


# what is usual, lowest and highest, in SI units: given keys, then keys of `device.results`
USUAL = {
    "a_0": (1e-7, 0.1),
    "a_1": (1e-7, 0.1),
    "radius": (1e-7, 0.1),
    "heated_length": (1e-6, 10.0),
    "permeability": (1e-21, 1e-13),  # of a gel; sand has 1e-11, a pebble bed 1e-8 m^2
    "viscosity": (1e-4, 2.0),  # from hot water to glycerol
    "thermal_diffusivity": (3e-8, 1e-6),  # of liquids and gels; metals have 1e-5 to 2e-4 m^2/s
    "critical_temperature": (250.0, 400.0),
    "heating_step": (1e-3, 100.0),
    "density": (500.0, 2000.0),
    "pipe_section": (1e-14, 1.0),
    "latent_heat": (1e5, 1e9),  # of dry polymer; PNIPAM 5e7 to 6e7 J/m^3
    "repeat_unit": (0.02, 2.0),
    "polymer_density": (500.0, 2500.0),
    "heat_capacity": (1e6, 6e6),
    "molecule_volume": (1e-29, 1e-27),
    "osmotic_modulus": (1.0, 1e9),
    "shear_modulus": (0.1, 1e9),
    "Lewis_number": (0.1, 1e7),
    "response_time": (1e-6, 1e7),  # four months
    "recovery_time": (1e-6, 1e7),
    "travel_time": (1e-6, 1e7),
}
BEAD_USUAL = {"poroelastic_time": (1e-6, 1e7)}  # a tube's is that of its whole length


def unusual(design: Design) -> dict[str, tuple[float, str]]:
    """How far each key lies outside its usual range, as a factor above 1, and that in words."""
    from gelpump.design.device import results

    values = {key: (design.si(key), f"{design.given[key].units:~C}") for key in design.given}
    values |= {each.key: (each.value, each.unit) for each in results(design)}
    found = {}
    for key, (low, high) in (USUAL | (BEAD_USUAL if design.kind == "bead" else {})).items():
        if key not in values:
            continue
        value, unit = values[key]
        if not low <= value <= high:
            given = f"{told(value)} {units.readable(unit)}".removesuffix(" 1")
            text = f"{key.replace('_', ' ')} = {given}, usually {told(low)} to {told(high)}"
            found[key] = max(low / value, value / high), text
    return found


def _plausible(design: Design) -> Light:
    found = sorted(unusual(design).values(), reverse=True)
    reason = "; ".join(text for _, text in found) or "each is within what is usual"
    return Light(PLAUSIBLE, found[0][0] if found else 1.0, reason)


def fitted(fit: Fit) -> Light:
    """How well a measured gel's curve goes through its points (`gelpump.materials.measured`)."""
    chi2 = fit.reduced_chi2
    return Light(FIT, chi2, f"χ² per degree of freedom is {told(chi2)}")


def smallest_diffusivity(design: Design, temperature: float | None = None) -> tuple[float, float]:
    """Least D over that of the swollen gel, less its sign, on the way to the collapsed one, and
    where (phi)."""
    material, gel = design.material, design.material.gel
    low = material.own_start
    phi = np.linspace(low, low * material.Phi_inf, 2001)
    T = material.hot if temperature is None else temperature
    D = gel.diffusivity(phi, T)
    least = int(D.argmin())
    return float(D[least] / abs(gel.diffusivity(low, T))), float(phi[least])


def own_response_time(design: Design) -> float | None:
    """t_99 with the gel's own D along the way in place of the tangents'; None if D <= 0 there.

    t = (a_1-a_0)^2/16 Integral dPhi/[Phi^{2/3} D (Phi_inf - Phi)], section 3.4 with the D of
    eqn:lens_transport.
    """
    from scipy.integrate import quad

    material, gel = design.material, design.material.gel
    if smallest_diffusivity(design)[0] <= 0:
        return None
    unit = design.si("permeability") / design.si("viscosity") * material.pressure_unit
    end = material.Phi_inf

    def per_y(y):  # y = ln[Phi/(Phi_inf - Phi)], as in tube.deswelling
        Phi = end / (1 + np.exp(-y))
        return Phi ** (1 / 3) / (
            end * unit * gel.diffusivity(material.own_start * Phi, material.hot)
        )

    last = end - (end - 1) / 100
    ends = (np.log(Phi / (end - Phi)) for Phi in (1.0, last))
    wall = design.si("a_1") - design.si("a_0")
    return wall**2 / 16 * quad(per_y, *ends, epsabs=0, epsrel=1e-10)[0]


def before_solving(design: Design) -> list[Light]:
    """The lights that need no solution."""
    k = design.si("permeability")
    found = [heat.light(design)]
    if design.kind == "tube":
        a_0, a_1, L = (design.si(key) for key in ("a_0", "a_1", "heated_length"))
        thickness, what = a_1 - a_0, "the wall"
        found += [
            Light(
                SLENDER,
                (a_1 / L) ** 2,
                f"ε = a₁/L = {told(a_1 / L)}; corrections are of order ε²",
            ),
            Light(COUPLING, k / a_1**2, f"G = k/a₁² = {told(k / a_1**2, 2)}"),
        ]
    else:
        thickness, what = design.si("radius"), "the bead"
        Le, D = lewis_number(design), units.si(diffusivity(design), "m^2/s")
        kappa = design.si("thermal_diffusivity")
        found.append(
            Light(LEWIS, Le, f"Le = κ/D = {told(kappa, 2)}/{told(D, 2)} = {told(Le)}; "
                  "the bead is warm throughout before its water moves")
        )  # fmt: skip
    pores = thickness / k**0.5
    found += [
        Light(CONTINUUM, pores,
              f"{what} is {told(pores, 2)} times √k = {told(k**0.5 * 1e9, 2)} nm thick"),
        _plausible(design),
        *_gel_lights(design),
    ]  # fmt: skip
    return _sorted(found)


def _gel_lights(design: Design) -> list[Light]:
    material = design.material
    if not material.energy_based:
        return [
            Light(ONE_PHASE, smallest_diffusivity(design)[0], "D > 0 for every Φ of a linear gel")
        ]
    least, phi = smallest_diffusivity(design)
    if least > 0:
        reason = (
            f"least D is {told(least)} of the swollen one, at φ = {phi:.3g}, {design.T_hot:g} K"
        )
    else:
        roots = material.gel.spinodal_polymer_fractions(material.hot)
        reason = (
            f"D < 0 between φ = {roots[0]:.3g} and {roots[1]:.3g} at {design.T_hot:g} K"
            if len(roots) == 2
            else f"D < 0 at φ = {phi:.3g}, {design.T_hot:g} K"
        ) + ": dry and swollen gel will part, times are not to be trusted"
    found = [Light(ONE_PHASE, least, reason)]
    if design.kind == "tube":
        own = own_response_time(design)
        from gelpump.design.device import response_time

        mine = response_time(design)
        value = np.inf if own is None else abs(mine / own - 1)
        reason = (
            "the gel's own D is negative on the way, tangents hide it"
            if own is None
            else f"t₉₉ is {told(mine)} s with the tangents, {told(own)} s with the gel's own D"
        )
        found.append(Light(LINEAR, min(value, 1e9), reason))
    return found


def measured_linearity(found: Mapping[str, Result]) -> Light | None:
    """Of a tube that was solved with its gel's own D and phi_0(T): the linear one's error."""
    from gelpump.design.own_gel import KEY

    own, linear = (found.get(key) for key in (KEY, "final_pumped_volume_conserving"))
    if own is None or linear is None:
        return None
    volumes = [units.shown(each.value, "m^3") for each in (linear, own)]
    said = [f"{units.told(number)} {units.readable(unit)}" for number, unit in volumes]
    reason = f"{said[0]} are pumped with the tangents, {said[1]} with the gel’s own D, φ₀(T)"
    return Light(LINEAR, abs(linear.value / own.value - 1), reason)


def after_solving(design: Design, data: xr.Dataset) -> list[Light]:
    """The lights of a solved tube, at the time when the front has travelled the heated length."""
    if design.kind == "bead" or "unsolved" in data.attrs:
        return []
    share = float((data.departed_length / data.front_position)[-1])
    peak = max(
        float(np.abs(data[f"lumen_velocity_{form}"]).max()) for form in ("printed", "conserving")
    )
    return flow_lights(design, share, float(data.front_polymer_ratio[-1]), peak)


def flow_lights(design: Design, share: float, front: float, peak: float) -> list[Light]:
    """Lights of a pulse: share of the heated length out of equilibrium, Phi_1 at the front, and the
    largest velocity in the lumen (m/s)."""
    a_0, L, mu = design.si("a_0"), design.si("heated_length"), design.si("viscosity")
    pressure = 8 * mu * peak * L / a_0**2
    speed = f"{told(1e3 * peak, 2)} mm/s"
    reynolds = design.si("density") * peak * a_0 / mu * a_0 / L
    Phi_inf = design.material.Phi_inf
    return _sorted(
        [
            Light(CLOSE, share,
                  f"{share:.0%} of the heated length is more than a tenth of the jump away from "
                  f"Φ₀; at the front Φ₁ = {front:.3g} lies between 1 and {Phi_inf:.3g} always"),
            Light(LUMEN_PRESSURE, pressure / design.material.Pi_00,
                  f"Poiseuille flow at {speed} over L needs {told(pressure, 2)} Pa, "
                  f"Π₀₀ = {told(design.material.Pi_00, 2)} Pa"),
            Light(REYNOLDS, reynolds, f"ρ v a₀²/(µ L) = {told(reynolds, 2)} at v = {speed}"),
        ]
    )  # fmt: skip


def _sorted(lights) -> list[Light]:
    return sorted(lights, key=lambda light: CRITERIA.index(light.criterion))
