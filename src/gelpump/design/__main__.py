"""What the formulae say of a design, at once and without solving it.

python -m gelpump.design config/designs/microtube.yaml
python -m gelpump.design config/designs/microtube.yaml --within "10 ms"
python -m gelpump.design config/designs/millitube.yaml --within "10 s" --volume "2 uL" \\
    --wall "50 um" --inverse FOLDER

The last scans the tubes around this one for those that do all three, and leaves all of them, the
best and their picture in FOLDER (`gelpump.design.feasible`).
"""

import argparse
import signal
import sys
from pathlib import Path
from typing import Any

import gelpump
from gelpump.config import ConfigError
from gelpump.design import description, device, feasible, inverse, late, units, validity
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
    parser.add_argument("--volume", metavar="VOLUME", help='least volume per pulse, such as "2 uL"')
    parser.add_argument("--wall", metavar="LENGTH", help='thinnest wall, such as "50 um"')
    parser.add_argument("--inverse", metavar="FOLDER", help="scan for tubes that do all of these")
    parser.add_argument("--config", metavar="FILE", help="gels beside those of config/config.yaml")
    options = parser.parse_args(arguments)
    try:
        block = description.read(options.file)
        design = description.checked(options.file, block, gels_for(block, options.config))
        asked = _wanted(design, options)
        if options.inverse:
            return _scan(design, asked, Path(options.inverse))
    except ConfigError as refusal:
        print(refusal, file=sys.stderr)
        return 1
    longest = asked.get("response_time")
    tube = design.kind == "tube"
    for each in device.results(design) + (late.late_results(design) if tube else []):
        number, unit = units.shown(each.value, each.unit)
        print(f"{each.text:50} {number:12.6g} {units.readable(unit):6} {each.source}")
    lights = validity.before_solving(design) + (late.late_lights(design) if tube else [])
    for each in lights:
        print(f"{each.light:6} {each.criterion.text}: {each.reason}")
    if longest is not None and tube:
        now = device.response_time(design)
        for lights in (AMBER, GREEN):
            print(f"within {longest:g} s, {'no light red' if lights == AMBER else 'all green'}:")
            for each in inverse.ranges(design, longest, now, lights):
                print(f"  {inverse.sentence(each)}")
        print("heat, closeness and the lumen's pressure and flow are judged by building the change")
    elif longest is not None:
        print("a bead's response needs its solution: build its sheet")
    return 0


def _wanted(design, options):
    """What is wanted, in SI units: of the command line, or else of the design. ConfigError."""
    asked = {key: units.si(value, feasible.UNITS[key]) for key, value in design.wanted.items()}
    for key, name, example in (
        ("response_time", "within", "10 s"),
        ("pumped_volume", "volume", "2 uL"),
        ("wall", "wall", "50 um"),
    ):
        text = getattr(options, name)
        if text is None:
            continue
        try:
            asked[key] = units.si(units.parsed(text, feasible.UNITS[key]), feasible.UNITS[key])
            if not asked[key] > 0:
                raise ValueError("must be greater than 0")
        except ValueError as problem:
            raise ConfigError(f"--{name} = {text!r}: {problem}; such as {example!r}") from problem
    return asked


def _scan(design, asked, folder):
    from gelpump import netcdf, tables
    from gelpump.figures import design_feasible, style
    from gelpump.text import write_text

    found = feasible.scan(design, asked, feasible.SAMPLES)
    if not found.sizes["index"]:
        print(f"none of {found.scanned} slender tubes does it", file=sys.stderr)
        return 1
    some = feasible.confirmed(design, found)
    for line in feasible.sentences(found, some):
        print(line)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{Path(design.name).stem}_feasible"
    netcdf.write(found, file.with_suffix(".nc"), f"{design.title}: a scan around it", asked)
    columns = [
        tables.Column(f"{key} ({each.units})", f"{key} ({each.units})")
        for key, each in some.items()
    ]
    rows = zip(*(some[key].values for key in some), strict=True)
    write_text(tables.csv(columns, rows), file.with_suffix(".csv"))
    with style.styled():
        fig = design_feasible.picture(found, some)
        style.save(fig, [file.with_suffix(f".{kind}") for kind in ("pdf", "png", "svg")], None)
    return 0


if __name__ == "__main__":
    if hasattr(signal, "SIGPIPE"):  # a reader such as head may end before us: no fault
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main())
