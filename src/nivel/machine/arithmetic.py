"""The small arithmetic of machine files as a tree: ``2*length + 5 mm``, ``7850 kg/m^3``, ``10 + 3*sin(2*pi*time)``.

grammar.py makes trees of texts. Here names are bound to parameters and units, and what does not depend on time
becomes a number.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Final, SupportsFloat

from nivel.machine.dimension import Dimension
from nivel.machine.unit import UNITS, UnknownUnitError, unit


class ExpressionError(ValueError):
    """The text cannot be read or computed; the message says where and why."""


class FaultyParameterError(Exception):
    """The text uses a parameter that is itself at fault, which has been reported already."""


@dataclass(frozen=True)
class Number:
    """`value` in SI units of `dimension`; without one, a bare number."""

    value: float
    dimension: Dimension | None = None


@dataclass(frozen=True)
class Time:
    """The time of the simulation in seconds."""


@dataclass(frozen=True)
class Name:
    """A parameter, constant or unit that is not bound yet."""

    text: str


@dataclass(frozen=True)
class Negative:
    operand: Node


@dataclass(frozen=True)
class Operation:
    """`symbol` is one of + - * / **."""

    symbol: str
    left: Node
    right: Node


@dataclass(frozen=True)
class Call:
    """A function of FUNCTIONS."""

    function: str
    arguments: tuple[Node, ...]


Node = Number | Time | Name | Negative | Operation | Call
Parameters = Mapping[str, Number | None]  # None marks a parameter at fault

CONSTANTS: Final = {"pi": math.pi, "e": math.e}
FUNCTIONS: Final[dict[str, tuple[Callable[..., float], tuple[int, int]]]] = {  # the function, fewest and most arguments
    "sin": (math.sin, (1, 1)),
    "cos": (math.cos, (1, 1)),
    "tan": (math.tan, (1, 1)),
    "asin": (math.asin, (1, 1)),
    "acos": (math.acos, (1, 1)),
    "atan": (math.atan, (1, 1)),
    "atan2": (math.atan2, (2, 2)),
    "sqrt": (math.sqrt, (1, 1)),
    "exp": (math.exp, (1, 1)),
    "log": (math.log, (1, 1)),
    "abs": (math.fabs, (1, 1)),
    "min": (min, (2, 99)),
    "max": (max, (2, 99)),
}
TIME: Final = "time"
RESERVED: Final = frozenset({TIME, *CONSTANTS, *FUNCTIONS})


def finite(value: SupportsFloat) -> float:
    """`value` as a float.

    Raises ExpressionError for inf, nan and integers beyond the range of floats.
    """
    try:
        number = float(value)
    except OverflowError:
        raise ExpressionError("the number is too large") from None
    if not math.isfinite(number):
        raise ExpressionError("this is not a number" if math.isnan(number) else "the number is too large")
    return number


def given(value: SupportsFloat) -> float:
    """`value`, which stood as a number where it was read, as a float.

    Raises ExpressionError for inf, nan and integers beyond the range of floats.
    """
    if isinstance(value, float) and math.isinf(value):
        raise ExpressionError("a finite number was expected, got one that is infinite or too large")
    return finite(value)


def names(node: Node) -> set[str]:
    """The unbound names in `node`."""
    match node:
        case Name(text):
            return {text}
        case Negative(operand):
            return names(operand)
        case Operation(_, left, right):
            return names(left) | names(right)
        case Call(_, arguments):
            return set().union(*(names(argument) for argument in arguments))
        case _:
            return set()


def uses_time(node: Node) -> bool:
    match node:
        case Negative(operand):
            return uses_time(operand)
        case Operation(_, left, right):
            return uses_time(left) or uses_time(right)
        case Call(_, arguments):
            return any(uses_time(argument) for argument in arguments)
        case _:
            return isinstance(node, Time)


def bind(node: Node, parameters: Parameters) -> Node:
    """`node` with every name replaced by what it stands for: a parameter, else a constant, else a unit.

    Raises ExpressionError for an unknown name, FaultyParameterError for one that has no value because of its own fault.
    """
    match node:
        case Name(text):
            return _value_of(text, parameters)
        case Negative(operand):
            return Negative(bind(operand, parameters))
        case Operation(symbol, left, right):
            return Operation(symbol, bind(left, parameters), bind(right, parameters))
        case Call(function, arguments):
            return Call(function, tuple(bind(argument, parameters) for argument in arguments))
        case _:
            return node


def _value_of(name: str, parameters: Parameters) -> Number:
    if name in parameters:
        value = parameters[name]
        if value is None:
            raise FaultyParameterError(name)
        return value
    if name in CONSTANTS:
        return Number(CONSTANTS[name])
    try:
        return Number(*unit(name))
    except UnknownUnitError:
        near = get_close_matches(name, [*parameters, *RESERVED, *UNITS], n=1, cutoff=0.6)
        hint = f"; did you mean `{near[0]}`?" if near else ""
        raise ExpressionError(f"`{name}` is neither a parameter nor a unit{hint}") from None


def evaluate(node: Node, time: float = math.nan) -> float:
    """The number that `node` stands for at `time` [s], in SI units. Names must be bound.

    Raises ExpressionError where there is none (division by zero, the root of a negative number, overflow).
    """
    try:
        value = _evaluate(node, time)
    except ZeroDivisionError:
        raise ExpressionError("division by zero") from None
    except OverflowError:
        raise ExpressionError("the number is too large") from None
    except ValueError as error:
        raise (
            error if isinstance(error, ExpressionError) else ExpressionError("outside the domain of a function")
        ) from None
    return finite(value)


def _evaluate(node: Node, time: float) -> float:
    match node:
        case Number(value, _):
            return value
        case Time():
            return time
        case Negative(operand):
            return -_evaluate(operand, time)
        case Operation(symbol, left, right):
            return _operate(symbol, _evaluate(left, time), _evaluate(right, time))
        case Call(function, arguments):
            return float(FUNCTIONS[function][0](*(_evaluate(argument, time) for argument in arguments)))
        case Name(text):
            raise ExpressionError(f"`{text}` has no value")


def _operate(symbol: str, left: float, right: float) -> float:
    match symbol:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "/":
            return left / right
    raised = left**right
    if isinstance(raised, complex):
        raise ExpressionError("a negative number raised to a fraction is not a real number")
    return raised


def fold(node: Node) -> Node:
    """`node` with every part that does not depend on time replaced by one bare number."""
    if not uses_time(node):
        return Number(evaluate(node))
    match node:
        case Negative(operand):
            return Negative(fold(operand))
        case Operation(symbol, left, right):
            return Operation(symbol, fold(left), fold(right))
        case Call(function, arguments):
            return Call(function, tuple(fold(argument) for argument in arguments))
        case _:
            return node


_PRECEDENCE = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 4}
_SIGN, _ATOM = 3, 5


def render(node: Node) -> str:
    """`node` as text that Python and this parser read alike. Names must be bound; units have become SI numbers."""
    return _render(node)[0]


def _render(node: Node) -> tuple[str, int]:
    match node:
        case Number(value, _):
            return repr(value), _SIGN if math.copysign(1, value) < 0 else _ATOM
        case Time():
            return TIME, _ATOM
        case Name(text):
            return text, _ATOM
        case Negative(operand):
            return f"-{_within(operand, _SIGN)}", _SIGN
        case Call(function, arguments):
            return f"{function}({', '.join(render(argument) for argument in arguments)})", _ATOM
        case Operation(symbol, left, right):
            level = _PRECEDENCE[symbol]
            space = " " if level == 1 else ""
            rightwards = symbol == "**"
            first = _within(left, level + rightwards)
            second = _within(right, _SIGN if rightwards else level + 1)
            return f"{first}{space}{symbol}{space}{second}", level


def _within(node: Node, level: int) -> str:
    """`node` as an operand that must bind at least as tightly as `level`."""
    text, its = _render(node)
    return text if its >= level else f"({text})"
