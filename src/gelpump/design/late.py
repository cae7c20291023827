"""What the wave of a tube's late pulse says, at once: front, flow and what is pumped, in SI units.

When the front has travelled the heated length, and if the wall had time to relax by then, the
solved device of `gelpump.design.solve_tube` is told by its travelling waves, with their stated
uncertainty (`gelpump.tube.wave`, `gelpump.tube.late_pump`). Keys are those of the solved device.
"""

from __future__ import annotations

import numpy as np

from gelpump.design import units
from gelpump.design.description import Design
from gelpump.design.device import lewis_number, scales, tubes
from gelpump.design.result import Result
from gelpump.design.solve_tube import TIMES
from gelpump.design.validity import Light, flow_lights
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.late_pump import late_pump, relaxation
from gelpump.tube.wave import late_pulse

CONSERVED, PRINTED = "water conserved", "as printed"


def is_late(design: Design) -> bool:
    """Whether the wall has time to relax once while the front travels the heated length, and the
    wave is found."""
    tube, tau = tubes(design), _end(design)
    if tau < relaxation(tube):
        return False
    found = late_pump(tube, lewis_number(design), tau).uncertainty
    return all(np.isfinite(each) for each in found.values())


def late_results(design: Design) -> list[Result]:
    """Numbers with the uncertainty of the waves; none where the pulse is not late."""
    if not is_late(design):
        return []
    scale = scales(design)
    second, L, a_1 = (
        units.si(scale[k], unit) for k, unit in (("time", "s"), ("along", "m"), ("across", "m"))
    )
    tube, Le, tau = tubes(design), lewis_number(design), _end(design)
    printed, pump = late_pulse(tube, Le, tau), late_pump(tube, Le, tau)
    volume, speed = np.pi * a_1**2 * L, L / second
    lumen = np.pi * design.si("a_0") ** 2
    found = []

    def add(key, text, symbol, unit, source, late, name, value, power=0.0):
        share = late.uncertainty[name]
        area = 1.0
        if power:
            area = late.values["Phi1_front"] ** power
            share = share + abs(power) * late.uncertainty["Phi1_front"]
        value = float(value * area)
        found.append(
            Result(f"final_{key}", text, symbol, value, unit, source, float(share * abs(value)))
        )

    wave, balance, eqn = "gelpump.tube.wave", "gelpump.tube.late_pump", "eqn:lumen"
    A = printed.values["A"]
    add("front_polymer_ratio", "polymer fraction at the front over the swollen one", "Phi_1", "1",
        wave, printed, "Phi1_front", printed.values["Phi1_front"])  # fmt: skip
    add("front_width", "width of the front, 10 to 90 per cent", "2.20 L/A", "m", wave, printed, "A",
        2 * np.arctanh(0.8) * L / A)  # fmt: skip
    add("departed_length", "length out of equilibrium", "", "m", wave, printed, "departed_length",
        L * printed.values["departed_length"])  # fmt: skip
    for key, name, text in (
        ("pumped_volume_conserving", "pumped_station",
         f"volume pumped per pulse and side, {CONSERVED}"),
        ("pumped_end_volume", "pumped_end", "the same, out of the tube’s own end"),
        ("collapse_volume", "collapse_station", "of it by the lumen’s collapse, past a station"),
        ("from_wall_volume", "inner", "of it out of the wall"),
        ("pumped_volume_printed", "printed_station",
         f"volume pumped per pulse and side, {PRINTED}"),
    ):  # fmt: skip
        source = eqn if name == "printed_station" else balance
        add(key, text, "", "m^3", source, pump, name, volume * pump.values[name])
    for form, said, source, late, front in (
        ("conserving", CONSERVED, balance, pump, "V_front"),
        ("printed", PRINTED, eqn, printed, "V_peak"),
    ):
        V, far = speed * late.values[front], speed * late.values["V_far"]
        add(f"flow_front_{form}", f"flow in the lumen at the front, {said}", "Q", "m^3/s", source,
            late, front, lumen * V, -2 / 3)  # fmt: skip
        add(f"flow_far_{form}", f"flow far ahead of the front, {said}", "Q", "m^3/s", source, late,
            "V_far", lumen * far)  # fmt: skip
    return found


def late_lights(design: Design) -> list[Light]:
    """Closeness, the lumen's pressure and its flow, with the largest velocity since the later of
    the first time that the solved device has and that in which the wall relaxes."""
    if not is_late(design):
        return []
    tube, Le, tau = tubes(design), lewis_number(design), _end(design)
    speed = design.si("heated_length") / units.si(scales(design)["time"], "s")
    early = np.maximum(tau / TIMES**2, relaxation(tube))
    printed, pump = late_pulse(tube, Le, early).values, late_pump(tube, Le, early).values
    peak = max(printed["V_peak"], abs(pump["V_front"]), abs(pump["V_far"]))
    now = late_pulse(tube, Le, tau).values
    return flow_lights(
        design, float(now["departed_length"]), float(now["Phi1_front"]), float(speed * peak)
    )


def _end(design):
    """tau when the front is at Z = 1."""
    return 1 / (FRONT_CONSTANT**2 * lewis_number(design))
