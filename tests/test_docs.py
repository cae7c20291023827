"""The site's pages are those of the project: its API is the face, its tools are the pinned ones."""

import inspect
import re
from pathlib import Path
from pkgutil import resolve_name

import pytest
import yaml

import gelpump

PROJECT = Path(__file__).resolve().parents[1]
DOCS = PROJECT / "docs"
SHOWN = {  # what pages take from the code, with its file, by page
    page.name: re.findall(
        r"^\[(gelpump\S+)\]\(\.\./(\S+)\)$", page.read_text(encoding="utf-8"), re.M
    )
    for page in DOCS.glob("*.md")
}


@pytest.mark.parametrize("package", ["gels", "bead", "tube", "design"])
def test_the_api_tells_of_all_that_a_package_gives(package):
    page = (DOCS / "api.md").read_text(encoding="utf-8")
    _, _, section = page.partition(f"`gelpump.{package}`\n")
    section = section.partition("\n## ")[0]
    given = getattr(gelpump, package)
    for name in given.__all__:
        each = getattr(given, name)
        assert f"\n| `{name}` |" in section
        path = each.__name__ if inspect.ismodule(each) else f"{each.__module__}.{name}"
        assert f"\n[{path}" in section


@pytest.mark.parametrize(("path", "file"), [each for page in sorted(SHOWN) for each in SHOWN[page]])
def test_what_a_page_shows_is_there_and_told(path, file):
    if ".truth." in path:
        pytest.importorskip("skfem")
    shown = resolve_name(path)
    assert shown.__doc__
    assert Path(inspect.getsourcefile(shown)).samefile(PROJECT / file)


def test_a_derivation_is_told_once():
    told = [each for page in SHOWN.values() for each in page]
    assert len(told) == len(set(told)) > 80


def test_the_bead_that_separates_collapses():
    page = (DOCS / "howto.md").read_text(encoding="utf-8")
    scope = {}
    exec(re.search(r"```python\n(.*?)```", page, re.S)[1], scope)
    collapsed = scope["gel"].equilibrium_polymer_fraction(308.0)
    assert float(scope["run"].radius[-1]) == pytest.approx(collapsed ** (-1 / 3), rel=1e-5)
    assert float(scope["run"].radius[0]) == pytest.approx(scope["phi"] ** (-1 / 3), rel=1e-9)


def test_every_page_is_in_the_sites_menu():
    config = yaml.safe_load((PROJECT / "mkdocs.yml").read_text(encoding="utf-8"))
    menu = re.findall(r"\w+\.md", yaml.safe_dump(config["nav"]))
    assert sorted(menu) == sorted(SHOWN)
    assert config["strict"]


def test_hooks_before_a_commit_are_the_pinned_tools():
    hooks = (PROJECT / ".pre-commit-config.yaml").read_text(encoding="utf-8")
    pinned = (PROJECT / "requirements-test.txt").read_text(encoding="utf-8").splitlines()
    tools = re.findall(r"additional_dependencies: \[(\S+)\]", hooks)
    assert {tool.partition("==")[0] for tool in tools} == {"ruff", "snakefmt"}
    assert set(tools) <= set(pinned)
