"""Heat that the collapse consumes, and the printed heat equation.

`printed` is of the paper, `statements` go beyond it; what they rest on is derived in docs/heat.md.
"""

import numpy as np

from gelpump.materials.latent_heat import energy_pressure, latent_heat
from gelpump.statements.statement import LINE, Collection, Computed, Evidence, holds
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.stefan import tolerated

printed, statements = Collection(), Collection()
states = statements.states
HEAT, DOCS = "tube_heat", "docs/heat.md"
CALORIMETRY = {"value": 5.75, "resolution": 0.75}  # kJ per mol of repeat units of PNIPAM: 5 to 6.5
MOLE = 0.11316 / 1.1e3  # m^3 of dry PNIPAM to a mole of repeat units
HEATED = (304.0, 308.0)  # K, across the collapse of both gels
WARM = 0.95  # of Z_C that the front is to reach for the printed law of conduction to hold
BALANCE = 1e-8


def _last(e):
    return e.data[HEAT].isel(tau=-1) if HEAT in e.data else None


@states("heat-front-limit", DOCS, f"{HEAT}: front_over_diffusion, front_limit")
def front_limit(e: Evidence) -> Computed | None:
    """Z_C of a tube in a bath, in pipes and insulated tends to that of the similarity solution:
    over it, at the last time, it is 1, for each tube."""
    if (heat := _last(e)) is None:
        return None
    return Computed(
        (heat.front_over_diffusion / heat.front_limit).values,
        (heat.front_over_diffusion_uncertainty / heat.front_limit).values,
        (e.data[HEAT].front_over_diffusion[:, 0] / heat.front_limit).values,
        "at the first time:",
        paper={"value": 1.0, "resolution": 1e-3},
    )


@states("heat-energy", DOCS, f"{HEAT}: energy_balance_error")
def energy(e: Evidence) -> Computed | None:
    """The tubes keep their heat: what was conducted and carried in, given off and carried out is
    what they have gained."""
    if HEAT not in e.data:
        return None
    worst = float(e.data[HEAT].energy_balance_error.max())
    return Computed(
        holds(BALANCE - worst, 0.0),
        0.0,
        worst,
        "largest heat unaccounted for, over all that has passed:",
        paper={"value": True},
    )


@states("heat-decoupled", "section 3.5", f"{HEAT}: front_limit, f_St, surrounding")
def decoupled(e: Evidence) -> Computed | None:
    """The front of heat is that of conduction alone: Z_C/sqrt(Le tau) of eqn:temp_field_sol in a
    large bath, in pipes and with insulation, each latent heat (Le that of the tube)."""
    if (heat := _last(e)) is None:
        return None
    one, five = tolerated(0.01), tolerated(0.05)
    return Computed(
        heat.front_limit.values,
        heat.front_over_diffusion_uncertainty.values,
        heat.f_St.values,
        "f St:",
        f"in a pipe it is so to 1 % if f St p < {one:.2g}, to 5 % if f St p < {five:.2g}, "
        "whatever Le",
        {"value": FRONT_CONSTANT, "resolution": (1 - WARM) * FRONT_CONSTANT},
    )


@states("heat-large-lewis", "section 3.5", f"{HEAT}: front_limit, front_limit_large_Le")
def large_lewis(e: Evidence) -> Computed | None:
    """Le of the tube is large: the limit of each front over that for Le to infinity is 1."""
    if (heat := _last(e)) is None:
        return None
    return Computed(
        (heat.front_limit / heat.front_limit_large_Le).values,
        1e-10,
        follows="what circulates through the outside of an insulated front carries cold water into "
        "its hot side",
        paper={"value": 1.0, "resolution": 0.01},
    )


@states("heat-printed-front", "section 3.5, eqn:lens_heat_equation", f"{HEAT}: Z_C_printed")
def printed_front(e: Evidence) -> Computed | None:
    """With a large Le eqn:lens_heat_equation is that of conduction: solved with its term in T, for
    each N = T_C/Delta T, Z_C goes as tau to the power of 1/2 at the last times."""
    if HEAT not in e.data:
        return None
    heat = e.data[HEAT]
    span = np.log(heat.tau_printed.values[-1] / heat.tau_printed.values[-2])
    Z_C = heat.Z_C_printed.values[:, -2:]
    doubt = (heat.Z_C_printed_uncertainty.values[:, -2:] / Z_C).sum(axis=1) / span
    hottest = heat.theta_printed.values[:, -1]
    return Computed(
        np.log(Z_C[:, 1] / Z_C[:, 0]) / span,
        doubt,
        hottest,
        "highest (T - T_C)/Delta T:",
        "the printed term gives off heat, and the front feeds itself; with the water's enthalpy in "
        "the flux of energy the term is not there",
        {"value": 0.5, "resolution": 0.02},
    )


@states(
    "heat-printed-term",
    "eqn:lens_heat_equation",
    "gelpump.materials.latent_heat: U_v at phi_0(304 K)",
)
def printed_term(e: Evidence) -> Computed | None:
    """What stands beside Pi in the term with Dphi/Dt, over rho c T (water's rho c): 1 as printed;
    from the energies, with the water's enthalpy in the flux of energy, U_v (HHT, ANB)."""
    if HEAT not in e.data:
        return None
    found = []
    for name in ("HHT", "ANB"):
        gel, T = e.gels[name], HEATED[0]
        U_v = energy_pressure(gel, gel.equilibrium_polymer_fraction(T), T)
        found.append(float(U_v) / (4.18e6 * T))
    return Computed(
        found,
        np.abs(found) * 1e-9,
        follows="negative: the collapse takes heat up, where the printed term gives it off",
        paper={"value": 1.0, "resolution": 0.0},
    )


@states("heat-of-energies", "appendix A", "gelpump.materials.latent_heat: U between the equilibria")
def heat_of_energies(e: Evidence) -> Computed | None:
    """Latent heat of the collapse from 304 to 308 K by the energies, in kJ per mole of repeat units
    of PNIPAM (HHT, ANB); by calorimetry 5 to 6.5."""
    if HEAT not in e.data:
        return None
    found = []
    for name in ("HHT", "ANB"):
        gel = e.gels[name]
        phi = [gel.equilibrium_polymer_fraction(T, "dry") for T in HEATED]
        found.append(1e-3 * MOLE * latent_heat(gel, *phi, sum(HEATED) / 2))
    return Computed(
        found,
        np.abs(found) * 1e-9,
        follows="fitted to swelling they know no calorimeter: for use at constant temperature",
        paper=CALORIMETRY,
    )


def warming(carried: float, parcels: int = 1000) -> float:
    """d ln T/d ln phi of an insulated element of gel that shrinks to half its volume, parcel by
    parcel of water, which takes the share ``carried`` of its thermal energy along.

    Energies are those of rho c T alone: no heat of mixing, no work of Pi.
    """
    T, J = 300.0, 20.0
    parcel = J / 2 / parcels
    for _ in range(parcels):
        T, J = T * (J - carried * parcel) / (J - parcel), J - parcel
    return float(np.log(T / 300.0) / np.log(20.0 / J))


@printed.states(
    "printed-heat-term", "eqn:lens_heat_equation", "gelpump.statements.heat.warming", LINE
)
def printed_heat_term(e: Evidence) -> Computed | None:
    """Coefficient of T in the term with Dphi/Dt of eqn:lens_heat_equation, 1 as printed: that of an
    insulated element of gel whose departing water takes its thermal energy along."""
    return Computed(
        warming(1.0),
        1e-12,
        warming(0.0),
        "if the water left it behind (energy flux Q + mu J):",
        "the term goes if the flux of energy holds the water's enthalpy; with it a gel that "
        "collapses to twice its polymer fraction would double its absolute temperature",
        {"value": 1.0, "resolution": 0.0},
    )
