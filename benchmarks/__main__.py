"""python -m benchmarks measure FILE.json  |  python -m benchmarks page FILE.json FOLDER."""

import json
import sys
from pathlib import Path


def main(arguments: list[str]) -> int:
    """Measure, or make the page of what was measured."""
    match arguments:
        case ["measure", file]:
            from benchmarks import cost, growing
            from gelpump.text import write_json

            measured = {"machine": growing.machine(), "rebuild": growing.rebuild()}
            measured["growth"] = [*growing.series(), growing.steps()]
            measured["cost"] = cost.measure()
            Path(file).parent.mkdir(parents=True, exist_ok=True)
            write_json(measured, file)
        case ["page", file, folder]:
            from benchmarks import page

            page.write(json.loads(Path(file).read_text(encoding="utf-8")), Path(folder))
        case _:
            print(__doc__)
            return 2
    return 0


sys.exit(main(sys.argv[1:]))
