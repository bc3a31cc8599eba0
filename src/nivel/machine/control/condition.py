"""Conditions: a comparison, or a value that is positive where the condition holds."""

from __future__ import annotations

import re
from typing import Annotated, Any, Final

from pydantic import BeforeValidator, WithJsonSchema

from nivel.machine.control.block import Input
from nivel.machine.units.quantity import fault, shown

_COMPARISON: Final = re.compile(r"(<=|>=|==|!=|<|>|=)")


def _difference(value: Any) -> Any:
    """`a > b` and `b < a` as `a - (b)`."""
    if not isinstance(value, str):
        return value
    left, *rest = _COMPARISON.split(value)
    if not rest:
        return value
    if len(rest) > 2:
        raise fault(f"one comparison was expected, got {shown(value)}; several stand in a list")
    sign, right = rest
    if "=" in sign.replace("<=", "").replace(">=", "") or sign == "!=":
        raise fault(f"`{sign}` is hardly ever true of numbers that vary; write `>` or `<`: {shown(value)}")
    if not left.strip() or not right.strip():
        raise fault(f"a comparison has two sides: {shown(value)}")
    greater, less = (left, right) if sign[0] == ">" else (right, left)
    return f"({greater.strip()}) - ({less.strip()})"


# positive where the condition holds
Condition = Annotated[
    Input, BeforeValidator(_difference), WithJsonSchema({"anyOf": [{"type": "string"}, {"type": "number"}]})
]
