"""The small arithmetic of machine files: ``2*length + 5 mm``, ``7850 kg/m^3``, ``10 + 3*sin(2*pi*time)``.

A text becomes a tree, names are bound to parameters, and what does not depend on time is folded to a number. Nothing is ever
handed to Python's `eval`.

    sum     = term { (+ | -) term }
    term    = sign { (* | /) sign | unit }      a unit may follow a number, `)` or a unit directly: `10 cm`, `(1/2) in`
    sign    = [ + | - ] sign | power
    power   = atom [ (^ | **) sign ]              to the right first, and before the sign: -2^2 = -4, as in Python
    atom    = number | name | function ( sum, … ) | ( sum )
    unit    = name [ (^ | **) sign ]

A unit multiplies what stands before it in its term, so `3/8 in` is three eighths of an inch and `pi/2 rad` a quarter turn.
`2 m / 4 s` could then be read in two ways and is refused; `(2 m)/(4 s)` is clear.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Final

from nivel.machine.dimension import Dimension
from nivel.machine.unit import UNITS, UnknownUnit, unit


class ArithmeticFault(ValueError):
    """The text cannot be read or computed; the message says where and why."""


class FaultyParameter(Exception):
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
    "abs": (abs, (1, 1)),
    "min": (min, (2, 99)),
    "max": (max, (2, 99)),
}
TIME: Final = "time"
RESERVED: Final = frozenset({TIME, *CONSTANTS, *FUNCTIONS})

_MOST_TOKENS = 400  # trees are walked by recursion: this and _DEEPEST keep them far from Python's limit
_DEEPEST = 60
_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[^\W\d]\w*|°)|(?P<symbol>\*\*|[-+*/^(),]))"
)


def parse(text: str) -> Node:
    """The tree of `text`, names unbound.

    Raises ArithmeticFault.
    """
    return _Parser(text).whole()


class _Parser:
    """Recursive descent over the grammar at the top of this file."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = _tokens(text)
        self.at = 0
        self.depth = 0

    def whole(self) -> Node:
        node = self.sum()
        if self.at < len(self.tokens):
            raise self.unexpected()
        return node

    def sum(self) -> Node:
        self.depth += 1
        if self.depth > _DEEPEST:
            raise ArithmeticFault("the expression is nested too deeply")
        node = self.term()
        while self.symbol() in ("+", "-"):
            node = Operation(self.take(), node, self.term())
        self.depth -= 1
        return node

    def term(self) -> Node:
        node = self.sign()
        has_unit = divided = False
        while True:
            if self.symbol() in ("*", "/"):
                divided = self.take() == "/"
                node = Operation("/" if divided else "*", node, self.sign())
            elif self.kind() == "name" and self.follows_number():
                if divided and has_unit:
                    raise ArithmeticFault("which part the last unit belongs to is unclear; write `(2 m)/(4 s)`")
                node = Operation("*", node, self.unit())
                has_unit = True
            else:
                return node

    def follows_number(self) -> bool:
        """A unit may stand directly after a number, a closing parenthesis or another unit."""
        kind, text = self.tokens[self.at - 1]
        return kind == "number" or text == ")" or (kind == "name" and (text in UNITS or text in CONSTANTS))

    def sign(self) -> Node:
        sign = self.symbol()
        if sign not in ("+", "-"):
            return self.power()
        self.take()
        self.depth += 1
        if self.depth > _DEEPEST:
            raise ArithmeticFault("the expression is nested too deeply")
        operand = self.sign()
        self.depth -= 1
        return Negative(operand) if sign == "-" else operand

    def power(self) -> Node:
        return self.raised(self.atom())

    def raised(self, base: Node) -> Node:
        if self.symbol() not in ("^", "**"):
            return base
        self.take()
        self.depth += 1
        exponent = self.sign()
        self.depth -= 1
        return Operation("**", base, exponent)

    def unit(self) -> Node:
        name = self.take()
        if self.symbol() == "(":
            raise ArithmeticFault(f"`*` is missing before `{name}`")
        return self.raised(Time() if name == TIME else Name(name))

    def atom(self) -> Node:
        kind = self.kind()
        if kind == "number":
            return Number(_finite(float(self.take())))
        if kind == "name":
            name = self.take()
            if self.symbol() == "(":
                return self.call(name)
            return Time() if name == TIME else Name(name)
        if self.symbol() == "(":
            self.take()
            node = self.sum()
            self.expect(")")
            return node
        raise self.unexpected()

    def call(self, name: str) -> Node:
        if name not in FUNCTIONS:
            near = get_close_matches(name, FUNCTIONS, n=1)
            hint = f"; did you mean `{near[0]}`?" if near else f"; there are {', '.join(FUNCTIONS)}"
            raise ArithmeticFault(f"there is no function `{name}`{hint}")
        self.take()
        arguments = [self.sum()]
        while self.symbol() == ",":
            self.take()
            arguments.append(self.sum())
        self.expect(")")
        fewest, most = FUNCTIONS[name][1]
        if not fewest <= len(arguments) <= most:
            wanted = str(fewest) if fewest == most else f"at least {fewest}"
            raise ArithmeticFault(f"`{name}` takes {wanted} argument{'s' if fewest > 1 else ''}, got {len(arguments)}")
        return Call(name, tuple(arguments))

    def kind(self) -> str:
        return self.tokens[self.at][0] if self.at < len(self.tokens) else "end"

    def symbol(self) -> str:
        return self.tokens[self.at][1] if self.kind() == "symbol" else ""

    def take(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1][1]

    def expect(self, symbol: str) -> None:
        if self.symbol() != symbol:
            raise self.unexpected(f"; `{symbol}` was expected")
        self.take()

    def unexpected(self, hint: str = "") -> ArithmeticFault:
        if self.at >= len(self.tokens):
            return ArithmeticFault(f"the expression ends too early{hint}")
        return ArithmeticFault(f"`{self.tokens[self.at][1]}` was not expected here{hint}")


def _tokens(text: str) -> list[tuple[str, str]]:
    tokens: list[tuple[str, str]] = []
    at, end = 0, len(text.rstrip())
    while at < end:
        found = _TOKEN.match(text, at)
        if found is None:
            raise ArithmeticFault(f"`{text[at:].lstrip()[0]}` is not understood")
        tokens.append((str(found.lastgroup), found.group(str(found.lastgroup))))
        at = found.end()
        if len(tokens) > _MOST_TOKENS:
            raise ArithmeticFault("the expression is too long; split it with `parameters:`")
    if not tokens:
        raise ArithmeticFault("nothing stands here; a number was expected")
    return tokens


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise ArithmeticFault("the number is too large" if not math.isnan(value) else "the result is not a number")
    return value


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

    Raises ArithmeticFault for an unknown name, FaultyParameter for one that has no value because of its own fault.
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
            raise FaultyParameter(name)
        return value
    if name in CONSTANTS:
        return Number(CONSTANTS[name])
    try:
        return Number(*unit(name))
    except UnknownUnit:
        near = get_close_matches(name, [*parameters, *RESERVED, *UNITS], n=1, cutoff=0.6)
        hint = f"; did you mean `{near[0]}`?" if near else ""
        raise ArithmeticFault(f"`{name}` is neither a parameter nor a unit{hint}") from None


def evaluate(node: Node, time: float = math.nan) -> float:
    """The number that `node` stands for at `time` [s], in SI units. Names must be bound.

    Raises ArithmeticFault where there is none (division by zero, the root of a negative number, overflow).
    """
    try:
        value = _evaluate(node, time)
    except ZeroDivisionError:
        raise ArithmeticFault("division by zero") from None
    except OverflowError:
        raise ArithmeticFault("the number is too large") from None
    except ValueError as error:
        raise error if isinstance(error, ArithmeticFault) else ArithmeticFault("outside the domain of a function") from None
    return _finite(value)


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
            raise ArithmeticFault(f"`{text}` has no value")


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
        raise ArithmeticFault("a negative number raised to a fraction is not a real number")
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
