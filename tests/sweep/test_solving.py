"""Chunks of designs against single solves, an exact law of the tube, and how failures are told."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
import xarray as xr

from gelpump import netcdf
from gelpump.sweep import accuracy, combine, part, plan, sampling, sensitivity, solving

NUMERICS = plan.DEFAULTS["numerics"]
TUBE = {"ell": 0.5, "M": 1.0, "Pi_ratio": 1.0, "Phi_inf": 2.0, "eps": 0.1, "Le": 10.0}
ENDED_WELL = solving.REFINED


def designs(count, **changed):
    columns = TUBE | changed
    data = {k: ("index", np.broadcast_to(np.asarray(v, float), count)) for k, v in columns.items()}
    return xr.Dataset(data | {"design": ("index", np.arange(count))})


@pytest.fixture(scope="module")
def cube():
    sweep = plan.checked(
        {
            "method": "latin_hypercube",
            "samples": 12,
            "seed": 3,
            "parameters": {
                "ell": {"between": [0.1, 0.9]},
                "M": {"between": [0.03, 10.0], "spaced": "log"},
                "Pi_ratio": {"between": [0.1, 10.0], "spaced": "log"},
                "Phi_inf": {"between": [1.2, 6.0]},
                "eps": {"between": [0.05, 0.2], "spaced": "log"},
            },
            "tau": [0.001, 0.01],
            "accuracy": {"designs": 4, "error": 1e-2},
        },
        problems := [],
    )
    assert not problems
    return sweep, solving.solve_designs(sampling.sample(sweep), sweep["tau"], sweep["numerics"])


def test_a_chunk_agrees_with_its_designs_alone(cube):
    """They share no more than their steps in time, so they differ by the accuracy asked for."""
    sweep, together = cube
    assert (together.status == solving.SOLVED).all()
    for i in range(0, 12, 3):
        alone = solving.solve_designs(together.isel(index=[i]), sweep["tau"], sweep["numerics"])
        for name in solving.OUTPUTS:
            a, b = together[name].values[i], alone[name].values[0]
            assert np.abs(a / b - 1).max() < sweep["accuracy"]["error"], (name, i)
        assert alone.tau99.values[0] == together.tau99.values[i]


def test_a_chunk_is_as_accurate_as_its_sweep_asks(cube):
    sweep, together = cube
    chosen = together.isel(index=accuracy.subset(sweep, 12))
    found = accuracy.errors(chosen, sweep)
    passed, told = accuracy.verdict(found)
    assert passed, told
    assert found.sizes["index"] == 4
    # a wrong output, an accuracy that is not reached, a lost design: each fails
    wrong = chosen.assign(A=chosen.A * 1.02)
    passed, told = accuracy.verdict(accuracy.errors(wrong, sweep))
    assert not passed
    assert "A at tau" in told or "front_width at tau" in told
    assert not accuracy.verdict(found.assign(allowed_error=1e-9))[0]
    assert not accuracy.verdict(found.assign(unconfirmed=1))[0]
    none = found.isel(index=slice(0)).assign(flagged=4)
    assert not accuracy.verdict(none)[0]
    assert accuracy.verdict(none.assign(flagged=0))[0]  # none was asked for


def test_waves_serve_where_they_are_accurate_enough(cube):
    sweep, pulses = cube
    mixed = solving.solve_designs(pulses, sweep["tau"], sweep["numerics"], error=1e-2)
    by_wave = (mixed.solver == solving.WAVE).values
    assert by_wave.any()
    assert not by_wave.all()
    assert (mixed.uncertainty.values[by_wave] <= 1e-2).all()
    assert (pulses.solver == solving.PULSE).all()
    for name in solving.OUTPUTS:
        apart = np.abs(mixed[name] / pulses[name] - 1).values
        # a late wave beside a pulse: the pulse of that time reaches the times before it
        assert (apart <= mixed.uncertainty.values + solving.PULSE_UNCERTAINTY).all(), name
    finest = accuracy.errors(mixed, sweep)  # by pulses only
    assert accuracy.verdict(finest)[0]


def test_a_large_chunk_is_several_families(monkeypatch, cube):
    sweep, together = cube
    monkeypatch.setattr(solving, "FAMILY", 5)
    sizes, honest = [], solving._family

    def counting(these, *rest):
        sizes.append(these.sizes["index"])
        return honest(these, *rest)

    monkeypatch.setattr(solving, "_family", counting)
    apart = solving.solve_designs(together, sweep["tau"], sweep["numerics"])
    assert sorted(sizes) == [2, 5, 5]
    for name in solving.OUTPUTS:
        assert np.abs(apart[name] / together[name] - 1).max() < sweep["accuracy"]["error"], name


def test_only_the_healing_length_counts():
    """Phi_1 depends on ell and eps by Z/w and tau/w^2 only, w = eps (1-ell)/4: an exact law."""
    base, tau = designs(1), 0.01
    w = lambda ell, eps: eps * (1 - ell) / 4  # noqa: E731
    here = solving.solve_designs(base, [tau], NUMERICS)
    for ell, eps in ((0.75, 0.2), (0.9, 0.05), (0.05, 0.13)):
        scale = w(ell, eps) / w(0.5, 0.1)
        there = solving.solve_designs(designs(1, ell=ell, eps=eps), [tau * scale**2], NUMERICS)
        assert float(there.Phi1_front[0, 0]) == pytest.approx(
            float(here.Phi1_front[0, 0]), rel=1e-9
        )
        assert float(there.A[0, 0]) * scale == pytest.approx(float(here.A[0, 0]), rel=1e-7)
        assert float(there.tau99[0]) == pytest.approx(float(here.tau99[0]) * scale**2, rel=1e-12)


def test_other_parameters_do_count():
    """The law's other half: with the same w, each of M, Pi_ratio, Phi_inf, Le changes Phi_1."""
    changed = {"M": 2.0, "Pi_ratio": 2.0, "Phi_inf": 2.5, "Le": 5.0}
    columns = {k: [TUBE[k], *(v if k == key else TUBE[k] for key, v in changed.items())]
               for k in changed}  # fmt: skip
    made = solving.solve_designs(designs(5, **columns), [1e-4], NUMERICS)
    for i, key in enumerate(changed, 1):
        assert abs(float(made.Phi1_front[i, 0] / made.Phi1_front[0, 0]) - 1) > 1e-3, key


def test_a_design_that_fails_leaves_the_others_alone(monkeypatch):
    def failing(these, tau, numerics):
        if (these.Le.values == 7.0).any():
            raise RuntimeError("no convergence")
        return honest(these, tau, numerics)

    honest = solving._family
    monkeypatch.setattr(solving, "_family", failing)
    made = solving.solve_designs(designs(4, Le=[10.0, 7.0, 10.0, 10.0]), [0.01], NUMERICS)
    assert made.status.values.tolist() == [0, solving.FAILED, 0, 0]
    assert "no convergence" in json.loads(made.reasons)["1"]
    assert np.isnan(made.A.values[1]).all()
    assert np.isfinite(made.A.values[[0, 2, 3]]).all()
    assert made.A.values[0] == pytest.approx(made.A.values[2], rel=5e-3)


def test_a_result_that_breaks_its_conservation_is_flagged(monkeypatch):
    honest = solving._family
    monkeypatch.setattr(solving, "_family", lambda *a: (honest(*a)[0], np.array([1e-3, 0.2])))
    made = solving.solve_designs(designs(2), [0.01], NUMERICS)
    assert made.status.values.tolist() == [0, solving.INACCURATE]
    assert "conservation of water" in json.loads(made.reasons)["1"]


@pytest.mark.parametrize(
    "corner",
    [{"Phi_inf": 12.0, "M": 10.0}, {"Phi_inf": 12.0, "M": 0.0}, {"Pi_ratio": 50.0, "Phi_inf": 6.0}],
    ids=str,
)
def test_corners_that_a_tenth_of_the_tolerance_would_stall(corner):
    made = solving.solve_designs(designs(1, **corner), [0.01], NUMERICS)
    assert int(made.status[0]) <= ENDED_WELL, made.reasons


def test_sobols_indices_of_a_known_function():
    """ln f = x_0 + 2 x_1 has S = (1/5, 4/5); tau_99, which has no Le, has an index of zero."""
    sweep = plan.checked(
        {
            "method": "sobol",
            "samples": 512,
            "parameters": {
                "ell": {"between": [0.1, 0.9]},
                "M": {"between": [0.1, 1.0], "spaced": "log"},
                "Le": {"between": [5.0, 20.0]},
            },
            "tau": [0.01],
        },
        [],
    )
    made = sampling.sample(sweep)
    x = (made.ell.values - 0.1) / 0.8, np.log10(made.M.values / 0.1)
    f = np.exp(x[0] + 2 * x[1])
    outputs = dict.fromkeys(sensitivity.ANALYSED, (("index", "tau"), f[:, np.newaxis]))
    status = ("index", np.zeros(len(f), np.int8))
    made = made.assign(outputs | {"tau99": ("index", f), "status": status}).assign_coords(
        tau=[0.01]
    )
    found = sensitivity.indices(sweep, made).isel(tau=0)
    for name in sensitivity.ANALYSED:
        for key in ("S1", "ST"):
            values = found[key].sel(output=name).values
            assert np.abs(values - [0.2, 0.8, 0.0]).max() < 0.02, (name, key)
    assert np.abs(found.ST.sel(output="tau99", parameter="Le")) < 1e-20
    with pytest.raises(ValueError, match="a design failed"):
        sensitivity.indices(sweep, made.assign(status=made.status + solving.FAILED))


@pytest.fixture(scope="module")
def chunk(cube, tmp_path_factory):
    path = tmp_path_factory.mktemp("chunk") / "000000.nc"
    netcdf.write(cube[1], path, "a chunk", {}, flag="status")
    return path


def test_part_of_a_dataset_is_read(chunk, cube):
    here = part.read(chunk, lambda count: slice(count - 2, count + 5))
    assert here.sizes["index"] == 2
    assert here.attrs == {}
    assert np.array_equal(here.A, cube[1].A[-2:])


def test_combined_chunks_are_the_chunks(chunk, cube, tmp_path):
    target = tmp_path / "sweep.nc"
    assert combine.combine([chunk, chunk], target, 24, "title", {"a": 1}, {"extra": "b"}) == 0
    with xr.open_dataset(target) as made:
        for name in cube[1].data_vars:
            for where in (slice(12), slice(12, 24)):
                assert np.array_equal(made[name][where], cube[1][name]), name
            assert made[name].attrs.keys() >= {"long_name"}
        assert made.attrs["extra"] == "b"
    with pytest.raises(ValueError, match="hold 12 designs instead of 13"):
        combine.combine([chunk], tmp_path / "other.nc", 13, "title", {}, {})
    assert not (tmp_path / "other.nc").exists()


MEASURE = """
import resource, sys
from gelpump.sweep import combine
count = int(sys.argv[3])
combine.combine([sys.argv[1]] * count, sys.argv[2], 12 * count, "t", {}, {})
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def test_combining_takes_no_more_memory_for_more_designs(cube, tmp_path):
    """Eight times the designs, some 40 MB more of them, take a few MB more, if any."""
    large = xr.concat([cube[1]] * 200, "index", data_vars="minimal")
    chunk = tmp_path / "chunk.nc"
    netcdf.write(large, chunk, "a chunk", {}, flag="status")
    script = MEASURE.replace("12 *", f"{large.sizes['index']} *")
    peaks = []
    for count in (10, 80):
        done = subprocess.run(
            [sys.executable, "-c", script, str(chunk), str(tmp_path / "sweep.nc"), str(count)],
            capture_output=True, text=True, check=True, env=os.environ,
        )  # fmt: skip
        peaks.append(int(done.stdout) / 1024)
    grown = (tmp_path / "sweep.nc").stat().st_size / 2**20 * 70 / 80
    assert grown > 25
    assert peaks[1] - peaks[0] < 0.3 * grown
