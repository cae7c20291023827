"""Which gelpump modules a script imports, directly or not, read from the text of its imports."""

import re
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
TYPE_CHECKING = re.compile(r"^if TYPE_CHECKING:\n(?:(?: {4}.*)?\n)+", re.MULTILINE)
IMPORT = re.compile(
    r"^ *from (gelpump[\w.]*|\.+[\w.]*) import (?:\(([^)]*)\)|(.*))|^ *import (gelpump[\w.]*)",
    re.MULTILINE,
)


def modules(script: str | Path) -> list[str]:
    """Paths, relative to the folder that holds src, of the modules that ``script`` imports.

    Imports in functions count, those for type checkers do not.  A module is imported together with
    the packages above it, and every script with what its frame, ``_helpers.py``, imports.
    """
    found, pending = set(), [Path(script), Path(script).with_name("_helpers.py")]
    while pending:
        new = _imported(pending.pop()) - found
        found |= new
        pending += new
    return sorted(path.relative_to(PACKAGE.parents[1]).as_posix() for path in found)


@cache
def _imported(file: Path) -> frozenset[Path]:
    names = set()
    for base, several, one, whole in IMPORT.findall(TYPE_CHECKING.sub("", file.read_text("utf-8"))):
        if base.startswith("."):
            base = _absolute(base, file)
        listed = re.findall(r"(\w+)(?: as \w+)?", re.sub("#.*", "", several or one))
        names |= {base or whole, *(f"{base}.{name}" for name in listed)}
    return frozenset(path for name in names for path in _files(name))


def _absolute(relative: str, file: Path) -> str:
    name = relative.lstrip(".")
    above = file.parents[len(relative) - len(name) - 1].relative_to(PACKAGE.parent).parts
    return ".".join([*above, name] if name else above)


@cache
def _files(name: str) -> tuple[Path, ...]:
    """The file of a module, if it is one, and of every package above it."""
    parts = name.split(".")[1:]
    packages = [PACKAGE.joinpath(*parts[:end], "__init__.py") for end in range(len(parts) + 1)]
    module = PACKAGE.joinpath(*parts).with_suffix(".py")
    return tuple(path for path in [*packages, module] if path.is_file())
