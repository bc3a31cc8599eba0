"""Trees of expressions: nodes, and walks over them."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final, Literal, SupportsFloat

from nivel.lazy import Struct, field, replace
from nivel.machine.units.unit import UNITS, Dimension

NOT_FINITE: Final = ("nan", "inf", "infinity")
CONSTANTS: Final = {"pi": math.pi, "e": math.e}
LOOKUP: Final = "lookup"  # lookup(x, KIND, x0, y0, x1, y1, …): a curve through points; KIND_1 is its derivative
COMPARISONS: Final = ("<", "<=", ">", ">=")
LOGICAL: Final = ("and", "or")
OPERATORS: Final[dict[str, Callable[[Any, Any], Any]]] = {  # of numbers and of arrays of them
    **{"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "**": operator.pow},
    **{"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge},
    "and": lambda first, second: (first > 0.0) & (second > 0.0),
    "or": lambda first, second: (first > 0.0) | (second > 0.0),
}
TIME: Final = "time"


class ExpressionError(ValueError):
    """The text cannot be read or computed; the message says where and why."""


class UnknownNameError(ExpressionError):
    """`name` is neither a parameter nor a unit."""

    def __init__(self, name: str, hint: str) -> None:
        super().__init__(f"`{name}` is neither a parameter nor a unit{hint}")
        self.name = name


class FaultyParameterError(Exception):
    """The text uses a parameter that is itself at fault, which has been reported already."""


class Number(Struct):
    """`value` in SI units of `dimension`; without one, a bare number."""

    value: float
    dimension: Dimension | None = None


class Time(Struct):
    """The time of the simulation in seconds."""


class Signal(Struct):
    """Something that the machine does: `hinge.angle`, or a local symbol such as `length` in the law of a spring."""

    path: str


class Name(Struct):
    """A parameter, constant, unit or local symbol that is not bound yet.

    place : `unit` directly behind a number, where a unit stands although a parameter may have its name (`2 m`, `2 N/m`);
    `product` behind `*` and a unit (`2 N*m`), where a name of both kinds is ambiguous
    """

    text: str
    place: Literal["free", "unit", "product"] = "free"


class Negative(Struct):
    operand: Node


class Operation(Struct):
    """`symbol` is one of + - * / **, of < <= > >=, or `and`, `or`."""

    symbol: str
    left: Node
    right: Node


class Call(Struct):
    """A function of FUNCTIONS; until it is bound, of any name."""

    function: str
    arguments: tuple[Node, ...]


class Lookup(Struct):
    """The curve of a `kind` of INTERPOLATIONS through `values` at `points`, which increase; or its derivative of an `order`."""

    argument: Node
    kind: str
    points: tuple[float, ...]
    values: tuple[float, ...]
    order: int = 0


class Function(Struct):
    """A named function: a bound `body` in which the `arguments` stand as signals of their names.

    head, text : as it is written, of an expression: ``bump(x)``, ``5 cm*sin(x)``
    """

    arguments: tuple[str, ...]
    body: Node
    head: str = field(default="", compare=False)
    text: str = field(default="", compare=False)


Node = Number | Time | Signal | Name | Negative | Operation | Call | Lookup


# None marks a parameter at fault; blocks of a control stand among the parameters as their signals
Parameters = Mapping[str, Number | Signal | Function | None]


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


def parts(node: Node) -> tuple[Node, ...]:
    """The operands or arguments of `node`, from left to right."""
    match node:
        case Negative(operand) | Lookup(operand):
            return (operand,)
        case Operation(_, left, right):
            return left, right
        case Call(_, arguments):
            return arguments
    return ()


def with_parts(node: Node, change: Callable[[Node], Node]) -> Node:
    """`node` with each of its operands or arguments changed."""
    match node:
        case Negative(operand):
            return Negative(change(operand))
        case Operation(symbol, left, right):
            return Operation(symbol, change(left), change(right))
        case Call(function, arguments):
            return Call(function, tuple(change(each) for each in arguments))
        case Lookup(argument):
            return replace(node, argument=change(argument))
    return node


def leaves(node: Node) -> Iterator[Node]:
    """The parts of `node` that have no parts, from left to right."""
    own = parts(node)
    for part in own:
        yield from leaves(part)
    if not own:
        yield node


def names(node: Node) -> set[str]:
    """The unbound names in `node` that may be those of parameters; signals are none."""
    return {
        leaf.text
        for leaf in leaves(node)
        if isinstance(leaf, Name) and not (leaf.place == "unit" and leaf.text in UNITS)
    }


def calls(node: Node) -> Iterator[str]:
    """The names of the functions that `node` calls."""
    if isinstance(node, Call):
        yield node.function
    for part in parts(node):
        yield from calls(part)


def signals(node: Node) -> tuple[str, ...]:
    """The paths of the signals in `node`, each once, in the order in which they stand."""
    return tuple(dict.fromkeys(leaf.path for leaf in leaves(node) if isinstance(leaf, Signal)))


def varies(node: Node) -> bool:
    """Whether `node` depends on time or on a signal."""
    return any(isinstance(leaf, Time | Signal) for leaf in leaves(node))


def substituted(node: Node, arguments: Mapping[str, Node]) -> Node:
    """`node` with what stands in `arguments` in place of the signals and names of these names."""
    match node:
        case Signal(name) | Name(name):
            return arguments.get(name, node)
    return with_parts(node, lambda part: substituted(part, arguments))
