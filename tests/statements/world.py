"""A small made-up world in which every statement can be computed, with answers known by hand."""

import copy

import numpy as np
import xarray as xr

from gelpump.materials import EnergyBasedGel, PiecewiseLinearGel
from gelpump.materials.tables import tabulated
from gelpump.statements.statement import Evidence

ELL = np.array([0.01, 0.1, 0.25, 0.5, 0.75, 0.9])
TAU = np.array([1e-4, 1e-3, 0.01, 0.025, 0.05, 0.1])
THIN = 1.0 - ELL
EPS, LE = 0.1, 10.0
DOUBT = 1e-6  # relative uncertainty of what is solved
GELS = {
    "ANB": EnergyBasedGel("ANB", -12.947, 17.92, 0.04496, -0.0569, 100.0, (290.0, 320.0)),
    "HHT": EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720.0, (290.0, 320.0)),
    "tube": PiecewiseLinearGel(2.0, 1.0, 1.0),
}
TIMES = {"swelling": [0.1, 1.0], "drying": [1.0, 5.0]}
LEVELS = 5


def solved(dims, **values):
    """A dataset of ell (and tau), each variable with its uncertainty."""
    names = dims.split()
    data = {}
    for name, value in values.items():
        whole = np.broadcast_to(value, [{"ell": ELL, "tau": TAU}[dim].size for dim in names])
        data[name] = (names, np.array(whole))
        data[f"{name}_uncertainty"] = (names, DOUBT * np.abs(np.array(whole)))
    coords = {"ell": ELL, "tau": TAU}
    return xr.Dataset(data, coords={dim: coords[dim] for dim in names})


def bead(radius, t, **attrs):
    """Production and refinement of a bead, whose levels agree."""
    gradient = 5.0 - (t - 5.1) ** 2
    run = {
        "radius": radius,
        "smallest_diffusivity": 0.5 + 0.0 * t,
        "steepest_gradient": gradient,
    }
    refined = {name: (("level", "t"), np.tile(value, (LEVELS, 1))) for name, value in run.items()}
    refined |= {f"{name}_uncertainty": ("t", np.full(t.size, 1e-4)) for name in run}
    return (
        xr.Dataset({name: ("t", value) for name, value in run.items()}, {"t": t}, attrs),
        xr.Dataset(refined, {"t": t}),
    )


def beads():
    data = {}
    for case, T in (("swelling", 308.0), ("drying", 304.0), ("separating", 304.0)):
        t = np.linspace(0.0, 8.0 if case == "drying" else 1.0, 401)
        phi = GELS["HHT"].equilibrium_polymer_fraction(T)
        radius = 1.1 + 1.4 * np.sqrt(t) if case == "swelling" else 2.6 - 0.4 * (1 - np.exp(-4 * t))
        if case == "drying":
            radius = radius - 0.9 / (1 + np.exp(-(t - 5.0) / 0.2))
        for model, less in (("nonlinear", 0.0), ("lens", 0.01)):
            run, refined = bead(radius - less, t, temperature=307.6)
            run["polymer_fraction"] = (("t", "cell"), np.full((t.size, 3), phi))
            if case == "drying":
                run.polymer_fraction[-1] = 0.6
            data[f"bead_{case}_{model}"], data[f"refinement/bead_{case}_{model}"] = run, refined
    for model in ("lens", "nonlinear"):
        data[f"bead_separating_{model}"].attrs |= {
            "stopped_t": 0.14, "temperature": 308.0, "stopped_polymer_fraction": 0.3,
        }  # fmt: skip
        data[f"refinement/bead_separating_{model}"]["stop_time"] = ("level", [0.14] * LEVELS)
        data[f"refinement/bead_separating_{model}"]["stop_time_uncertainty"] = 1e-4
    names = ["A0", "Omega"]
    data["sensitivity_drying"] = xr.Dataset(
        {"radius_change": (("parameter", "t"), np.full((2, 2), 1e-4))},
        {"t": TIMES["drying"], "parameter_name": ("parameter", names)},
    )
    return data


def tubes():
    Z_C = 0.953873 * np.sqrt(LE * TAU)
    one = np.ones((ELL.size, TAU.size))
    column = THIN[:, np.newaxis]
    pulse = xr.Dataset(
        {
            "Z_C": ("tau", Z_C),
            "front_error": (("ell", "tau"), 1e-9 * one),
            "Phi_inf": ("ell", np.full(ELL.size, 2.0)),
            "eps": ("ell", np.full(ELL.size, EPS)),
            "Le": LE,
        },
        {"ell": ELL, "tau": TAU},
    )
    refined = solved(
        "ell tau", A=1.0, Phi1_front=1.5, radial_to_axial_velocity=1.0, pulse_flux=1.0,
        V_front_printed=1.0, V_front_matched=1.0, V_front_moving=1.0, V_far_printed=1.0,
    )  # fmt: skip
    refined["Phi1_difference"] = (("ell", "tau"), 1e-5 * one)
    fit = solved("ell", A=30.0 / THIN, Phi1_front=1.5)
    fit["fit_rms"] = ("ell", np.full(ELL.size, 1e-3))
    fit["exponent"], fit["exponent_uncertainty"], fit["fit_tau"] = 1.0, 1e-4, 0.01
    fit["prefactor"], fit["in_power_law"] = 30.0, ("ell", ELL > 0.05)
    fit = fit.assign_coords(tau=TAU)
    for name, value in (("profile_change", 1e-3), ("departure_front", 5e-3)):
        fit[name] = (("ell", "tau"), value * one)
    lumen = solved(
        "ell tau", V_front_printed=2.0 / column, V_front_matched=2.0 / column, V_far_printed=1.0,
        V_front_moving=2.0 / column, V_front_tanh=2.0 / column, V_far_tanh=1.0,
        pulse_flux=3.0, Z_highest_printed=0.0,
    )  # fmt: skip
    for name, value in (("V_max_plotted", 1.472), ("V_far_plotted", 0.255), ("V_max", 5.0)):
        lumen[name] = ("A", value / np.array([50.0, 100.0]))
        lumen[f"{name}_uncertainty"] = ("A", [1e-9, 1e-9])
    lumen = lumen.assign_coords(A=[50.0, 100.0])
    lumen["one_minus_ell"], lumen["drawn_A"] = ("A", [0.6, 0.3]), 100.0
    budget = solved("ell tau", radial_to_axial_velocity=(1.0 + ELL)[:, np.newaxis], shed_volume=1.0)
    budget["shed_volume_error"] = (("ell", "tau"), 1e-5 * one)
    budget["outer_rate_printed"] = (("ell", "tau", "side"), np.stack([one, -0.5 * one], -1))
    M, Pi, wide = np.array([0.1, 1.0, 10.0]), np.array([0.5, 2.0]), np.array([2.0, 4.0])
    times = xr.Dataset(
        {
            "tau99": (("M", "Pi_ratio"), 1.0 / np.outer(1.0 + M, Pi)),
            "tau99_contrast": (("M", "Phi_inf"), 1.0 / np.outer(1.0 + M, wide)),
            "tau99_compared": ("ell", 8e-3 * THIN[2:5] ** 2),
        },
        {"M": M, "Pi_ratio": Pi, "Phi_inf": wide, "ell": ELL[2:5]},
    )
    times = times.assign({f"{name}_uncertainty": DOUBT * times[name] for name in times})
    return {
        "tube_pulse": pulse,
        "refinement/tube_pulse": refined,
        "front_fit": fit,
        "lumen_pulse": lumen,
        "water_budget": budget,
        "deswelling_map": times,
        "wall_times": walls(),
        "deswelling_curves": solved("ell tau", Phi1=(1.0 + ELL)[:, np.newaxis]),
        "tube_flow_whole": flow(),
    }


def walls():
    """Times that follow (1-ell)^2.2 and M^-1/2 on one surface in the middle, M^-1 on the other."""
    ell, M = np.array([0.1, 0.5, 0.9, 0.5, 0.5]), np.array([1.0, 1.0, 1.0, 1.0, 10.0])
    tau99 = np.ones((2, 2, 5))
    tau99[0, 0] = (1.0 - ell) ** 2.2
    tau99[:, 0, 3:] = 7.0 * M[3:] ** np.array([[-0.5], [-1.0]])
    dims = ("surface", "place", "tube")
    return xr.Dataset(
        {
            "tau99": (dims, tau99),
            "tau99_uncertainty": (dims, DOUBT * tau99),
            "tau99_printed": ("tube", (1.0 - ell) ** 2 * M**-0.8),
            "ell": ("tube", ell),
            "M": ("tube", M),
        },
        {
            "surface": ["conservative", "balanced"],
            "place": ["midline", "mean"],
            "varied": ("tube", ["ell", "ell", "ell", "M", "M"]),
        },
    )


def with_doubts(dataset, share=DOUBT):
    """The dataset, and the uncertainty of each of its variables."""
    return dataset.assign(
        {f"{name}_uncertainty": share * np.abs(dataset[name]) for name in dataset}
    )


def pumps():
    """Tubes of which two closures conserve water, and the printed one pumps three times as much."""
    tubes, tau = np.array([0.25, 0.75]), np.array([1e-3, 0.01, 0.1])
    V = np.array([3.0, 1.0, 1.1])[:, None, None] * tubes[:, None] * (1.0 + 1e-4 / tau)
    dims, wide = ("closure", "ell", "tau"), np.ones((3, 2, 3))
    missing = np.array([0.2, 1e-14, 3e-14])[:, None, None] * wide
    data = {"V_far": (dims, V), "V_far_order": (dims[:2], [[3.0, 3.0], [1.0, 1.01], [2.0, 2.0]])}
    found = with_doubts(xr.Dataset(data))
    found["V_far_geometry"] = (dims, wide * tubes[:, None])
    found["water_balance_error"] = (dims, missing)
    found["water_balance_step"] = (dims, 1e-15 * wide)
    closures = ["printed", "conservative", "balanced"]
    return found.assign_coords(closure=closures, ell=tubes, tau=tau)


def heated():
    """A tube in a bath and one that is insulated; of two printed ones the second runs by itself."""
    tau, wide = np.array([1.0, 2.0]), np.ones((2, 2))
    limit = np.array([0.95, 0.7])
    return xr.Dataset(
        {
            "front_over_diffusion": (("tube", "tau"), limit[:, None] * [1.1, 1.0005]),
            "front_over_diffusion_uncertainty": (("tube", "tau"), 1e-6 * wide),
            "front_limit": ("tube", limit),
            "front_limit_large_Le": ("tube", [0.95, 0.8]),
            "f_St": ("tube", [0.0, 0.5]),
            "energy_balance_error": (("tube", "tau"), [[1e-12, 2e-12], [1e-13, 0.0]]),
            "Z_C_printed": (("N", "tau_printed"), [np.sqrt(tau), tau]),
            "Z_C_printed_uncertainty": (("N", "tau_printed"), 1e-9 * np.array([np.sqrt(tau), tau])),
            "theta_printed": (("N", "tau_printed"), [[1.0, 3.0], [5.0, 17.0]]),
        },
        coords={"tau": tau, "tau_printed": tau, "N": [10.0, 30.0]},
    )


def separated(slower, phi):
    """A bead whose front travels inwards; ``slower`` times as long as the first."""
    front = np.array([1.0, 0.85, 0.6, 0.4, 0.15, 0.0])
    r = np.tile(1.5 * np.array([0.05, 0.3, 0.5, 0.7, 0.95]), (6, 1))
    outside = r > 1.5 * front[:, None]
    fraction = np.where(outside, 0.8, 0.05)
    fraction[1, 3], fraction[2, 0], fraction[2, 4] = phi, 0.04, 0.82
    fraction[-1] = 0.8
    return xr.Dataset(
        {
            "front_dry_radius": ("t", front),
            "front_radius": ("t", 1.5 * front),
            "front_present": ("t", [1, 1, 1, 1, 1, 0]),
            "r": (("t", "cell"), r),
            "polymer_fraction": (("t", "cell"), fraction),
            "passage_time": ("passage", [1.0, 1.0 + slower]),
            "passage_time_uncertainty": ("passage", [0.02, 0.03]),
        },
        {"t": np.arange(6.0), "passage": [0.7, 0.3]},
        {
            "completion_t": 4.0 * slower,
            "completion_t_uncertainty": 0.1,
            "radius_uncertainty": 1e-3,
            "phi_initial": 0.05,
            "birth_t": 0.1 * slower,
        },
    )


def separation():
    loss = xr.Dataset(
        {"loss_temperature": (("model", "a"), [[0.0, 308.0, 308.4], [307.9, 0.0, 308.2]])},
        {"model": ["lens", "nonlinear"]},
    )
    beads = {"nonlinear": separated(1.0, 0.06), "lens": separated(1.5, 0.07)}
    found = {f"separation_separating_{model}": bead for model, bead in beads.items()}
    return found | {"coexistence_HHT": loss}


def truth():
    """Fronts in two dimensions, of which those that move are four times as long as those at rest,
    and slender tubes whose errors are one per cent, and 0.3 early on."""
    ell, Pe, T = np.array([0.5, 0.75, 0.9]), np.array([0.0, 0.5, 1.0]), np.array([0.1, 1.0, 10.0])
    thin, moving = 1.0 - ell[:, None], np.array([1.0, 2.0, 4.0])
    share = (1 / np.log(1 / ell) - 2 * ell**2 / (1 - ell**2)) / 2
    waves = with_doubts(
        xr.Dataset(
            {
                "jump": (("ell", "Pe"), 0.3 + 0.0 * thin * moving),
                "width_Phi": (("ell", "Pe"), 0.7 * thin * moving),
                "A": (("ell", "Pe"), 20.0 * thin**-0.5 * moving),
                "width_radius": (("ell", "Pe"), 2.0 * thin**0.5 * moving),
                "share": (("ell", "Pe"), share[:, None] * np.array([9.0, 1.0, 7.0])),
            }
        ),
        1e-4,
    )
    waves["shed"] = (("ell", "Pe"), thin * np.array([1e-12, 1.0, 2.0]))
    waves["jump_M"], waves["jump_uncertainty_M"] = ("M", [0.2, 0.4]), ("M", [1e-4, 2e-4])
    waves["jump_energy_M"] = ("M", [0.02, 0.06])
    pulses = with_doubts(
        xr.Dataset(
            {
                "A": (("ell", "T"), 20.0 * thin**-1.5 * np.array([2.0, 1.0, 1.0])),
                "shed_ahead": (("ell", "T"), 0.3 + 0.1 * thin * np.array([1.0, -2.0, 1.0])),
            }
        )
    )
    pulses["water_balance_error"] = 1e-13
    late = np.array([0.3, 0.01, -0.02])
    errors = {
        f"{name}_error": (("closure", "ell", "T"), np.array([1.0, 2.0, 3.0])[:, None, None]
                          * np.array([1.0, 0.5, 0.2])[:, None] * size * late)
        for name, size in (("V_far", 1.0), ("pumped", 2.0), ("width", 3.0))
    }  # fmt: skip
    errors["tau99_error"] = (("closure", "wall_ell"), [[-0.8, -0.6], [0.2, 0.4], [0.01, 0.03]])
    errors["tau99_resolved_error"] = (
        ("surface", "wall_ell", "place"), np.array([-0.5, 0.01])[:, None, None] * np.ones((2, 2, 2))
    )  # fmt: skip
    slender = with_doubts(xr.Dataset(errors))
    verification = xr.Dataset(
        {
            "order": ("number", [1.99, 2.02, 1.0]),
            "wall_balance_error": 1e-12,
            "wave_balance_error": ("mesh", [1e-13, 2e-13]),
            "bead_radius": (("t", "bead_mesh"), [[1.2, 1.25], [1.4, 1.41]]),
            "bead_radius_nonlinear": ("t", [1.26, 1.405]),
        }
    )
    closures = ["printed", "conservative", "balanced"]
    return {
        "truth/waves": waves.assign_coords(ell=ell, Pe=Pe, M=[1.0, 3.0]),
        "truth/pulses": pulses.assign_coords(ell=ell, T=T),
        "truth/slenderness": slender.assign_coords(
            closure=closures, ell=ell, T=T, surface=["conservative", "balanced"]
        ),
        "truth/verification": verification,
    }


def cycled():
    """Three periods of two cycles."""
    stroke = np.array([[0.1, 0.11], [0.2, 0.22], [0.4, 0.44]])
    dims = ("period", "cycle")
    return xr.Dataset(
        {
            "stroke": (dims, stroke),
            "stroke_uncertainty": (dims, 1e-6 * stroke),
            "stroke_second": (dims, 1.0001 * stroke),
            "net": (dims, 1e-6 * stroke),
            "net_uncertainty": (dims, 1e-7 * stroke),
            "net_within": (dims, 0.25 * stroke),
            "water_balance_error": ("period", [1e-12, 2e-12, 3e-12]),
        },
        {"period": [1e-3, 4e-3, 1.6e-2], "cycle": [1, 2]},
    )


def flow():
    """A wall with Phi = Phi_1 + eps^2 Phi_2, Phi_2 = 3 (R - 0.5)^2, a hot and a cold section."""
    Phi1, R = np.array([1.9, 1.1]), np.linspace(0.25, 0.75, 9)
    Phi = Phi1[:, np.newaxis] + EPS**2 * 3.0 * (R - 0.5) ** 2
    D = GELS["tube"].diffusivity(Phi1, np.array([1.0, -1.0]))[:, np.newaxis]
    section = ("Z", "R")
    return xr.Dataset(
        {
            "polymer_fraction": (section, Phi),
            "radius": (section, np.tile(R, (2, 1))),
            "Phi1": ("Z", Phi1),
            "u_r": (section, D / Phi1[:, np.newaxis] * 6.0 * (R - 0.5)),
            "u_r_without_Phi1": (section, D * 6.0 * (R - 0.5)),
            "Z_C": 0.5,
            "eps": EPS,
        },
        {"Z": [0.4, 0.6]},
    )


def case(initial, name):
    times = {"published_times": TIMES.get(name, []), "end": 8.0}
    return {"gel": "HHT", "temperature_initial": initial, **times}


def world(published) -> Evidence:
    """Evidence of the made-up world; a deep copy each time, to be altered."""
    return copy.deepcopy(_WORLD)._replace(published=copy.deepcopy(published))


_WORLD = Evidence(
    data={
        "materials_ANB": tabulated(GELS["ANB"], [300.0, 310.0], 301),
        "materials_HHT": tabulated(GELS["HHT"], [300.0, 310.0], 301),
        **beads(),
        **tubes(),
        **separation(),
        **truth(),
        "pump_balance": pumps(),
        "tube_heat": heated(),
        "cycle_tube": cycled(),
    },
    gels=GELS,
    cases={
        "swelling": case(308.0, "swelling"),
        "drying": case(304.0, "drying"),
        "separating": case(304.0, "separating"),
    },
    tube={"eps": EPS, "Le": LE, "gel": "linear"},
    scales={
        "thermal_diffusivity": 1e-7,
        "compositional_diffusivity": 1e-8,
        "permeability": 1e-15,
        "smallest_radius": 1e-5,
    },
    published={},
)
