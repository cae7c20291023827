"""Do the datasets follow the CF conventions?

The checker takes a variable without units for a dimensionless one; here each says "1", except
flags, which are not quantities.
"""

from collections.abc import Iterable, Iterator
from importlib.util import find_spec

from gelpump.integrity.problem import Problem

CHECKER = "cf:1.11"


def checker_installed() -> bool:
    """Whether there is a checker: not every platform can have one, and a build needs none."""
    return find_spec("compliance_checker") is not None


def problems(paths: Iterable[str]) -> list[Problem]:
    """What the CF checker finds, file by file; a file that cannot be read is a problem too."""
    from compliance_checker.runner import CheckSuite

    CheckSuite.load_all_available_checkers()
    suite = CheckSuite()
    found = []
    for path in paths:
        try:
            dataset = suite.load_dataset(path)
        except (OSError, ValueError) as failure:
            found.append(Problem(path, "unreadable", str(failure)))
            continue
        groups, errors = suite.run_all(dataset, [CHECKER])[CHECKER]
        messages = [
            f"{name} has no units"
            for name, variable in dataset.variables.items()
            if variable.dtype is not str and not {"units", "flag_values"} & {*variable.ncattrs()}
        ]
        dataset.close()
        messages += [message for group in groups for message in _messages(group)]
        messages += [f"{check}: {error[0]}" for check, error in errors.items()]
        found += [Problem(path, CHECKER, message) for message in messages]
    return found


def _messages(group) -> Iterator[str]:
    value = group.value
    passed = value[0] == value[1] if isinstance(value, tuple) else bool(value)
    if not passed:
        yield from group.msgs or [str(group.name)]
