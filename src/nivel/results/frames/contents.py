"""Contents of a result, in memory or in a file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.sink import Header
from nivel.system.layout import FrameLayout, Variable


class Contents(Protocol):
    """Named arrays over time, the names along their dimensions, and the attributes of the run.

    variables : name → Variable; "time" is not among them. Variables without any column are left out.
    coordinates : dimension → the names along it.
    frame_count : number of complete frames.
    """

    @property
    def attributes(self) -> Mapping[str, str | float | int]: ...
    @property
    def variables(self) -> Mapping[str, Variable]: ...
    @property
    def coordinates(self) -> Mapping[str, tuple[str, ...]]: ...
    @property
    def frame_count(self) -> int: ...

    def read(self, name: str, where: tuple[slice | int, ...] = ()) -> NDArray[np.float64]:
        """The variable `name`, or "time", (frame_count, …); `where` selects along its dimensions, time first."""
        ...


# what stands for a slash in names of variables in files, where that would make groups: `d(position)/d(parameters.length)`
SLASH, IN_FILES = "/", "\N{DIVISION SLASH}"


def name_in_file(name: str) -> str:
    """The name of a variable as files have it."""
    return name.replace(SLASH, IN_FILES)


def name_of(in_file: str) -> str:
    """The name of a variable that files have so."""
    return in_file.replace(IN_FILES, SLASH)


def present_variables(layout: FrameLayout) -> dict[str, Variable]:
    """The variables that have at least one column: a machine without joints has no joint forces."""
    return {variable.name: variable for variable in layout.variables if variable.columns.stop > variable.columns.start}


def shape_of(variable: Variable, coordinates: Mapping[str, tuple[str, ...]]) -> tuple[int, ...]:
    """Lengths of the dimensions after time."""
    return tuple(len(coordinates[dim]) for dim in variable.dims[1:])


def apart_from_variables(layout: FrameLayout) -> dict[str, str]:
    """Dimension → its name in the result.

    A dimension may not carry the name of a variable of several dimensions (xarray refuses it), so such a dimension gets
    `_name` appended: the variable `joint_coordinate` lies along the dimension `joint_coordinate_name`.
    """
    names = {variable.name for variable in layout.variables}
    return {dim: f"{dim}_name" if dim in names else dim for dim in layout.coordinates}


def resolved(header: Header) -> tuple[dict[str, Variable], dict[str, tuple[str, ...]]]:
    """Variables and coordinates of a header as they stand in a result: without empty ones, dimensions renamed."""
    layout = header.layout
    rename = apart_from_variables(layout)
    variables = {
        name: Variable(
            name,
            tuple(rename.get(dim, dim) for dim in variable.dims),
            variable.units,
            variable.long_name,
            variable.columns,
        )
        for name, variable in present_variables(layout).items()
    }
    used = {dim for variable in variables.values() for dim in variable.dims[1:]}
    coordinates = {rename[dim]: tuple(names) for dim, names in layout.coordinates.items() if rename[dim] in used}
    return variables, coordinates
