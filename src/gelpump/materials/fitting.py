"""One form of gel through measured equilibria, and what the points leave open of it.

At an equilibrium Pi = 0 says, with w = 1/Omega, s = T or 1/T and t(phi) = -ln(1-phi) - phi,

    r = [t + w (kappa phi - phi^{1/3})]/phi^2 - (p_1 + q_1 s) - phi (p_2 + q_2 s) - phi^2 p_3 = 0 ,

linear in the parameters. The fit minimises chi^2, the sum of r^2/S^2, S^2 = (r_phi s_phi)^2 +
(r_T s_T)^2, which is the orthogonal distance of the points from the curve to first order. (Weighted
linear least squares, from which it starts, would be biased: phi and T with their errors stand in
both r and its slopes.) The covariance follows from the slopes of r/S at the minimum; where errors
are not given, it is scaled by the scatter, and S only weighs.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .energy_based import EnergyBasedGel
from .explicit import ExplicitGel, log_tail
from .fit_checks import missing_state, require_stable, usual, warnings
from .flory_rehner import GAS_CONSTANT, LOGARITHM, FloryRehnerGel
from .measurements import Points

WORST = 25.0  # chi^2 per degree of freedom beyond which a form does not represent the points
NAMES = ("A0", "A1", "B0", "B1", "Omega")  # of the form appendix-A
DRAWS = 200  # of a bootstrap


@dataclass(frozen=True)
class Form:
    """A family: whether s = 1/T, and which of p_1, q_1, p_2, q_2, p_3 are free."""

    inverse: bool
    free: tuple[int, ...]


FORMS = {
    "linear": Form(False, (0, 1, 2)),
    "theta": Form(True, (0, 1, 2)),
    "linear-3": Form(False, (0, 1, 2, 4)),
    "theta-3": Form(True, (0, 1, 2, 4)),
    "appendix-A": Form(False, (0, 1, 2, 3)),
}
COEFFICIENTS = ("chi_1", "chi_1_slope", "chi_2", "chi_2_slope", "chi_3")


@dataclass(frozen=True)
class Fit:
    """The gel, the covariance of its parameters, chi^2 per degree of freedom, the residuals in
    errors, Bayes' criterion, what to beware of, and why other forms were not taken."""

    gel: ExplicitGel
    form: str
    covariance: NDArray
    reduced_chi2: float
    residuals: NDArray
    criterion: float
    network: tuple[str, float]
    warnings: tuple[str, ...] = ()
    passed_over: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters, in the order of the covariance."""
        return names(self.form)

    @property
    def parameters(self) -> NDArray:
        """Their values."""
        known = self.gel.parameters
        return np.array([known[name][0] if name in known else 0.0 for name in self.names])

    @property
    def errors(self) -> NDArray:
        """Their standard errors."""
        return np.sqrt(np.diag(self.covariance))

    def block(self, parameters: NDArray | None = None) -> dict[str, Any]:
        """The config block of the gel, or of one with these parameters."""
        given = self.parameters if parameters is None else parameters
        span = list(self.gel.temperature_range)
        values = dict(zip(self.names, map(float, given), strict=True))
        if self.form == "appendix-A":
            return {"model": "energy-based"} | values | {"temperature_range": span}
        kind, phi_ref = self.network
        pair = ("enthalpy", "entropy") if FORMS[self.form].inverse else ("constant", "slope")
        p, q = values["chi_1"], values["chi_1_slope"]
        both = (GAS_CONSTANT * q, -GAS_CONSTANT * p) if FORMS[self.form].inverse else (p, q)
        chi = {"chi_1": dict(zip(pair, both, strict=True)), "chi_2": values["chi_2"]}
        share = 0.5 if kind == "phantom" else 1.0  # of four chains a junction
        return {
            "model": "flory-rehner",
            "chi": chi | ({"chi_3": values["chi_3"]} if "chi_3" in values else {}),
            "network": {
                "elasticity": kind,
                "reference_polymer_fraction": phi_ref,
                "chain_length": values["Omega"] * share * phi_ref ** (2 / 3),
            },
            "temperature_range": span,
        }


def names(form: str) -> tuple[str, ...]:
    """The parameters of a form."""
    if form == "appendix-A":
        return NAMES
    return (*(COEFFICIENTS[i] for i in FORMS[form].free), "Omega")


def fit(
    name: str,
    points: Points,
    temperature_range=None,
    form: str = "appendix-A",
    network: tuple[str, float] = ("neo-Hookean", 1.0),
    checked: bool = True,
) -> Fit:
    """The gel of one form through the points; ValueError if they do not determine one, or, when
    ``checked``, if the form does not represent them.

    network: kind of elasticity and the polymer fraction at which the chains are relaxed.
    """
    from scipy.optimize import least_squares

    missing = missing_state(points)
    count = len(FORMS[form].free) + 1
    refused = f"{name}: the points do not determine {_counted(count)} parameters: " + (
        missing or "they must cover several temperatures and, best, both states"
    )
    inverse, free = FORMS[form].inverse, list(FORMS[form].free)
    kappa = LOGARITHM[network[0]] * network[1] ** (-2 / 3)
    T, phi = points.T, points.phi
    s = 1 / T if inverse else T
    middle = 1 / T.mean() if inverse else T.mean()
    u, du = s - middle, -1 / T**2 if inverse else np.ones_like(T)
    mixing = log_tail(phi, 2) / phi**2
    mixing_slope = 1 / (1 - phi) - 2 * log_tail(phi, 3) / phi**3
    chain = kappa / phi - phi ** (-5 / 3)
    chain_slope = -kappa / phi**2 + 5 / 3 * phi ** (-8 / 3)
    one = np.ones_like(phi)
    columns = np.column_stack([-chain, *np.array([one, u, phi, phi * u, phi**2])[free]])
    zero = 0 * one
    by_phi = np.column_stack([chain_slope, *-np.array([zero, zero, one, u, 2 * phi])[free]])
    by_T = np.column_stack([zero, *-np.array([zero, one, zero, phi, zero])[free]]) * du[:, None]

    def residual(p):
        along = (mixing_slope + by_phi @ p) * points.phi_error
        spread = np.hypot(along, (by_T @ p) * points.T_error)
        return (mixing - columns @ p) / spread, spread

    norm = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    if np.linalg.matrix_rank(columns / norm, tol=1e-10) < count:
        raise ValueError(refused)
    spread = one
    for _ in range(8):
        p = np.linalg.lstsq(columns / spread[:, None], mixing / spread, rcond=None)[0]
        spread = residual(p)[1]
        if not np.all(np.isfinite(spread) & (spread > 0)):
            raise ValueError(refused)
    _, R = np.linalg.qr(columns / spread[:, None])
    if np.linalg.cond(R / np.linalg.norm(R, axis=0)) > 1e10:
        raise ValueError(refused)
    try:
        best = least_squares(
            lambda q: residual(np.linalg.solve(R, q))[0], R @ p, xtol=1e-13, ftol=1e-13, gtol=1e-13,
            max_nfev=400,
        )  # fmt: skip
    except (ValueError, np.linalg.LinAlgError) as problem:
        raise ValueError(f"{name}: the points cannot be fitted: {problem}") from problem
    p = np.linalg.solve(R, best.x)
    if not p[0] > 0:
        if missing:
            raise ValueError(refused)
        raise ValueError(f"{name}: the points give 1/Omega = {p[0]:.3g}: must be greater than 0")
    inverse_R = np.linalg.solve(R, np.linalg.pinv(best.jac))
    freedom, chi2 = len(phi) - count, float((best.fun**2).sum())
    reduced = chi2 / max(freedom, 1)
    covariance = inverse_R @ inverse_R.T * (1.0 if points.errors_given else reduced)
    coefficients, turn = _uncentred(p, free, middle)
    span = temperature_range or (float(T.min() - 5), float(T.max() + 5))
    if form == "appendix-A":
        p_1, q_1, p_2, q_2, _ = coefficients
        half = np.array([[1, 0, 0.5, 0], [0, 0, 0.5, 0], [0, 1, 0, 0.5], [0, 0, 0, 0.5]])
        turn[:-1] = half @ turn[:-1]
        values = (p_1 + p_2 / 2, p_2 / 2, q_1 + q_2 / 2, q_2 / 2)
        gel: ExplicitGel = EnergyBasedGel(name, *map(float, values), 1 / float(p[0]), span)
    else:
        p_1, q_1, p_2, q_2, p_3 = map(float, coefficients)
        gel = FloryRehnerGel(name, (p_1, p_2, p_3), (q_1, q_2, 0.0), inverse, 1 / float(p[0]),
                             kappa, temperature_range=span)  # fmt: skip
    if checked:
        scatter = max(1.0, 1.4826 * float(np.median(np.abs(best.fun))))
        require_stable(gel, points, 1.0 if points.errors_given else scatter, missing)
        if reduced > WORST:
            raise ValueError(
                f"{name}: the points lie {reduced**0.5:.3g} times their errors away from the best "
                f"fit{'' if points.errors_given else usual()}: this form cannot represent them, "
                "or they need larger errors" + (missing and f"; {missing}")
            )
    misfit = chi2 if points.errors_given else len(phi) * np.log(max(chi2, 1e-20))
    found = Fit(gel, form, turn @ covariance @ turn.T, reduced, best.fun,
                float(count * np.log(len(phi)) + misfit), network)  # fmt: skip
    return replace(found, warnings=tuple(warnings(found, points, missing)))


def _counted(count):
    return {4: "four", 5: "five"}[count]


def _uncentred(p, free, middle):
    """p_1, q_1, p_2, q_2, p_3 about s = 0; what turns w and the free ones into these and Omega."""
    whole = np.zeros((5, len(p)))
    whole[free, np.arange(1, len(p))] = 1.0
    for constant, slope in ((0, 1), (2, 3)):
        whole[constant] -= middle * whole[slope]
    last = np.zeros(len(p))
    last[0] = -(p[0] ** -2)
    return whole @ p, np.vstack([whole[free], last])


def bootstrap(found: Fit, points: Points, draws: int = DRAWS) -> tuple[NDArray, list[NDArray]]:
    """Parameters, (draws, parameters), and fold temperatures of each draw, of fits to points that
    lie on the fitted curve but for normal errors: those of the points, or what these scatter, where
    none are given. Every run draws the same. A draw whose fit is refused has nan and no folds.
    """
    random = np.random.default_rng(0)
    scale = 1.0 if points.errors_given else found.reduced_chi2**0.5
    parameters = np.full((draws, len(found.names)), np.nan)
    folds: list[NDArray] = []
    curve = _on_curve(found.gel, points)
    for i in range(draws):
        T, phi = (
            value + scale * error * random.normal(size=len(value))
            for value, error in zip(curve, (points.T_error, points.phi_error), strict=True)
        )
        folds.append(np.array([]))
        if np.any((phi <= 0) | (phi >= 1)):
            continue
        moved = replace(points, T=T, phi=phi)
        try:
            span = found.gel.temperature_range
            again = fit("draw", moved, span, found.form, found.network, checked=False)
        except ValueError:
            continue
        parameters[i], folds[i] = again.parameters, np.sort(again.gel.folds().temperature)
    return parameters, folds


def _on_curve(gel, points):
    """T and phi of the nearest points of the curve, in errors, by three steps to first order."""
    T, phi = points.T, points.phi
    for _ in range(3):
        h = 1e-5 * phi * (1 - phi)
        ends = gel.equilibrium_temperature(phi + h), gel.equilibrium_temperature(phi - h)
        along = (ends[0] - ends[1]) / (2 * h)
        # of points (T, phi) on the line T_eq(phi) + along (phi' - phi), the nearest one
        offset = points.T - gel.equilibrium_temperature(phi) - along * (points.phi - phi)
        size = points.T_error**2 + (along * points.phi_error) ** 2
        T = points.T - offset * points.T_error**2 / size
        phi = points.phi + offset * along * points.phi_error**2 / size
        phi = np.clip(phi, 1e-6, 1 - 1e-6)
    return T, phi
