"""Dataset of tubes whose collapse holds the front of heat back, by what surrounds them."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import heated, scaling
from gelpump.tube.closure import CLOSURES
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.slender import PARAMETERS
from gelpump.tube.stefan import SURROUNDINGS, Surrounding, bath_shift, front_constant
from gelpump.tube.tubes import Tubes

SAFETY = 1.25  # of the grid-convergence index
SHIFTS = (1e-3, 3.0, 60)  # f St of the curves
PRINTED = (0.04, 9.0, 14)  # tau/w^2 of the printed heat equation
DECOUPLED = "front without latent heat, far from insulation"


def study(gel, tube: Mapping, settings: Mapping, numerics: Mapping) -> xr.Dataset:
    """Fronts, profiles and books of tubes in a bath, pipes and insulation; dims (tube, tau, cell).

    Pipes are as wide as the tube, so that f = 1 - ell^2 as it is with insulation. Beside it the
    limits of docs/heat.md, the shift of the front over f St, and the printed heat equation.
    """
    kinds = ["bath", *["pipe"] * len(settings["pipe"]), *["insulated"] * len(settings["insulated"])]
    f_St = np.array([0.0, *settings["pipe"], *settings["insulated"]])
    tubes, Le = _tubes(gel, tube, settings, len(kinds)), float(tube["Le"])
    St, surrounding = f_St / (1 - tubes.ell**2), Surrounding(kinds)
    w = float(CLOSURES["conservative"].wall_length(tubes)[0])
    tau = w**2 * np.geomspace(*settings["range"], settings["points"])
    cells, tolerance = tuple(numerics["cells"]), numerics["tolerance"]
    fine, coarse = (
        heated.solve(tubes, Le, tau, surrounding, St=St, cells=each, tolerance=error)
        for each, error in (
            (cells, tolerance),
            (tuple(count // 2 for count in cells), 4 * tolerance),
        )
    )
    change = (fine.front_over_diffusion - coarse.front_over_diffusion) / 3
    text = "Z_C over sqrt(Le tau), extrapolated from two meshes"
    dims = ("tube", "tau")
    data = {
        "front_over_diffusion": variable(dims, (fine.front_over_diffusion + change).values, text),
        "front_over_diffusion_uncertainty": variable(
            dims, SAFETY * np.abs(change).values, f"numerical uncertainty: {text}"
        ),
        "front_limit": variable(
            "tube", front_constant(tubes, St, surrounding, Le), "the same, long after the start"
        ),
        "front_limit_large_Le": variable(
            "tube",
            front_constant(tubes, St, surrounding),
            "the same, long after the start, at a large Lewis number",
        ),
        "f_St": variable("tube", f_St, "wall's share of the section times the Stefan number"),
        "Le": variable((), Le, "Lewis number"),
        "Phi_inf": variable((), float(gel.Phi_inf), PARAMETERS["Phi_inf"]),
        "eps": variable((), float(tube["eps"]), PARAMETERS["eps"]),
    }
    data |= _curves(tubes, Le) | _printed(gel, tube, settings, numerics)
    names = ("surrounding", {"long_name": "what conducts heat beside the tube"})
    return (
        fine.drop_vars(["front_over_diffusion"])
        .assign(data)
        .assign_coords(surrounding=("tube", kinds, names[1]))
    )


def _tubes(gel, tube, settings, count):
    return Tubes(
        np.full(count, settings["ell"]), tube["eps"], gel.M, gel.Pi_ratio, gel.Phi_inf
    )  # fmt: skip


def _curves(tubes, Le):
    f_St = np.geomspace(*SHIFTS)
    one = Tubes(tubes.ell[0], tubes.eps[0], tubes.M[0], tubes.Pi_ratio[0], tubes.Phi_inf[0])
    St = f_St / (1 - one.ell**2)
    shift = {"bath": bath_shift(one, St)}
    for kind in ("pipe", "insulated"):
        shift[kind] = front_constant(one, St, Surrounding(kind), Le) / FRONT_CONSTANT - 1
    return {
        "f_St_curve": variable("f_St_curve", f_St, "f St, with f = 1 - ell^2 in a bath too"),
        "shift": variable(
            ("kind", "f_St_curve"),
            np.stack([shift[kind] for kind in SURROUNDINGS]),
            f"relative change of Z_C, long after the start, from that of the {DECOUPLED}",
            "in a bath to first order, when the front is at Z = 1",
        ),
        "kind": ("kind", list(SURROUNDINGS), {"long_name": "what conducts heat"}),
    }


def _printed(gel, tube, settings, numerics):
    """Fronts of eqn:lens_heat_equation with its term in T, in a pipe as wide as the tube."""
    N = np.array(settings["N"], float)
    tubes = _tubes(gel, tube, settings, len(N))
    w = float(CLOSURES["conservative"].wall_length(tubes)[0])
    tau = w**2 * np.geomspace(*PRINTED)
    runs = [
        heated.solve(
            tubes,
            float(tube["Le"]),
            tau,
            Surrounding("pipe"),
            N=N[:, np.newaxis],
            cells=tuple(count // share for count in numerics["cells"]),
            tolerance=3 * share**2 * numerics["tolerance"],
        )
        for share in (1, 2)
    ]
    Z_C, other = (run.Z_C.values for run in runs)
    dims = ("N", "tau_printed")
    text = "position of the front, printed heat equation"
    return {
        "N": variable("N", N, "T_C over Delta T"),
        "tau_printed": variable(
            "tau_printed", tau, "elapsed time, printed heat equation", "mu_l L^2/(k Pi_00)"
        ),
        "Z_C_printed": variable(dims, Z_C, text, scaling.AXIAL),
        "Z_C_printed_uncertainty": variable(
            dims, SAFETY / 3 * np.abs(Z_C - other), f"numerical uncertainty: {text}", scaling.AXIAL
        ),
        "theta_printed": variable(
            dims, runs[0].theta.max("cell").values, "highest temperature, printed heat equation",
            "(T - T_C)/Delta T",
        ),
    }  # fmt: skip
