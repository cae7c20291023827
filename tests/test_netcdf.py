"""Files that are whole or not there, and hold nothing but finite numbers."""

import numpy as np
import pytest
import xarray as xr

from gelpump import netcdf
from gelpump.files import whole
from gelpump.text import write_text


def dataset(value):
    return xr.Dataset({"x": netcdf.variable("t", np.array([1.0, value]), "a number")})


def test_what_is_written_is_read(tmp_path):
    file = tmp_path / "x.nc"
    netcdf.write(dataset(2.0), file, "numbers", {"a": 1})
    np.testing.assert_array_equal(netcdf.read(file).x, [1.0, 2.0])
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_number_that_is_not_finite_is_refused(tmp_path, value):
    with pytest.raises(ValueError, match="numbers: 1 values of x are not finite"):
        netcdf.write(dataset(value), tmp_path / "x.nc", "numbers", {})
    assert list(tmp_path.iterdir()) == []


def test_a_file_has_its_name_only_when_it_is_whole(tmp_path):
    file = tmp_path / "x.txt"
    with whole(file) as partial:
        partial.write_text("half")
        assert not file.exists()
        partial.write_text("all of it")
    assert file.read_text() == "all of it"


def fail_half_way(file):
    with whole(file) as partial:
        partial.write_text("half")
        raise RuntimeError("disk full")


def test_a_failure_leaves_what_was_there(tmp_path):
    file = tmp_path / "x.txt"
    write_text("before", file)
    with pytest.raises(OSError, match=r"x\.txt was not written \(\d+ kB are free\): disk full"):
        fail_half_way(file)
    assert file.read_text() == "before"
    assert list(tmp_path.iterdir()) == [file]


def test_what_a_killed_run_left_is_replaced(tmp_path):
    file = tmp_path / "x.nc"
    (tmp_path / ".x.nc.partial").write_bytes(b"half of a dataset")
    netcdf.write(dataset(2.0), file, "numbers", {})
    assert list(tmp_path.iterdir()) == [file]
