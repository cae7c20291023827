"""Can every pin be installed on every platform that the README names, without a compiler?

``python tests/install/wheels.py`` asks pip, for each platform and Python, for a wheel of each pin.
What has none, and why, stands below; a wheel that has come since is told, so that the list stays
true.  A pin without a wheel that is not listed fails.
"""

import argparse
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path

from packaging.requirements import Requirement

PROJECT = Path(__file__).resolve().parents[2]
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
PLATFORMS = {
    "macOS 14 arm64": ("darwin", "arm64", [f"macosx_{v}_0_arm64" for v in (14, 13, 12, 11)]),
    "Linux x86-64": (
        "linux",
        "x86_64",
        [f"manylinux_2_{v}_x86_64" for v in (28, 27, 24, 17, 12, 5)]
        + ["manylinux2014_x86_64", "manylinux2010_x86_64", "manylinux1_x86_64"],
    ),
    "Linux aarch64": (
        "linux",
        "aarch64",
        [f"manylinux_2_{v}_aarch64" for v in (28, 27, 26, 24, 17)] + ["manylinux2014_aarch64"],
    ),
}


def without_wheel(name: str, machine: str, python: str) -> str:
    """Why a pin has to be built there, or nothing if it should not have to be."""
    if name == "connection-pool":
        return "pure Python: needs no compiler"
    if name == "immutables" and python == "3.14":
        return "a C file: needs a compiler; Snakemake needs it, and no release has wheels"
    if name == "scikit-sundae" and machine == "aarch64":
        return "needs a compiler and SUNDIALS; no release has wheels"
    return ""


def pins(file: Path, system: str, machine: str, python: str) -> list[Requirement]:
    """Pins that the markers of a file of requirements choose there; pip would judge them here."""
    environment = {
        "sys_platform": system,
        "platform_system": system.capitalize(),
        "platform_machine": machine,
        "os_name": "posix",
        "python_version": python,
        "python_full_version": f"{python}.1",
        "implementation_name": "cpython",
        "platform_python_implementation": "CPython",
    }
    found = []
    for line in file.read_text(encoding="utf-8").splitlines():
        if line.startswith("-r "):
            found += pins(file.parent / line.removeprefix("-r "), system, machine, python)
        elif line and not line.startswith(("#", "-")):
            pin = Requirement(line.partition(" #")[0])
            if pin.marker is None or pin.marker.evaluate(environment):
                found.append(pin)
    return found


def answer(chosen: list[Requirement], tags: list[str], python: str) -> str:
    """Nothing if pip has a wheel for each pin, otherwise its words."""
    with tempfile.TemporaryDirectory() as folder:
        asked = Path(folder, "pins.txt")
        asked.write_text("".join(f"{pin.name}{pin.specifier}\n" for pin in chosen))
        where = [argument for tag in tags for argument in ("--platform", tag)]
        where += ["--python-version", python, "--implementation", "cp", "--target", folder]
        pip = [sys.executable, "-m", "pip", "install", "--dry-run", "--quiet", "--no-deps"]
        wheels = ["--ignore-installed", "--only-binary", ":all:"]
        result = subprocess.run(
            [*pip, *wheels, *where, "-r", asked],
            capture_output=True,
            text=True,
            check=False,
        )
    errors = [line for line in result.stderr.splitlines() if line.startswith("ERROR")]
    return "\n  ".join(errors or [result.stderr]) if result.returncode else ""


def examined(case: tuple[str, str]) -> tuple[str, bool]:
    """What is found on one platform with one Python, and whether it is as told above."""
    (system, machine, tags), python = PLATFORMS[case[0]], case[1]
    chosen, built = [], []
    for pin in pins(PROJECT / "requirements-test.txt", system, machine, python):
        reason = without_wheel(pin.name, machine, python)
        (built if reason else chosen).append(pin)
    said = [f"{case[0]}, Python {python}: {len(chosen)} wheels"]
    problem = answer(chosen, tags, python)
    if problem:
        said.append(f"  {problem}")
    for pin in built:
        reason = without_wheel(pin.name, machine, python)
        come = not answer([pin], tags, python)
        said.append(f"  {pin.name}: {'has a wheel now' if come else reason}")
    return "\n".join(said), not problem


def library_on_windows(python: str) -> tuple[str, bool]:
    """Whether what the library alone needs has wheels for Windows, where nothing else is tried."""
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    problem = answer([Requirement(each) for each in project["dependencies"]], ["win_amd64"], python)
    said = problem or f"{len(project['dependencies'])} wheels"
    return f"Windows, the library alone, Python {python}: {said}", not problem


def main() -> int:
    """Exit code 1 if a pin that should have a wheel has none."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--python", choices=PYTHONS, action="append")
    arguments = parser.parse_args()
    pythons = arguments.python or PYTHONS
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(examined, product(PLATFORMS, pythons)))
        found += pool.map(library_on_windows, pythons)
    print("\n".join(said for said, _ in found))
    fine = sum(good for _, good in found)
    print(f"{fine} of {len(found)} platforms do as told")
    return fine < len(found)


if __name__ == "__main__":
    sys.exit(main())
