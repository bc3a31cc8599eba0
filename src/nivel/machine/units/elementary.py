"""Functions of expressions in terms of simpler ones: arithmetic, `min`, `max`, `floor`, comparisons and choices."""

from __future__ import annotations

from typing import Final

from nivel.machine.units.arithmetic import Call, Negative, Node, Number, Operation

COMPOUND: Final = ("step", "step_rate", "step_acceleration", "ramp", "mod", "sign", "not")
_ZERO, _ONE, _TWO = Number(0.0), Number(1.0), Number(2.0)


def elementary(call: Call) -> Node:
    """The same value in simpler functions."""
    match call:
        case Call("sign", (x,)):
            return Operation("-", Operation("<", _ZERO, x), Operation("<", x, _ZERO))
        case Call("not", (x,)):
            return Operation("<=", x, _ZERO)
        case Call("mod", (x, y)):
            return Operation("-", x, Operation("*", y, Call("floor", (Operation("/", x, y),))))
        case Call("step" | "step_rate" | "step_acceleration" | "ramp" as function, (x, x0, y0, x1, y1)):
            width, height = Operation("-", x1, x0), Operation("-", y1, y0)
            share = Call("min", (Call("max", (Operation("/", Operation("-", x, x0), width), _ZERO)), _ONE))
            return _between(function, share, y0, height, width)
    raise ValueError(call.function)


def _between(function: str, s: Node, start: Node, height: Node, width: Node) -> Node:
    """The way from `start` at s = 0 up to start + height at s = 1."""
    if function == "ramp":
        return Operation("+", start, Operation("*", height, s))
    rest = Operation("-", _ONE, s)
    if function == "step":  # s³ (10 - 15 s + 6 s²)
        inner = Operation("-", Operation("*", Number(6.0), s), Number(15.0))
        shape = Operation("*", Operation("*", Operation("**", s, _TWO), s), _linear(10.0, s, inner))
        return Operation("+", start, Operation("*", height, shape))
    if function == "step_rate":  # 30 s² (1 - s)²
        shape = Operation("*", Number(30.0), Operation("**", Operation("*", s, rest), _TWO))
        return Operation("*", Operation("/", height, width), shape)
    # 60 s (1 - s) (1 - 2 s)
    shape = Operation("*", Operation("*", Number(60.0), Operation("*", s, rest)), _linear(1.0, s, Negative(_TWO)))
    return Operation("*", Operation("/", height, Operation("**", width, _TWO)), shape)


def _linear(constant: float, s: Node, slope: Node) -> Node:
    """constant + s slope."""
    return Operation("+", Number(constant), Operation("*", s, slope))
