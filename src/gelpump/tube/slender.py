"""A family of slender tubes that collapse behind a front of heat (eqn:tube_model).

The polymer fraction Phi_1(Z, tau) in the middle of the wall, in units of phi_00, obeys

    Phi_tau + (D/Phi) Phi_Z^2 - (1/3) Phi^{-1/3} Phi_Z Integral_0^Z Phi^{-2/3} Phi_tau du
        = F + (D Phi_Z)_Z                                                      (eqn:tube_model)

    D = s Phi + (4M/3) Phi^{1/3},    F = 16 Phi^{2/3} D (Phi_0 - Phi) / (eps^2 (1-ell)^2)

    hot,  Z < Z_C(tau):   s = Pi_ratio/Phi_inf,  Phi_0 = Phi_inf
    cold, Z > Z_C(tau):   s = 1,                 Phi_0 = 1

    Phi(Z, 0) = 1,    Phi_Z = 0 at Z = 0 and far ahead,    Phi and D Phi_Z continuous at Z_C

Z is in units of L, tau of mu_l L^2/(k Pi_00) (eqn:nondimensionalisation). The parameters are those
of `Tubes`, the front that of `heat`.

Local form. With G the integral, d/dZ(Phi^{-1/3} G) = Phi^{-1} Phi_tau - (1/3) Phi^{-4/3} Phi_Z G,
which the equation says to be F/Phi + (D Phi_Z/Phi)_Z. Integrated from Z = 0 this gives G without a
time derivative; put back,

    Phi_tau + [ (2/3)(D/Phi) Phi_Z - (1/3) Integral_0^Z (F/Phi) du ] Phi_Z = F + (D Phi_Z)_Z .

Material form, which is what is solved. The gel moves at -(1/3) Phi^{-1/3} G, so the left side less
its second term is the rate of change at a material point, and the equation reads

    DPhi/Dtau = F + Phi (D Phi_Z/Phi)_Z .

Take as coordinate the length X that a point had when swollen, dX = Phi^{1/3} dZ, and as unknown the
stretch lambda = dZ/dX = Phi^{-1/3}. Then the equation is a diffusion equation in conservation form,
with neither a convection nor an integral:

    lambda_tau = (K lambda_X)_X - S,    K = s lambda^{-5} + (4M/3) lambda^{-3},
    S = lambda^4 F/3,    K lambda_X = -(D Phi_Z)/(3 Phi)

and what is left of the integral is one number for each tube, the material point X_C where the front
is:  Z_C(tau) = Integral_0^{X_C} lambda dX.  16/(eps^2 (1-ell)^2) is 1/w^2 with w = eps (1-ell)/4,
the length over which radial flow heals an axial disturbance, so X is measured in units of w.

Closures (`gelpump.tube.closure`). What is told above is the printed equation, which conserves the
length lambda dX. The others conserve the water of the wall, whose volume is lambda^3 dX:

    (lambda^3)_tau = 3 (lambda^2 K lambda_X)_X - 3 lambda^2 S .

How it is solved is told in `gelpump.tube.moving_mesh`.
"""

import warnings
from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from gelpump.bdf import MAX_TRIALS, integrate
from gelpump.netcdf import variable
from gelpump.tube import scaling
from gelpump.tube.closure import named
from gelpump.tube.heat import Heat
from gelpump.tube.ledger import AMOUNT, AMOUNT_RATE, ENTRIES, Ledger, Length
from gelpump.tube.moving_mesh import Family
from gelpump.tube.tubes import Tubes

NEWTON_SHARE = 0.1  # of the tolerance that the Newton iteration may leave


def solve(
    tubes: Tubes,
    heat: Heat,
    tau: ArrayLike,
    *,
    cells: tuple[int, int] = (64, 40),
    tolerance: float = 3e-5,
    order: int = 3,
    reach: float = 12.0,
    newton_share: float = NEWTON_SHARE,
    trials: int = MAX_TRIALS,
    closure: str | Sequence[str] = "printed",
    books: bool = False,
) -> xr.Dataset:
    """Phi_1 of all `tubes` at the times `tau`, on cells behind and ahead of the front.

    Times are in mu_l L^2/(k Pi_00), lengths in L (eqn:tube_model). The dataset has the dims ell,
    tau, cell and face: Phi1 and Z(ell, tau, cell), Z_C(tau), and what else its attributes say.
    ValueError for times that do not increase from above 0, or a front that does not move ahead.

    `tolerance` bounds the local error of Phi_1 in a time step, `order` (2 or 3) is that of the time
    steps, `reach` the distance from the front to the end of the domain in units of w (Phi_1 = 1
    beyond). The defaults give Phi_1 to 1e-3 in the maximum norm for Lewis numbers up to some
    hundreds; above, `Family.limit` costs accuracy and more cells behind the front are needed.
    `newton_share` of the tolerance may be left by Newton's iteration: where Phi_inf is large, what
    a tenth leaves can stall the choice of the next step. After `trials` steps RuntimeError is
    raised. The Lewis number of `heat` may be a column, (tubes, 1). `closure` is one of
    `gelpump.tube.closure`, or one for each tube of those that conserve water. `books` are those of
    `gelpump.tube.ledger`; where water is conserved they are kept in any case.
    """
    tau = np.atleast_1d(np.asarray(tau, float))
    if not (tau[0] > 0 and (np.diff(tau) > 0).all() and np.isfinite(tau).all()):
        raise ValueError(f"tau = {tau} is not allowed: positive and increasing")
    if np.any(heat.front(0.0)) or not (np.diff(heat.front(tau), prepend=0.0) > 0).all():
        raise ValueError("heat.front is not allowed: it must start at Z = 0 and move ahead")
    family = Family(tubes, heat, cells, reach, newton_share * tolerance, named(closure))
    account = (Ledger if books or family.closure.conserves_water else Length)(family, order)
    times = np.sqrt(tau)
    found, steps = [], 0
    for step in integrate(
        family.advance,
        family.initial(),
        times[-1],
        order=order,
        tolerance=tolerance,
        first_step=0.01 * family.w.min(),
        error_norm=family.error_norm,
        trials=trials,
    ):
        steps += 1
        account.enter(step)
        while len(found) < len(times) and times[len(found)] <= step.time:
            t = times[len(found)]
            found.append(family.profile(t, step) | account.at(t, step))
    dataset = _dataset(tubes, tau, heat, family, found)
    dataset.attrs.update(
        steps=steps,
        sweeps=family.sweep.sweeps,
        cells_behind=cells[0],
        cells_ahead=cells[1],
        tolerance=tolerance,
        order=order,
        reach=reach,
    )
    if isinstance(account, Ledger):
        dataset.attrs.update(closure=closure, water_balance_step=account.worst)
    _report_range(dataset, tolerance)
    return dataset


VARIABLES = {
    "Phi1": ("cell", "polymer fraction in the middle of the wall", scaling.POLYMER),
    "Z": ("cell", "axial position of the cells", scaling.AXIAL),
    "F": ("cell", "source of polymer fraction by radial flow", scaling.RATE),
    "Z_face": ("face", "axial position of the faces", scaling.AXIAL),
    "flux": ("face", "axial flux D dPhi1/dZ", ""),
    "Phi1_front": (None, "polymer fraction in the middle of the wall at Z_C", scaling.POLYMER),
    "front_error": (None, "distance of the front's face from Z_C", scaling.AXIAL),
    "water_balance_error": (
        None,
        "shortening of the tube less that by water lost through its walls, over Z_C",
        "",
    ),
    "departed_length": (
        None,
        "length of tube where Phi1 differs from its equilibrium by more than a tenth of the jump",
        scaling.AXIAL,
    ),
}
PARAMETERS = {
    "eps": "slenderness a_1/L",
    "M": "shear modulus over the osmotic pressure scale when cold",
    "Pi_ratio": "osmotic pressure scale when hot over that when cold",
    "Phi_inf": "equilibrium polymer fraction when hot over that when cold",
}


def _dataset(tubes, tau, heat, family, found):
    data = {
        name: variable(
            ("ell", "tau", *filter(None, [dim])), np.stack([p[name] for p in found], axis=1), *text
        )
        for name, (dim, *text) in VARIABLES.items()
    }
    Z_C = np.asarray(heat.front(tau))
    dims = ("ell", "tau")[-Z_C.ndim :]
    data["Z_C"] = variable(dims, Z_C, "position of the front", scaling.AXIAL)
    data["hot"] = variable("cell", family.hot, "whether the cell is behind the front")
    if family.closure.conserves_water:
        data["wall_length"] = variable(
            "ell",
            family.w[:, 0],
            "length over which radial flow heals a disturbance",
            scaling.AXIAL,
        )
    for name in (each for each in ENTRIES if each in found[0]):
        dim, text = ENTRIES[name]
        for suffix, what, unit in (("", "", AMOUNT), ("_rate", "rate of: ", AMOUNT_RATE)):
            values = np.stack([each[f"{name}{suffix}"] for each in found], axis=1)
            dims = ("ell", "tau", *filter(None, [dim]))
            data[f"{name}{suffix}"] = variable(dims, values, f"{what}{text}", unit)
    for key, text in PARAMETERS.items():
        data[key] = variable("ell", np.ravel(getattr(tubes, key)), text)
    return xr.Dataset(
        data, coords={"ell": scaling.ell(np.ravel(tubes.ell)), "tau": scaling.tau(tau)}
    )


def _report_range(dataset, tolerance):
    """F drives Phi_1 towards 1 or Phi_inf, so it can leave this range by numerical error only."""
    outside = np.maximum(1 - dataset.Phi1, dataset.Phi1 - dataset.Phi_inf).max(("tau", "cell"))
    bad = outside > 10 * tolerance
    if bad.any():
        warnings.warn(
            f"Phi_1 leaves [1, Phi_inf] by {float(outside.max()):.1e} for ell = "
            f"{dataset.ell.values[bad.values]}: refine the cells or the tolerance",
            stacklevel=3,
        )
