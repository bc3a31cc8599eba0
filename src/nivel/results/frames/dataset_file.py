"""NetCDF files of analyses whose numbers fit into memory."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from nivel.errors import ModelError
from nivel.results.frames.contents import name_in_file

if TYPE_CHECKING:
    import xarray


def write_dataset(dataset: xarray.Dataset, path: str | PathLike[str], *, force: bool) -> Path:
    """Write a dataset as NetCDF; returns where. Raises ModelError where the file exists and `force` is not given, or cannot be written."""
    target = Path(path)
    if target.exists() and not force:
        raise ModelError(f"the file {target} exists; give another name, or replace it with force")
    try:
        names = {name: name_in_file(str(name)) for name in dataset.data_vars if name_in_file(str(name)) != name}
        dataset.rename(names).to_netcdf(target, engine="h5netcdf")
    except OSError as error:
        raise ModelError(f"the file {target} cannot be written: {str(error).lower()}") from error
    return target
