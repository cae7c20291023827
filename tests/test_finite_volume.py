"""FiPy's sweep solves the system it is given, and both ways to make it give the same."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.linalg import solve_banded

from gelpump import config, finite_volume, tridiagonal
from gelpump.bead import lens, production
from gelpump.finite_volume import NewtonSweep
from gelpump.materials import from_config
from gelpump.tube import production as tubes

PROJECT = Path(__file__).resolve().parents[1]
QUICK = yaml.safe_load((PROJECT / "config/quick.yaml").read_text())
PAPER = yaml.safe_load((PROJECT / "config/config.yaml").read_text())
config.fill_defaults(
    PAPER, yaml.safe_load((PROJECT / "workflow/schemas/config.schema.yaml").read_text())
)


def system(cells, seed=1, drifts=False):
    """K, c, G and u of a system that is not symmetric, with a seam."""
    rng = np.random.default_rng(seed)
    K, c, G = rng.uniform(0.1, 1e3, cells + 1), rng.uniform(0.1, 1.0, cells), rng.normal(size=cells)
    u = rng.normal(size=cells + 1)
    K[[0, cells // 2, -1]] = u[[0, cells // 2, -1]] = 0.0
    return (K, c, G, u) if drifts else (K, c, G)


def banded(K, c, G, u=None):
    """c delta = div(K grad delta) + div(u delta) - G on unit cells, solved without FiPy."""
    u = np.zeros_like(K) if u is None else u
    bands = np.zeros((3, c.size))
    bands[0, 1:] = -(K + u / 2)[1:-1]
    bands[2, :-1] = -(K - u / 2)[1:-1]
    bands[1] = c + (K - u / 2)[1:] + (K + u / 2)[:-1]
    return solve_banded((1, 1), bands, -G)


def public_alone(cells, drifts, first):
    return finite_volume.Equation(cells, drifts).correction


@pytest.mark.parametrize("scale", [1.0, 1e-9, 1e9])
@pytest.mark.parametrize("drifts", [False, True])
@pytest.mark.parametrize("kind", [finite_volume.Equation, tridiagonal.Equation])
def test_correction_is_that_of_the_banded_system(kind, drifts, scale):
    equation = kind(50, drifts)
    for seed in (1, 2):  # coefficients must be taken anew at each call
        K, c, G, *u = system(50, seed, drifts)
        expected = banded(K, c, scale * G, *u)
        delta = equation.correction(K, c, scale * G, *u)
        np.testing.assert_allclose(delta, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())


def test_blocks_do_not_touch():
    sweep = NewtonSweep(8)
    K, c = np.full(9, 5.0), np.ones(8)
    K[4] = 0.0  # the seam
    G = np.array([1.0, 2.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0])
    delta = sweep.correction(K, c, G)
    np.testing.assert_array_equal(delta[4:], 0.0)
    assert np.all(np.abs(delta[:4]) > 0.1)


def test_what_is_not_finite_is_not_skipped():
    sweep = NewtonSweep(5)
    K, c, G = system(5)
    for bad in range(3):
        coefficients = [K.copy(), c.copy(), G.copy()]
        coefficients[bad][2] = np.nan
        assert np.isnan(sweep.correction(*coefficients)).all()
    assert np.isfinite(sweep.correction(K, c, G)).all()
    assert sweep.sweeps == 4


def test_shapes_of_another_mesh_are_refused():
    K, c, G, u = system(5, drifts=True)
    with pytest.raises(ValueError, match=r"shapes .*\(4,\).* are not allowed here"):
        NewtonSweep(5).correction(K, c, G[:4])
    with pytest.raises(ValueError, match="not allowed here"):
        NewtonSweep(5).correction(K, c, G, u)
    with pytest.raises(ValueError, match="not allowed here"):
        NewtonSweep(5, drifts=True).correction(K, c, G)


class Changed(tridiagonal.Equation):
    """What a FiPy whose private methods changed could do: another answer, or none."""

    def correction(self, *coefficients):
        return super().correction(*coefficients) * (1 + 1e-8)


class Gone:
    def __init__(self, cells, drifts):
        raise AttributeError("FiPy has no _buildMatrix")


@pytest.mark.parametrize(
    ("kind", "reason"), [(Changed, "differs by"), (Gone, "FiPy has no _buildMatrix")]
)
def test_a_fast_path_that_is_wrong_is_left_with_a_warning(monkeypatch, kind, reason):
    monkeypatch.setattr(tridiagonal, "Equation", kind)
    K, c, G = system(20)
    sweep = NewtonSweep(20)
    assert not sweep.correction(K, c, 0 * G).any()  # agreement on nothing would mean nothing
    with pytest.warns(RuntimeWarning, match=reason):
        delta = sweep.correction(K, c, G)
    np.testing.assert_array_equal(delta, finite_volume.Equation(20, False).correction(K, c, G))
    np.testing.assert_array_equal(sweep.correction(K, c, 2 * G), 2 * delta)  # and no more warning


def test_a_fast_path_that_is_right_is_used():
    K, c, G = system(20)
    fast = tridiagonal.Equation(20, False).correction(K, c, G)
    assert (fast != finite_volume.Equation(20, False).correction(K, c, G)).any()
    np.testing.assert_array_equal(NewtonSweep(20).correction(K, c, G), fast)


def bead(case):
    block = PAPER["beads"][case]
    gel = from_config(block["gel"], PAPER["gels"][block["gel"]])
    numerics = QUICK["numerics"]["bead_lens"]
    found = lens.solve_meshes(
        gel,
        *production.start(gel, block, numerics),
        [numerics["cells"]],
        tolerance=numerics["tolerance"],
    )
    return found[0]


def tube_family():
    settings = PAPER["tube_pulse"] | QUICK["tube_pulse"]
    gel = from_config(PAPER["tube"]["gel"], PAPER["gels"][PAPER["tube"]["gel"]])
    return tubes.family(gel, PAPER["tube"], settings, QUICK["numerics"]["tube_pulse"])


PROBLEMS = {case: lambda case=case: bead(case) for case in PAPER["beads"]} | {"tubes": tube_family}


@pytest.mark.parametrize("problem", PROBLEMS)
def test_both_paths_agree_on_every_production_problem(problem, monkeypatch):
    """On every sweep to rounding, and so do the solutions; coarse meshes."""
    with monkeypatch.context() as patch:
        differences = []

        def compared(cells, drifts, first):
            ways = [kind.Equation(cells, drifts) for kind in (finite_volume, tridiagonal)]

            def correction(*coefficients):
                public, fast = (way.correction(*coefficients) for way in ways)
                differences.append(np.abs(fast - public).max() / np.abs(public).max())
                return public

            return correction

        patch.setattr(finite_volume, "trusted", compared)
        public = PROBLEMS[problem]()
    assert len(differences) == public.attrs["sweeps"] > 50
    assert max(differences) < finite_volume.ROUNDING
    fast = PROBLEMS[problem]()
    assert {**fast.attrs} == pytest.approx({**public.attrs}, rel=1e-9)
    for name in public.variables:
        if public[name].dtype.kind == "f" and "error" not in name:
            scale = float(np.abs(public[name]).max())
            np.testing.assert_allclose(fast[name], public[name], rtol=0.0, atol=1e-9 * scale)


def test_fipy_is_imported_only_when_it_is_needed():
    code = "import sys, gelpump.bead.lens, gelpump.tube.slender; assert 'fipy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
