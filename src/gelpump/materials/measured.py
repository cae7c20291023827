"""A gel known by measured equilibria phi_0(T), fitted to the energy-based form (appendix A).

At an equilibrium eqn:phi_0_full says, with w = 1/Omega and -ln(1-phi) - phi written as t(phi),

    r = t(phi)/phi^2 + w (phi - phi^{1/3})/phi^2 - (A0-A1) - (B0-B1) T - 2 phi (A1 + B1 T) = 0 ,

linear in the five parameters. The fit minimises the sum of r^2/s^2, s^2 = (r_phi s_phi)^2 +
(r_T s_T)^2, which is the orthogonal distance of the points from the curve to first order. (Weighted
linear least squares, from which it starts, would be biased: phi and T with their errors stand in
both r and its slopes.) The covariance follows from the slopes of r/s at the minimum; where errors
are not given, it is scaled by the scatter.
"""

import csv
import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .energy_based import EnergyBasedGel
from .explicit import log_tail

NAMES = ("A0", "A1", "B0", "B1", "Omega")
COLUMNS = ("temperature", "polymer_fraction")
ERRORS = ("temperature_error", "polymer_fraction_error")
FEWEST, MOST = 6, 10_000
COLDEST, HOTTEST = 200.0, 500.0  # K: outside, the column is hardly in kelvin
USUAL_ERROR = {"temperature_error": 0.1, "polymer_fraction_error": 0.01}  # second one relative
COLLAPSED = 0.25  # polymer fraction: above it a gel counts as collapsed
FAR = 5.0  # standard errors, or scatters, from a stable branch, at which a point is not on it


@dataclass(frozen=True)
class Points:
    """Measured T (K) and phi_0 with their errors; whether these were given."""

    T: NDArray
    phi: NDArray
    T_error: NDArray
    phi_error: NDArray
    errors_given: bool


@dataclass(frozen=True)
class Fit:
    """The gel, the covariance of NAMES, chi^2 per degree of freedom, and what to beware of."""

    gel: EnergyBasedGel
    covariance: NDArray
    reduced_chi2: float
    warnings: tuple[str, ...]

    @property
    def parameters(self) -> NDArray:
        """The values of NAMES."""
        return np.array([getattr(self.gel, name) for name in NAMES])

    @property
    def errors(self) -> NDArray:
        """Their standard errors."""
        return np.sqrt(np.diag(self.covariance))


def read(path: str | Path) -> Points:
    """The points of a CSV with the columns temperature (K) and polymer_fraction, and, if known,
    temperature_error (K) and polymer_fraction_error.

    ValueError, with the line, for anything else.
    """
    try:
        with open(path, encoding="utf-8-sig", newline="") as stream:
            text = stream.read(10_000_000)
        lines = list(csv.reader(text.splitlines(), strict=True))
    except (OSError, UnicodeError, csv.Error) as problem:
        raise ValueError(f"{path}: cannot be read: {problem}") from problem
    rows = [(i, line) for i, line in enumerate(lines, 1) if line and not line[0].startswith("#")]
    if not rows:
        raise ValueError(f"{path}: is empty; must begin with the columns {', '.join(COLUMNS)}")
    number, heading = rows[0]
    names = [name.strip() for name in heading]
    known = {*COLUMNS, *ERRORS}
    if len(set(names)) != len(names) or not set(COLUMNS) <= set(names) <= known:
        raise ValueError(
            f"{path}, line {number}: columns {names}: must be {list(COLUMNS)}, "
            f"and may be {list(ERRORS)}"
        )
    found = {name: [] for name in names}
    for number, row in rows[1:]:
        if len(row) != len(names):
            raise ValueError(f"{path}, line {number}: {len(row)} values: must be {len(names)}")
        for name, cell in zip(names, row, strict=True):
            found[name].append(_number(path, number, name, cell))
    count = len(rows) - 1
    if not FEWEST <= count <= MOST:
        raise ValueError(f"{path}: {count} points: must be {FEWEST} to {MOST}")
    T, phi = (np.array(found[name]) for name in COLUMNS)
    given = all(name in found for name in ERRORS)
    T_error = np.array(found.get(ERRORS[0], np.full(count, USUAL_ERROR[ERRORS[0]])))
    phi_error = np.array(found.get(ERRORS[1], USUAL_ERROR[ERRORS[1]] * phi))
    return Points(T, phi, T_error, phi_error, given)


def _number(path, line, name, cell):
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    allowed = {
        "temperature": (COLDEST <= value <= HOTTEST, f"kelvin, {COLDEST:g} to {HOTTEST:g}"),
        "polymer_fraction": (0 < value < 1, "greater than 0 and less than 1"),
    }
    inside, text = allowed.get(name, (0 < value < math.inf, "a number greater than 0"))
    if not inside:
        raise ValueError(f"{path}, line {line}: {name} = {cell[:40]!r}: must be {text}")
    return value


def fit(name: str, points: Points, temperature_range=None) -> Fit:
    """The energy-based gel through the points; ValueError if they do not determine one."""
    from scipy.optimize import least_squares

    middle = points.T.mean()
    T, phi = points.T - middle, points.phi
    free = log_tail(phi, 2) / phi**2
    chain = (phi - np.cbrt(phi)) / phi**2
    one = np.ones_like(phi)
    columns = np.column_stack([-chain, one, T, 2 * phi, 2 * phi * T])  # of w, c0, c1, A1', B1
    step = 1e-6 * phi * (1 - phi)

    def of_phi(f):
        return log_tail(f, 2) / f**2, (f - np.cbrt(f)) / f**2

    (up, up_chain), (down, down_chain) = of_phi(phi + step), of_phi(phi - step)
    free_slope, chain_slope = (up - down) / (2 * step), (up_chain - down_chain) / (2 * step)

    def residual(p):
        w, _, c1, A1, B1 = p
        along = free_slope + w * chain_slope - 2 * (A1 + B1 * T)
        spread = np.hypot(along * points.phi_error, (c1 + 2 * phi * B1) * points.T_error)
        return (free - columns @ p) / spread, spread

    missing = missing_state(points)
    refused = f"{name}: the points do not determine five parameters: " + (
        missing or "they must cover several temperatures and, best, both states"
    )
    if (
        np.linalg.matrix_rank(
            columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-300), tol=1e-10
        )
        < 5
    ):
        raise ValueError(refused)
    spread = one
    for _ in range(8):
        p = np.linalg.lstsq(columns / spread[:, None], free / spread, rcond=None)[0]
        spread = residual(p)[1]
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
    inverse = np.linalg.solve(R, np.linalg.pinv(best.jac))
    covariance = inverse @ inverse.T
    freedom = len(phi) - 5
    chi2 = float((best.fun**2).sum() / max(freedom, 1))
    if not points.errors_given:
        covariance = covariance * chi2
    w, c0, c1, A1c, B1 = p
    # from w, c0, c1, A1, B1 about the middle temperature to NAMES
    values = {"A1": A1c - B1 * middle, "B1": B1, "B0": c1 + B1, "Omega": 1 / w}
    values["A0"] = c0 - c1 * middle + values["A1"]
    turn = np.array(
        [
            [0, 1, -middle, 1, -middle],
            [0, 0, 0, 1, -middle],
            [0, 0, 1, 0, 1],
            [0, 0, 0, 0, 1],
            [-(w**-2), 0, 0, 0, 0],
        ]
    )
    covariance = turn @ covariance @ turn.T
    span = temperature_range or (float(points.T.min() - 5), float(points.T.max() + 5))
    gel = EnergyBasedGel(name, **{key: float(values[key]) for key in NAMES}, temperature_range=span)
    scatter = 1.0 if points.errors_given else max(1.0, 1.4826 * float(np.median(np.abs(best.fun))))
    _require_stable(gel, points, scatter, missing)
    return Fit(gel, covariance, chi2, tuple(_warnings(gel, covariance, chi2, points)))


def missing_state(points: Points) -> str:
    """In words, which of the two states no point is in; "" if both are there."""
    for state, missing in (
        ("collapsed", np.all(points.phi < COLLAPSED)),
        ("swollen", np.all(points.phi > COLLAPSED)),
    ):
        if missing:
            return (
                f"the {state} state is missing (phi from {points.phi.min():.3g} to "
                f"{points.phi.max():.3g}, none {'above' if state == 'collapsed' else 'below'} "
                f"{COLLAPSED:g})"
            )
    return ""


def _require_stable(gel, points, scatter, missing):
    """ValueError unless each point lies within FAR times its error of a stable branch.

    The distance is that to the drawn curve, in errors; they are multiplied by ``scatter``.
    """
    phi = np.concatenate([np.geomspace(1e-5, 0.05, 2000), np.linspace(0.05, 0.9999, 20_000)])
    phi = np.sort(np.concatenate([phi, points.phi]))
    T = gel.equilibrium_temperature(phi)
    stable = (gel.osmotic_modulus(phi, T) > 0) & (T > 0)
    for t, f, *errors in zip(points.T, points.phi, points.T_error, points.phi_error, strict=True):
        distance = np.hypot((T - t) / errors[0], (phi - f) / errors[1]) / scatter
        nearest = distance[stable].min(initial=np.inf)
        if nearest > FAR and not stable[distance.argmin()]:
            raise ValueError(
                f"{gel.name}: the point at {t:g} K, phi = {f:g} lies on the unstable branch of the "
                f"best fit, {nearest:.3g} errors away from a stable one: what is measured is "
                "stable, so this form cannot represent these points" + (missing and f"; {missing}")
            )


def _warnings(gel, covariance, chi2, points):
    for name, error in zip(NAMES, np.sqrt(np.diag(covariance)), strict=True):
        value = getattr(gel, name)
        if error > abs(value) / 2:
            yield f"{name} = {value:.4g} is not identified: its standard error is {error:.2g}"
    if missing := missing_state(points):
        yield f"{missing}: what the fit says of it is extrapolated"
    if points.errors_given and not 0.3 < chi2 < 3:
        yield f"chi^2 per degree of freedom is {chi2:.2g}: the form or the errors do not fit"
    if not points.errors_given:
        yield "errors were not given for both columns: they are estimated from the scatter"
        if chi2 > 3:
            usual = "{temperature_error:g} K and {polymer_fraction_error:.0%}".format(**USUAL_ERROR)
            yield (
                f"the points scatter about the fit {chi2**0.5:.2g} times as far as errors of "
                f"{usual} would: the points scatter or the form does not fit"
            )
    T = np.sort(gel.folds().temperature)
    if len(T) > 1 and not _both_branches(gel, points, T[0], T[-1]):
        yield (
            f"the fit has a hysteresis from {T[0]:.2f} to {T[-1]:.2f} K, but no temperature is "
            "measured in both states there"
        )


def _both_branches(gel, points, low, high):
    """Whether points of both states lie within the temperatures of the hysteresis."""
    within = (low <= points.T) & (high >= points.T)
    middle = gel.folds().polymer_fraction.mean()
    return len(set(points.phi[within] > middle)) == 2


def find(points: str, folders) -> Path:
    """The file of points, relative to the first of the folders that has it."""
    for folder in folders:
        if (path := Path(folder) / points).is_file():
            return path
    raise ValueError(f"points = {points!r}: no such file in {[str(f) for f in folders]}")


def resolve(
    gels: dict, folders=(".",), warn: Callable[[str], None] = warnings.warn
) -> dict[str, str]:
    """Put the fitted energy-based block in place of each measured one; the files they came from.

    ``warn`` gets what there is to beware of. ValueError, with the gel, for points that are refused.
    """
    files = {}
    for name, block in gels.items():
        if not isinstance(block, dict) or block.get("model") != "measured":
            continue
        extra = set(block) - {"model", "points", "temperature_range"}
        if extra or not isinstance(block.get("points"), str):
            raise ValueError(
                f"{name}: measured takes points, the path of a CSV, and temperature_range, "
                f"not {sorted(extra)}"
            )
        try:
            path = find(block["points"], folders)
            found = fit(name, read(path), block.get("temperature_range"))
        except ValueError as refusal:
            said = str(refusal).removeprefix(f"{name}: ")
            raise ValueError(f"{name}: {said}") from refusal
        for text in found.warnings:
            warn(f"gel {name}: {text}")
        gel = found.gel
        files[name] = path.as_posix()
        gels[name] = {"model": "energy-based"} | {key: getattr(gel, key) for key in NAMES}
        gels[name]["temperature_range"] = list(gel.temperature_range)
    return files
