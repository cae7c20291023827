"""How a build is started: odd folders, other clones' environments, what the command line says."""

import csv
import os
import subprocess
import sys
import sysconfig
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml
from clone import Clone
from snakemake.settings.types import ConfigSettings

from gelpump import launch
from gelpump.config import ConfigError

TABLE = "results/tables/table1_tube_parameters.csv"


@pytest.fixture(scope="module")
def odd(tmp_path_factory):
    """A clone, its environment inside it, in a folder that a shell would take to pieces."""
    clone = Clone(tmp_path_factory.mktemp("odd") / "my gel (2) & 'co'; $HOME")
    venv = clone.path / ".venv"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", venv], check=True)
    packages = next(venv.glob("lib/python*/site-packages"))
    (packages / "installed.pth").write_text(f"{sysconfig.get_path('purelib')}\n")
    return clone


def build(clone: Clone, *arguments: str, **environment: str):
    command = [".venv/bin/python", "-m", "snakemake", "--cores", "1", *arguments]
    return subprocess.run(
        command,
        cwd=clone.path,
        env=clone.environment() | environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


def test_a_build_in_an_odd_folder_takes_all_that_its_command_line_says(odd):
    for name, tube in {"first": {"eps": 0.02, "Le": 3.0}, "second": {"eps": 0.03}}.items():
        (odd.path / f"{name}.yaml").write_text(yaml.safe_dump({"tube": tube}))
    several = ["--configfile", "first.yaml", "--configfile", "second.yaml"]
    switches = {"PYTHONOPTIMIZE": "2", "FIPY_INLINE": "1", "FIPY_SOLVERS": "petsc"}
    result = build(odd, TABLE, *several, "--config", "gels={linear: {M: 2e1}}", **switches)
    assert result.returncode == 0, result.stdout + result.stderr
    with open(odd.path / TABLE) as stream:
        values = {row["Name"]: float(row["Value"]) for row in csv.DictReader(stream)}
    assert [values[name] for name in ("Le", "eps", "M")] == [3.0, 0.03, 20.0]


def test_the_environment_of_another_clone_is_refused_and_nothing_is_deleted(odd, tmp_path):
    left = odd.path / "results/tables/left.csv"
    left.parent.mkdir(parents=True, exist_ok=True)
    left.write_text("made before")
    before = {path: path.read_bytes() for path in odd.path.glob("results/**/*.*")}
    elsewhere = Clone(tmp_path / "another").path / "src"
    for profile in ([], ["--workflow-profile", "none"]):
        result = build(odd, TABLE, "--forceall", *profile, PYTHONPATH=str(elsewhere))
        said = result.stdout + result.stderr
        assert result.returncode != 0
        for words in (str(elsewhere / "gelpump"), str(odd.path), "pip install -r requirements.txt"):
            assert words in said
        assert "rule " not in said
    assert before == {path: path.read_bytes() for path in odd.path.glob("results/**/*.*")}


FIPY = """
import sys
from gelpump import finite_volume, plain_fipy
assert plain_fipy.load().solvers.solver_suite == "scipy"
from fipy.tools.inline import doInline
assert not doInline
assert sys.argv[1:] == {switches!r}
finite_volume.Equation(5, drifts=True)
from gelpump import tridiagonal
"""
SWITCHES = [[], ["--inline"], ["--petsc"], ["--Trilinos", "--inline"]]


@pytest.mark.parametrize("switches", SWITCHES, ids=" ".join)
def test_switches_of_fipy_are_put_aside(switches, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(FIPY.format(switches=switches))
    meant = {"FIPY_INLINE": "1", "FIPY_SOLVERS": "pyamgx", "FIPY_INLINE_COMMENT": "1"}
    run = [sys.executable, script, *switches]
    subprocess.run(run, check=True, env=os.environ | meant, cwd=tmp_path)


@pytest.mark.parametrize(
    ("first", "words"),
    [("", "without -OO"), ("import sys; sys.argv += ['--inline']; import fipy", "before gelpump")],
)
def test_what_cannot_be_put_aside_is_refused_in_words(first, words):
    python = [sys.executable, *(["-OO"] if not first else [])]
    code = f"{first}\nfrom gelpump import plain_fipy\nplain_fipy.load()"
    result = subprocess.run([*python, "-c", code], capture_output=True, text=True, check=False)
    assert result.stderr.splitlines()[-1].startswith("ImportError: FiPy ")
    assert words in result.stderr


def complete(arguments, last_files, last_entries, config=None):
    """What a configuration becomes when Snakemake kept the last files and entries alone."""
    from snakemake.cli import parse_config

    settings = ConfigSettings(
        config=parse_config(last_entries), configfiles=last_files, config_args=last_entries
    )
    workflow = SimpleNamespace(config_settings=settings, configfiles=[*last_files])
    config = config or {}
    launch.complete(workflow, config, arguments)
    assert settings.overwrite_config == config
    return config, workflow


def test_several_configfiles_add_up_however_they_are_given(tmp_path):
    values = {"a": {"x": {"1": 1, "2": 1}}, "b": {"x": {"2": 2}}, "c": {"x": {"3": 3}, "y": 3}}
    files = {name: tmp_path / f"{name}.yaml" for name in values}
    for name, value in values.items():
        files[name].write_text(yaml.safe_dump(value))
    a, b, c = map(str, files.values())
    ways = {
        ("--configfile", a, "--configfile", b, "--configfile", c): [c],
        ("--configfile", a, b, "--cores", "2", "--configfiles", c): [c],
        (f"--configfile={a}", "--config", "zz=1", "--configfile", b, c): [b, c],
        ("--configfile", a, b, c): [a, b, c],
    }
    for arguments, kept in ways.items():
        entries = [each for each in arguments if each == "zz=1"]
        config, workflow = complete(arguments, [Path(file) for file in kept], entries)
        assert config == {"x": {"1": 1, "2": 2, "3": 3}, "y": 3} | ({"zz": 1} if entries else {})
        assert workflow.configfiles == workflow.config_settings.configfiles == [*files.values()]
    files["a"].write_text("x: {k: 1, k: 2}")
    with pytest.raises(ConfigError, match=r"x\.k .*given twice"):
        complete(["--configfile", a, "--configfile", b], [files["b"]], [])


NUMBERS = ["1", "-2", "0.5", "1e-4", "2.5E+3", "-.5", "+1.0e-3"]


@pytest.mark.parametrize("number", NUMBERS)
def test_numbers_inside_config_are_numbers(number):
    for form in ("{{k: {}}}", "[{}, 2]", "{{k: [{{q: {}}}]}}"):
        entry = f"tube={form.format(number)}"
        config, _ = complete(["--config", entry], [], [entry])
        value = config["tube"]
        while isinstance(value, dict | list):
            value = next(iter(value.values() if isinstance(value, dict) else value))
        assert isinstance(value, int | float)
        assert value == float(number)


def test_entries_of_config_keep_their_kinds_and_add_up():
    first, last = ["tube={eps: 0.1, gel: ten, open: true}"], ["tube={M: 2}", "design=a.yaml"]
    config, workflow = complete(["--config", *first, "-C", *last], [], last)
    tube = {"eps": 0.1, "gel": "ten", "open": True, "M": 2}
    assert config == {"design": "a.yaml", "tube": tube}
    assert workflow.config_settings.config_args == first + last
    for entry, words in {
        "tube={eps: 1, eps: 2}": "given twice",
        "tube={eps: !!python/name:os.system }": "not allowed",
    }.items():
        with pytest.raises(ConfigError, match=words):
            complete(["--config", entry], [], [entry])


def test_pandas_is_not_imported_for_plain_params():
    code = "import sys; from gelpump import launch; launch.settle()\n"
    code += "from snakemake.persistence.file import FilePersistence as P\n"
    code += "print(P._serialize_param.fget(P.__new__(P))({'a': [1]}), 'pandas' in sys.modules)"
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert result.stdout == "{'a': [1]} False\n"


def test_the_interpreter_is_called_by_its_name_where_a_shell_would_split_its_path(monkeypatch):
    for path in (sys.executable, "/tmp/plain/.venv/bin/python3"):
        monkeypatch.setattr(sys, "executable", path)
        launch.settle()
        assert sys.executable == path
    monkeypatch.setattr(sys, "executable", "/tmp/my gel/.venv/bin/python3")
    monkeypatch.setenv("PATH", "/usr/bin:/tmp/my gel/.venv/bin:/bin")
    launch.settle()
    assert sys.executable == "python3"
    assert os.environ["PATH"] == "/tmp/my gel/.venv/bin:/usr/bin:/bin"
