"""A number as a sensor shows it: in the sensor's own `units`, which need not be SI."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, ValidationInfo, WithJsonSchema

from nivel.machine.units.dimension import without_angle
from nivel.machine.units.measure import measure
from nivel.machine.units.quantity import ANY, constant_tree, expression_fault, parameters_of, read_quantity, reported
from nivel.machine.units.tree import ExpressionError, FaultyParameterError, Parameters


def _read(value: Any, info: ValidationInfo) -> float:
    parameters, units = parameters_of(info), info.data.get("units", "")
    try:
        number = read_quantity(value, ANY, parameters)
        if not isinstance(value, str) or not units or measure(constant_tree(value, parameters)) is None:
            return number
        return number / _unit_of(value, units, parameters)
    except FaultyParameterError:
        raise reported() from None
    except ExpressionError as problem:
        raise expression_fault(problem, value) from None


def _unit_of(text: str, units: str, parameters: Parameters) -> float:
    """`units` in SI, which must measure what the quantity `text` does.

    Raises ExpressionError.
    """
    try:
        its, unit = measure(constant_tree(f"1 {units}", {})), read_quantity(f"1 {units}", ANY, {})
    except ExpressionError:
        raise ExpressionError(f"the sensor is in `{units}`, which is no unit; write a plain number") from None
    given = measure(constant_tree(text, parameters))
    if its is None or given is None or without_angle(its) != without_angle(given):
        raise ExpressionError(f"the sensor is in `{units}`, which `{text.strip()}` is not")
    return unit


ShownNumber = Annotated[
    float, BeforeValidator(_read), WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "string"}]})
]
"""A plain number is in the units of the sensor; a text with a unit is converted to them."""
