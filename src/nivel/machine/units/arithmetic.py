"""The small arithmetic of machine files as a tree: ``2*length + 5 mm``, ``7850 kg/m^3``, ``10 + 3*sin(2*pi*time)``.

A comparison is 1 where it holds and 0 where it does not; a condition holds where its value is greater than zero.

grammar.py makes trees of texts. Here names are bound to parameters and units, and what does not vary becomes a number.
What varies is `time` and signals: what the machine itself does, such as `hinge.angle_rate`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from itertools import pairwise
from typing import Final, Literal, SupportsFloat

from nivel.machine.units.dimension import Dimension
from nivel.machine.units.interpolation import FEWEST, INTERPOLATIONS, interpolated
from nivel.machine.units.slips import spelled
from nivel.machine.units.unit import UNITS, UnknownUnitError, unit


class ExpressionError(ValueError):
    """The text cannot be read or computed; the message says where and why."""


class UnknownNameError(ExpressionError):
    """`name` is neither a parameter nor a unit."""

    def __init__(self, name: str, hint: str) -> None:
        super().__init__(f"`{name}` is neither a parameter nor a unit{hint}")
        self.name = name


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
class Signal:
    """Something that the machine does: `hinge.angle`, or a local symbol such as `length` in the law of a spring."""

    path: str


@dataclass(frozen=True)
class Name:
    """A parameter, constant, unit or local symbol that is not bound yet.

    place : `unit` directly behind a number, where a unit stands although a parameter may have its name (`2 m`, `2 N/m`);
    `product` behind `*` and a unit (`2 N*m`), where a name of both kinds is ambiguous
    """

    text: str
    place: Literal["free", "unit", "product"] = "free"


@dataclass(frozen=True)
class Negative:
    operand: Node


@dataclass(frozen=True)
class Operation:
    """`symbol` is one of + - * / **, of < <= > >=, or `and`, `or`."""

    symbol: str
    left: Node
    right: Node


@dataclass(frozen=True)
class Call:
    """A function of FUNCTIONS; until it is bound, of any name."""

    function: str
    arguments: tuple[Node, ...]


@dataclass(frozen=True)
class Lookup:
    """The curve of a `kind` of INTERPOLATIONS through `values` at `points`, which increase; or its derivative of an `order`."""

    argument: Node
    kind: str
    points: tuple[float, ...]
    values: tuple[float, ...]
    order: int = 0


@dataclass(frozen=True)
class Function:
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


def _step(x: float, x0: float, y0: float, x1: float, y1: float) -> float:
    """y0 up to x0, y1 from x1 on, and between them a way that is smooth to the second derivative."""
    s = min(max((x - x0) / (x1 - x0), 0.0), 1.0)
    return y0 + (y1 - y0) * s**3 * (10.0 + s * (-15.0 + s * 6.0))


def _step_rate(x: float, x0: float, y0: float, x1: float, y1: float) -> float:
    s = min(max((x - x0) / (x1 - x0), 0.0), 1.0)
    return (y1 - y0) / (x1 - x0) * 30.0 * s**2 * (1.0 - s) ** 2


def _step_acceleration(x: float, x0: float, y0: float, x1: float, y1: float) -> float:
    s = min(max((x - x0) / (x1 - x0), 0.0), 1.0)
    return (y1 - y0) / (x1 - x0) ** 2 * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)


def _ramp(x: float, x0: float, y0: float, x1: float, y1: float) -> float:
    """y0 up to x0, y1 from x1 on, and a straight line between them."""
    return y0 + (y1 - y0) * min(max((x - x0) / (x1 - x0), 0.0), 1.0)


def _sign(x: float) -> float:
    return float((x > 0.0) - (x < 0.0))


def _choice(condition: float, yes: float, no: float) -> float:
    return yes if condition > 0.0 else no


def _modulo(x: float, y: float) -> float:
    """What is left of x after whole multiples of y."""
    return x - y * math.floor(x / y)


def _not(x: float) -> float:
    return float(x <= 0.0)


NOT_FINITE: Final = ("nan", "inf", "infinity")
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
    "step": (_step, (5, 5)),
    "step_rate": (_step_rate, (5, 5)),
    "step_acceleration": (_step_acceleration, (5, 5)),
    "ramp": (_ramp, (5, 5)),
    "if": (_choice, (3, 3)),
    "not": (_not, (1, 1)),
    "sign": (_sign, (1, 1)),
    "floor": (math.floor, (1, 1)),
    "mod": (_modulo, (2, 2)),
    "tanh": (math.tanh, (1, 1)),
}
LOOKUP: Final = "lookup"  # lookup(x, KIND, x0, y0, x1, y1, …): a curve through points; KIND_1 is its derivative
COMPARISONS: Final = ("<", "<=", ">", ">=")
LOGICAL: Final = ("and", "or")
TIME: Final = "time"
RESERVED: Final = frozenset({TIME, LOOKUP, *LOGICAL, *CONSTANTS, *FUNCTIONS})
FREE_CONSTANTS: Final = frozenset({"e"})  # names that parameters and arguments of functions may take over
NOT_FOR_PARAMETERS: Final = RESERVED - FREE_CONSTANTS
LOCAL_SYMBOLS: Final = ("length", "angle", "value", "depth", "rate")  # where a law may use them they are signals


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


def leaves(node: Node) -> Iterator[Node]:
    """The parts of `node` that have no parts, from left to right."""
    match node:
        case Negative(operand) | Lookup(operand):
            yield from leaves(operand)
        case Operation(_, left, right):
            yield from leaves(left)
            yield from leaves(right)
        case Call(_, arguments):
            for argument in arguments:
                yield from leaves(argument)
        case _:
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
    match node:
        case Call(function, arguments):
            yield function
            for argument in arguments:
                yield from calls(argument)
        case Operation(_, left, right):
            yield from calls(left)
            yield from calls(right)
        case Negative(operand):
            yield from calls(operand)


def signals(node: Node) -> tuple[str, ...]:
    """The paths of the signals in `node`, each once, in the order in which they stand."""
    return tuple(dict.fromkeys(leaf.path for leaf in leaves(node) if isinstance(leaf, Signal)))


def varies(node: Node) -> bool:
    """Whether `node` depends on time or on a signal."""
    return any(isinstance(leaf, Time | Signal) for leaf in leaves(node))


def bind(node: Node, parameters: Parameters, local: Collection[str] = ()) -> Node:
    """`node` with every name replaced by what it stands for: one of the `local` symbols, else a parameter, a constant
    or a unit; directly behind a number a unit comes first.

    Raises ExpressionError for an unknown name or one with two meanings, FaultyParameterError for one that has no value
    because of its own fault.
    """
    match node:
        case Name(text, "unit") if text in UNITS:
            return Number(*UNITS[text])
        case Name(text, "product") if text in UNITS and (text in parameters or text in local):
            raise ExpressionError(
                f"`{text}` behind `*` and a unit may be the unit or the {'argument' if text in local else 'parameter'}: write a "
                f"space in place of `*` for the unit, as in `2 N {text}`, or parentheses for the other, as in `(2 N)*{text}`"
            )
        case Name(text) if text in local:
            if text in parameters:
                raise ExpressionError(
                    f"`{text}` is a parameter and has a meaning of its own here; rename the parameter"
                )
            return Signal(text)
        case Name(text):
            return _value_of(text, parameters, local)
        case Negative(operand):
            return Negative(bind(operand, parameters, local))
        case Operation(symbol, left, right):
            try:
                return Operation(symbol, bind(left, parameters, local), bind(right, parameters, local))
            except UnknownNameError as problem:
                raise _hinting_at_hyphen(problem, node) from None
        case Call(function, arguments):
            return _bind_call(function, arguments, parameters, local)
        case Lookup(argument):
            return replace(node, argument=bind(argument, parameters, local))
        case _:
            return node


def _bind_call(function: str, arguments: tuple[Node, ...], parameters: Parameters, local: Collection[str]) -> Node:
    """A call of a function of ours, a curve, or the body of a named function with its arguments put in."""
    if function == LOOKUP:
        return _bind_lookup(arguments, parameters, local)
    bound = tuple(bind(argument, parameters, local) for argument in arguments)
    if function in FUNCTIONS:
        _check_count(function, len(bound), *FUNCTIONS[function][1])
        return Call(function, bound)
    meant = parameters.get(function)
    if isinstance(meant, Function):
        _check_count(function, len(bound), len(meant.arguments), len(meant.arguments))
        return substituted(meant.body, dict(zip(meant.arguments, bound, strict=True)))
    if function in parameters:
        if meant is None:
            raise FaultyParameterError(function)
        raise ExpressionError(f"`{function}` is a number and takes no arguments; `*` is missing behind it")
    known = [*FUNCTIONS, LOOKUP, *(name for name, each in parameters.items() if isinstance(each, Function))]
    last = function.casefold().rpartition(".")[2]  # of `math.sin`
    near = [each for each in known if each == last] or get_close_matches(function, known, n=1)
    hint = f"; did you mean `{near[0]}`?" if near else f"; there are {', '.join(known)}"
    raise ExpressionError(f"there is no function `{function}`{hint}")


def _check_count(function: str, given: int, fewest: int, most: int) -> None:
    if not fewest <= given <= most:
        wanted = str(fewest) if fewest == most else f"at least {fewest}"
        raise ExpressionError(f"`{function}` takes {wanted} argument{'s' if fewest > 1 else ''}, got {given}")


def _bind_lookup(arguments: tuple[Node, ...], parameters: Parameters, local: Collection[str]) -> Lookup:
    form = f"`{LOOKUP}(x, linear, x0, y0, x1, y1, …)`"
    if len(arguments) < 4 or len(arguments) % 2:
        raise ExpressionError(f"{form} was expected: an argument, an interpolation, and points in pairs")
    argument, kind, *numbers = arguments
    word, _, order = kind.text.partition("_") if isinstance(kind, Name) else ("", "", "")
    if word not in INTERPOLATIONS or order not in ("", "1", "2", "3", "4"):
        raise ExpressionError(f"{form} was expected, with one of {', '.join(INTERPOLATIONS)} as the interpolation")
    bound = [bind(number, parameters, local) for number in numbers]
    if any(varies(number) for number in bound):
        raise ExpressionError(f"the points of {form} are numbers; they cannot vary")
    values = [evaluate(number) for number in bound]
    points = tuple(values[::2])
    if any(after <= before for before, after in pairwise(points)):
        raise ExpressionError(f"the points x0, x1, … of `{LOOKUP}` increase")
    if len(points) < FEWEST[word]:
        raise ExpressionError(f"a {word} `{LOOKUP}` needs at least {FEWEST[word]} points, got {len(points)}")
    return Lookup(bind(argument, parameters, local), word, points, tuple(values[1::2]), int(order or 0))


def substituted(node: Node, arguments: Mapping[str, Node]) -> Node:
    """`node` with what stands in `arguments` in place of the signals of these names."""
    match node:
        case Signal(path):
            return arguments.get(path, node)
        case Negative(operand):
            return Negative(substituted(operand, arguments))
        case Operation(symbol, left, right):
            return Operation(symbol, substituted(left, arguments), substituted(right, arguments))
        case Call(function, given):
            return Call(function, tuple(substituted(each, arguments) for each in given))
        case Lookup(argument):
            return replace(node, argument=substituted(argument, arguments))
        case _:
            return node


def _hinting_at_hyphen(problem: UnknownNameError, node: Operation) -> ExpressionError:
    """`problem`, found in `node`, which may be meant as one symbol: `left-hinge.angle`."""
    before, after = list(leaves(node.left))[-1], next(leaves(node.right))
    is_name = isinstance(before, Name) and before.text == problem.name
    if node.symbol != "-" or not is_name or not isinstance(after, Signal):
        return problem
    element = after.path.partition(".")[0]
    return ExpressionError(
        f"{problem}; and the name `{problem.name}-{element}` cannot stand in an expression, where `-` is the minus sign:"
        f" rename it to `{problem.name}_{element}`"
    )


def _value_of(name: str, parameters: Parameters, local: Collection[str]) -> Number | Signal:
    if name in parameters:
        value = parameters[name]
        if value is None:
            raise FaultyParameterError(name)
        if isinstance(value, Function):
            raise ExpressionError(f"`{name}` is a function; write `{name}({', '.join(value.arguments)})`")
        return value
    if name in CONSTANTS:
        return Number(CONSTANTS[name])
    meant = spelled(name)
    try:
        if not meant or name in UNITS or not name.lstrip("kMm").startswith("N"):
            return Number(*unit(name))  # pint would take the `s` of `Nms` for a plural
    except UnknownUnitError:
        pass
    if name.lower() in NOT_FINITE:
        raise ExpressionError(f"a finite number is needed, got `{name}`")
    near = _near(name, [*local, *parameters, *RESERVED, *UNITS])
    hint = f"; write `{meant}`" if meant else f"; did you mean `{near[0]}`?" if near else ""
    raise UnknownNameError(name, hint)


def _near(name: str, known: Sequence[str]) -> list[str]:
    """What may be meant by `name`: a unit in small letters, or one of the `known`; nothing is near a single letter."""
    try:
        unit(name.lower())
    except UnknownUnitError:
        return get_close_matches(name, known, n=1, cutoff=0.6) if len(name) > 1 else []
    return [name.lower()]


def evaluate(node: Node, time: float = math.nan, values: Mapping[str, float] | None = None) -> float:
    """The number that `node` stands for at `time` [s], in SI units. Names must be bound.

    values : the value of each signal by its path, SI

    Raises ExpressionError where there is none (division by zero, the root of a negative number, overflow).
    """
    try:
        value = _evaluate(node, time, values or {})
    except ZeroDivisionError:
        raise ExpressionError("division by zero") from None
    except OverflowError:
        raise ExpressionError("the number is too large") from None
    except ValueError as error:
        raise (
            error if isinstance(error, ExpressionError) else ExpressionError("outside the domain of a function")
        ) from None
    return finite(value)


def _evaluate(node: Node, time: float, values: Mapping[str, float]) -> float:
    match node:
        case Number(value, _):
            return value
        case Time():
            return time
        case Signal(path):
            if path not in values:
                raise ExpressionError(f"`{path}` is only known while the machine moves")
            return values[path]
        case Negative(operand):
            return -_evaluate(operand, time, values)
        case Operation(symbol, left, right):
            return _operate(symbol, _evaluate(left, time, values), _evaluate(right, time, values))
        case Call("if", (condition, yes, no)):
            return _evaluate(yes if _evaluate(condition, time, values) > 0.0 else no, time, values)
        case Call(function, arguments):
            return float(FUNCTIONS[function][0](*(_evaluate(argument, time, values) for argument in arguments)))
        case Lookup(argument, kind, points, heights, order):
            return interpolated(kind, points, heights, _evaluate(argument, time, values), order)
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
        case "<" | "<=" | ">" | ">=" | "and" | "or":
            return float(_holds(symbol, left, right))
    raised = left**right
    if isinstance(raised, complex):
        raise ExpressionError("a negative number raised to a fraction is not a real number")
    return raised


def _holds(symbol: str, left: float, right: float) -> bool:
    match symbol:
        case "<":
            return left < right
        case "<=":
            return left <= right
        case ">":
            return left > right
        case ">=":
            return left >= right
        case "and":
            return left > 0.0 and right > 0.0
    return left > 0.0 or right > 0.0


def fold(node: Node) -> Node:
    """`node` with every part that does not vary replaced by one bare number."""
    if not varies(node):
        return Number(evaluate(node))
    match node:
        case Negative(operand):
            return Negative(fold(operand))
        case Operation(symbol, left, right):
            return Operation(symbol, fold(left), fold(right))
        case Call(function, arguments):
            return Call(function, tuple(fold(argument) for argument in arguments))
        case Lookup(argument):
            return replace(node, argument=fold(argument))
        case _:
            return node


_PRECEDENCE = {"or": -2, "and": -1, **dict.fromkeys(COMPARISONS, 0), "+": 1, "-": 1, "*": 2, "/": 2, "**": 4}
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
        case Signal(text) | Name(text):
            return text, _ATOM
        case Negative(operand):
            return f"-{_within(operand, _SIGN)}", _SIGN
        case Call(function, arguments):
            return f"{function}({', '.join(render(argument) for argument in arguments)})", _ATOM
        case Lookup(argument, kind, points, values, order):
            pairs = ", ".join(f"{point!r}, {value!r}" for point, value in zip(points, values, strict=True))
            return f"{LOOKUP}({render(argument)}, {kind}{f'_{order}' if order else ''}, {pairs})", _ATOM
        case Operation(symbol, left, right):
            level = _PRECEDENCE[symbol]
            space = " " if level <= 1 else ""
            rightwards = symbol == "**"
            first = _within(left, level + (rightwards or level == 0))
            second = _within(right, _SIGN if rightwards else level + 1)
            return f"{first}{space}{symbol}{space}{second}", level


def _within(node: Node, level: int) -> str:
    """`node` as an operand that must bind at least as tightly as `level`."""
    text, its = _render(node)
    return text if its >= level else f"({text})"
