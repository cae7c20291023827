"""What verify prints and writes."""

from collections.abc import Sequence

from gelpump.integrity.problem import Problem
from gelpump.integrity.reference import Row


def markdown(checks: dict[str, list[Problem]], rows: Sequence[Row], notes: Sequence[str]) -> str:
    """One line a check with its verdict, all problems, then every number beside its reference."""
    total = sum(map(len, checks.values()))
    lines = ["# Verification of this build", ""]
    lines += [f"**{f'{total} problems' if total else 'Everything agrees.'}**", ""]
    lines += ["| check | verdict |", "| --- | --- |"]
    lines += [f"| {name} | {_verdict(found)} |" for name, found in checks.items()]
    lines += ["", *(f"Note: {note}\n" for note in notes)]
    if total:
        lines += ["## Problems", ""]
        lines += [f"- {problem}" for found in checks.values() for problem in found]
        lines += [""]
    if rows:
        lines += [
            "## Numbers",
            "",
            "| variable | reference | here | difference | tolerance | verdict |",
            "| --- | ---: | ---: | ---: | ---: | --- |",
        ]
        lines += [
            f"| {row.quantity} | {row.reference:.9g} | {row.here:.9g} | {row.difference:.1e} "
            f"| {row.tolerance:.1e} | {'agrees' if row.agrees else '**differs**'} |"
            for row in rows
        ]
        lines += [""]
    return "\n".join(lines)


def _verdict(found: Sequence[Problem]) -> str:
    return f"**{len(found)} found**" if found else "passed"
