"""The names by which the numbers of a result are asked for.

A variable is asked for by its own name (`position`) or for one element (`crank.position`, `hinge.force`, `hinge.angle`,
`hinge.angle.rate`, `hinge.s.x.violation`; of two, `vibration_1.crank.mode_shift`), and either for one component (`crank.position.x`).
"""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping
from functools import lru_cache
from itertools import product
from types import MappingProxyType

from nivel.errors import ModelError
from nivel.lazy import dataclass
from nivel.system.layout import Variable

# Dimensions whose names are components of one quantity, not elements of the machine.
COMPONENTS = ("xyz", "euler_parameter")


@dataclass(frozen=True)
class Selection:
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
