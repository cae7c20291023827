"""python -m benchmarks measure FILE.json  |  page FILE.json FOLDER  |  profile."""

import json
import sys
from pathlib import Path


def main(arguments: list[str]) -> int:
    """Measure, make the page of what was measured, or show where a rebuild spends its time."""
    match arguments:
        case ["measure", file]:
            from benchmarks import cost, growing, levers, profile
            from gelpump.text import write_json

            measured = {"machine": growing.machine(), "rebuild": growing.rebuild()}
            measured["profile"] = profile.rebuild()
            measured["growth"] = growing.series()
            measured["cost"] = cost.measure()
            measured["levers"] = levers.measure()
            Path(file).parent.mkdir(parents=True, exist_ok=True)
            write_json(measured, file)
        case ["page", file, folder]:
            from benchmarks import page

            page.write(json.loads(Path(file).read_text(encoding="utf-8")), Path(folder))
        case ["profile"]:
            from benchmarks import page, profile

            measured = profile.rebuild()
            print(page.spent_table(measured), page.imports_table(measured), sep="\n")
            print(page.rules_table(measured), page.functions_table(measured), sep="\n")
        case _:
            print(__doc__)
            return 2
    return 0


sys.exit(main(sys.argv[1:]))
