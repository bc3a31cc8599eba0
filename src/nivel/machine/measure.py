"""The dimension of an expression, and whether it makes sense: lengths are not added to masses, no sine is of metres."""

from __future__ import annotations

from nivel.machine.arithmetic import (
    Call,
    ExpressionError,
    Name,
    Negative,
    Node,
    Number,
    Operation,
    Time,
    evaluate,
    uses_time,
)
from nivel.machine.dimension import Dimension, described, dimension, known, power, product, without_angle

_RADIAN = dimension(rad=1)


def measure(node: Node, *, time: Dimension | None = None) -> Dimension | None:
    """Dimension of `node`; None for a bare number. `time` is the dimension that the variable `time` is given.

    Raises ExpressionError where dimensions clash.
    """
    match node:
        case Number(_, its):
            return None if its is None else known(its)
        case Time():
            return time
        case Negative(operand):
            return measure(operand, time=time)
        case Call(function, arguments):
            return _of_call(function, [measure(argument, time=time) for argument in arguments])
        case Operation(symbol, left, right):
            return _of_operation(symbol, left, right, time)
        case Name(text):
            raise ExpressionError(f"`{text}` has no value")


def _of_operation(symbol: str, left: Node, right: Node, time: Dimension | None) -> Dimension | None:
    first, second = measure(left, time=time), measure(right, time=time)
    match symbol:
        case "+" | "-":
            return _same(first, second, "added" if symbol == "+" else "subtracted")
        case "*":
            return product(first, second)
        case "/":
            return product(first, power(second, -1))
    if without_angle(second) != without_angle(None):
        raise ExpressionError(f"an exponent is a pure number, not {described(second)}")
    if first is None:
        return None
    if uses_time(right):
        raise ExpressionError("a quantity with a unit cannot be raised to a power that changes with time")
    return power(first, evaluate(right))


def _of_call(function: str, arguments: list[Dimension | None]) -> Dimension | None:
    match function:
        case "min" | "max":
            result = arguments[0]
            for other in arguments[1:]:
                result = _same(result, other, "compared")
            return result
        case "abs":
            return arguments[0]
        case "sqrt":
            return power(arguments[0], 0.5)
        case "atan2":
            _same(arguments[0], arguments[1], "compared")
            return _RADIAN
    if without_angle(arguments[0]) != without_angle(None):
        wanted = "an angle" if function in ("sin", "cos", "tan") else "a pure number"
        raise ExpressionError(f"`{function}` is taken of {wanted}, not of {described(arguments[0])}")
    return _RADIAN if function in ("asin", "acos", "atan") else None


def _same(first: Dimension | None, second: Dimension | None, action: str) -> Dimension | None:
    if first is None or second is None:
        return first if second is None else second
    if without_angle(first) != without_angle(second):
        raise ExpressionError(f"{described(first)} and {described(second)} cannot be {action}")
    return first
