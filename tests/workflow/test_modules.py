"""The modules that a rule declares are exactly those that its script imports."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]
SOURCE = PROJECT / "src"


def module_file(name: str) -> Path | None:
    path = SOURCE / Path(*name.split("."))
    for candidate in (path.with_suffix(".py"), path / "__init__.py"):
        if candidate.exists():
            return candidate
    return None


def package_files(name: str):
    """The file of a module and of every package above it, which are imported with it."""
    parts = name.split(".")
    for end in range(1, len(parts) + 1):
        file = module_file(".".join(parts[:end]))
        if file is not None:
            yield file


def is_type_checking(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)


def imported_names(file: Path):
    """Every gelpump module named by an import statement of ``file``, wherever it stands."""
    pending = [ast.parse(file.read_text())]
    package = ".".join(file.relative_to(SOURCE).parent.parts) if file.is_relative_to(SOURCE) else ""
    while pending:
        node = pending.pop()
        if is_type_checking(node):
            continue
        pending.extend(ast.iter_child_nodes(node))
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                above = package.split(".")[: len(package.split(".")) - node.level + 1]
                base = ".".join([*above, base]).strip(".")
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)


@cache
def closure(file: Path) -> frozenset[Path]:
    found, pending = set(), [file]
    while pending:
        for name in imported_names(pending.pop()):
            if name.split(".")[0] != "gelpump":
                continue
            for dependency in package_files(name):
                if dependency not in found:
                    found.add(dependency)
                    pending.append(dependency)
    return frozenset(found)


def declared_modules(clone) -> dict[str, set[str]]:
    """Files under src that each rule of a full build lists among its inputs."""
    result = clone.snakemake(
        "--dry-run",
        "--forceall",
        "all",
        "verify",
        "renew_reference",
        "renew_map",
        "results/designs/bead.nc",
        "results/gels/ANB.nc",
        *(
            f"results/sweeps/sensitivity/{file}"
            for file in ("accuracy.nc", "surface.pdf", "bars.pdf")
        ),
    )
    assert result.returncode == 0, result.stdout + result.stderr
    declared, rule = {}, None
    for line in (result.stdout + result.stderr).splitlines():
        if match := re.match(r"(?:local)?rule (\w+):", line):
            rule = match[1]
        elif line.startswith("    input: ") and rule != "all":
            files = line.removeprefix("    input: ").split(", ")
            declared[rule] = {file for file in files if file.endswith(".py")}
    return declared


@pytest.mark.xdist_group("workflow")
def test_rules_declare_exactly_what_their_scripts_import(clone):
    declared = declared_modules(clone)
    assert len(declared) > 10
    for rule, files in declared.items():
        script = PROJECT / f"workflow/scripts/{rule}.py"
        assert script.exists(), f"rule {rule} has no script of its name"
        imported = {str(file.relative_to(PROJECT)) for file in closure(script)}
        imported |= {
            f"src/gelpump/{module}.py" for module in ("__init__", "progress", "provenance")
        }
        imported.add("workflow/scripts/_helpers.py")
        assert files == imported, rule


def test_the_closure_sees_late_and_relative_imports():
    lens = {str(file.relative_to(SOURCE)) for file in closure(SOURCE / "gelpump/bead/lens.py")}
    assert "gelpump/bdf.py" in lens
    materials = closure(SOURCE / "gelpump/materials/__init__.py")
    assert SOURCE / "gelpump/materials/validation.py" in materials
    config = closure(SOURCE / "gelpump/config.py")
    assert SOURCE / "gelpump/materials/energy_based.py" in config  # imported in a function


def test_nothing_follows_the_job_of_a_rule_that_makes_something():
    """Such a job ends its interpreter with success, whatever a script would do or say later."""
    rules = "".join(file.read_text("utf-8") for file in (PROJECT / "workflow/rules").glob("*.smk"))
    following = set()
    for script in sorted((PROJECT / "workflow/scripts").glob("*.py")):
        statements = ast.parse(script.read_text("utf-8")).body
        if any(isinstance(each, ast.With) for each in statements[:-1]):
            following.add(script.stem)
            [body] = re.findall(rf"^rule {script.stem}:\n((?:    .*\n|\n)+)", rules, re.MULTILINE)
            assert "    output:" not in body, script.stem
    assert "verify" in following  # which ends with its verdict
