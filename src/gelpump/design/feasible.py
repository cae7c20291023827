r"""Which tubes do what is wanted: a plain scan of shape, permeability and heating, and the best.

Wanted are at most `response_time`, at least `pumped_volume` per pulse and at least `wall`, the
thickness when swollen. Scanned are ell, a_1, the heated length L, the permeability k and the
heating step Delta T, the latter if the gel has a free energy, which is what Delta T acts on. By

    t_99  = mu_l (a_1-a_0)^2 I/(16 k Pi_00) times what a wall resolved in r takes longer,
            the longer of its two surfaces (`device.slower`)
    V     = a_1^2 L times what has been pumped when the front is at L, the wall conserving water,
            on one side of the heated end (`gelpump.tube.late_pump`)

and the lights of `gelpump.design.validity`, of which none may be red; that of heat is judged for
each heating step with the shape of the design that is given. What is no travelling wave
yet by then, or less accurate than ACCURATE, is not decided and does not count. Points are Sobol's,
evenly in ell and in the logarithms of the others, as far as the tubes are slender. The best are
those of which no other responds as fast, is over as soon and pumps as much: the pulse lasts until
the front of heat is at L, which may be hours. Some of them are solved as pulses (`confirmed`).
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import xarray as xr

from gelpump.config import ConfigError
from gelpump.design import device, units, validity
from gelpump.design.description import Design
from gelpump.design.heat import HEAT
from gelpump.design.material import BOLTZMANN, from_energy
from gelpump.design.result import AMBER, RED, Criterion

SAMPLES = 2**15
SPREAD = 10.0  # of a_1, L and k, either way
THIN, THICK = 0.05, 0.95  # ell
STEPS, STEP_SPREAD = 8, 3.0  # of Delta T
ACCURATE = 0.05
CONFIRMED = 12
TAU = 0.01  # at which all of these are solved, by the law of the healing length
INPUTS = {
    "ell": ("1", "ratio of the radii, a_0/a_1"),
    "a_1": ("m", "outer radius, swollen"),
    "heated_length": ("m", "heated length"),
    "permeability": ("m^2", "permeability"),
    "heating_step": ("K", "heating step"),
}
ANSWERS = {
    "response_time": ("s", "response time, of the wall resolved in r"),
    "pumped_volume": ("m^3", "volume pumped per pulse and side, water conserved"),
    "wall": ("m", "thickness of the wall, swollen"),
    "travel_time": ("s", "time of the front along the heated length"),
}
UNITS = {"response_time": "s", "pumped_volume": "m^3", "wall": "m"}


def scan(design: Design, wanted: Mapping[str, float], samples: int = SAMPLES) -> xr.Dataset:
    """The designs around `design` that do what is wanted, dimension `index`, and which are best.

    `wanted` in SI units, by the keys of UNITS. ConfigError if `design` is no tube, or its gel
    separates whatever the heating step.
    """
    if design.kind != "tube":
        raise ConfigError(f"kind = {design.kind!r}: must be 'tube' for the inverse question")
    gels = _heated(design)
    points = _points(design, len(gels), samples)
    parts = []
    for level, (step, each) in enumerate(gels.items()):
        here = {key: values[points["level"] == level] for key, values in points.items()}
        here["heating_step"] = np.full(len(here["ell"]), step)
        parts.append(here | _answers(each, here))
    found = {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}
    unknown, red = ~found.pop("decided"), ~found.pop("allowed")
    does = (
        ~red
        & ~unknown
        & (found["response_time"] <= wanted.get("response_time", np.inf))
        & (found["pumped_volume"] >= wanted.get("pumped_volume", 0.0))
        & (found["wall"] >= wanted.get("wall", 0.0))
    )
    data = {
        key: ("index", found[key][does], {"units": unit, "long_name": text})
        for key, (unit, text) in (INPUTS | ANSWERS).items()
    }
    costs = [data[key][1] for key in ("response_time", "travel_time")]
    best = unbeaten(np.array([*costs, -data["pumped_volume"][1]]))
    for key, values, text in (
        ("pumped_volume_uncertainty", found["uncertainty"][does], "relative, of the volume"),
        ("best", best.astype(np.int8), "1 if no other is as fast, as soon over, and pumps as much"),
    ):
        data[key] = "index", values, {"units": "1", "long_name": text}
    return xr.Dataset(
        data,
        attrs={
            "design": design.name,
            "scanned": len(does),
            "red": int(red.sum()),
            "undecided": int(unknown.sum()),
            "wanted": ", ".join(f"{key} {value:g} {UNITS[key]}" for key, value in wanted.items()),
        },
    )


def unbeaten(costs: np.ndarray) -> np.ndarray:
    """Which columns of (cost, design) no other column is below or equal to in every row."""
    left = np.lexsort(costs[::-1])  # the first is never beaten by those after it
    best = np.zeros(costs.shape[1], bool)
    while len(left):
        first, left = left[0], left[1:]
        best[first] = True
        left = left[(costs[:, left] < costs[:, [first]]).any(axis=0)]
    return best


def confirmed(design: Design, found: xr.Dataset) -> xr.Dataset:
    """Some of the best, from the fastest on, and `solved_volume`, that of the solved pulse.

    Phi_1 depends on Z/w and tau/w^2 only, so that all are solved at one tau, each in its own unit
    of length; the design's is L/unit.
    """
    from gelpump.tube.heat import FRONT_CONSTANT, StepHeating
    from gelpump.tube.pump import volumes
    from gelpump.tube.slender import solve
    from gelpump.tube.tubes import Tubes

    best = np.flatnonzero(found.best.values)
    best = best[np.argsort(found.response_time.values[best])]
    some = found.isel(index=best[np.unique(np.linspace(0, len(best) - 1, CONFIRMED).astype(int))])
    gels = _heated(design)
    steps, k = some.heating_step.values, some.permeability.values
    numbers = [gels[step].material for step in steps]
    Le = np.array([_lewis(gels[step], each) for step, each in zip(steps, k, strict=True)])
    per_unit = np.sqrt(1 / (FRONT_CONSTANT**2 * Le * TAU))  # the unit of length over L
    eps = some.a_1.values / some.heated_length.values / per_unit
    columns = ([getattr(each, key) for each in numbers] for key in ("M", "Pi_ratio", "Phi_inf"))
    tubes = Tubes(some.ell.values, eps, *(np.array(column) for column in columns))
    pulse = solve(tubes, StepHeating(Le[:, np.newaxis]), [TAU], closure="conservative")
    pumped = volumes(pulse)["pumped_station"][:, 0] * per_unit
    volume = some.a_1.values**2 * some.heated_length.values * pumped
    text = "volume pumped per pulse and side, of the solved pulse"
    return some.assign(solved_volume=("index", volume, {"units": "m^3", "long_name": text}))


def sentences(found: xr.Dataset, some: xr.Dataset) -> list[str]:
    """How many do it, over which ranges, and the best, as `confirmed` gives them."""

    def said(value, unit):
        number, chosen = units.shown(float(value), unit)
        return f"{units.told(number, 3)} {units.readable(chosen)}".strip()

    lines = [
        f"{found.sizes['index']} of {found.scanned} slender tubes do it; {found.red} have a red "
        f"light, of {found.undecided} the volume is not known to {ACCURATE:.0%}"
    ]
    for key, (unit, text) in INPUTS.items():
        values = found[key].values
        lines += [f"{text}: {said(values.min(), unit)} to {said(values.max(), unit)}"]
    lines += [
        ", ".join(text for _, text in (INPUTS | ANSWERS).values()) + "; volume as a solved pulse"
    ]
    for i in range(some.sizes["index"]):
        one = some.isel(index=i)
        cells = (said(one[key], unit) for key, (unit, _) in (INPUTS | ANSWERS).items())
        lines.append(f"{', '.join(cells)}; {said(one.solved_volume, 'm^3')}")
    return lines


def _heated(design):
    """The design by heating step, as far as its gel can be heated and stays whole."""
    if not design.material.energy_based:
        return {design.si("heating_step"): design}
    T_C, step = design.si("critical_temperature"), design.si("heating_step")
    lowest, highest = design.material.gel.temperature_range
    most = min(STEP_SPREAD * step, T_C - lowest, highest - T_C)
    volume = BOLTZMANN * design.T_hot / design.material.pressure_unit
    found = {}
    for each in np.geomspace(step / STEP_SPREAD, most, STEPS):
        T_cold, T_hot = round(T_C - each, 9), round(T_C + each, 9)
        try:
            material = from_energy(design.material.gel, T_cold, T_hot, volume)
        except ValueError:
            continue  # no stable state there
        given = dict(design.given) | {"heating_step": units.quantity(each, "K")}
        this = replace(design, material=material, T_cold=T_cold, T_hot=T_hot, given=given)
        moved = (validity.ONE_PHASE, validity.LINEAR, HEAT)
        seen = [light for light in validity.before_solving(this) if light.criterion in moved]
        if material.Phi_inf > 1 and all(light.light != RED for light in seen):
            found[float(each)] = this
    if not found:
        raise ConfigError(
            f"{design.name}: the gel separates at every heating step up to {most:g} K"
        )
    return found


def _points(design, levels, samples):
    from scipy.stats import qmc

    unit = qmc.Sobol(5, rng=0).random(samples).T
    logs = SPREAD ** (2 * unit[1:4] - 1)
    keys = ("a_1", "heated_length", "permeability")
    points = {
        "ell": THIN + (THICK - THIN) * unit[0],
        **{key: design.si(key) * factor for key, factor in zip(keys, logs, strict=True)},
        "level": np.minimum((levels * unit[4]).astype(int), levels - 1),
    }
    slender = _not_red(validity.SLENDER, (points["a_1"] / points["heated_length"]) ** 2)
    return {key: values[slender] for key, values in points.items()}


def _lewis(design, permeability):
    return device.lewis_number(design) * design.si("permeability") / permeability


def _answers(design, here):
    from gelpump.tube.deswelling import response_time
    from gelpump.tube.heat import FRONT_CONSTANT
    from gelpump.tube.late_pump import conserved
    from gelpump.tube.tubes import Tubes
    from gelpump.tube.wave import late_pulse

    ell, a_1, L, k = (here[key] for key in ("ell", "a_1", "heated_length", "permeability"))
    material, mu, kappa = design.material, design.si("viscosity"), design.si("thermal_diffusivity")
    time = response_time(ell * a_1, a_1, k, mu, material.Pi_00, **material.numbers)
    Le = _lewis(design, k)
    tubes, tau = Tubes(ell, a_1 / L, **material.numbers), 1 / (FRONT_CONSTANT**2 * Le)
    pump, printed = conserved(tubes, Le, tau), late_pulse(tubes, Le, tau)
    uncertainty = pump.uncertainty["pumped_station"]
    t_pore = mu * L**2 / (k * material.Pi_00)
    velocity = L / t_pore * np.maximum(printed.values["V_peak"], pump.values["V_far"])
    a_0, wall = ell * a_1, (1 - ell) * a_1
    judged = {
        validity.COUPLING: k / a_1**2,
        validity.CONTINUUM: wall / np.sqrt(k),
        validity.CLOSE: printed.values["departed_length"],
        validity.LUMEN_PRESSURE: 8 * mu * velocity * L / a_0**2 / material.Pi_00,
        validity.REYNOLDS: design.si("density") * velocity * a_0 / mu * a_0 / L,
    }
    return {
        "response_time": time * device.slower(design)(ell),
        "pumped_volume": np.pi * a_1**2 * L * pump.values["pumped_station"],
        "wall": wall,
        "travel_time": L**2 / (FRONT_CONSTANT**2 * kappa),
        "uncertainty": uncertainty,
        "decided": np.isfinite(uncertainty) & (uncertainty <= ACCURATE),
        "allowed": np.all([_not_red(light, value) for light, value in judged.items()], axis=0),
    }


def _not_red(criterion: Criterion, value):
    limit = getattr(criterion, AMBER)
    return value >= limit if criterion.large else value <= limit
