"""`import gelpump` gives what users call, costs nothing until used, and says what it takes."""

import ast
import inspect
import subprocess
import sys
from importlib.resources import files
from pathlib import Path

import pytest

import gelpump
from gelpump import bead, design, gels, tube

TUTORIAL = Path(__file__).resolve().parents[1] / "docs/tutorial.py"
PACKAGES = [gels, bead, tube, design]
GIVEN = [
    (package.__name__, name)
    for package in PACKAGES
    for name in package.__all__
    if inspect.isfunction(getattr(package, name)) or inspect.isclass(getattr(package, name))
] + [("gelpump", "open_dataset")]


def test_the_face_is_cheap():
    heavy = ("numpy", "scipy", "xarray", "netCDF4", "fipy", "sksundae", "matplotlib", "pint")
    code = f"""
import sys
import gelpump
import gelpump.bead, gelpump.tube, gelpump.design
assert not [name for name in {heavy} if name in sys.modules]
gelpump.tube.Tubes(0.5)
assert "fipy" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_it_is_complete():
    assert set(gelpump.__all__) == {"gels", "bead", "tube", "design", "open_dataset"}
    assert dir(gelpump) == gelpump.__all__
    for package in (gelpump, *PACKAGES):
        for name in package.__all__:
            given = getattr(package, name)
            # a module, once imported, would take the name of a function
            file = Path(package.__file__).with_name(f"{name}.py")
            assert inspect.ismodule(given) or not file.exists(), name
        with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
            _ = package.nothing
    assert files("gelpump").joinpath("py.typed").is_file()


@pytest.mark.parametrize(("package", "name"), GIVEN)
def test_what_it_gives_is_told_and_typed(package, name):
    given = getattr(sys.modules[package], name)
    assert given.__doc__
    functions = [given]
    if inspect.isclass(given):
        functions = [
            each
            for key, each in vars(given).items()
            if inspect.isfunction(each) and not key.startswith("_")
        ]
    for function in functions:
        untyped = [
            key
            for key, each in inspect.signature(function).parameters.items()
            if each.annotation is each.empty and key not in ("self", "cls")
        ]
        assert not untyped, function
        assert "return" in function.__annotations__, function


def test_the_tutorial_uses_the_face_only():
    imported = {}
    for node in ast.walk(ast.parse(TUTORIAL.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            imported.setdefault(node.module, set()).update(each.name for each in node.names)
        elif isinstance(node, ast.Import):
            imported.update({each.name: set() for each in node.names})
    assert set(imported) == {"tempfile", "pathlib", "numpy", "gelpump"}
    assert imported["gelpump"] <= set(gelpump.__all__)


def test_the_tutorial_runs_in_an_empty_folder(tmp_path):
    run = subprocess.run(
        [sys.executable, "-W", "error::RuntimeWarning", TUTORIAL],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    for line in (
        "gel: phi_0 = 0.0523 at 304.0 K and 0.3581 at 307.6 K",
        "bead, LENS: its radius falls from 2.674 to 1.408 R_dry",
        "bead, nonlinear: its radius falls from 2.674 to 1.408 R_dry",
        "tube, thin wall: the front is 0.017 L wide at tau = 0.01",
        "device: response time, heated everywhere: 0.0179 s",
    ):
        assert line in run.stdout.splitlines()
    assert list(tmp_path.iterdir()) == []


def test_no_module_is_long_without_a_reason():
    sources = Path(__file__).resolve().parents[1] / "src/gelpump"
    texts = {file: file.read_text("utf-8") for file in sources.rglob("*.py")}
    long = {file for file, text in texts.items() if text.count("\n") > 300}
    assert long == {file for file, text in texts.items() if "\nLonger than 300 lines: " in text}
