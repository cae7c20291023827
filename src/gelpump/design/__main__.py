"""What the formulae say of a design, at once and without solving it.

python -m gelpump.design config/designs/microtube.yaml
python -m gelpump.design config/designs/microtube.yaml --within "10 ms"
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import gelpump
from gelpump.config import ConfigError
from gelpump.design import description, device, inverse, late, units, validity
from gelpump.design.result import AMBER, GREEN


def gels_for(block: Any, config: str | None = None) -> dict[str, Any]:
    """The gels that a design's ``block`` may name: the project's, and those of the file ``config``.

    The project is the folder that this is run in, or else the one that gelpump stands in. The gel
    that is named is fitted if it is a measured one; warnings go to standard error. ConfigError.
    """
    from gelpump.materials import measured

    folders = [Path.cwd(), Path(gelpump.__file__).parents[2]]
    own = [path for folder in folders if (path := folder / "config/config.yaml").is_file()]
    gels: dict[str, Any] = {}
    for file in [*own[:1], *([Path(config)] if config else [])]:
        given = description.read(file)
        found = given.get("gels", {}) if isinstance(given, dict) else given
        if not (isinstance(found, dict) and all(isinstance(b, dict) for b in found.values())):
            raise ConfigError(f"{file}: gels: must be blocks of gels by name")
        for name, gel in found.items():
            gels[name] = gels.get(name, {}) | gel
    named = block.get("gel") if isinstance(block, dict) else None
    if isinstance(named, str) and named in gels:
        if config:
            folders.insert(1, Path(config).parent)
        try:
            measured.resolve(only := {named: gels[named]}, folders, _warn)
        except ValueError as refusal:
            raise ConfigError(f"gels.{refusal}") from refusal
        gels |= only
    return gels


def _warn(text: str) -> None:
    print(f"warning: {text}", file=sys.stderr)


def main(arguments: list[str] | None = None) -> int:
    """Print numbers, lights and, for a tube, the ranges; 1 if the design is refused."""
    parser = argparse.ArgumentParser(
        prog="python -m gelpump.design",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("file", help="a design, as in config/designs")
    parser.add_argument("--within", metavar="TIME", help='longest response time, such as "10 s"')
    parser.add_argument("--config", metavar="FILE", help="gels beside those of config/config.yaml")
    options = parser.parse_args(arguments)
    try:
        block = description.read(options.file)
        design = description.checked(options.file, block, gels_for(block, options.config))
        wanted = design.wanted.get("response_time")
        if options.within:
            wanted = units.parsed(options.within, "s")
    except ConfigError as refusal:
        print(refusal, file=sys.stderr)
        return 1
    except ValueError as problem:
        print(f"--within = {options.within!r}: {problem}; such as '10 s'", file=sys.stderr)
        return 1
    tube = design.kind == "tube"
    for each in device.results(design) + (late.late_results(design) if tube else []):
        number, unit = units.shown(each.value, each.unit)
        print(f"{each.text:50} {number:12.6g} {units.readable(unit):6} {each.source}")
    lights = validity.before_solving(design) + (late.late_lights(design) if tube else [])
    for each in lights:
        print(f"{each.light:6} {each.criterion.text}: {each.reason}")
    if wanted is not None and tube:
        now, longest = device.response_time(design), units.si(wanted, "s")
        for lights in (AMBER, GREEN):
            print(f"within {longest:g} s, {'no light red' if lights == AMBER else 'all green'}:")
            for each in inverse.ranges(design, longest, now, lights):
                print(f"  {inverse.sentence(each)}")
        print("heat, closeness and the lumen's pressure and flow are judged by building the change")
    elif wanted is not None:
        print("a bead's response needs its solution: build its sheet")
    return 0


if __name__ == "__main__":
    sys.exit(main())
