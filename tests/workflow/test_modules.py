"""The modules that are inputs of a rule are exactly those that its script imports."""

import ast
from functools import cache
from pathlib import Path

import pytest

from gelpump import imports

PROJECT = Path(__file__).resolve().parents[2]
SOURCE = PROJECT / "src"
SCRIPTS = PROJECT / "workflow/scripts"


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


@pytest.mark.parametrize("script", sorted(SCRIPTS.glob("[!_]*.py")), ids=lambda path: path.stem)
def test_a_rule_gets_exactly_what_its_script_imports(script):
    frame = closure(SCRIPTS / "_helpers.py")
    imported = {str(file.relative_to(PROJECT)) for file in closure(script) | frame}
    assert set(imports.modules(script)) == imported


def test_imports_in_functions_and_of_neighbours_count_those_for_type_checkers_do_not(tmp_path):
    (tmp_path / "_helpers.py").touch()
    (tmp_path / "solve.py").write_text(
        "if TYPE_CHECKING:\n    from gelpump.figures import style\n\n"
        "def run():\n    from gelpump.materials import (\n        Gel,  # a protocol\n    )\n"
    )
    found = imports.modules(tmp_path / "solve.py")
    assert "src/gelpump/materials/validation.py" in found  # by `from .validation import ...`
    assert not {file for file in found if "figures" in file}
