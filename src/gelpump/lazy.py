"""What a package gives without importing any of it before it is asked for.

A job that draws a figure need not import FiPy, and an edit of one model need not rerun the jobs of
another, though ``gelpump.bead`` gives both.  Scripts of the workflow name modules, not faces: that
is how a rule knows what it depends on.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def face(
    package: str, names: Mapping[str, str]
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """``__getattr__``, ``__dir__`` and ``__all__`` of a package that gives ``names``.

    names: by name, where it stands: ``module`` of gelpump, or ``module:attribute``.
    """

    def getattr_(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        module, _, attribute = names[name].partition(":")
        found = import_module(f"gelpump.{module}")
        return getattr(found, attribute) if attribute else found

    given = sorted(names)
    return getattr_, lambda: given, given
