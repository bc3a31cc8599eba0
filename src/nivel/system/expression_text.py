"""Expressions of machine files as Python source for the compiler, on real numbers and on complex ones."""

from __future__ import annotations

from collections.abc import Mapping

from nivel.machine.arithmetic import Call, Name, Negative, Node, Number, Operation, Signal, Time
from nivel.machine.expression import Expression

# of `nivel.kernels.smooth_step`, on real and on complex numbers
# functions of expressions in compiled code, where they are called otherwise than there with `np.` before; then on complex numbers
STEPS = ("step", "step_rate", "step_acceleration")
SPELLING = {
    **{name: name for name in STEPS},
    "asin": "np.arcsin",
    "acos": "np.arccos",
    "atan": "np.arctan",
    "atan2": "np.arctan2",
    "min": "np.minimum",
    "max": "np.maximum",
}
ANALYTIC = {
    **SPELLING,
    "atan2": "arctan2",
    "min": "minimum",
    "max": "maximum",
    "abs": "absolute",
    "tanh": "tanh",
    "**": "power",
}


def motion_lines(expression: Expression, spelling: Mapping[str, str]) -> str:
    """Body of a function of time alone, which leaves its two derivatives behind its argument."""
    rate = expression.derivative
    lines = (
        f"x[1] = {source(rate.tree, {}, spelling)}",
        f"x[2] = {source(rate.derivative.tree, {}, spelling)}",
        f"return {source(expression.tree, {}, spelling)}",
    )
    return "\n".join(f"    {line}" for line in lines)


def source(node: Node, places: Mapping[str, int], spelling: Mapping[str, str] = SPELLING) -> str:
    """Python source of an arithmetic tree for the compiler; the time is x[0], a signal x[its place].

    `max` and `min` of many arguments are nested.
    """
    match node:
        case Number(value, _):
            return f"({value!r})"
        case Time():
            return "x[0]"
        case Signal(path):
            return f"x[{places[path]}]"
        case Negative(operand):
            return f"(-{source(operand, places, spelling)})"
        case Operation("**", left, right) if "**" in spelling:
            return f"{spelling['**']}({source(left, places, spelling)}, {source(right, places, spelling)})"
        case Operation(symbol, left, right):
            return f"({source(left, places, spelling)} {symbol} {source(right, places, spelling)})"
        case Call(("min" | "max") as function, (first, *others)):
            text = source(first, places, spelling)
            for other in others:
                text = f"{spelling[function]}({text}, {source(other, places, spelling)})"
            return text
        case Call(function, arguments):
            called = spelling.get(function, f"np.{function}")
            return f"{called}({', '.join(source(each, places, spelling) for each in arguments)})"
        case Name(text):
            raise ValueError(f"the name {text} is not bound")
