"""A design file: read, checked key by key, and turned into a device.

A refusal names the key, what was given and what is allowed, as `gelpump.config` does; it comes
before any job.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from gelpump.config import ConfigError, require_plain, schema_problems, value_problems
from gelpump.design import programme as programmes
from gelpump.design import units
from gelpump.design.heat import UNKNOWN, given_latent_heat
from gelpump.design.material import Material, from_energy, from_moduli, from_ratios

OFFSET = "a difference of temperatures, in K or delta_degC"


class DesignError(ConfigError):
    """Some keys of a design are refused; the message lists them all, one a line."""


@dataclass(frozen=True)
class Design:
    """A checked design. ``given`` holds its pint quantities by key, each in its SI unit.

    Lengths of a tube are a_0, a_1, heated_length; of a bead, radius. ``surrounding`` is what
    conducts heat beside a tube; latent_heat is among the given if its enthalpy is known.
    """

    name: str
    kind: str
    title: str
    given: Mapping[str, Any]
    material: Material
    T_cold: float
    T_hot: float
    wanted: Mapping[str, Any]
    surrounding: str = UNKNOWN
    programme: programmes.Cycles | None = None

    def si(self, key: str) -> float:
        """The magnitude of a given quantity in its SI unit."""
        return float(self.given[key].magnitude)


@cache
def schema() -> dict[str, Any]:
    """The schemas of both kinds of design."""
    import yaml

    text = files("gelpump.design").joinpath("schema.yaml").read_text(encoding="utf-8")
    return yaml.safe_load(text)["$defs"]


def read(path: str | Path) -> Any:
    """The block that the file ``path`` holds.

    DesignError if it cannot be read, or does not mean what it seems to.
    """
    import yaml

    try:
        require_plain(path)
    except ConfigError as refusal:
        reasons = str(refusal).partition("\n")[2] or f"  {refusal}"
        raise DesignError(f"{path} is refused:\n{reasons}") from refusal
    with open(path, encoding="utf-8") as stream:
        return yaml.safe_load(stream)


def checked(name: str, block: Any, gels: Mapping[str, Any]) -> Design:
    """The design ``name`` of a block, with the gel blocks of the configuration.

    Raises DesignError.
    """
    if not isinstance(block, dict):
        raise DesignError(f"{name} is refused:\n  the file holds {block!r}: must be a mapping")
    _refuse(name, value_problems(block, ""))
    kind = block.get("kind")
    if kind not in ("tube", "bead"):
        given = f"kind = {kind!r}" if "kind" in block else "kind is missing"
        _refuse(name, [f"{given}: must be one of ['tube', 'bead']"])
    rules = schema()[kind]
    _refuse(name, schema_problems(block, rules))
    given, problems = {}, []
    for key, rule in rules["properties"].items():
        if "unit" in rule:
            text = block.get(key, rule.get("default"))
            if text is not None:
                problems += _quantity(key, text, rule, given)
    wanted, gel = {}, {}
    nested = {"wanted": wanted, "gel": gel}
    for key, into in nested.items():
        if isinstance(block.get(key), dict):
            for inner, rule in rules["properties"][key]["properties"].items():
                if "unit" in rule and inner in block[key]:
                    problems += _quantity(f"{key}.{inner}", block[key][inner], rule, into, inner)
    if "a_0" in given and "a_1" in given and not given["a_0"] < given["a_1"]:
        problems.append(f"a_0 = {block['a_0']!r}: must be less than a_1 = {block['a_1']!r}")
    _refuse(name, problems)
    T_C, step = (float(given[key].magnitude) for key in ("critical_temperature", "heating_step"))
    if not step < T_C:
        _refuse(
            name,
            [f"heating_step = {block['heating_step']!r}: must leave T_C - Delta T above 0 K"],
        )
    T_cold, T_hot = round(T_C - step, 9), round(T_C + step, 9)
    try:
        given_latent_heat(block, given)
        material = _material(block, given, gel, gels, T_cold, T_hot)
    except ValueError as refusal:
        _refuse(name, [str(refusal)])
    cycles, wrong = programmes.read(block, T_cold)
    if cycles and kind == "bead" and not material.energy_based:
        wrong.append(f"programme: a bead's gel = {block['gel']!r}: must be one with an energy")
    _refuse(name, [*wrong, *(programmes.range_problems(cycles, material) if cycles else ())])
    return Design(
        name, kind, block.get("title", name), given, material, T_cold, T_hot, wanted,
        block.get("surrounding", UNKNOWN), cycles,
    )  # fmt: skip


def _refuse(name, problems) -> None:
    found = list(problems)
    if found:
        raise DesignError(f"{name} is refused:\n  " + "\n  ".join(found))


def _quantity(key, text, rule, into, name=None) -> Iterator[str]:
    """Put the quantity that ``text`` says into ``into``; what is wrong with it."""
    allowed = f"must be a quantity in {rule['unit']} or the like, such as {rule['example']!r}"
    try:
        if key == "heating_step" and units.is_offset(text):
            yield f"{key} = {text!r}: must be {OFFSET}, such as {rule['example']!r}"
            return
        value = units.parsed(text, rule["unit"])
    except ValueError as problem:
        yield f"{key} = {text!r}: {problem}; {allowed}"
        return
    except Exception:  # pint raises many things at units it does not know
        yield f"{key} = {text!r}: is in no unit that is known; {allowed}"
        return
    if not value.magnitude > 0:
        yield f"{key} = {text!r}: must be greater than 0"
        return
    into[name or key] = value


def _material(block, given, gel, gels, T_cold, T_hot) -> Material:
    from gelpump.materials import from_config

    named, modulus = block["gel"], block.get("osmotic_modulus")
    if isinstance(named, dict):
        if modulus is not None:
            raise ValueError(f"osmotic_modulus = {modulus!r}: must stand in the block gel only")
        phi_00, phi_hot = named["polymer_fraction"], named["polymer_fraction_hot"]
        if not phi_hot > phi_00:
            raise ValueError(
                f"gel.polymer_fraction_hot = {phi_hot!r}: must be greater than "
                f"gel.polymer_fraction = {phi_00!r}, the gel collapses"
            )
        moduli = (gel[key].magnitude for key in ("osmotic_modulus", "osmotic_modulus_hot",
                                                 "shear_modulus"))  # fmt: skip
        return from_moduli("own gel", *moduli, phi_00, phi_hot)
    if named not in gels:
        raise ValueError(f"gel = {named!r}: must be one of {sorted(gels)}, or a block of moduli")
    found = from_config(named, gels[named])
    if not hasattr(found, "spinodal_tip"):
        if modulus is None:
            raise ValueError(f"osmotic_modulus is missing: gel = {named!r} has ratios only")
        if not found.Phi_inf > 1:
            raise ValueError(f"gel = {named!r}: its Phi_inf = {found.Phi_inf}: must exceed 1")
        return from_ratios(found, given["osmotic_modulus"].magnitude)
    if modulus is not None:
        raise ValueError(f"osmotic_modulus = {modulus!r}: not allowed, gel = {named!r} gives it")
    for key, T in (("T_C - Delta T", T_cold), ("T_C + Delta T", T_hot)):
        lowest, highest = found.temperature_range
        if not lowest <= T <= highest:
            raise ValueError(
                f"critical_temperature, heating_step: {key} = {T:g} K: must be within "
                f"{lowest:g} to {highest:g} K, the range of gel = {named!r}"
            )
    volume = getattr(found, "molecule_volume", None)
    if volume and "molecule_volume" in block:
        raise ValueError(
            f"molecule_volume = {block['molecule_volume']!r}: not allowed, gel = {named!r} gives it"
        )
    material = from_energy(found, T_cold, T_hot, volume or given["molecule_volume"].magnitude)
    if not material.Phi_inf > 1:
        raise ValueError(f"gel = {named!r}: does not collapse between {T_cold:g} and {T_hot:g} K")
    return material
