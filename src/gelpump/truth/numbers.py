"""Numbers of a front, of waves and of pulses alike, and what they mean.

Lengths are in a_1 and times in mu_l a_1^2/(k Pi_00): a time is tau/eps^2, a velocity eps V and a
sharpness A eps in the paper's scaling. Volumes leave out pi: they are in pi a_1^2 times a_1.
"""

import numpy as np

from gelpump.bdf import derivative_weights
from gelpump.truth.observables import front_numbers, lumen, mean_width, running_loss, section
from gelpump.truth.pulse import Pulse
from gelpump.truth.wave import Wave

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
