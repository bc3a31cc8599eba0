"""Results by name: what all of them offer in notebooks and programs, whatever they are results of."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from nivel.errors import Fault, ModelError, refuse
from nivel.extras import needed
from nivel.files.target import write_file
from nivel.known import Result
from nivel.lazy import xarray
from nivel.results.frames.contents import name_in_file, name_of
from nivel.results.frames.stored import DAMAGE
from nivel.words.arguments import checked_arguments
from nivel.words.wording import unknown_word

if TYPE_CHECKING:
    import pandas


class Column(NamedTuple):
    """The numbers of one column, and their SI unit; "1" or nothing where they have none."""

    values: Any
    units: str


class Rows(NamedTuple):
    """A table: what stands before its rows, by its name, and its columns by name."""

    name: str
    along: Column
    columns: Mapping[str, Column]


class Tabulated(ABC):
    """Something with numbers by name: `keys()`, completion of names in notebooks, `save(path)`, `to_dataframe()`."""

    @abstractmethod
    def to_xarray(self) -> xarray.Dataset:
        """Everything, with names and units."""

    def keys(self) -> tuple[str, ...]:
        """The names that ``[…]`` takes."""
        return tuple(str(name) for name in self.to_xarray().data_vars)

    def __getitem__(self, name: str) -> Any:
        """The numbers of this name with their units. Raises ModelError with the nearest name where there is none."""
        if name not in self.keys():
            raise ModelError(Fault.at("", unknown_word(str(name), list(self.keys()), "name")))
        return self.to_xarray()[name]

    def _ipython_key_completions_(self) -> list[str]:
        return list(self.keys())

    @checked_arguments
    def save(self, path: str | PathLike[str], *, force: bool = False) -> Path:
        """Write everything as NetCDF. Raises ModelError where the file exists and `force` is not given."""
        return write_dataset(self.to_xarray(), path, force=force)

    @checked_arguments
    def to_dataframe(self, select: Iterable[str] = ()) -> pandas.DataFrame:
        """A pandas table with one column per number; ``table.attrs["units"]`` has the SI units by column.

        select : names or patterns (`*.effort`) of columns; default all. Raises ModelError where there is no such column.
        """
        frames = needed("pandas", "tables need")
        rows = self._rows([select] if isinstance(select, str) else list(select))
        index = frames.Index(rows.along.values, name=rows.name)
        table = frames.DataFrame({name: each.values for name, each in rows.columns.items()}, index=index)
        table.attrs["units"] = {rows.name: rows.along.units} | {name: each.units for name, each in rows.columns.items()}
        return table

    def _rows(self, select: list[str]) -> Rows:
        """The table of `to_dataframe`: everything over the first dimension of the dataset."""
        data = self.to_xarray()
        along = str(next(iter(data.data_vars.values())).dims[0])
        columns: dict[str, Column] = {}
        for name, array in data.data_vars.items():
            if array.dims[:1] == (along,) and array.ndim == 1:
                columns[str(name)] = Column(array.to_numpy(), str(array.attrs.get("units", "")))
            elif array.dims[:1] == (along,) and array.ndim == 2:
                labels = [str(each) for each in data[array.dims[1]].to_numpy()]
                units = str(array.attrs.get("units", "")).split(", ")
                each_unit = units if len(units) == len(labels) else units[:1] * len(labels)
                for k, (label, unit) in enumerate(zip(labels, each_unit, strict=True)):
                    columns[f"{label}.{name}"] = Column(array.to_numpy()[:, k], unit)
        units = str(data[along].attrs.get("units", "s" if along == "time" else ""))
        return Rows(along, Column(data[along].to_numpy(), units), chosen(columns, select))


def chosen(columns: Mapping[str, Column], select: list[str]) -> dict[str, Column]:
    """The columns of these names or patterns, in the order asked for; all where nothing is. Raises ModelError for unknown ones."""
    found: dict[str, Column] = {}
    faults = []
    for entry in select:
        its = {name: each for name, each in columns.items() if name == entry or fnmatchcase(name, entry)}
        found |= its
        if not its:
            faults.append(Fault.at("select", unknown_word(entry, list(columns), "name")))
    refuse(faults)
    return found if select else dict(columns)


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
