"""Units of variables whose rows differ: joint coordinates are angles or lengths, constraint rows lengths, angles or cosines."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import lru_cache

from nivel.results.frames.names import derivative

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
