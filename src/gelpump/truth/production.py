"""Production runs of the truth: waves, pulses and walls, each on three meshes.

Lengths are in a_1 and times in mu_l a_1^2/(k Pi_00): a time is tau/eps^2, a velocity eps V and a
sharpness A eps in the paper's scaling. Volumes leave out pi: they are in pi a_1^2 times a_1.

The value is that of the middle mesh; its uncertainty is the grid-convergence index of the three
and, where there is a time, that of three time tolerances.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from gelpump import progress
from gelpump.bdf import derivative_weights
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.netcdf import variable
from gelpump.truth.observables import front_numbers, lumen, mean_width, running_loss, section
from gelpump.truth.pulse import Pulse
from gelpump.truth.wave import Wave
from gelpump.tube.heat import StepHeating
from gelpump.tube.scaling import ell as ell_coordinate
from gelpump.uncertainty import convergence_index

LENGTH = "in units of a_1, the outer radius of the swollen tube"
TIME = "in units of mu_l a_1^2/(k Pi_00), so that it is tau/eps^2"
VELOCITY = "in units of a_1 per mu_l a_1^2/(k Pi_00), so that it is eps V"
VOLUME = "in units of pi a_1^3"
STRESS = "in units of Pi_00"
MEANING = {
    "Phi_behind": ("polymer fraction in the middle of the wall just behind the front", ""),
    "Phi_ahead": ("polymer fraction in the middle of the wall just ahead of the front", ""),
    "jump": ("by how much the polymer fraction jumps at the front, in the middle of the wall", ""),
    "radius_front": ("radius of the middle of the wall at the front over its swollen one", ""),
    "width_Phi": (
        "length of the front, 10 to 90 % of polymer fraction, middle of the wall",
        LENGTH,
    ),
    "width_mean": ("length of the front, 10 to 90 % of the wall's mean polymer fraction", LENGTH),
    "width_radius": ("length of the front, 10 to 90 % of the radius, middle of the wall", LENGTH),
    "A": ("sharpness of the front, fitted to all of the profile", "in units of 1/a_1, A eps"),
    "A_window": ("sharpness of the front, fitted within 8 w of it", "in units of 1/a_1, A eps"),
    "overshoot": ("by how much the polymer fraction exceeds Phi_inf behind the front", ""),
    "hoop_tension": ("largest hoop stress", STRESS),
    "hoop_compression": ("largest hoop compression", STRESS),
    "share": ("share of the water shed that enters the lumen", ""),
    "V_far": ("mean axial velocity in the lumen far ahead of the front", VELOCITY),
    "V_peak": ("largest mean axial velocity in the lumen", VELOCITY),
    "shed_ahead": ("part of the water that the wall sheds ahead of the front", ""),
    "shed": ("rate at which the wall sheds water, through both surfaces", "in units of pi"),
    "pumped": ("volume that has left the lumen ahead since the beginning", VOLUME),
    "lost": ("water that the wall has shed since the beginning", VOLUME),
}


FIELDS = {
    "r": ("radius", LENGTH),
    "z": ("axial position less that of the front", LENGTH),
    "Phi": ("polymer fraction", "in units of phi_00"),
    "p": ("pore pressure", STRESS),
    "sigma_hoop": ("hoop stress", STRESS),
    "u_r": ("radial interstitial flux", VELOCITY),
    "u_z": ("axial interstitial flux", VELOCITY),
}


def wave_numbers(wave: Wave, y: np.ndarray, Pe: float) -> dict[str, float]:
    """All of MEANING that a wave has."""
    fields, Phi_inf, ell = wave.body.fields(y), wave.gel.Phi_inf, wave.ell
    seen = section(wave.elements, fields, wave.body.material)
    numbers = front_numbers(seen, 0.0, Phi_inf, ell)
    numbers["width_mean"] = mean_width(wave.elements, fields)
    leaving = wave.outflow(y, Pe)
    inside = lumen(wave.elements, fields, leaving, wave.inner)
    speed = Phi_inf ** (-1 / 3) * Pe / (1 - ell)
    far = ell * Phi_inf ** (-1 / 3)
    flux = speed * (inside["b"] ** 2 - far**2) / 2 + inside["inflow"]
    return numbers | _flows(wave.elements, leaving, flux, inside["b"])


def pulse_numbers(pulse: Pulse, step, root: float) -> tuple[dict[str, float], dict]:
    """All of MEANING that a pulse has, and FIELDS, at a root of time within a step."""
    elements, size = pulse.elements, pulse.elements.size
    roots = np.r_[root, step.times[step.times != root]]
    weights = derivative_weights(roots)
    states = [step.at(t) for t in roots]
    rate = 1 / (2 * (pulse.root + root))
    alpha, history = rate * weights[0], rate * weights[1:] @ np.array(states[1:])
    fields = pulse.body.fields(states[0][:size], root)
    seen = section(elements, fields, pulse.body.material)
    front = float(pulse.heat.front((pulse.root + root) ** 2))
    numbers = front_numbers(seen, front, pulse.gel.Phi_inf, pulse.ell)
    numbers["width_mean"] = mean_width(elements, fields)
    drift = history[elements.blocks["Z"]]
    residual, _ = pulse.body.rows(states[0][:size], root, alpha, drift, False)
    leaving = -(residual[elements.blocks["p"]] + history[size : size + elements.pressures.N])
    along = [
        lumen(elements, pulse.body.fields(y[:size], t), leaving, pulse.inner)
        for y, t in zip(states, roots, strict=True)
    ]
    change = rate * weights @ np.array([each["volume"] for each in along])
    moving = rate * weights @ np.array([each["z"] for each in along])
    here = along[0]
    flux = moving * here["b"] ** 2 / 2 - change + here["inflow"]
    swollen = pulse.ell**2 / 2 * pulse.length
    lost = states[0][-2:]
    numbers |= _flows(elements, leaving, flux, here["b"])
    numbers["pumped"] = 2 * (swollen - here["volume"][-1] + lost[0])
    numbers["lost"] = 2 * lost.sum()
    picture = {name: getattr(seen, name) for name in FIELDS}
    picture["z"] = picture["z"] - front
    picture |= {
        "lumen_z": here["z"] - front,
        "lumen_b": here["b"],
        "lumen_V": 2 * flux / here["b"] ** 2,
    }
    return numbers, picture


def _flows(elements, leaving, flux, b):
    radius, share = elements.pressure_nodes
    total, ahead = leaving.sum(), 0.0
    shed = {}
    for surface in (radius.min(), radius.max()):
        nodes = np.flatnonzero(np.isclose(radius, surface))
        nodes = nodes[np.argsort(share[nodes])]
        running = running_loss(share[nodes], leaving[nodes])
        shed[surface] = running[-1]
        ahead += running[-1] - running[np.abs(share[nodes]).argmin()]
    if abs(total) < 1e-9:  # a front at rest: nothing to share out
        total = np.inf
    velocity = 2 * flux / b**2
    return {
        "share": shed[radius.min()] / total,
        "shed_ahead": ahead / total,
        "V_far": velocity[-1],
        "V_peak": velocity.max(),
        "shed": 2 * leaving.sum(),
    }


def waves(
    gel: PiecewiseLinearGel,
    ells: Sequence[float],
    Pe: Sequence[float],
    cells: Sequence[int],
    c: float = 0.0,
) -> xr.Dataset:
    """Waves on `cells` halved, taken and doubled; dims (ell, Pe)."""
    meshes = _three(cells)

    def numbers(mesh, ell):
        wave = Wave(ell, gel, mesh, c, max(Pe))
        found = [wave_numbers(wave, y, each) for each, y in zip(Pe, wave.solve(Pe), strict=True)]
        return _stacked(found)

    levels = []
    for i, mesh in enumerate(meshes):
        levels.append(_stacked([numbers(mesh, ell) for ell in ells]))
        progress.at(i + 1.0, len(meshes))
    return _with_uncertainty(
        levels, ("ell", "Pe"), {"ell": ell_coordinate(np.array(ells)), "Pe": peclet(Pe)}
    )


def other_gels(
    block: Mapping, M: Sequence[float], ell: float, Pe: float, cells: Sequence[int]
) -> xr.Dataset:
    """A wave of gels with other shear moduli, and with the energy's second invariant; dims (M,).

    The energy's change of a number is what it gains with c = 1 in place of c = 0.
    """
    gels = [PiecewiseLinearGel(block["Phi_inf"], block["Pi_ratio"], each) for each in M]

    def numbers(mesh, c=0.0):
        found = []
        for gel in gels:
            wave = Wave(ell, gel, mesh, c, Pe)
            found.append(wave_numbers(wave, wave.solve([Pe])[-1], Pe))
        return _stacked(found)

    levels = [numbers(mesh) for mesh in _three(cells)]
    other = numbers(_three(cells)[1], c=1.0)
    coords = {"M": variable("M", np.array(M, float), "shear modulus over Pi_00")}
    data = _with_uncertainty(levels, ("M",), coords)
    for name, value in levels[1].items():
        text = f"{MEANING[name][0]}: change with the energy's second invariant"
        data[f"{name}_energy"] = variable("M", other[name] - value, text, MEANING[name][1])
    named = {name: f"{name}_M" for name in data.data_vars}
    return data.rename(named).assign(verified_ell=variable((), ell, "ell of the waves of other M"))


def peclet(values):
    """The coordinate Pe."""
    return variable(
        "Pe",
        np.array(values, float),
        "speed of the front in the swollen tube times the thickness of its wall",
        "in units of k Pi_00/mu_l: Phi_inf^(1/3) eps (1-ell) dZ_C/dtau",
    )


def pulses(
    gel: PiecewiseLinearGel,
    Le: float,
    ell: Sequence[float],
    T: Sequence[float],
    drawn: float,
    cells: Sequence[int],
    tolerance: float,
) -> xr.Dataset:
    """Tubes behind the printed front at the times T; dims (ell, T).

    Meshes are compared at the third of three tolerances, which are sqrt(10) and 10 times the first.
    FIELDS are those of the first at the time of T nearest to `drawn`.
    """
    coarse, middle, fine = _three(cells)
    loose, looser = 10**0.5 * tolerance, 10 * tolerance
    plan = [
        (middle, tolerance),
        (middle, loose),
        (middle, looser),
        (coarse, looser),
        (fine, looser),
    ]
    shown = int(np.abs(np.asarray(T) - drawn).argmin())
    runs, worst, pictures = [], 0.0, []
    for i, (mesh, each) in enumerate(plan):
        rows = []
        for j, each_ell in enumerate(ell):
            seen, error = pulse_at(Pulse(each_ell, gel, StepHeating(Le), T[-1], mesh, each), T)
            rows.append(_stacked([numbers for numbers, _ in seen]))
            worst = max(worst, error)
            if i == 0:
                pictures.append(seen[shown][1])
            progress.at(i + (j + 1.0) / len(ell), len(plan))
        runs.append(_stacked(rows))
    best, middle_run, loosest, rough, dense = runs
    coords = {
        "ell": ell_coordinate(np.array(ell)),
        "T": variable("T", np.array(T, float), "elapsed time", TIME),
    }
    data = {"Le": variable((), Le, "Lewis number")}
    for name, value in best.items():
        error = convergence_index(rough[name], loosest[name], dense[name])
        error = error + convergence_index(loosest[name], middle_run[name], value)
        data |= _variables(name, ("ell", "T"), value, error)
    picture = _stacked(pictures)
    for name, (long_name, comment) in FIELDS.items():
        data[name] = variable(("ell", "line", "across"), picture[name], long_name, comment)
    for name, text, comment in (
        ("lumen_z", "axial position along the inner surface less that of the front", LENGTH),
        ("lumen_b", "radius of the lumen", LENGTH),
        ("lumen_V", "mean axial velocity in the lumen", VELOCITY),
    ):
        data[name] = variable(("ell", "node"), picture[name], text, comment)
    data["drawn_T"] = variable((), T[shown], "time of the fields", TIME)
    data["water_balance_error"] = variable((), worst, "largest share of water unaccounted for")
    return xr.Dataset(data, coords)


def pulse_at(pulse: Pulse, T: Sequence[float]) -> tuple[list[tuple[dict, dict]], float]:
    """`pulse_numbers` at each of T, and the largest share of the water unaccounted for."""
    roots = np.sqrt(np.asarray(T)) - pulse.root
    if not roots[0] > 0:
        raise ValueError(f"T = {T[0]} is not allowed: the run begins at {pulse.root**2:.3g}")
    found, worst = [], 0.0
    for step in pulse.steps():
        now, before = pulse.water(step.solution)
        worst = max(worst, abs(now - before) / before)
        while len(found) < len(roots) and roots[len(found)] <= step.time * (1 + 1e-12):
            found.append(pulse_numbers(pulse, step, min(roots[len(found)], step.time)))
    return found, worst


def _three(cells):
    across, behind, ahead = cells
    if across % 4:
        raise ValueError(f"{across} cells across the wall are not allowed: a multiple of four")
    return [tuple(int(factor * n) for n in (across, behind, ahead)) for factor in (0.5, 1, 2)]


def _stacked(rows: list[Mapping]) -> dict[str, np.ndarray]:
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _with_uncertainty(levels, dims, coords):
    data = {}
    for name, value in levels[1].items():
        error = convergence_index(levels[0][name], value, levels[2][name])
        data |= _variables(name, dims, value, error)
        data[f"{name}_levels"] = variable(
            ("level", *dims), np.array([level[name] for level in levels]), f"{name} on each mesh"
        )
    return xr.Dataset(data, coords)


def _variables(name, dims, value, error):
    long_name, comment = MEANING[name]
    return {
        name: variable(dims, value, long_name, comment),
        f"{name}_uncertainty": variable(
            dims, error, f"numerical uncertainty: {long_name}", comment
        ),
    }
