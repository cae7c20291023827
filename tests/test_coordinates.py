"""Coordinates put together from named and from spaced values."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gelpump import netcdf
from gelpump.bead import production
from gelpump.coordinates import ROUNDED, merged


def test_a_named_value_is_kept_as_it_was_named():
    spaced = 0.1 * np.arange(11.0)  # 0.30000000000000004
    assert spaced[3] != 0.3
    found = merged([0.3, 0.55, 0.0], spaced)
    assert found.tolist() == sorted([*np.delete(spaced, 3), 0.3, 0.55])
    assert merged([], [2.0, 1.0], [1.0 + 1e-15, 3.0]).tolist() == [1.0, 2.0, 3.0]
    assert merged(1.0, [1.0 + 2 * ROUNDED]).size == 2


@given(
    end=st.floats(1e-3, 1e3),
    count=st.integers(6, 400),
    named=st.lists(st.sampled_from([(i / 20) ** 2 for i in range(21)]), max_size=8),
)
def test_output_times_of_any_case_are_apart(end, count, named):
    case = {"end": end, "published_times": [end * each for each in named], "profile_times": named}
    times = production.output_times(case, count)
    assert times[0] == 0.0
    assert np.all(np.diff(times) > ROUNDED * times[1:])
    assert {float(each) for each in named} <= set(times.tolist())


def test_no_coordinate_of_a_dataset_holds_a_value_twice(built):
    files = sorted((built.path / "results").rglob("*.nc"))
    assert len(files) > 20
    for file in files:
        for name, values in netcdf.read(file).indexes.items():
            if values.dtype.kind == "f":
                gaps = np.abs(np.diff(np.sort(values)))
                apart = gaps > ROUNDED * np.abs(np.sort(values)[1:])
                assert apart.all(), f"{file.name}: {name}"
