"""NetCDF files of analyses whose numbers fit into memory."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from nivel.errors import ModelError
from nivel.files.target import write_file
from nivel.results.frames.contents import name_in_file

if TYPE_CHECKING:
    import xarray


def write_dataset(dataset: xarray.Dataset, path: str | PathLike[str], *, force: bool) -> Path:
    """Write a dataset as NetCDF; returns where. Raises ModelError where the file exists and `force` is not given, or cannot be written."""
    target = Path(path)
    if target.exists() and not force:
        raise ModelError(f"the file {target} exists; give another name, or replace it with force")
    names = {name: name_in_file(str(name)) for name in dataset.data_vars if name_in_file(str(name)) != name}
    return write_netcdf(dataset.rename(names), target)


def write_netcdf(dataset: xarray.Dataset, target: Path) -> Path:
    """Write a dataset as it is; an existing file is replaced. Raises ModelError where it cannot be written."""
    # in memory first: HDF5 ends the process where a disk is full
    return write_file(target, "data file", dataset.to_netcdf(engine="h5netcdf"))
