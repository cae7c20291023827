"""What a configuration may hold, and how a refusal reads."""

import copy
import itertools
from pathlib import Path

import pytest
import yaml

from gelpump import config as checked

PROJECT = Path(__file__).resolve().parents[1]
SCHEMA = yaml.safe_load((PROJECT / "workflow/schemas/config.schema.yaml").read_text())
PAPER = yaml.safe_load((PROJECT / "config/config.yaml").read_text())
QUICK = yaml.safe_load((PROJECT / "config/quick.yaml").read_text())


def changed(path: str, value):
    """The paper's configuration with one key set (or deleted, for ...)."""
    config = copy.deepcopy(PAPER)
    *parents, last = path.split(".")
    block = config
    for key in parents:
        block = block[key]
    if value is ...:
        del block[last]
    else:
        block[last] = value
    return config


def merged(config, update):
    for key, value in update.items():
        if isinstance(value, dict):
            merged(config.setdefault(key, {}), value)
        else:
            config[key] = value
    return config


def test_the_papers_configuration_is_accepted():
    config = copy.deepcopy(PAPER)
    checked.validate(config, SCHEMA)
    assert config["beads"]["drying"]["branch"] == "swollen"  # a default, filled in


def test_the_papers_numbers():
    """Tables 1 and 2 and what the text prints, typed a second time."""
    keys = ("A0", "A1", "B0", "B1", "Omega")
    ANB, HHT = (tuple(PAPER["gels"][gel][key] for key in keys) for gel in ("ANB", "HHT"))
    assert ANB == (-12.947, 17.92, 0.04496, -0.0569, 100)
    assert HHT == (-62.22, -58.28, 0.20470, 0.19044, 720)
    linear = PAPER["gels"][PAPER["tube"]["gel"]]
    assert (linear["Phi_inf"], linear["Pi_ratio"], linear["M"]) == (2, 1, 1)
    assert (PAPER["tube"]["eps"], PAPER["tube"]["Le"]) == (0.1, 10)
    jumps = {
        case: (bead["gel"], bead["temperature_initial"], bead["temperature_final"])
        for case, bead in PAPER["beads"].items()
    }
    assert jumps == {
        "swelling": ("HHT", 308, 304),
        "drying": ("HHT", 304, 307.6),
        "separating": ("HHT", 304, 308),
    }
    printed = {
        "phi0-308-hht": 0.64,
        "phi0-304-hht": 0.05,
        "tc-up-anb": 304.5,
        "tc-down-anb": 306,
        "tc-hht": 307.6,
        "phi0-asymptote": -0.6,
        "phi0-low-temperature": 0.01,
        "singular-t-anb": 308,
        "singular-t-hht": 311,
        "lewis-number": 10,
        "A-exponent": -1,
        "front-position": 0.9539,
        "lumen-height-vs-ell": -1,
        "figure-10-ell": 0.25,
    }
    assert {claim: PAPER["published"][claim]["value"] for claim in printed} == printed


def test_the_quick_configuration_is_accepted():
    checked.validate(merged(copy.deepcopy(PAPER), QUICK), SCHEMA)


def test_an_empty_numerics_block_gets_every_default():
    config = changed("numerics", ...)
    checked.validate(config, SCHEMA)
    assert config["numerics"]["bead_lens"]["cells"] == 160


REFUSALS = [
    # key, value, what the refusal must say beside the key and the value
    ("beads.drying.gel", "HTT", "must be one of the energy-based gels ['ANB', 'HHT']"),
    ("gels.HHT.Omega", -720.0, "exclusiveMinimum 0"),
    ("gels.HHT.Omega", "many", "must be of type number"),
    ("gels.HHT.A0", True, "must be of type number"),
    ("gels.HHT.A0", float("nan"), "must be a finite number"),
    (
        "gels.HHT.model",
        "magic",
        "must be one of ['energy-based', 'flory-rehner', 'piecewise-linear', 'measured']",
    ),
    ("gels.HHT.temperature_range", [320.0, 290.0], "the first must be lower than the second"),
    ("beads.drying.temperature_final", 400.0, "must be within gels.HHT.temperature_range"),
    ("beads.drying.temperature_initial", 100.0, "290.0 to 320.0 K"),
    ("beads.drying.end", 0.0, "exclusiveMinimum 0"),
    ("beads.drying.branch", "wet", "must be one of ['swollen', 'dry']"),
    ("beads.drying.published_times", [9.0], "must not lie after beads.drying.end = 8.0"),
    ("numerics.bead_lens.cells", 4, "minimum 16"),
    ("numerics.bead_lens.cells", 99.5, "must be of type integer"),
    ("numerics.bead_lens.tolerance", "1e-5", "must be of type number"),
    ("materials.temperatures", [305.0, 300.0], "must increase"),
    ("figures.fig05_spinodal.cases", ["drying", "melting"], "must be one of"),
    ("figures.fig10_flow.views", ["whole", "half"], "must be one of"),
    ("figures.fig06_tube_schematic.ell", 0.33, "must be one of"),
    ("published.dry-radius-lens.value", [1.0, 2.0], "one value for each of"),
    ("tube.eps", -0.1, "exclusiveMinimum 0"),
    ("gels.linear.M", -1.0, "minimum 0"),
    ("tube_pulse.tau", [0.01, 0.001], "must increase"),
    ("tube_pulse.ell", [0.5, 1.0], "exclusiveMaximum 1"),
    ("figures.fig02_osmotic_schema.temperatures", [305.0, 306.0], "must be one of"),
]


@pytest.mark.parametrize(("key", "value", "allowed"), REFUSALS)
def test_a_refusal_names_key_value_and_what_is_allowed(key, value, allowed):
    with pytest.raises(checked.ConfigError) as refusal:
        checked.validate(changed(key, value), SCHEMA)
    message = str(refusal.value)
    assert key in message
    wrong = [v for v in value if not isinstance(v, float)] if isinstance(value, list) else [value]
    assert all(repr(each) in message for each in wrong[-1:])
    assert allowed in message


def test_a_misspelt_key_is_refused():
    config = changed("beads.drying.temprature_final", 307.0)
    with pytest.raises(checked.ConfigError, match=r"beads\.drying\.temprature_final = 307\.0") as e:
        checked.validate(config, SCHEMA)
    assert "'temperature_final'" in str(e.value)


def test_a_missing_key_is_refused():
    with pytest.raises(checked.ConfigError, match=r"beads\.drying: missing \['end'\]"):
        checked.validate(changed("beads.drying.end", ...), SCHEMA)
    with pytest.raises(checked.ConfigError, match=r"gels\.HHT\.B1 is missing"):
        checked.validate(changed("gels.HHT.B1", ...), SCHEMA)


def test_an_initial_state_without_a_solution_is_refused():
    config = changed("gels.HHT.A0", 40.0)  # phases separate at every temperature
    config["beads"]["drying"]["phi_initial"] = 0.3
    with pytest.raises(checked.ConfigError, match=r"beads\.drying: no initial state: phi_initial"):
        checked.validate(config, SCHEMA)


def test_a_key_of_another_model_is_refused():
    with pytest.raises(checked.ConfigError, match=r"gels\.HHT\.Phi_inf = 2\.0: unknown key"):
        checked.validate(changed("gels.HHT.Phi_inf", 2.0), SCHEMA)


def test_all_problems_are_told_at_once():
    config = changed("beads.drying.gel", "HTT")
    config["beads"]["swelling"]["temperature_final"] = 1000.0
    with pytest.raises(checked.ConfigError) as refusal:
        checked.validate(config, SCHEMA)
    assert "beads.drying.gel" in str(refusal.value)
    assert "beads.swelling.temperature_final" in str(refusal.value)


def described(schema, path=()):
    """Every property of the schema, with its path."""
    for name, rule in schema.get("properties", {}).items():
        yield (*path, name), rule
        yield from described(rule, (*path, name))
    if isinstance(schema.get("additionalProperties"), dict):
        yield from described(schema["additionalProperties"], (*path, "*"))


def test_every_key_has_a_description_and_unknown_ones_are_refused():
    undescribed = [".".join(path) for path, rule in described(SCHEMA) if "description" not in rule]
    assert undescribed == []
    objects = itertools.chain([((), SCHEMA)], described(SCHEMA))
    for path, rule in objects:
        if rule.get("type") == "object":
            assert "additionalProperties" in rule, path


@pytest.mark.parametrize(
    "arguments",
    [
        ["--configfile", "BAD"],
        ["--configfile=BAD"],
        ["--cores", "2", "all", "--configfiles", "GOOD", "BAD", "--config", "a=1"],
        ["--config", "a=1", "--configfile", "BAD", "-n"],
        ["--configfile", "GOOD", "--configfile", "BAD"],
    ],
)
def test_a_command_line_is_refused_for_any_of_its_files(tmp_path, monkeypatch, arguments):
    (tmp_path / "BAD").write_text("__use_yte__: true\n")
    (tmp_path / "GOOD").write_text("tube: {Le: 5.0}\n")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit, match="can run code"):
        checked.require_plain_arguments(arguments)
    checked.require_plain_arguments([each.replace("BAD", "GOOD") for each in arguments])
    checked.require_plain_arguments(["--cores", "2", "fig14_equilibrium"])
