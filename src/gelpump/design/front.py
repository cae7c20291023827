"""What the front of a bead tells of a gel that separates in a design.

Where D < 0 on the way, dry and swollen gel part, and a sharp front dries a bead from its surface
inwards (`gelpump.separation.sharp`, the fully nonlinear bead). With a its swollen radius, t_1 when
the skin appears and t_2 when the front is at the centre,

    front speed = a/(t_2 - t_1) .

No front in a tube is solved. Water leaves a wall through both of its surfaces, so it is told what
a bead as thick as the wall does, a = (a_1 - a_0)/2: half the thickness over the front's speed. A
flat wall takes longer, up to three times if its front moves quasi-steadily (a^2/2 against a^2/6).
"""

from __future__ import annotations

import numpy as np

from gelpump.design.description import Design
from gelpump.design.result import Result
from gelpump.design.validity import smallest_diffusivity

CELLS = (40, 20)
TOLERANCE = 1e-6
HORIZON = 1e4  # relaxation times of the collapsed bead within which the front must arrive
SOURCE = "gelpump.separation.sharp"
BEAD_NOTE = (
    "Where phases separate the profiles drawn end. A sharp front then dries the bead from its "
    "surface inwards: its times are those of the fully nonlinear bead (docs/separation.md)."
)
NO_TUBE = "dry and swollen gel part in the wall: a slender tube has one phase, none is solved"
TUBE_NOTE = (
    "Dry and swollen gel part in this wall, which no slender tube has. No front in a tube is "
    "solved: what is told is a bead as thick as the wall, half the thickness over its front's "
    "speed. It is an order of magnitude; a flat wall alone takes up to three times as long."
)


def separates(design: Design) -> bool:
    """Whether phases part in a tube: D < 0 on the way of its gel."""
    return design.material.energy_based and smallest_diffusivity(design)[0] <= 0


def front_of(design: Design) -> tuple[list[Result], str]:
    """Times and speed of the front, and what is to be said; no number where none is solved."""
    try:
        fine, coarse = (_times(design, share) for share in (1, 2))
    except (ValueError, RuntimeError) as reason:
        return [], f"Phases part, but no front is told: {reason}."
    half = design.si("radius") if design.kind == "bead" else _wall(design) / 2
    fine, coarse = ((_second(design, half) * each).tolist() for each in (fine, coarse))
    where, middle = (
        ("fully nonlinear bead", "at the centre")
        if design.kind == "bead"
        else ("bead as thick as the wall", "has dried all")
    )
    speeds = [half / (each[1] - each[0]) for each in (fine, coarse)]
    found = [
        Result("separation_time", f"phases separate, {where}", "t_1", fine[0], "s", SOURCE,
               abs(fine[0] - coarse[0])),
        Result("drying_front_time", f"drying front {middle}, {where}", "t_2", fine[1], "s",
               SOURCE, abs(fine[1] - coarse[1])),
        Result("drying_front_speed", f"mean speed of the drying front, {where}", "a/(t_2 - t_1)",
               speeds[0], "m/s", SOURCE, abs(speeds[0] - speeds[1])),
    ]  # fmt: skip
    return found, BEAD_NOTE if design.kind == "bead" else TUBE_NOTE


def _times(design: Design, coarser: int) -> np.ndarray:
    """When the skin appears and when the front is at the centre, in t_BMJ; RuntimeError if not."""
    from gelpump.separation import sharp
    from gelpump.separation.energy import Nonlinear

    material = design.material
    end = HORIZON * _relaxation(material)
    run = sharp.solve(
        Nonlinear(material.gel, material.hot),
        material.own_start,
        np.append(0.0, end * np.geomspace(1e-8, 1.0, 33)),
        tuple(count // coarser for count in CELLS),
        tolerance=TOLERANCE * coarser**2,
        skin=sharp.SKIN * coarser,
    )
    if run.stopped:
        raise RuntimeError(run.stopped)
    if "completion_t" not in run.attrs:
        what = "does not arrive" if "birth_t" in run.attrs else "is not born in the nonlinear bead"
        raise RuntimeError(f"it {what} within {HORIZON:g} relaxation times")
    return np.array([run.attrs["birth_t"], run.attrs["completion_t"]])


def _relaxation(material) -> float:
    """a^2/(pi^2 D) of the collapsed bead, in t_BMJ."""
    phi = material.own_start * material.Phi_inf
    D = float(material.gel.diffusivity(phi, material.hot)) / material.gel.shear_modulus(1.0)
    return phi ** (-2 / 3) / (np.pi**2 * D)


def _wall(design: Design) -> float:
    return design.si("a_1") - design.si("a_0")


def _second(design: Design, half: float) -> float:
    """t_BMJ = mu_l R_dry^2/(k mu_s(1)) of a bead of swollen radius ``half``, in s."""
    material = design.material
    R_dry = half * np.cbrt(material.own_start)
    mu = material.gel.shear_modulus(1.0) * material.pressure_unit
    return design.si("viscosity") * R_dry**2 / (design.si("permeability") * mu)
