"""A result as xarray sees it. Only this file imports xarray, and only when it is asked to."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray

from nivel.errors import ModelError
from nivel.results.frames.contents import name_of
from nivel.results.frames.stored import DAMAGE

if TYPE_CHECKING:
    from nivel.results.result import Result


def data_array(result: Result, name: str) -> xarray.DataArray:
    """`name` with its dimensions, coordinates and units; a single element keeps its name as a scalar coordinate."""
    if name == "time":
        return xarray.DataArray(result.time, dims=("time",), name="time", attrs={"units": "s", "long_name": "time"})
    found = result.selection(name)
    variable = result.variables[found.variable]
    where = (*found.where, *[slice(None)] * (len(variable.dims) - len(found.where)))
    dims = [dim for dim, each in zip(variable.dims, where, strict=True) if isinstance(each, slice)]
    coords: dict[str, object] = {"time": ("time", result.time, {"units": "s", "long_name": "time"})}
    for dim, each in zip(variable.dims[1:], where[1:], strict=True):
        names = result.coordinates[dim]
        coords[dim] = (dim, list(names)) if isinstance(each, slice) else names[each]
    attrs: dict[str, object] = {"units": result.units(name), "long_name": variable.long_name}
    if (error := result.estimated_error(name)).size and not np.isnan(error).all():
        attrs["estimated_error"] = float(np.nanmax(error))
    return xarray.DataArray(result.array(name), dims=dims, coords=coords, name=name, attrs=attrs)


def dataset(result: Result) -> xarray.Dataset:
    """Everything. The file of a finished run is read lazily; one that may still grow, and memory, at once."""
    if result.path is not None and result.outcome != "running":
        try:
            found = xarray.open_dataset(result.path, engine="h5netcdf", decode_times=False)
            others = {name: name_of(str(name)) for name in found.data_vars if name_of(str(name)) != name}
            return found.rename(others) if others else found
        except (OSError, RuntimeError, *DAMAGE) as error:
            raise ModelError(f"{result.path} is damaged and cannot be read: {error}") from None
    variables = {
        name: (variable.dims, result.array(name), {"units": variable.units, "long_name": variable.long_name})
        for name, variable in result.variables.items()
    }
    coords: dict[str, object] = {dim: (dim, list(names)) for dim, names in result.coordinates.items()}
    coords["time"] = ("time", result.time, {"units": "s", "long_name": "time"})
    return xarray.Dataset(variables, coords=coords, attrs=dict(result.attributes))
