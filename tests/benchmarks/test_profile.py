"""The profile of a rebuild: what a process samples of itself, and what it is taken for."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from benchmarks import page, profile

PACKAGES = "/somewhere/lib/python3.11/site-packages"
IMPORT = "<frozen importlib._bootstrap>:_find_and_load"
SCRIPT = "/build/.snakemake/scripts/tmpab1_.fig09_relax.py:<module>"

BURN = """
import os
import threading
import time

def burn(seconds):
    until = time.process_time() + seconds
    while time.process_time() < until:
        pass

def in_one_call():
    sorted(range(1_000_000, 0, -1), key=str)

def elsewhere():
    burn(0.5)

burn(0.6)
thread = threading.Thread(target=elsewhere)
thread.start()
thread.join()
before = time.process_time()
in_one_call()
print(time.process_time() - before, flush=True)
"""


def test_a_process_samples_itself(tmp_path):
    sampling = Path(profile.__file__).parent / "sampling"
    environment = os.environ | {"PYTHONPATH": str(sampling), "GELPUMP_PROFILE": str(tmp_path)}
    run = subprocess.run(
        [sys.executable, "-c", BURN],
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    )
    (file,) = tmp_path.glob("*.json")
    record = json.loads(file.read_text(encoding="utf-8"))
    spent = dict.fromkeys(("burn", "in_one_call", "elsewhere"), 0.0)
    for stack, seconds in record["stacks"]:
        for name in spent:
            spent[name] += seconds * (f"<string>:{name}" in stack)
    assert spent["burn"] == pytest.approx(1.1, rel=0.1)
    assert spent["elsewhere"] == pytest.approx(0.5, rel=0.1)
    # a long call into C is not left out, though no sample is taken within it
    assert spent["in_one_call"] == pytest.approx(float(run.stdout), rel=0.2)
    sampled = sum(seconds for _, seconds in record["stacks"])
    whole = record["start"] + sampled + record["sampling"]
    assert whole == pytest.approx(record["seconds"], rel=0.02)
    assert record["sampling"] < 0.1 * record["seconds"]
    assert record["memory_mb"] > 5


FORK = """
import atexit, os, time
if os.fork() == 0:
    while time.process_time() < 0.3:
        pass
    atexit._run_exitfuncs()
    os._exit(0)
os.wait()
"""


def test_a_fork_samples_itself_and_nothing_of_its_parent(tmp_path):
    sampling = Path(profile.__file__).parent / "sampling"
    environment = os.environ | {"PYTHONPATH": str(sampling), "GELPUMP_PROFILE": str(tmp_path)}
    subprocess.run([sys.executable, "-c", FORK], env=environment, check=True)
    records = [json.loads(file.read_text(encoding="utf-8")) for file in tmp_path.glob("*.json")]
    fork = max(records, key=lambda record: record["seconds"])
    assert len(records) == 2
    assert sum(seconds for _, seconds in fork["stacks"]) == pytest.approx(0.3, rel=0.1)


def test_without_being_asked_a_process_is_left_alone(tmp_path):
    sampling = Path(profile.__file__).parent / "sampling"
    ask = "import signal; print(signal.getsignal(signal.SIGPROF) == signal.SIG_DFL)"
    environment = {k: v for k, v in os.environ.items() if k != "GELPUMP_PROFILE"}
    run = subprocess.run(
        [sys.executable, "-c", ask],
        env=environment | {"PYTHONPATH": str(sampling)},
        check=True,
        capture_output=True,
        text=True,
    )
    assert run.stdout.strip() == "True"


@pytest.mark.parametrize(
    ("frames", "name"),
    [
        ([IMPORT, f"{PACKAGES}/fipy/__init__.py:<module>"], "imports"),
        (
            [
                f"{PACKAGES}/fipy/terms/term.py:sweep",
                f"{PACKAGES}/fipy/terms/term.py:_prepareLinearSystem",
            ],
            "FiPy: matrix assembly",
        ),
        (
            [
                f"{PACKAGES}/fipy/terms/term.py:sweep",
                "/build/src/gelpump/tridiagonal.py:_solve_",
                f"{PACKAGES}/scipy/linalg/_basic.py:solve_banded",
            ],
            "linear solves",
        ),
        ([f"{PACKAGES}/fipy/variables/cellVariable.py:setValue"], "FiPy: the rest"),
        (["/build/src/gelpump/bead/lens.py:linearised"], "our own Python"),
        (["/build/src/gelpump/netcdf.py:write"], "netCDF: writing"),
        (["/build/src/gelpump/figures/fig09_relax.py:draw"], "figures: drawing"),
        (
            [
                "/build/src/gelpump/figures/style.py:save",
                f"{PACKAGES}/matplotlib/backends/backend_pdf.py:print_pdf",
            ],
            "figures: saving PDF",
        ),
        (["/build/src/gelpump/figures/style.py:save"], "figures: layout"),
        ([], "the rest"),
    ],
)
def test_what_a_stack_is_taken_for(frames, name):
    assert profile.category([SCRIPT, *frames]) == name


def test_an_import_is_that_of_the_package_that_asked_for_others():
    stack = [SCRIPT, IMPORT, "/build/src/gelpump/netcdf.py:<module>", IMPORT]
    stack += [f"{PACKAGES}/xarray/__init__.py:<module>", IMPORT]
    assert profile.imported([*stack, f"{PACKAGES}/pandas/__init__.py:<module>"]) == "xarray"
    assert profile.imported([SCRIPT, IMPORT]) == "Python's own and gelpump"


def test_rules_and_groups():
    assert profile.job(["/build/.snakemake/scripts/tmpab1_.fig09_relax.py"]) == "fig09_relax"
    assert profile.job(["/venv/lib/snakemake/__main__.py", "all"]) == ""
    named = {rule: profile.group(rule) for rule in ("", "fig09_relax", "bead_lens", "anything")}
    assert list(named.values()) == ["Snakemake", "figures", "beads", "others"]


def records():
    scheduler = {
        "command": ["/venv/lib/snakemake/__main__.py"],
        "start": 0.1,
        "sampling": 0.1,
        "seconds": 2.2,
        "wall": 9.0,
        "memory_mb": 90.0,
        "stacks": [[["/venv/lib/snakemake/dag.py:init"], 2.0]],
    }
    figure = scheduler | {
        "command": ["/build/.snakemake/scripts/tmpab1_.fig09_relax.py"],
        "stacks": [
            [[SCRIPT, IMPORT, f"{PACKAGES}/xarray/__init__.py:<module>"], 1.5],
            [[SCRIPT, "/build/src/gelpump/figures/fig09_relax.py:draw"], 0.5],
        ],
    }
    return [scheduler, figure]


def test_every_second_is_counted_once():
    found = profile.summed(records(), 5.0)
    assert found["seconds"] == pytest.approx(4.8)
    counted = sum(sum(each.values()) for each in found["table"].values())
    assert counted == pytest.approx(found["seconds"])
    assert set().union(*found["table"].values()) <= set(profile.ROWS)
    assert found["table"]["figures"] == pytest.approx(
        {
            "interpreter: start": 0.1,
            "imports": 1.5,
            "figures: drawing": 0.5,
            "interpreter: end, and shells": 0.6,
        }
    )
    assert found["imports"] == {"xarray": [1, 1.5]}
    assert found["rules"]["fig09_relax"]["seconds"] == pytest.approx(2.1)
    assert not any("tmpab1_" in name for name, _ in found["functions"])


def test_the_page_shows_them():
    found = profile.summed(records(), 5.0)
    assert "| imports |  | 1.5 |  |  |  |  | 1.5 | 31% |" in page.spent_table(found)
    assert "| xarray | 1 | 1.5 |" in page.imports_table(found)
    assert "| fig09_relax | 1 | 2.1 | 9.0 | 90 |" in page.rules_table(found)
    assert "figures/fig09_relax.py:draw | 0.5 |" in page.functions_table(found)


def test_what_is_left_adds_up():
    found = profile.summed(records(), 5.0) | {"wall": 4.0}
    once = {"needed": {"seconds": 1.0}, "start": {"snakemake": 0.5}}
    shown = page.left(found, once | {"plan": 1.5})
    assert "| imports, and interpreters that begin and end | 2.3 |" in shown
    assert "| 1.5 |\n| Snakemake's plan and schedule | 2.0 |" in shown
    assert "| Snakemake's plan and schedule | 2.0 |" in shown
    assert "| **all** | **4.8** |" in shown


def test_a_rebuild_is_measured_by_the_process_that_imports():
    again = {"nothing to do": {"wall": 3.0}, "a figure": {"wall": 8.0}}
    found = profile.summed(records(), 5.0) | {"wall": 2.4, "again": again}
    shown = page.ratios({"seconds": 0.1, "wall": 2.0}, found)
    assert "| a rebuild, CPU | 48 | 45 | does not hold |" in shown
    assert "| a rebuild, wall over CPU | 0.5 | 0.6 | holds |" in shown
    assert "| nothing to do, wall | 1.5 | 1.5 | holds |" in shown
    assert "| a figure, wall | 4 | 2.5 | does not hold |" in shown
    assert "| the largest process, MB | 90 | 300 | holds |" in shown
