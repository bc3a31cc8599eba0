"""NetCDF files of analyses: nothing is replaced unasked, and what cannot be written is said."""

import pytest
import xarray

from nivel.errors import ModelError
from nivel.results.frames.tabulated import write_dataset

DATA = xarray.Dataset({"x": ("time", [1.0, 2.0])})


def test_a_dataset_comes_back_and_is_replaced_with_force_only(tmp_path):
    path = write_dataset(DATA, tmp_path / "data.nc", force=False)
    assert xarray.load_dataset(path, engine="h5netcdf").equals(DATA)
    with pytest.raises(ModelError, match="exists; give another name, or replace it with force"):
        write_dataset(2 * DATA, path, force=False)
    assert xarray.load_dataset(path, engine="h5netcdf").equals(DATA)
    write_dataset(2 * DATA, path, force=True)
    assert xarray.load_dataset(path, engine="h5netcdf").equals(2 * DATA)


def test_a_folder_that_is_not_there_is_said(tmp_path):
    with pytest.raises(ModelError, match="cannot be written"):
        write_dataset(DATA, tmp_path / "nowhere" / "data.nc", force=False)
