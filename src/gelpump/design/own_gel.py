"""How far the tube's piecewise-linear picture of a gel is off: the gel's own tube beside it.

`gelpump.cycles.tube` with the gel's D and phi_0(T) at the temperature of each place, the end heated
from T_C - Delta T to T_C + Delta T, until Z_C = 1; water conserved.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gelpump.design import units
from gelpump.design.programme import LEVELS, parted
from gelpump.design.result import Result
from gelpump.uncertainty import convergence_index

if TYPE_CHECKING:
    from gelpump.design.description import Design

KEY = "own_gel_pumped_volume"


def own_gel(design: Design) -> tuple[list[Result], str]:
    """What the gel itself pumps, and what is to be said; no number where D < 0 is met."""
    from gelpump.cycles import tube
    from gelpump.cycles.programme import Programme
    from gelpump.design.device import lewis_number, scales, tubes
    from gelpump.tube.heat import FRONT_CONSTANT

    Le, scale = lewis_number(design), scales(design)
    second, a_1, L = (units.si(scale[key], unit) for key, unit in
                      (("time", "s"), ("across", "m"), ("along", "m")))  # fmt: skip
    heated = Programme(design.T_cold, ((0.0, design.T_cold), (0.0, design.T_hot)))
    tau = [1 / (FRONT_CONSTANT**2 * Le)]
    runs = [
        tube.solve(tubes(design), heated, Le, tau, gel=design.material.gel, cell=cell,
                   tolerance=tolerance)
        for cell, tolerance in LEVELS
    ]  # fmt: skip
    if runs[1].lost:
        return [], f"With the gel’s own D and φ₀(T) {parted(runs[1].lost, second, L)}."
    volumes = [np.pi * a_1**2 * L * float(run.station[-1]) for run in runs]
    text = "volume pumped per pulse and side, with the gel’s own D and φ₀(T)"
    return [
        Result(KEY, text, "", volumes[1], "m^3", "gelpump.cycles",
               float(convergence_index(*volumes)))
    ], ""  # fmt: skip
