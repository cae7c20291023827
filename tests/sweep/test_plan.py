"""Sweep files: what they mean, and what is refused by key, value and what is allowed."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.stats import qmc

from gelpump.config import ConfigError
from gelpump.sweep import plan, sampling

PROJECT = Path(__file__).resolve().parents[2]
FILES = sorted((PROJECT / "config/sweeps").glob("*.yaml"))
CUBE = {
    "method": "latin_hypercube",
    "samples": 32,
    "parameters": {
        "ell": {"between": [0.1, 0.9]},
        "M": {"between": [0.01, 10.0], "spaced": "log"},
    },
    "tau": [0.01],
}
GRID = {"method": "grid", "parameters": {"ell": [0.1, 0.5], "Le": [5.0, 10, 20]}, "tau": [0.01]}
SOBOL = CUBE | {"method": "sobol", "samples": 8}


def loaded(tmp_path, given):
    file = tmp_path / "mine.yaml"
    file.write_text(given if isinstance(given, str) else yaml.safe_dump(given, sort_keys=False))
    return plan.load(file)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_sweeps_of_the_repository_are_plans(file):
    sweep = plan.load(file)
    few = sweep | {"samples": min(sweep["samples"], 1024)}
    assert sampling.sample(few).sizes["index"] == plan.designs(few)
    assert (plan.chunks(sweep) - 1) * sweep["chunk"] < plan.designs(sweep)
    assert plan.chunks(sweep) * sweep["chunk"] >= plan.designs(sweep)


def test_a_grid_has_every_combination_once(tmp_path):
    sweep = loaded(tmp_path, GRID | {"fixed": {"M": 3.0}})
    made = sampling.sample(sweep)
    pairs = set(zip(made.ell.values, made.Le.values, strict=True))
    assert pairs == {(ell, Le) for ell in (0.1, 0.5) for Le in (5.0, 10.0, 20.0)}
    assert len(made.design) == plan.designs(sweep) == 6
    assert (made.M == 3.0).all()  # fixed
    assert (made.eps == 0.1).all()  # table 1
    assert sorted(made.design.values) == list(range(6))


def test_a_latin_hypercube_has_one_design_in_each_slice(tmp_path):
    made = sampling.sample(loaded(tmp_path, CUBE))
    ell = (made.ell.values - 0.1) / 0.8
    M = np.log(made.M.values / 0.01) / np.log(1000)
    for unit in (ell, M):
        assert sorted(np.floor(32 * unit).astype(int)) == list(range(32))
    assert qmc.discrepancy(np.column_stack([ell, M])) < 0.01
    again = sampling.sample(loaded(tmp_path, CUBE))
    assert made.identical(again)
    other = sampling.sample(loaded(tmp_path, CUBE | {"seed": 1}))
    assert not np.array_equal(made.ell, other.ell)


def test_sobols_scheme_replaces_one_column_at_a_time(tmp_path):
    """Base sample, then each column of a second one put into it in turn, then the second one."""
    sweep = loaded(tmp_path, SOBOL)
    made = sampling.sample(sweep).sortby("design")
    assert plan.designs(sweep) == made.sizes["index"] == 8 * 4
    ell, M = (made[key].values.reshape(8, 4) for key in ("ell", "M"))
    assert (ell[:, 0] == ell[:, 2]).all()
    assert (ell[:, 1] == ell[:, 3]).all()
    assert (M[:, 0] == M[:, 1]).all()
    assert (M[:, 2] == M[:, 3]).all()
    assert (ell[:, 0] != ell[:, 1]).all()
    assert made.ell.min() >= 0.1
    assert made.M.max() <= 10


def test_neighbours_have_similar_walls(tmp_path):
    made = sampling.sample(loaded(tmp_path, CUBE))
    assert (np.diff(made.eps * (1 - made.ell)) >= 0).all()


def test_a_grid_is_drawn_by_ratios_if_these_are_more_even():
    assert plan.by_ratios([0.01, 0.1, 1, 10])
    assert plan.by_ratios([1.25, 2, 4, 8])
    assert plan.by_ratios([1, 100])
    assert not plan.by_ratios([0.1, 0.25, 0.5, 0.75, 0.9])
    assert not plan.by_ratios([0, 1, 100])
    assert not plan.by_ratios([3])


def change(given, path, value):
    """`given` with the value at a dotted path."""
    key, _, rest = path.partition(".")
    return given | {key: change(given.get(key, {}), rest, value) if rest else value}


@pytest.mark.parametrize(
    ("given", "path", "value", "told"),
    [
        (CUBE, "colour", "red", "colour = 'red': no such key; allowed: ['method', 'parameters',"),
        (CUBE, "method", "random", "method = 'random': must be one of ['grid', 'latin_hypercube',"),
        (CUBE, "method", ["grid"], "method = ['grid']: must be one of"),
        (CUBE, "samples", 0, "samples = 0: must be a whole number from 1 to 10000000"),
        (CUBE, "samples", "many", "samples = 'many': must be a whole number"),
        (CUBE, "samples", 1e3, "samples = 1000.0: must be a whole number"),
        (CUBE, "samples", True, "samples = True: must be a whole number"),
        (CUBE, "samples", 10**8, "samples = 100000000: must be a whole number from 1 to 10000000"),
        (CUBE, "chunk", 10**6, "chunk = 1000000: must be a whole number from 1 to 500000"),
        (CUBE, "seed", -1, "seed = -1: must be a whole number from 0"),
        (SOBOL, "samples", 12, "samples = 12: must be a power of two for sobol"),
        (SOBOL, "samples", 2**23, "give 33554432 designs: at most 10000000 are allowed"),
        (GRID, "parameters", {"ell": [i / 3400 for i in range(1, 3301)],
                              "M": [float(i) for i in range(3300)]},
         "give 10890000 designs: at most 10000000 are allowed"),
        (GRID, "parameters.ell", [0.5, 0.1], "parameters.ell = [0.5, 0.1]: must be a list of incr"),
        (GRID, "parameters.ell", [0.5, 0.5], "must be a list of increasing numbers"),
        (GRID, "parameters.ell", [], "parameters.ell = []: must be a list of increasing numbers"),
        (GRID, "parameters.ell", 0.5, "parameters.ell = 0.5: must be a list"),
        (GRID, "parameters.ell", [0.5, 1.0], "parameters.ell = 1.0: must be a number with 0 < ell"),
        (GRID, "parameters", {}, "parameters = {}: at least one must vary"),
        (GRID, "parameters", None, "parameters = None: must be a mapping of ['ell',"),
        (CUBE, "parameters.ell", [0.1, 0.9], "parameters.ell = [0.1, 0.9]: must have `between`"),
        (CUBE, "parameters.ell.between", [0.9, 0.1], "between = [0.9, 0.1]: must be [least, larg"),
        (CUBE, "parameters.ell.between", [0.1], "between = [0.1]: must be [least, largest]"),
        (CUBE, "parameters.ell.between", "0.1 to 0.9", "must be [least, largest]"),
        (CUBE, "parameters.ell.between", [0.1, float("nan")], "must be [least, largest]"),
        (CUBE, "parameters.ell.between", [0.0, 0.9], "between = 0.0: must be a number with 0 <"),
        (CUBE, "parameters.M.between", [0.0, 1.0], "must be positive if spaced by log"),
        (CUBE, "parameters.M.between", [1.0, 10**400], "must be [least, largest]"),
        (CUBE, "parameters.M.spaced", "sqrt", "M.spaced = 'sqrt': must be evenly or log"),
        (CUBE, "parameters.radius", {"between": [1, 2]}, "parameters.radius = {'between': [1, 2]}: "
         "no such key; allowed: ['ell', 'M', 'Pi_ratio', 'Phi_inf', 'eps', 'Le']"),
        (CUBE, "fixed.ell", 0.5, "fixed.ell = 0.5: varies in parameters.ell"),
        (CUBE, "fixed.Phi_inf", 1, "fixed.Phi_inf = 1: must be a number with Phi_inf > 1"),
        (CUBE, "fixed.Le", "ten", "fixed.Le = 'ten': must be a number with Le > 0"),
        (CUBE, "tau", [], "tau = []: must be a list of positive, increasing numbers"),
        (CUBE, "tau", [0.1, 0.01], "tau = [0.1, 0.01]: must be a list of positive, increasing"),
        (CUBE, "tau", 0.1, "tau = 0.1: must be a list"),
        (CUBE, "numerics.cells", 32, "numerics.cells = 32: must be two numbers from 8 to 1000"),
        (CUBE, "numerics.tolerance", 0, "numerics.tolerance = 0: must be from 1e-8 to 1e-2"),
        (CUBE, "numerics.reach", 1, "numerics.reach = 1: must be from 4 to 100"),
        (CUBE, "numerics.order", 3, "numerics = {'order': 3}: must be a mapping of ['cells',"),
        (CUBE, "accuracy.error", 2, "accuracy.error = 2: must be between 0 and 1"),
        (CUBE, "accuracy.designs", -1, "accuracy.designs = -1: must be from 0 to 1000"),
    ],
)  # fmt: skip
def test_refusals_name_key_value_and_what_is_allowed(tmp_path, given, path, value, told):
    with pytest.raises(ConfigError, match="is refused") as refusal:
        loaded(tmp_path, change(given, path, value))
    assert told in str(refusal.value)


@pytest.mark.parametrize("key", ["method", "parameters", "tau"])
def test_a_missing_key_is_named(tmp_path, key):
    with pytest.raises(ConfigError, match=f"{key}: missing"):
        loaded(tmp_path, {k: v for k, v in CUBE.items() if k != key})


@pytest.mark.parametrize(
    "text", ["", "- 1\n", "method: grid\nmethod: sobol\n", "a: !!python/name:os.system\n", "a: [\n"]
)
def test_a_file_that_is_no_mapping_is_refused(tmp_path, text):
    with pytest.raises(ConfigError, match=r"mine\.yaml"):
        loaded(tmp_path, text)
