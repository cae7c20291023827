"""All checks of the build below the working directory: what `snakemake verify` runs."""

import json
from collections.abc import Mapping
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

import yaml

from gelpump.integrity import conventions, reference
from gelpump.integrity.build import Build
from gelpump.integrity.problem import Problem
from gelpump.tables import table


class Examination(NamedTuple):
    """Problems by check, every number beside the reference's, and what was not done."""

    checks: dict[str, list[Problem]]
    rows: list[reference.Row]
    notes: list[str]

    @property
    def passed(self) -> bool:
        """Whether nothing is wrong."""
        return not any(self.checks.values())

    def markdown(self) -> str:
        """A line a check with its verdict, all problems, every number beside its reference."""
        total = sum(map(len, self.checks.values()))
        lines = ["# Verification of this build", ""]
        lines += [f"**{f'{total} problems' if total else 'Everything agrees.'}**", ""]
        verdicts = {
            "check": lambda each: each[0],
            "verdict": lambda each: f"**{len(each[1])} found**" if each[1] else "passed",
        }
        lines += [table(verdicts, self.checks.items()), *(f"Note: {note}\n" for note in self.notes)]
        if total:
            lines += ["## Problems", ""]
            lines += [f"- {problem}" for found in self.checks.values() for problem in found]
            lines += [""]
        if self.rows:
            columns = {
                "variable": attrgetter("quantity"),
                "reference": lambda row: f"{row.reference:.9g}",
                "here": lambda row: f"{row.here:.9g}",
                "difference": lambda row: f"{row.difference:.1e}",
                "tolerance": lambda row: f"{row.tolerance:.1e}",
                "verdict": lambda row: "agrees" if row.agrees else "**differs**",
            }
            lines += ["## Numbers", "", table(columns, self.rows)]
        return "\n".join(lines)


def examine(blocks: Mapping[str, str | None], quantities: Path, values: Path) -> Examination:
    """Examine the build; FileNotFoundError if there is none.

    blocks: digest of what each job takes from the configuration now.  quantities and values: files
    of the numbers that are compared, and of the reference.
    """
    build = Build()
    checks = build.problems(blocks)
    notes = []
    if conventions.checker_installed():
        checks["datasets follow CF-1.11"] = conventions.problems(build.dataset_files())
    else:
        notes.append(
            "the datasets' CF metadata were NOT checked: compliance-checker is not installed "
            "(pip install -r requirements-test.txt, where it has wheels)."
        )
    data, checks["datasets can be read"] = build.datasets()
    known = json.loads(values.read_text(encoding="utf-8"))
    if known["numbers_digest"] != build.manifest["numbers_digest"]:
        note = (
            "the numbers were NOT compared: the reference is for the paper's configuration "
            f"(digest {known['numbers_digest'][:12]}), this build has another one "
            f"(digest {build.manifest['numbers_digest'][:12]})."
        )
        return Examination(checks, [], [*notes, note])
    listed = yaml.safe_load(quantities.read_text(encoding="utf-8"))
    here, absent = reference.evaluated(listed, data)
    rows, differing = reference.compared(known["values"], here)
    checks["numbers agree with the reference"] = absent + differing
    if known.get("shown_digest") != build.shown_digest:
        note = "the figures' key numbers were NOT compared: this build shows other ones."
        return Examination(checks, rows, [*notes, note])
    shown = reference.of_figures(build.figure_numbers())
    more, differing = reference.compared(known["figures"], shown)
    checks["figures' key numbers agree with the reference"] = differing
    return Examination(checks, rows + more, notes)
