"""The README's commands and its example."""

import re
from pathlib import Path

import yaml

PROJECT = Path(__file__).resolve().parents[1]
README = (PROJECT / "README.md").read_text()


def test_there_are_two_commands():
    commands = dict(re.findall(r"<!-- (\w+) -->\n```sh\n(.*?)\n```", README))
    install = "python3 -m venv .venv && .venv/bin/pip install -r requirements{}.txt && .venv/bin/"
    assert commands == {
        "rebuild": install.format("") + "snakemake --cores 2",
        "tests": install.format("-test") + "pytest",
    }


def test_the_example_runs():
    example = re.search(r"```python\n(.*?)```", README, re.S)[1]
    scope = {}
    exec(example.replace("tolerance=1e-4", "tolerance=1e-3"), scope)
    radius = scope["run"].radius.values
    assert abs(radius[0] - scope["phi"] ** (-1 / 3)) < 1e-12
    assert abs(radius[-1] - 2.596) < 5e-3
    assert abs(scope["front"].completion_t - 0.2629) < 3e-3
    assert scope["front"].front_dry_radius.diff("t").max() <= 0


def test_the_gel_of_the_readme_is_a_valid_configuration():
    from gelpump import config as checked

    block = yaml.safe_load(re.search(r"```yaml\n(.*?)```", README, re.S)[1])
    config = yaml.safe_load((PROJECT / "config/config.yaml").read_text())
    config["gels"].update(block["gels"])
    config["figures"].update(block["figures"])
    schema = yaml.safe_load((PROJECT / "workflow/schemas/config.schema.yaml").read_text())
    checked.validate(config, schema)
