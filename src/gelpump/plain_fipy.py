"""FiPy as gelpump needs it, whatever the environment and the command line tell it to be."""

import os
import sys
from functools import cache
from types import ModuleType


@cache
def load() -> ModuleType:
    """FiPy on SciPy's solvers and without its own inline compiler.

    FiPy reads ``FIPY_*`` and switches such as ``--inline`` and ``--petsc`` from whatever process
    it is first imported in; they are put aside meanwhile.  ImportError, with the cure, if Python
    has dropped the docstrings to some of which FiPy adds, or if FiPy was imported differently.
    """
    if sys.flags.optimize > 1:
        raise ImportError(
            "FiPy cannot be imported without docstrings: start Python without -OO, and with"
            " PYTHONOPTIMIZE unset or at most 1"
        )
    arguments, switches = sys.argv, {k: v for k, v in os.environ.items() if k.startswith("FIPY_")}
    sys.argv = arguments[:1]
    for name in switches:
        del os.environ[name]
    os.environ["FIPY_SOLVERS"] = "scipy"
    try:
        import fipy
        from fipy.solvers import solver_suite
        from fipy.tools.inline import doInline
    finally:
        sys.argv = arguments
        del os.environ["FIPY_SOLVERS"]
        os.environ.update(switches)
    if solver_suite != "scipy" or doInline:
        raise ImportError(
            f"FiPy was imported before gelpump with solvers of {solver_suite!r}"
            f"{' and --inline' if doInline else ''}: import gelpump's solvers first, or start"
            " without FIPY_SOLVERS, FIPY_INLINE, --inline and solver switches"
        )
    return fipy
