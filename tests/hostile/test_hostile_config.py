"""Config files and values of any kind: accepted, or refused in words before any job."""

import copy
import json
import time
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from gelpump import config as checked

PROJECT = Path(__file__).resolve().parents[2]
SCHEMA = yaml.safe_load((PROJECT / "workflow/schemas/config.schema.yaml").read_text())
PAPER = yaml.safe_load((PROJECT / "config/config.yaml").read_text())

SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.sampled_from([10**30, 10**400, -(10**30)]),
    st.floats(),
    st.text(max_size=8),
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.dictionaries(st.one_of(st.text(max_size=5), st.integers()), inner, max_size=3),
    ),
    max_leaves=8,
)


def leaves(block, path=()):
    """Paths of everything in a configuration, lists as a whole."""
    for key, value in block.items():
        yield (*path, key)
        if isinstance(value, dict):
            yield from leaves(value, (*path, key))


PATHS = sorted(leaves(PAPER))


def changed(path, value):
    config = copy.deepcopy(PAPER)
    block = config
    for key in path[:-1]:
        block = block[key]
    block[path[-1]] = value
    return config


def validated(config):
    """Whether the configuration is accepted; any refusal must be a ConfigError, and soon."""
    started = time.monotonic()
    with refused(checked.ConfigError, "the configuration is refused:\n  ") as refusal:
        checked.validate(config, SCHEMA)
    assert time.monotonic() - started < 10.0
    return not refusal.happened


@given(st.sampled_from(PATHS), VALUES)
@settings(max_examples=150)
@pytest.mark.filterwarnings("ignore:tube.eps")
def test_any_value_anywhere_is_accepted_or_refused(path, value):
    config = changed(path, value)
    if validated(config):
        json.dumps(config, allow_nan=False)  # what is accepted is finite


@given(VALUES)
def test_any_configuration_is_refused_in_words(config):
    if isinstance(config, dict):
        assert not validated(config)


@given(st.text(max_size=40))
@settings(max_examples=100)
def test_any_text_is_read_or_refused(tmp_path_factory, text):
    file = tmp_path_factory.mktemp("hostile") / "config.yaml"
    file.write_bytes(text.encode("utf-8", "surrogatepass"))
    with refused(checked.ConfigError, str(file)):
        checked.require_plain(file)


NAMES = [
    "../x", "a/b", "a b", "x\n", "", ".", "-x", "$(touch ran)", "a;b", "{x}", "%s", "a\0b", "ä",
]  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    ("family", "like"), [("gels", "HHT"), ("beads", "drying"), ("tube_flow", "whole")]
)
def test_names_that_would_be_other_paths_are_refused(family, like, name):
    config = copy.deepcopy(PAPER)
    config[family][name] = copy.deepcopy(config[family][like])
    with pytest.raises(checked.ConfigError, match=family):
        checked.validate(config, SCHEMA)


@pytest.mark.parametrize(
    ("path", "value", "told"),
    [
        (("numerics", "bead_lens", "cells"), 10**30, r"maximum 4000"),
        (("gels", "HHT", "A0"), 10**400, r"gels\.HHT\.A0 = 1000.*must be a finite number"),
        (("tube", "Le"), float("inf"), r"tube\.Le = inf: must be a finite number"),
        (("tube", "Le"), float("nan"), r"tube\.Le = nan: must be a finite number"),
        (("tube_pulse", "tau"), [float("nan")], r"tube_pulse\.tau\[0\] = nan"),
        (("tube", "Le"), "10 # os.system('x')", r"must be of type number"),
        (("gels", "HHT"), None, r"gels\.HHT = None: must be of type object"),
        (("gels", 1), {"model": "energy-based"}, r"gels: the key 1 is not a string"),
        ((True,), {}, r"the key True is not a string"),
        (("tube_pulse", "law_count"), 1001, r"law_count = 1001: maximum 1000"),
    ],
)
def test_values_that_no_solver_should_see(path, value, told):
    with pytest.raises(checked.ConfigError, match=told):
        checked.validate(changed(path, value), SCHEMA)


def test_a_dataset_that_fits_no_memory_is_refused():
    config = changed(("tube_pulse", "tau_count"), 10_000)
    config["numerics"]["tube_pulse"]["cells"] = [4000, 4000]
    with pytest.raises(checked.ConfigError, match=r"tube_pulse\.tau_count = 10000.* too many"):
        checked.validate(config, SCHEMA)


LAUGHS = "a: &a [x, x]\n" + "".join(
    f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n"
    for old, new in zip("abcdefgh", "bcdefghi", strict=True)
)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("tube: {Le: 1.0}\ntube: {Le: 2.0}\n", r"tube \(line 2\): given twice"),
        ("tube: {Le: 1.0, 'Le': 2.0}\n", r"tube\.Le \(line 1\): given twice"),
        ('{"tube": {"Le": 1.0, "Le": 2.0}}', r"tube\.Le \(line 1\): given twice"),
        ("tube: !!python/object/apply:os.system ['touch ran']\n", r"tube.*python/object"),
        ("tube: !!python/name:os.system\n", r"tube.*python/name"),
        ("tube: !!python/tuple [1, 2]\n", r"tube.*python/tuple"),
        ("tube: !ruby {}\n", r"tube .*'!ruby' values are not allowed"),
        ("__use_yte__: true\ntube: ?__import__('os').system('touch ran')\n", r"run code"),
        ("tube: 2025-01-01\n", r"'timestamp' values are not allowed"),
        ("tube: !!binary aGVsbG8=\n", r"'binary' values are not allowed"),
        ("1: {}\n", r"the key '1' is not a string"),
        ("true: {}\n", r"the key 'true' is not a string"),
        ("? [a, b]\n: 1\n", r"is not a string"),
        ("a: &a {b: 1}\nc: {<<: *a}\n", r"the key '<<' is not a string"),
        ("a: &a [*a]\n", r"nested deeper|more than"),
        (LAUGHS, r"more than 20000 values"),
        ("[" * 60 + "]" * 60, r"nested deeper than 20"),
        ("[" * 5000 + "]" * 5000, r"cannot be read"),
        ("a: 1\n---\na: 2\n", r"cannot be read"),
        ("\tx: 1\n", r"cannot be read"),
        ("a: [\n", r"cannot be read"),
        ("a: \x00\n", r"cannot be read"),
    ],
)
def test_files_that_do_not_mean_what_they_seem_are_refused(tmp_path, monkeypatch, text, told):
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "config.yaml"
    file.write_text(text)
    with pytest.raises(checked.ConfigError, match=told):
        checked.require_plain(file)
    assert not (tmp_path / "ran").exists()


def test_an_alias_that_means_what_it_says_is_read(tmp_path):
    file = tmp_path / "config.yaml"
    file.write_text("tube_pulse: {ell: &ells [0.25, 0.5]}\nfig: *ells\n")
    checked.require_plain(file)


@pytest.mark.parametrize("file", ["config.yaml", "quick.yaml"])
def test_our_own_files_are_plain(file, capsys):
    checked.main([PROJECT / "config" / file])
    assert "plain" in capsys.readouterr().out
