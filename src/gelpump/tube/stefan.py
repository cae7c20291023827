"""Where heat is conducted along a tube, and how far the front comes that a collapse consumes.

Temperature is uniform across the section that conducts, theta = (T - T_C)/Delta T, and gel and
water have one rho c and one kappa. In the units of `gelpump.tube.slender`, a slice dX of the tube
holds the capacity C dX, conducts with G and sends the share o of what its wall sheds out of the
section (`lumen_share` sigma, s the section of a pipe over pi a_1^2):

    bath       nothing the tube does is felt: theta is eqn:temp_field_sol, f = 0
    pipe       C = s lambda,     G = s/lambda,   o = 0                    f = (1-ell^2)/s
    insulated  C = lambda^3,     G = lambda,     o = (1-sigma)(1-ell^2)   f = 1-ell^2

f is the wall's share of the section. What the pipe's water does in return for the gel's motion, and
the lumen's for its collapse, is in the balance of volumes (`gelpump.tube.heated`).

Long after the start, tau >> w^2, the front is sharp and everything depends on
x = Z/(2 sqrt(Le tau)). With Z_C = 2 Lambda sqrt(Le tau), p = Phi_inf^(1/3), q = Phi_inf^(-2/3),

    hot   theta = 1 - erf(x)/erf(Lambda),     cold   theta = erfc(x + beta Lambda)/erfc(X) - 1,

X = (1 + beta) Lambda, and the latent heat, the flux conducted in less that conducted away, makes

    E S exp(-Lambda^2)/erf(Lambda) - exp(-X^2)/erfc(X) = sqrt(pi) Lambda f St p W .   (similarity)

    pipe       S = 1,  beta = 0
    insulated  S = q,  beta = (1-ell^2)(p-1) - ell^2 (1-q) - sigma (1-ell^2)(p-q):

section and conductance of the collapsed tube are q of the swollen one's, and volume flows past a
fixed station ahead at -beta Z_C': the swollen wall is drawn in, its lumen is pumped forwards.
E = W = 1 in a pipe, and where Le is large. The wall draws water in ahead of the front and sheds it
behind, even at rest (Q = -3 o lambda^2 K lambda_X): where that goes on through the outside, cold
water is carried into the hot side, and the flux of heat J = Le G theta_X obeys J_X = Q J/(Le G), so

    E = exp[-Gamma(lambda_hot)/Le] ,   Gamma(lambda) = 3 o Integral_lambda^1 lambda K dlambda ,
    W = Integral exp(-Gamma/Le) d(lambda^3) / (1 - 1/Phi_inf) .

St = rho L/(rho c Delta T), rho L being the heat that the collapse takes per volume of swollen gel.
Where the collapse gives off heat, f St p <= -1, there is no such front: docs/heat.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import lumen_share

SURROUNDINGS = ("bath", "pipe", "insulated")


@dataclass(frozen=True)
class Surrounding:
    """What conducts heat beside each of some tubes.

    kind: one of `SURROUNDINGS`, or one for each tube.  section: of a pipe, over pi a_1^2, at least
    1; not asked for otherwise.
    """

    kind: str | Sequence[str]
    section: ArrayLike = 1.0

    def __post_init__(self):
        kinds = np.atleast_1d(np.asarray(self.kind, str))
        for each in kinds:
            if each not in SURROUNDINGS:
                raise ValueError(
                    f"surrounding = {str(each)!r} is not allowed: one of {', '.join(SURROUNDINGS)}"
                )
        section = np.where(kinds == "pipe", np.asarray(self.section, float), 1.0)
        bad = ~((section >= 1) & np.isfinite(section))
        if bad.any():
            raise ValueError(
                f"section = {section[bad].flat[0]:g} is not allowed: a pipe is at least as wide as "
                "its tube, section >= 1 of pi a_1^2, finite"
            )
        object.__setattr__(self, "kind", kinds)
        object.__setattr__(self, "section", section)

    @property
    def insulated(self) -> NDArray:
        """Which tubes conduct alone."""
        return self.kind == "insulated"

    def wall_share(self, ell: ArrayLike) -> NDArray:
        """f, the wall's share of the section that conducts; nothing of a bath's."""
        f = (1 - np.asarray(ell) ** 2) / self.section
        return np.where(self.kind == "bath", 0.0, f)


def stefan_numbers(St: ArrayLike) -> NDArray:
    """St as an array; ValueError unless each is 0 or more, and finite."""
    St = np.asarray(St, float)
    bad = ~((St >= 0) & np.isfinite(St))
    if bad.any():
        raise ValueError(
            f"St = {St[bad].flat[0]:g} is not allowed: the collapse takes up heat, St >= 0, finite"
        )
    return St


def tolerated(shift: float) -> float:
    """f St p of a pipe in which the latent heat holds Z_C back by the share `shift` of it."""
    from scipy.special import erf, erfcinv, erfcx

    y = (1 - shift) * erfcinv(0.5)
    return (np.exp(-(y**2)) / erf(y) - 1 / erfcx(y)) / (np.sqrt(np.pi) * y)


def circulated(tubes: Tubes, Le: ArrayLike, surrounding: Surrounding) -> tuple[NDArray, NDArray]:
    """E and W of each tube, from the closed form of its front at rest."""
    from gelpump.tube.wave import resting_polymer_fraction

    def one(ell, M, Pi_ratio, Phi_inf, Le, insulated):
        if not insulated:
            return 1.0, 1.0
        outwards = (1 - float(lumen_share(ell))) * (1 - ell**2)
        front = resting_polymer_fraction(M, Pi_ratio, Phi_inf, "conservative") ** (-1 / 3)

        def potential(x, s):
            return -s / (3 * x**3) - 4 * M / (3 * x)

        node, weight = np.polynomial.legendre.leggauss(40)
        carried, W = 0.0, 0.0
        for low, high, s in (
            (front, 1.0, 1.0),
            (Phi_inf ** (-1 / 3), front, Pi_ratio / Phi_inf),
        ):
            x = (low + high + (high - low) * node) / 2
            Gamma = carried + 3 * outwards * (potential(high, s) - potential(x, s))
            W += (high - low) / 2 * (weight * 3 * x**2 * np.exp(-Gamma / Le)).sum()
            carried += 3 * outwards * (potential(high, s) - potential(low, s))
        return float(np.exp(-carried / Le)), float(W / (1 - 1 / Phi_inf))

    return np.vectorize(one, otypes=[float, float])(
        tubes.ell, tubes.M, tubes.Pi_ratio, tubes.Phi_inf, Le, surrounding.insulated
    )


def front_constant(
    tubes: Tubes, St: ArrayLike, surrounding: Surrounding, Le: ArrayLike = np.inf
) -> NDArray:
    """Z_C/sqrt(Le tau), long after the start, of each tube: 2 Lambda of (similarity).

    ValueError for a Stefan number that is negative or not finite.
    """
    from scipy.optimize import brentq
    from scipy.special import erf, erfcx

    ell, Phi_inf, St, insulated = np.broadcast_arrays(
        tubes.ell, tubes.Phi_inf, stefan_numbers(St), surrounding.insulated
    )
    p, q, a = np.cbrt(Phi_inf), Phi_inf ** (-2 / 3), 1 - ell**2
    E, W = circulated(tubes, Le, surrounding)
    S = np.where(insulated, q, 1.0) * E
    beta = a * (p - 1) - ell**2 * (1 - q) - lumen_share(ell) * a * (p - q)
    beta = np.where(insulated, beta, 0.0)
    consumed = surrounding.wall_share(ell) * St * p * W

    def root(S, beta, consumed):
        def excess(y):
            hot = S * np.exp(-(y**2)) / erf(y)
            return hot - 1 / erfcx((1 + beta) * y) - np.sqrt(np.pi) * y * consumed

        if excess(1e-8) <= 0:  # the water that circulates takes all heat with it
            return 0.0
        return 2 * brentq(excess, 1e-8, 5.0, xtol=1e-15, rtol=1e-14)

    return np.vectorize(root, otypes=[float])(S, beta, consumed)


def bath_shift(tubes: Tubes, St: ArrayLike, Z_C: ArrayLike = 1.0) -> NDArray:
    """Relative shift of Z_C in a large bath that conducts as the gel does, to first order in St.

    The front takes up St a p per advance of it, a = 1 - ell^2, over a disc as wide as the swollen
    tube. That spreads along Z, mirrored with the other sign at Z = 0, and across the bath: of a
    disc's heat, 1 - exp(-y) [I_0(y) + I_1(y)] is within it a time s later, y = eps^2/(2 Le s). The
    front moves by what that makes of theta at it over the gradient there; Le drops out.
    """
    from scipy.special import i0e, i1e

    ell, eps, Phi_inf, St, Z_C = np.broadcast_arrays(
        tubes.ell, tubes.eps, tubes.Phi_inf, stefan_numbers(St), np.asarray(Z_C, float)
    )
    within = lambda y: 1 - i0e(y) - i1e(y)  # noqa: E731
    return -(1 - ell**2) * np.cbrt(Phi_inf) * St * _held_back(within, (eps / Z_C) ** 2)


def _held_back(within, thin):
    """-d ln Z_C / d(f St p), of heat of which `within` stays; thin is (eps/Z_C)^2."""
    c = FRONT_CONSTANT
    node, weight = np.polynomial.legendre.leggauss(200)
    v, weight = ((1 + node) / 2)[:, None], weight[:, None] / 2  # v^2 = 1 - s/tau
    z = np.sqrt(1 - v**2)  # where the front was, over Z_C
    spread = np.exp(-((c * (1 - z) / (2 * v)) ** 2)) - np.exp(-((c * (1 + z) / (2 * v)) ** 2))
    y = c**2 * np.ravel(thin) / (2 * v**2)
    felt = (weight * spread / z * within(y)).sum(axis=0) * c / (2 * np.sqrt(np.pi))
    return np.reshape(felt / (2 / np.sqrt(np.pi) * np.exp(-(c**2) / 4) * c), np.shape(thin))
