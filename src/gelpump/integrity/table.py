"""What verify prints and writes."""

from collections.abc import Sequence

from gelpump.integrity.problem import Problem
from gelpump.integrity.reference import Row
from gelpump.tables import table


def markdown(checks: dict[str, list[Problem]], rows: Sequence[Row], notes: Sequence[str]) -> str:
    """One line a check with its verdict, all problems, then every number beside its reference."""
    total = sum(map(len, checks.values()))
    lines = ["# Verification of this build", ""]
    lines += [f"**{f'{total} problems' if total else 'Everything agrees.'}**", ""]
    verdicts = {"check": lambda each: each[0], "verdict": lambda each: _verdict(each[1])}
    lines += [table(verdicts, checks.items()), *(f"Note: {note}\n" for note in notes)]
    if total:
        lines += ["## Problems", ""]
        lines += [f"- {problem}" for found in checks.values() for problem in found]
        lines += [""]
    if rows:
        columns = {
            "variable": lambda row: row.quantity,
            "reference": lambda row: f"{row.reference:.9g}",
            "here": lambda row: f"{row.here:.9g}",
            "difference": lambda row: f"{row.difference:.1e}",
            "tolerance": lambda row: f"{row.tolerance:.1e}",
            "verdict": lambda row: "agrees" if row.agrees else "**differs**",
        }
        lines += ["## Numbers", "", table(columns, rows)]
    return "\n".join(lines)


def _verdict(found: Sequence[Problem]) -> str:
    return f"**{len(found)} found**" if found else "passed"
