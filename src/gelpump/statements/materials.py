"""The energy-based gels (appendix A and sections 2.1, 2.2)."""

from functools import partial

import numpy as np

from gelpump.materials import EnergyBasedGel
from gelpump.statements.derivations import modulus, refined
from gelpump.statements.statement import LINE, Collection, Computed, Evidence, holds
from gelpump.uncertainty import rounding_error

statements = Collection()
states = statements.states
GELS = ("ANB", "HHT")
ROUNDING = 4 * np.finfo(float).eps  # relative, of a closed formula or a root found to the last bit
COLD = 300.0  # K, the lowest temperature that the paper draws
WARMER = np.array([300.0, 305.0, 310.0, 315.0])  # K, the range of figure 13
NUDGE = 1e-6  # relative shift of a polymer fraction, to see how well an extremum is located


def root_uncertainty(gel: EnergyBasedGel, phi: float, T: float) -> float:
    """How far phi is from T_eq(phi) = T, to first order, and what rounding adds."""
    at, beside = gel.equilibrium_temperature(np.array([phi, phi * (1 + NUDGE)]))
    return float(abs((at - T) * phi * NUDGE / (beside - at))) + ROUNDING


def fold_uncertainty(gel: EnergyBasedGel, phi: float) -> float:
    """How far T_eq moves when the fold's polymer fraction is nudged: T is flat there."""
    T = gel.equilibrium_temperature(np.array([phi * (1 - NUDGE), phi, phi * (1 + NUDGE)]))
    return float(np.ptp(T)) + ROUNDING * float(T[1])


def initial_state(e: Evidence, case: str) -> Computed:
    """Polymer fraction of a bead before the jump."""
    phi = float(e.data[f"bead_{case}_lens"].polymer_fraction[0, 0])
    gel, T = e.gels[e.cases[case]["gel"]], e.cases[case]["temperature_initial"]
    return Computed(phi, root_uncertainty(gel, phi, T))


for _T, _case in ((308, "swelling"), (304, "drying")):
    _text = f"the HHT gel in equilibrium at {_T} K has this polymer fraction"
    _evidence = f"bead_{_case}_lens: polymer_fraction"
    states(f"phi0-{_T}-hht", "section 2.1", _evidence, text=_text)(
        partial(initial_state, case=_case)
    )


def _folds(e, name: str) -> tuple[np.ndarray, list[float]]:
    table = e.data[f"materials_{name}"]
    doubts = [fold_uncertainty(e.gels[name], phi) for phi in table.fold_polymer_fraction.values]
    return np.sort(table.fold_temperature.values), doubts


def jump_of_anb(e: Evidence, fold: int) -> Computed:
    """Temperature of a fold of ANB, by rank."""
    folds, doubts = _folds(e, "ANB")
    drawn = f"the folds lie at {folds[0]:.3f} and {folds[-1]:.3f} K, where figure 14 draws them"
    return Computed(float(folds[fold]), max(doubts), follows=drawn)


for _way, _fold, _what in (("up", 0, "swelling"), ("down", -1, "drying")):
    _text = f"temperature at which the ANB gel jumps on {_what}"
    _at = "appendix A, figure 14", "materials_ANB: fold_temperature"
    states(f"tc-{_way}-anb", *_at, text=_text)(partial(jump_of_anb, fold=_fold))


@states("tc-hht", "appendix A, figure 14", "materials_HHT: fold_temperature")
def transition_of_hht(e: Evidence) -> Computed:
    """Temperature at which the HHT gel jumps (on swelling, on drying)."""
    folds, doubts = _folds(e, "HHT")
    return Computed(folds, [max(doubts)] * folds.size)


BOTH_FOLDS = "materials_{ANB,HHT}: fold_temperature"


@states("hysteresis-both", "appendix A, figure 14", BOTH_FOLDS)
def hysteresis(e: Evidence) -> Computed:
    """Both gels have several equilibria in a narrow band of temperatures."""
    folds = [_folds(e, name) for name in GELS]
    width, doubt = min(np.ptp(T) for T, _ in folds), max(sum(doubts) for _, doubts in folds)
    return Computed(holds(width, doubt), doubt, width, "narrower band, K:")


def _exponent(phi, asymptote, step: int) -> float:
    """Power of (1/2 - a + b) that phi_0 follows at the lowest temperatures (asymptote: -3/5)."""
    slope = np.diff(np.log(phi[: step + 1 : step])) / np.diff(np.log(asymptote[: step + 1 : step]))
    return -0.6 * float(slope[0])


SWOLLEN = "materials_{ANB,HHT}: swollen_polymer_fraction, asymptotic_polymer_fraction"


@states("phi0-asymptote", "appendix A", SWOLLEN)
def low_temperature_power(e: Evidence) -> Computed:
    """Power of 1/2 - (A0-A1) - (B0-B1) T that phi_0 of the swollen gels (ANB, HHT) follows at the
    lowest temperature of their range."""
    tables = [e.data[f"materials_{name}"] for name in GELS]
    curves = [(t.swollen_polymer_fraction, t.asymptotic_polymer_fraction) for t in tables]
    near, wide = ([_exponent(p.values, a.values, step) for p, a in curves] for step in (1, 2))
    off = [float(asymptote[0] / phi[0]) - 1.0 for phi, asymptote in curves]
    measured = "relative error of the asymptote at the lowest temperature:"
    return Computed(near, np.abs(np.subtract(near, wide)), off, measured)


COLD_STATES = "materials_{ANB,HHT}: equilibrium_polymer_fraction"


@states("phi0-low-temperature", "appendix A", COLD_STATES)
def low_temperature_fraction(e: Evidence) -> Computed:
    """At 300 K, which is sufficiently low, the swollen gels (ANB, HHT) have this phi_0."""
    tables = [e.data[f"materials_{name}"] for name in GELS]
    at_300 = [
        float(t.equilibrium_polymer_fraction.values[t.equilibrium_temperature == COLD].min())
        for t in tables
    ]
    doubts = [root_uncertainty(e.gels[n], phi, COLD) for n, phi in zip(GELS, at_300, strict=True)]
    return Computed(at_300, doubts, follows="at 300 K it is {:.3f} and {:.3f}".format(*at_300))


def end_of_the_asymptote(e: Evidence, gel: str) -> Computed:
    """Temperature at which the low-temperature asymptote diverges."""
    T = float(e.data[f"materials_{gel}"].singular_temperature)
    return Computed(T, ROUNDING * T)


for _gel in GELS:
    _text = f"temperature at which the low-temperature asymptote of {_gel} breaks down"
    _at = "appendix A", f"materials_{_gel}: singular_temperature"
    states(f"singular-t-{_gel.lower()}", *_at, text=_text)(partial(end_of_the_asymptote, gel=_gel))


def _moduli(gel, phi, phi_00: float, steps: int) -> np.ndarray:
    """mu_s from the energy over that of the gel at COLD, for WARMER temperatures and phi."""
    cold = COLD * gel.shear_modulus(phi_00)
    return np.array([modulus(gel, phi, T, phi_00, steps) for T in WARMER]) / cold


SHEARED = "gelpump.statements.derivations: free energy of an element in shear"


@states("mu-independent-of-phi", "appendix A", SHEARED)
def shear_modulus(e: Evidence) -> Computed:
    """The shear modulus does not depend on the polymer fraction, and grows with temperature."""
    phi, phi_00 = np.geomspace(1e-3, 0.9, 40), 0.05
    spread, growth, doubt = 0.0, np.inf, 1e3 * ROUNDING  # shear adds little to far larger energies
    for gel in (e.gels[name] for name in GELS):
        by_steps = partial(_moduli, gel, phi, phi_00)
        mu, error = refined(by_steps, 8)
        doubt = max(doubt, float(error.max()))
        spread = max(spread, float(np.abs(mu * COLD / WARMER[:, np.newaxis] - 1.0).max()))
        growth = min(growth, float(np.diff(mu, axis=0).min()))
    measured = "largest relative distance from phi_00^(1/3) k_B T/Omega_p, least growth in 5 K:"
    return Computed(
        holds(growth, doubt) and not holds(spread, doubt), [doubt] * 2, [spread, growth], measured
    )


@states("mu-chain-length", "appendix A", SHEARED, LINE)
def chain_length(e: Evidence) -> Computed:
    """The shear modulus increases with chain length, longer chains having a larger Omega_p: at one
    phi_00 it is more than once as large for chains of twice the length."""
    gel = e.gels["HHT"]
    longer, phi = (
        type(gel)(gel.name, gel.A0, gel.A1, gel.B0, gel.B1, 2.0 * gel.Omega),
        np.array([0.1]),
    )
    value, doubt = refined(
        lambda n: modulus(longer, phi, COLD, 0.05, n)[0] / modulus(gel, phi, COLD, 0.05, n)[0], 8
    )
    return Computed(holds(value - 1.0, doubt), float(doubt) + ROUNDING, float(value), "factor:",
                    "it falls as 1/Omega_p", {"value": True})  # fmt: skip


PRESSURES = "materials_{ANB,HHT}: osmotic_pressure"


@states("pi-negative-small-phi", "appendix A, figure 13", PRESSURES)
def ends_of_the_pressure(e: Evidence) -> Computed:
    """The osmotic pressure is slightly negative as phi -> 0 and diverges as phi -> 1."""
    Pi = [e.data[f"materials_{name}"].osmotic_pressure.values for name in GELS]
    negative = max(float(each[:, 0].max()) for each in Pi)
    growth = min(float((each[:, -1] - each[:, -2]).min()) for each in Pi)
    doubt = ROUNDING * max(float(np.abs(each).max()) for each in Pi)
    measured = "largest Pi at the smallest phi, in k_B T/Omega_f:"
    return Computed(holds(min(-negative, growth), doubt), doubt, negative, measured)


REFERENCE = "bead_drying_lens: polymer_fraction"


@states("diffusivity-reference-state", "eqn:lens_transport", REFERENCE, LINE)
def reference_state(e: Evidence) -> Computed:
    """The elastic part of D is (4/3) mu_s (phi/phi_0)^(1/3); here D in mu_s k/mu_l at the start and
    the end of drying."""
    gel, bead = e.gels["HHT"], e.data["bead_drying_lens"]
    phi_00, T = float(bead.polymer_fraction[0, 0]), float(bead.attrs["temperature"])
    phi_0 = float(bead.polymer_fraction[-1].mean())
    phi, mu = np.array([phi_00, phi_0]), gel.shear_modulus(phi_00)

    def derived(n):  # phi d/dphi of what div sigma = 0 balances grad p with, by eqn:div_xi
        def balance(phi):
            return gel.osmotic_pressure(phi, T) + 4.0 * mu * np.cbrt(phi / phi_00)

        h = phi / n
        return phi * (balance(phi + h) - balance(phi - h)) / (2.0 * h) / mu

    value, doubt = refined(derived, 500)
    printed = gel.osmotic_modulus(phi, T) / mu + 4.0 / 3.0 * np.cbrt(phi / phi_0)
    follows = "the derivation gives phi_00, as in eqn:tube_evolution"
    rounding = rounding_error(gel.diffusivity, phi, T) / mu
    paper = {"value": printed, "resolution": rounding}
    return Computed(value, doubt, follows=follows, paper=paper)
