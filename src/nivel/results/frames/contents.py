"""Contents of a result, in memory or in a file, and the format of result files: `docs/versions.md` says what may change in it.

The names by which the numbers of a result are asked for.
A variable is asked for by its own name (`position`) or for one element (`crank.position`, `hinge.force`, `hinge.angle`,
`hinge.angle.rate`, `hinge.s.x.violation`; of two, `vibration_1.crank.mode_shift`), and either for one component (`crank.position.x`).
"""

import difflib
import json
import re
from collections.abc import Mapping
from functools import lru_cache
from itertools import product
from types import MappingProxyType
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

import nivel
from nivel.errors import ModelError
from nivel.integrate.loop.sink import Header
from nivel.lazy import Struct, replace
from nivel.system.layout import Variable


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


def shape_of(variable: Variable, coordinates: Mapping[str, tuple[str, ...]]) -> tuple[int, ...]:
    """Lengths of the dimensions after time."""
    return tuple(len(coordinates[dim]) for dim in variable.dims[1:])


def resolved(header: Header) -> tuple[dict[str, Variable], dict[str, tuple[str, ...]]]:
    """Variables and coordinates of a header as they stand in a result: without those that have no column, as joint forces of a machine
    without joints. A dimension may not carry the name of a variable of several dimensions (xarray refuses it), so such a one gets `_name`
    appended: the variable `joint_coordinate` lies along the dimension `joint_coordinate_name`."""
    layout = header.layout
    rename = {dim: f"{dim}_name" for dim in layout.coordinates if dim in {each.name for each in layout.variables}}
    variables = {
        each.name: replace(each, dims=tuple(rename.get(dim, dim) for dim in each.dims))
        if not rename.keys().isdisjoint(each.dims)
        else each
        for each in layout.variables
        if each.columns.stop > each.columns.start
    }
    used = {dim for variable in variables.values() for dim in variable.dims[1:]}
    along = {rename.get(dim, dim): tuple(names) for dim, names in layout.coordinates.items()}
    return variables, {dim: names for dim, names in along.items() if dim in used}


FORMAT: Final = 1
ATTRIBUTE: Final = "result_format"  # of the file; nivel 0.1.0 wrote files of format 1 without it


def check_format(path: object, attributes: Mapping[str, Any]) -> None:
    """Refuse a result file of another format. `attributes` has `nivel_version`.

    Raises ModelError, and ValueError or TypeError where the attribute is no whole number.
    """
    given = int(attributes.get(ATTRIBUTE, FORMAT))
    if given == FORMAT:
        return
    version = _version(attributes)
    raise ModelError(
        f"{path} was written by nivel {version} in result format {given}; nivel {nivel.__version__}, which runs here, reads "
        f"format {FORMAT}: `pip install nivel=={version}` installs the version that reads the file"
    )


def written_by_newer(attributes: Mapping[str, Any]) -> str:
    """End of a message on what cannot be read: that a newer nivel wrote the file; empty where none did."""
    version = _version(attributes)
    if _numbers(version) <= _numbers(nivel.__version__):
        return ""
    return (
        f"; it was written by nivel {version}, and nivel {nivel.__version__} runs here: "
        f"`pip install nivel=={version}` installs the version that reads the file"
    )


def _version(attributes: Mapping[str, Any]) -> str:
    """The version that the file states; empty where the attribute is damaged."""
    try:
        given = attributes.get("nivel_version", "")
    except (KeyError, OSError, RuntimeError, ValueError):  # of the HDF5 library
        return ""
    return given.decode(errors="replace") if isinstance(given, bytes) else str(given)


def _numbers(version: str) -> tuple[int, ...]:
    """0.10.2 is newer than 0.9; what is no version is older than all."""
    found = re.match(r"\d{1,9}(?:\.\d{1,9})*", version)
    return tuple(int(each) for each in found[0].split(".")) if found else ()


class MemoryContents:
    """Frames (frame_count, width) of a run and the names of their columns."""

    def __init__(self, header: Header, frames: NDArray[np.float64], attributes: dict[str, str | float | int]) -> None:
        self.variables: dict[str, Variable]
        self.coordinates: dict[str, tuple[str, ...]]
        self.variables, self.coordinates = resolved(header)
        self.attributes = attributes
        self.frame_count = len(frames)
        self.header = header
        self.frames = frames

    def read(self, name: str, where: tuple[slice | int, ...] = ()) -> NDArray[np.float64]:
        if name == "time":
            return self.frames[:, 0][where or ...].copy()
        variable = self.variables[name]
        block = self.frames[:, variable.columns].reshape(self.frame_count, *shape_of(variable, self.coordinates))
        return np.array(block[where or ...])


# Dimensions whose names are components of one quantity, not elements of the machine.
COMPONENTS = ("xyz", "euler_parameter")


class Selection(Struct):
    """A part of a variable: `where` selects along its dimensions, time (all of it) first."""

    variable: str
    where: tuple[slice | int, ...]


def selections(
    variables: Mapping[str, Variable], coordinates: Mapping[str, tuple[str, ...]]
) -> Mapping[str, Selection]:
    """Every name that can be asked for, in the order of the variables. A variable's own name wins over an element's."""
    dims = tuple((name, variable.dims[1:]) for name, variable in variables.items())
    return _selections(dims, tuple((dim, tuple(names)) for dim, names in coordinates.items()))


@lru_cache(maxsize=8)  # runs of one structure have the same names
def _selections(
    variables: tuple[tuple[str, tuple[str, ...]], ...], along: tuple[tuple[str, tuple[str, ...]], ...]
) -> Mapping[str, Selection]:
    """For (name, dimensions after time) of variables and (dimension, names along it)."""
    every = slice(None)
    found, coordinates = {name: Selection(name, ()) for name, _ in variables}, dict(along)
    for whole, dims in variables:
        variable, named = _within(whole)
        elements = [dim for dim in dims if dim not in COMPONENTS]
        starts: list[tuple[str, tuple[slice | int, ...]]] = [(variable, (every,))]
        if elements:
            suffix = _suffix(variable, elements[0])
            starts = [
                (".".join(name for _, name in chosen) + suffix, (every, *(i for i, _ in chosen)))
                for chosen in product(*(enumerate(coordinates[element]) for element in elements))
            ]
        components = coordinates[dims[-1]] if dims and dims[-1] in COMPONENTS else ()
        for name, where in starts:
            found.setdefault(named.format(name), Selection(whole, where))
            for k, component in enumerate(components):
                found.setdefault(named.format(f"{name}.{component}"), Selection(whole, (*where, k)))
    return MappingProxyType(found)


def _within(variable: str) -> tuple[str, str]:
    """The variable of which this one is a derivative, and what makes a name of it one of the derivative; itself where it is none."""
    if (parts := derivative(variable)) is None:
        return variable, "{}"
    return parts[0], f"d({{}})/d({parts[1].replace('{', '{{').replace('}', '}}')})"


def derivative(name: str) -> tuple[str, str] | None:
    """(what, by what) of the name `d(what)/d(by what)`; None for other names."""
    if not (name.startswith("d(") and name.endswith(")")):
        return None
    what, between, by = name[2:-1].partition(")/d(")
    return (what, by) if between else None


def _suffix(variable: str, dimension: str) -> str:
    """`.force` for `joint_force` along `joint`; nothing for `joint_coordinate` along its own names."""
    first, _, rest = variable.partition("_")
    if not rest or first not in ("joint", "constraint", dimension.split("_", maxsplit=1)[0]):
        return f".{variable}"
    return "" if rest in dimension else f".{rest}"


def unknown_name(name: str, known: Mapping[str, Selection]) -> ModelError:
    """The error for a name that a result does not have, with the nearest names that it has."""
    near = difflib.get_close_matches(name, known, n=3, cutoff=0.5)
    if near:
        listed = " or ".join(f"`{each}`" for each in near)
        return ModelError(f"the result has no `{name}`; did you mean {listed}?")
    some = ", ".join(f"`{each}`" for each in list(known)[:6])
    return ModelError(f"the result has no `{name}`; it has, for instance, {some}")


# (units of the row at position level) → units of the variable
OF_VARIABLE = {
    "joint_coordinate": {"rad": "rad", "m": "m"},
    "joint_rate": {"rad": "rad/s", "m": "m/s"},
    "constraint_violation": {"m": "m", "1": "1", "rad": "rad"},
    "constraint_rate_violation": {"m": "m/s", "1": "1/s", "rad": "rad/s"},
    "constraint_force": {"m": "N", "1": "N m", "rad": "N m"},
}


def own_units(attributes: Mapping[str, str | float | int], variable: str, row: str) -> str:
    """Units of `row` of `variable`, from the attributes `coordinate_units`, `constraint_units` (JSON: row → units)."""
    if (parts := derivative(variable)) is not None:
        parameters = json.loads(str(attributes.get("sensitivities", "{}")))
        return per(own_units(attributes, parts[0], row), parameters.get(parts[1], {}).get("units", ""))
    attribute = "coordinate_units" if variable.startswith("joint_") else "constraint_units"
    stated = _stated(str(attributes.get(attribute, "{}")))
    return OF_VARIABLE.get(variable, {}).get(stated.get(row, ""), "")


def per(units: str, other: str) -> str:
    """Units of a derivative of what has `units` by what has `other` ones."""
    if other in ("", "1"):
        return units or "1"
    return f"{units or '1'}/({other})" if set(other) & set(" /") else f"{units or '1'}/{other}"


@lru_cache(maxsize=8)
def _stated(text: str) -> dict[str, str]:
    """Row → units, read once for all rows."""
    return json.loads(text)
