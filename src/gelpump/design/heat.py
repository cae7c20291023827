"""Heat that a device's collapse takes up, and how far that holds its front back (docs/heat.md).

With h the enthalpy by calorimetry, per dry mass (J/g) or per mole of repeat units (kJ/mol), rho_p
the density of the dry polymer, m the molar mass of its repeat unit and rho c the heat capacity,

    latent heat   h rho_p, or h rho_p/m, per dry volume;   phi_00 of it per swollen volume
    St = phi_00 (latent heat)/(rho c Delta T)     P = Pi_00/(rho c Delta T)     N = T_C/Delta T
    f St,  f = pi (a_1^2 - a_0^2) over the section that conducts      (`gelpump.tube.stefan`)

A tube is judged by the shift of its front, |Delta Z_C|/Z_C, long after the start: in a pipe 1 and
5 % are f St Phi_inf^(1/3) = 0.033 and 0.18. A bead is judged by how far its own collapse cools it,
0.4 St/Le: the mean of a sphere with a uniform sink, in water that conducts as it does. What is
unknown is never green unless the most that is usual for PNIPAM would be.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gelpump.design import units
from gelpump.design.result import Criterion, Light, Result
from gelpump.design.units import told

if TYPE_CHECKING:
    from gelpump.design.description import Design

UNKNOWN = "unknown"
USUAL_MOST = "6.5 kJ/mol"  # calorimetry of PNIPAM finds 5 to 6.5
SINK = 0.4  # mean of 1/15 (within) + 1/3 (around) of a sphere with a uniform sink
HEAT = Criterion("heat", "the heat that the collapse takes is small", "shift", 0.01, 0.05,
                 "docs/heat.md, section 3.5")  # fmt: skip
DERIVED = "gelpump.tube.stefan"


def latent_heat(text: str, density: Any, repeat_unit: Any) -> Any:
    """Heat per dry volume of what calorimetry gives in ``text``.

    ValueError if it is neither a heat per mass nor per mole, or not positive.
    """
    try:
        value = (units.parsed(text, "J/kg") * density).to("J/m^3")
    except ValueError:
        value = (units.parsed(text, "J/mol") * density / repeat_unit).to("J/m^3")
    if not value.magnitude > 0:
        raise ValueError("is not greater than 0, as the heat that the collapse takes up is")
    return value


def given_latent_heat(block: dict, given: dict) -> None:
    """Put the latent heat of a checked block into ``given``, and hold its pipe to its tube.

    ValueError with the key, its value and what is allowed.
    """
    text = block.get("enthalpy", UNKNOWN)
    if text != UNKNOWN:
        try:
            heat = latent_heat(text, given["polymer_density"], given["repeat_unit"])
        except ValueError as problem:
            raise ValueError(
                f"enthalpy = {text!r}: {problem}; must be a heat per dry mass or per mole of "
                "repeat units, such as '50 J/g' or '5.5 kJ/mol', or 'unknown'"
            ) from problem
        given["latent_heat"] = heat
    if block["kind"] == "bead":
        return
    kind, section = block.get("surrounding", UNKNOWN), given.get("pipe_section")
    if (kind == "pipe") != (section is not None):
        raise ValueError(
            "pipe_section is missing: surrounding = 'pipe' needs it"
            if kind == "pipe"
            else f"pipe_section = {block['pipe_section']!r}: only goes with surrounding = 'pipe'"
        )
    if section is not None and not section >= np.pi * given["a_1"] ** 2:
        raise ValueError(
            f"pipe_section = {block['pipe_section']!r}: must be at least the tube's, "
            f"pi a_1^2 = {told(np.pi * given['a_1'].magnitude ** 2)} m^2"
        )


def groups(design: Design, heat: Any | None = None) -> dict[str, float]:
    """P, N and, where latent heat and swollen fraction are known, St and, where gel shares its
    section, f St; of ``heat`` per dry volume in place of what is given."""
    given, material = design.given, design.material
    stored = given["heat_capacity"] * given["heating_step"]
    found = {
        "P": units.si(units.quantity(material.Pi_00, "Pa") / stored, ""),
        "N": units.si(given["critical_temperature"] / given["heating_step"], ""),
    }
    heat = given.get("latent_heat") if heat is None else heat
    if heat is not None and material.phi_00 is not None:
        found["St"] = units.si(material.phi_00 * heat / stored, "")
        if design.surrounding in ("pipe", "insulated"):
            area = np.pi * (given["a_1"] ** 2 - given["a_0"] ** 2)
            pipe = given.get("pipe_section", np.pi * given["a_1"] ** 2)
            found["f_St"] = found["St"] * units.si(area / pipe, "")
    return found


def usual_most(design: Design) -> Any:
    """The latent heat of PNIPAM, at most."""
    return latent_heat(
        USUAL_MOST, *(design.given[key] for key in ("polymer_density", "repeat_unit"))
    )


def shift(design: Design, kind: str, St: float) -> float:
    """Relative shift of the front of a tube in this surrounding; of a bead, its own cooling."""
    from gelpump.design.device import lewis_number, tubes
    from gelpump.tube.heat import FRONT_CONSTANT
    from gelpump.tube.stefan import Surrounding, bath_shift, front_constant

    Le = lewis_number(design)
    if design.kind == "bead":
        return -SINK * St / Le
    tube = tubes(design)
    if kind == "bath":
        return float(bath_shift(tube, St))
    root = front_constant(tube, St, Surrounding(kind, section(design)), Le)
    return float(np.ravel(root)[0]) / FRONT_CONSTANT - 1


def section(design: Design) -> float:
    """Of the pipe, over pi a_1^2; 1 without one."""
    pipe = design.given.get("pipe_section")
    return 1.0 if pipe is None else units.si(pipe / (np.pi * design.given["a_1"] ** 2), "")


def light(design: Design) -> Light:
    """Whether the heat that the collapse takes may be left out, as the solved device does."""
    known, kind = "latent_heat" in design.given, design.surrounding
    found = groups(design, None if known else usual_most(design))
    if "St" not in found:
        return Light(HEAT, 0.0, "unknown: the gel's swollen polymer fraction is not given", True)
    St = found["St"]
    said = f"St = {told(St)}" + ("" if known else f" at {USUAL_MOST}, the enthalpy being unknown")
    if design.kind == "bead":
        value = abs(shift(design, "bath", St))
        return Light(HEAT, value, f"{said}: the bead cools itself by {told(value, 2)} of ΔT")
    kinds = ["bath", "insulated"] if kind == UNKNOWN else [kind]
    values = [abs(shift(design, each, St)) for each in kinds]
    told_of = " and ".join(
        f"{told(100 * value, 2)} % {'in a ' if each in ('bath', 'pipe') else 'if '}{each}"
        for each, value in zip(kinds, values, strict=True)
    )
    start = "surrounding unknown: " if kind == UNKNOWN else ""
    open_ = kind == UNKNOWN
    if not known and not open_ and kind != "insulated":
        open_ = HEAT.light(values[0]) != "green"
    return Light(HEAT, values[0], f"{start}front held back by {told_of}; {said}", open_)


def results(design: Design) -> list[Result]:
    """The groups, the front that the heat holds back, and what an energy says of its own heat."""
    given, found = design.given, groups(design)
    texts = {
        "P": ("osmotic pressure over the heat stored", "P"),
        "St": ("Stefan number", "St"),
        "f_St": ("the same, times the wall’s share of the section", "f St"),
    }
    rows = [
        Result(key, *text, found[key], "1", DERIVED) for key, text in texts.items() if key in found
    ]
    if "latent_heat" in given:
        heat = units.si(given["latent_heat"], "J/m^3")
        rows.append(
            Result("latent_heat", "latent heat of the dry polymer", "h ρ", heat, "J/m^3",
                   "calorimetry, as given")
        )  # fmt: skip
    own = own_latent_heat(design)
    if own is not None:
        rows.append(
            Result("own_latent_heat", "the same by its energy, not to be trusted", "ΔU", own,
                   "J/m^3", "gelpump.materials.latent_heat")
        )  # fmt: skip
    if "St" in found and design.kind == "tube" and design.surrounding != UNKNOWN:
        from gelpump.tube.heat import FRONT_CONSTANT

        held = shift(design, design.surrounding, found["St"])
        travel = units.si(given["heated_length"] ** 2 / given["thermal_diffusivity"], "s")
        if held > -1:
            rows.append(
                Result("travel_time_held_back", "time of the front, held back by latent heat",
                       "t_L", travel / (FRONT_CONSTANT * (1 + held)) ** 2, "s", DERIVED)
            )  # fmt: skip
    return rows


def own_latent_heat(design: Design) -> float | None:
    """U(phi_hot) - U(phi_cold) at T_C of an energy, J per m^3 of dry polymer; None without one."""
    from gelpump.materials.latent_heat import BOLTZMANN
    from gelpump.materials.latent_heat import latent_heat as of_energy

    material = design.material
    if not material.energy_based:
        return None
    T = units.si(design.given["critical_temperature"], "K")
    volume = BOLTZMANN * design.T_hot / material.pressure_unit
    hot = material.phi_00 * material.Phi_inf
    return of_energy(material.gel, material.phi_00, hot, T, volume)
