"""Flow through the tube's wall and in its lumen (sections 3.6.1 and 3.6.2, appendix B)."""

import numpy as np

from gelpump.statements.statement import IDENTITY, LINE, Collection, Computed, Evidence, holds
from gelpump.statements.tubes import DRAWN_ELL, FOR_ELL, of_figure, of_prefactor, relative, slope
from gelpump.uncertainty import rounding_error

statements = Collection()
states = statements.states
PULSE = "lumen_pulse"
LATE = 0.1  # tau


@states(
    "flow-out-behind-in-ahead", "section 3.6.1, figures 10, 11", "water_budget: outer_rate_printed"
)
def direction_of_flow(e: Evidence) -> Computed:
    """Water leaves through the outer wall behind the front and enters ahead of it."""
    budget = e.data["water_budget"]
    doubt = float(np.abs(budget.shed_volume_error / budget.shed_volume).max())
    outer = budget.outer_rate_printed.where(budget.tau >= 1e-3, drop=True)
    inwards = float(min(outer.isel(side=0).min(), -outer.isel(side=1).max()))
    margin = inwards / float(np.abs(outer).max())
    return Computed(
        holds(margin, doubt), doubt, margin, "smaller of the two flows over the largest flow:"
    )


@states(
    "radial-dominates-thin", "section 3.6.1, figure 11", "water_budget: radial_to_axial_velocity"
)
def radial_dominance(e: Evidence) -> Computed:
    """Radial velocities dominate axial ones more in the thinner wall."""
    ratio = of_figure(e.data["water_budget"], tau=0.025).radial_to_axial_velocity.values
    doubt = relative(e.data["refinement/tube_pulse"], "radial_to_axial_velocity")
    thick, thin = DRAWN_ELL.index(0.25), DRAWN_ELL.index(0.75)
    return Computed(
        holds(ratio[thin] / ratio[thick] - 1.0, 2.0 * doubt),
        doubt * ratio,
        ratio,
        f"largest radial over largest axial velocity {FOR_ELL}:",
        "both velocities grow as (1-ell)^-1, so that their ratio hardly changes, and falls",
    )


@states(
    "interstitial-velocity",
    "eqn:ug, section 3.6.2",
    "tube_flow_whole: polymer_fraction, u_r_without_Phi1",
    LINE,
)
def interstitial_factor(e: Evidence) -> Computed:
    """U_g is D dPhi_2/dR, as the section on the lumen prints it and not eqn:ug; here at the inner
    edge where it is fastest."""
    flow = e.data["tube_flow_whole"]
    hot = np.where(flow.Z < flow.Z_C, 1.0, -1.0)
    D = e.gels["tube"].diffusivity(flow.Phi1.values, hot)

    def derived(stride):  # (D/Phi_1) dPhi/dR / eps^2 by differences, at the inner edge
        radius, Phi = (flow[name].values[:, ::stride] for name in ("radius", "polymer_fraction"))
        h = radius[:, 1] - radius[:, 0]
        at_edge = (-1.5 * Phi[:, 0] + 2.0 * Phi[:, 1] - 0.5 * Phi[:, 2]) / h
        return D / flow.Phi1.values * at_edge / float(flow.eps) ** 2

    fine, coarse = derived(1), derived(2)
    fastest = int(np.argmax(np.abs(fine)))
    doubt = abs(fine[fastest] - coarse[fastest]) + 1e-9 * abs(fine[fastest])
    return Computed(
        float(fine[fastest]),
        float(doubt),
        float(flow.u_r[fastest, 0]),
        "as eqn:ug has it:",
        "eqn:ug is right: the printed one is Phi_1 times too large",
        {"value": float(flow.u_r_without_Phi1[fastest, 0]), "resolution": 0.0},
    )


@states("figure-10-ell", "figure 10", "config: published", LINE)
def tube_of_figure_10(e: Evidence) -> Computed:
    """Figure 10 shows the tube of its caption; computed is what it draws."""
    read = e.published["figure-10-ell"]
    return Computed(read["drawn"], read["drawn_resolution"], follows="another tube is drawn")


@states("lumen-peak-at-front", "section 3.6.2, figure 12a", f"{PULSE}: Z_highest_printed")
def place_of_the_peak(e: Evidence) -> Computed:
    """The axial velocity of eqn:lumen is largest at Z_C, in every solved tube."""
    offset = float(np.abs(e.data["lumen_pulse"].Z_highest_printed).max())
    pulse = e.data["tube_pulse"]
    doubt = float(pulse.front_error.max()) + np.finfo(float).eps * float(pulse.Z_C.max())
    return Computed(not holds(offset, doubt), doubt, offset, "distance of the largest V from Z_C:")


def _plotted(e, name: str) -> Computed:
    at = e.data["lumen_pulse"].sel(A=float(e.data["lumen_pulse"].drawn_A), method="nearest")
    return Computed(float(at[name]), float(at[f"{name}_uncertainty"]))


@states("lumen-peak-height", "section 3.6.2, figure 12a", f"{PULSE}: V_max_plotted")
def height_of_the_peak(e: Evidence) -> Computed:
    """Largest axial velocity for A = 100, without the prefactor of eqn:lumen."""
    return _plotted(e, "V_max_plotted")


@states("lumen-far-nonzero", "section 3.6.2, figure 12a", f"{PULSE}: V_far_plotted")
def velocity_far_ahead(e: Evidence) -> Computed:
    """Axial velocity far ahead of the front for A = 100, without the prefactor of eqn:lumen."""
    return _plotted(e, "V_far_plotted")


@states("lumen-peak-product", "figure 12b", f"{PULSE}: V_max_plotted", IDENTITY)
def product_of_the_peak(e: Evidence) -> Computed:
    """A V_max without the prefactor, at the A of figure 12a: the tanh form depends on A (Z - Z_C)
    only, so that this is lumen-peak-height again."""
    peak, A = _plotted(e, "V_max_plotted"), float(e.data["lumen_pulse"].drawn_A)
    return Computed(A * peak.value, A * peak.uncertainty)


@states("figure-12-prefactor", "figure 12, eqn:lumen", f"{PULSE}: V_max", LINE)
def prefactor(e: Evidence) -> Computed:
    """Figure 12a draws V of eqn:lumen; here the largest for A = 100."""
    at = e.data["lumen_pulse"].sel(A=float(e.data["lumen_pulse"].drawn_A), method="nearest")
    fit, A = e.data["front_fit"], float(at.A)
    n, of_n = float(fit.exponent), float(fit.exponent_uncertainty)
    lever = abs(np.log(A / float(fit.prefactor))) / n**2  # V ~ (1-ell)^-2, 1-ell = (A/c)^(-1/n)
    doubt = 2.0 * (of_prefactor(fit) / n + lever * of_n) * float(at.V_max)
    before = 8.0 / (e.tube["eps"] * float(at.one_minus_ell)) ** 2
    return Computed(
        float(at.V_max),
        doubt,
        before,
        "8/(eps^2 (1-ell)^2) of the tube with this A:",
        "the figure is drawn without the prefactor",
        e.published["lumen-peak-height"],
    )


@states("Vmax-exponent", "figure 12b", f"{PULSE}: V_front_printed, data/front_fit.nc: A")
def law_of_the_peak(e: Evidence) -> Computed:
    """Power of A that V_max follows without the prefactor, in the solved tubes."""
    fit = e.data["front_fit"]
    at = of_figure(e.data["lumen_pulse"], tau=float(fit.fit_tau))
    bare = at.V_front_printed * (1.0 - at.ell) ** 2
    doubt = relative(e.data["refinement/tube_pulse"], "V_front_printed", "A")
    return Computed(*slope(of_figure(fit).A, bare, doubt))


@states("pulse-flux-constant", "section 3.6.2", f"{PULSE}: pulse_flux")
def flux_of_the_pulse(e: Evidence) -> Computed:
    """Power of 1 - ell that the flux of the pulse follows: none, it is constant (eqn:lumen)."""
    late = of_figure(e.data["lumen_pulse"], tau=LATE)
    doubt = relative(e.data["refinement/tube_pulse"], "pulse_flux")
    spread = float(np.ptp(late.pulse_flux.values) / late.pulse_flux.mean())
    return Computed(
        *slope(1.0 - late.ell, late.pulse_flux, doubt), spread, f"relative spread {FOR_ELL}:"
    )


@states("lumen-height-vs-ell", "section 3.6.2, figure 12", f"{PULSE}: V_front_printed")
def height_and_thickness(e: Evidence) -> Computed:
    """Sign of the power of 1 - ell that the height of the pulse follows, from eqn:lumen (text:
    grows with ell; caption: V_max ~ 1 - ell)."""
    late = of_figure(e.data["lumen_pulse"], tau=LATE)
    doubt = relative(e.data["refinement/tube_pulse"], "V_front_printed")
    power, doubt = slope(1.0 - late.ell, late.V_front_printed, doubt)
    return Computed(
        float(np.sign(power)) if abs(power) > doubt else 0.0,
        doubt,
        power,
        "the power:",
        f"with its prefactor V_max follows (1-ell)^{power:.2f}: the text is right, the figure is "
        "without the prefactor",
    )


def _ratio(e, above: str, below: str, doubts: tuple[str, ...], extra: float = 0.0) -> tuple:
    late = of_figure(e.data["lumen_pulse"], tau=LATE)
    ratio = (late[above] / late[below]).values
    return ratio, (relative(e.data["refinement/tube_pulse"], *doubts) + extra) * ratio


@states("lumen-matching", "eqn:lumen", f"{PULSE}: V_front_printed, V_front_matched", LINE)
def lumen_matching(e: Evidence) -> Computed:
    """U and V of eqn:lumen follow from matching the velocity U_g at R = B_0: printed over matched V
    at Z_C is 1."""
    names = "V_front_printed", "V_front_matched"
    follows = "matching gives C = -4 ((1-ell)/ell) D (Phi_0 - Phi_1) Phi_1^(-1/3) / (eps (1-ell))^2"
    return Computed(*_ratio(e, *names, names), follows=follows, paper={"value": 1.0})


@states(
    "lumen-continuity",
    "section 3.6.2, appendix B",
    f"{PULSE}: V_front_moving, V_front_matched",
)
def lumen_continuity(e: Evidence) -> Computed:
    """The lumen's radial velocity equals the flux relative to the wall: V with the wall's motion
    over V without it at Z_C is 1."""
    names = "V_front_moving", "V_front_matched"
    follows = (
        "what is continuous is q = u + u_p: the wall's own motion adds a term as large as the rest"
    )
    return Computed(*_ratio(e, *names, names), follows=follows, paper={"value": 1.0})


@states("tanh-lumen-velocity", "section 3.6.2, figure 12", f"{PULSE}: V_far_printed, V_far_tanh")
def tanh_velocities(e: Evidence) -> Computed:
    """The tanh form, from which figure 12 is computed, gives the velocity of the solved tubes: V of
    eqn:lumen far ahead, solved over tanh, is 1."""
    of_tanh = relative(e.data["front_fit"], "A")  # V ~ 1/A
    far, doubt = _ratio(e, "V_far_printed", "V_far_tanh", ("V_far_printed",), of_tanh)
    peak, _ = _ratio(e, "V_front_printed", "V_front_tanh", ("V_front_printed",), of_tanh)
    follows = f"{far.min():.1f} to {far.max():.1f} times the velocity far ahead"
    return Computed(far, doubt, peak, "the same of the peaks:", follows, {"value": 1.0})


@states("coupling-G", "appendix B", "config: scales, eqn:app:full_interior_bc")
def lumen_coupling(e: Evidence) -> Computed:
    """Lumen and gel uncouple for every a_1 above the stated smallest one: the term that G = k/a_1^2
    stands for is of order eps^2."""
    ell, M, known = 0.25, e.gels["tube"].M, (e.scales["permeability"], e.scales["smallest_radius"])

    def neglected(permeability, radius):  # dPhi_2/dR = -4 Phi_2/(1-ell), D = 1 + 4M/3, B_0 = ell
        return 8.0 * permeability / radius**2 * (1.0 + 4.0 * M / 3.0) / (ell * (1.0 - ell))

    size, doubt = float(neglected(*known)), float(rounding_error(neglected, *known))
    order = e.tube["eps"] ** 2
    enough = known[1] * np.sqrt(size / order)
    return Computed(
        not holds(size - order, doubt),
        doubt,
        size,
        f"neglected over kept term at the smallest a_1, ell = {ell:g}:",
        f"G is {known[0] / known[1] ** 2:.2g} there; the term is eps^2 at a_1 = {enough:.1g} m",
    )
