r"""What a late pulse has pumped, by the travelling wave of a wall that conserves water.

What the wall has lost is what a sharp front would have taken from it, less what the wave around the
front still holds back. With X_C the material point at the front, w that of the closure,
p = Phi_inf^(1/3), and the integrals over either side of the wave of `gelpump.tube.wave`

    d_k = Integral (lambda^k - lambda_rest^k) dxi ,    Z_C = X_C/p + w d_1(hot) ,

    loss     Integral (1 - lambda^3) dX = (1 - 1/Phi_inf) X_C - w d_3
    shorter  Integral (1 - lambda) dX   = (1 - 1/p) X_C - w d_1

    pumped   pi [ ell^2 (loss - shorter) + sigma (1-ell^2) loss ] ,

the lines of `gelpump.tube.pump`, past a fixed station far ahead. The wave is that of the speed
which the front had DELAY tau_99 ago, as in `gelpump.tube.wave`; the velocity far ahead is the rate
of what is pumped, over pi ell^2, with a second wave for that of d_k.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import lumen_share
from gelpump.tube.wave import INTERVALS, LatePulse, behind_front, branches, by_blocks
from gelpump.tube.wave_branch import meeting

STATED = {  # the three parts of the uncertainty, of relative errors
    "V_far": (1.0e-4, 0.5, 1.5),
    "pumped": (1.0e-4, 0.3, 1.0),
}
STEP = 1e-3  # of ln c


def late_pump(tubes: Tubes, Le: ArrayLike, tau: ArrayLike) -> LatePulse:
    """`pumped`, in a_1^2 L, and `V_far` behind the front of `StepHeating(Le)` at the times tau.

    As `gelpump.tube.wave.late_pulse`, of the `conservative` closure.
    """
    now = behind_front(tubes, Le, tau, "conservative")
    Z_C = FRONT_CONSTANT * np.sqrt(Le * np.asarray(tau))
    gel = tubes.M, tubes.Pi_ratio, tubes.Phi_inf

    def held_back(c):
        return by_blocks(displaced, 3, *gel, c)

    p, share = np.cbrt(tubes.Phi_inf), lumen_share(tubes.ell) * (1 - tubes.ell**2)

    def pumped(Z_C, d_hot, d_1, d_3):
        X_C = p * (Z_C - now.w * d_hot)
        loss = (1 - 1 / tubes.Phi_inf) * X_C - now.w * d_3
        shorter = (1 - 1 / p) * X_C - now.w * d_1
        return np.pi * (tubes.ell**2 * (loss - shorter) + share * loss)

    here, faster = held_back(now.c), held_back(now.c * (1 + STEP))
    # c ~ (tau - delay)^(-1/2)
    rate = (here - faster) / STEP * now.ageing
    values = {
        "pumped": pumped(Z_C, *here),
        "V_far": pumped(Z_C / 2, *rate) / (np.pi * tubes.ell**2 * tau),
    }
    return LatePulse(values, now.uncertainty(STATED))


def displaced(M: NDArray, Pi_ratio: NDArray, Phi_inf: NDArray, c: NDArray) -> NDArray:
    """d_1 of the hot side, d_1 and d_3 of both, (3, n), of conservative waves."""
    hot, cold = branches(M, Pi_ratio, Phi_inf, c, "conservative")
    front, found = meeting(hot, cold), []
    for intervals in (INTERVALS, INTERVALS // 2):
        sides = [branch.displaced(*branch.solve(front, intervals)) for branch in (hot, cold)]
        (behind, behind_cubed), (ahead, ahead_cubed) = sides
        found.append(np.array([behind, behind + ahead, behind_cubed + ahead_cubed]))
    return found[0] + (found[0] - found[1]) / 3
