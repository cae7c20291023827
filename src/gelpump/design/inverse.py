"""The inverse question: which designs respond within a given time, one parameter at a time.

By scaling, exactly, with I the quadrature of t_99 (section 3.4), which holds the gel only, and r
how many times as long a wall takes that is resolved in r (`device.slower`), which holds ell too:

    tube:  t_99 = r mu_l (a_1 - a_0)^2 I/(16 k Pi_00)       bead:  t_99 ~ mu_l a^2/(k Pi_00)

so that the longest time allowed bounds the thickness from above and k and Pi_00 (the moduli keeping
their ratios) from below. The lights that need no solution bound from the other side: slenderness,
the coupling G and the number of pores across the wall, each by a power of the
parameter. The Lewis number bounds beads only: a tube's front of heat does not ask for it, and what
holds that back is judged by building the change, as closeness and the lumen's flow are. A light
that the parameter does not move, but that is worse than asked for, leaves no range. `lights` asks
for amber at least, or for green.
"""

import math
from dataclasses import dataclass, replace

from gelpump.design import device, units
from gelpump.design.description import Design
from gelpump.design.heat import HEAT
from gelpump.design.result import AMBER, GREEN, LIGHTS
from gelpump.design.validity import (
    CONTINUUM,
    COUPLING,
    LEWIS,
    PLAUSIBLE,
    SLENDER,
    USUAL,
    before_solving,
    unusual,
)

MOVED = {  # which lights a parameter moves
    "radius": {CONTINUUM},
    "wall": {CONTINUUM, HEAT},
    "a_1": {CONTINUUM, COUPLING, SLENDER, HEAT},
    "size": {CONTINUUM, COUPLING, SLENDER, HEAT},
    "permeability": {LEWIS, COUPLING, CONTINUUM},
    "osmotic_modulus": {LEWIS},
}
TIMES = {"response_time", "recovery_time", "poroelastic_time"}
INPUTS = {  # which inputs, and what follows from them, a parameter moves
    "radius": {"radius", *TIMES},
    "wall": {"a_0", *TIMES},
    "a_1": {"a_1", *TIMES},
    "size": {"a_0", "a_1", *TIMES},
    "permeability": {"permeability", "Lewis_number", *TIMES},
    "osmotic_modulus": {"osmotic_modulus", "shear_modulus", "Lewis_number", *TIMES},
}


@dataclass(frozen=True)
class Range:
    """From ``low`` to ``high`` in SI ``unit``, and what sets either end; empty if low > high.

    ``high`` is 0 where a light that the parameter does not move leaves nothing.
    """

    key: str
    text: str
    unit: str
    now: float
    low: float
    low_by: str
    high: float
    high_by: str

    @property
    def feasible(self) -> bool:
        """Whether any value does it."""
        return self.low <= self.high


def ranges(design: Design, wanted: float, now: float, lights: str = AMBER) -> list[Range]:
    """The range of each parameter for which t_99 <= ``wanted``; ``now`` is t_99 as designed (s), of
    a tube as section 3.4 has it.

    ValueError unless both times are positive and ``lights`` is green or amber.
    """
    if not (wanted > 0 and now > 0 and lights in (GREEN, AMBER)):
        raise ValueError(f"wanted = {wanted!r}, now = {now!r}, lights = {lights!r}: not allowed")
    limit = {c: getattr(c, lights) for c in (SLENDER, LEWIS, COUPLING, CONTINUUM)}
    faster, k, Le = wanted / now, design.si("permeability"), device.lewis_number(design)
    time, pore = "response time", math.sqrt(k)
    Pi_00 = design.material.Pi_00
    if design.kind == "bead":
        a = design.si("radius")
        found = [
            Range("radius", "radius of the bead", "m", a, limit[CONTINUUM] * pore, CONTINUUM.text,
                  a * math.sqrt(faster), time),
        ]  # fmt: skip
        thickness, coupled = a, math.inf
        conducting = Le / limit[LEWIS], LEWIS.text
        stiffest = Pi_00 * conducting[0], conducting[1]
    else:
        a_0, a_1, L = (design.si(key) for key in ("a_0", "a_1", "heated_length"))
        wall = a_1 - a_0
        thickness = wall
        slower = device.slower(design)
        faster /= slower(a_0 / a_1)
        thinnest = limit[CONTINUUM] * pore
        widest = L * math.sqrt(limit[SLENDER])
        narrowest = pore / math.sqrt(limit[COUPLING])
        found = [
            _range("wall", "thickness of the wall, same outer radius", "m", wall,
                   [(thinnest, CONTINUUM.text)],
                   [(_thickest(wall, faster, slower, lambda wall: 1 - wall / a_1, a_1), time),
                    (a_1, "no lumen is left")]),
            _range("a_1", "outer radius, same inner radius", "m", a_1,
                   [(a_0 + thinnest, CONTINUUM.text), (narrowest, COUPLING.text)],
                   [(a_0 + _thickest(wall, faster, slower, lambda wall: a_0 / (a_0 + wall)), time),
                    (widest, SLENDER.text)]),
            _range("size", "outer radius, same ratio of the radii", "m", a_1,
                   [(a_1 * thinnest / wall, CONTINUUM.text), (narrowest, COUPLING.text)],
                   [(a_1 * math.sqrt(faster), time), (widest, SLENDER.text)]),
        ]  # fmt: skip
        coupled = limit[COUPLING] * a_1**2
        conducting = math.inf, LEWIS.text  # a tube's front does not ask for Le
        stiffest = USUAL["osmotic_modulus"][1], PLAUSIBLE.text
    found += [
        _range("permeability", "permeability", "m^2", k, [(k / faster, time)],
               [(k * conducting[0], conducting[1]), (coupled, COUPLING.text),
                ((thickness / limit[CONTINUUM]) ** 2, CONTINUUM.text),
                (USUAL["permeability"][1], PLAUSIBLE.text)]),
        _range("osmotic_modulus", "osmotic modulus, all moduli in proportion", "Pa", Pi_00,
               [(Pi_00 / faster, time)], [stiffest]),
    ]  # fmt: skip
    seen, odd = before_solving(design), set(unusual(design))
    return [_blocked(each, seen, lights, odd) for each in found]


def _thickest(wall, faster, slower, ell, limit=math.inf) -> float:
    """The thickness x below ``limit`` with x^2 r(ell(x)) = wall^2 r(ell(wall)) faster."""
    from scipy.optimize import brentq

    allowed = wall**2 * slower(ell(wall)) * faster

    def excess(x):
        return x**2 * slower(ell(x)) / allowed - 1

    most = min(limit * (1 - 1e-9), 4 * wall * math.sqrt(faster))
    return limit if excess(most) < 0 else brentq(excess, 0, most, xtol=1e-12 * wall, rtol=1e-12)


def _blocked(each, seen, lights, odd) -> Range:
    """The range, or an empty one if a light is worse than ``lights`` that it does not move."""
    moved = MOVED[each.key] | ({PLAUSIBLE} if odd <= INPUTS[each.key] else set())
    for light in seen:
        worse = LIGHTS.index(light.light) > LIGHTS.index(lights)
        if worse and light.criterion not in moved:
            said = f"{light.light}: {light.criterion.text}"
            return replace(each, low=each.now, low_by=said, high=0.0, high_by=said)
    return each


def _range(key, text, unit, now, lows, highs) -> Range:
    return Range(key, text, unit, now, *max(lows), *min(highs))


def sentence(each: Range) -> str:
    """The range in words."""

    def said(value):
        number, unit = units.shown(value, each.unit)
        return f"{units.told(number, 4)} {units.readable(unit)}".strip()

    if each.high == 0:
        return f"{each.text}: none, whatever it is ({each.low_by})"
    if not each.feasible:
        return (
            f"{each.text}: none; at least {said(each.low)} ({each.low_by}), "
            f"at most {said(each.high)} ({each.high_by})"
        )
    return (
        f"{each.text}: {said(each.low)} ({each.low_by}) to {said(each.high)} ({each.high_by}); "
        f"now {said(each.now)}"
    )
