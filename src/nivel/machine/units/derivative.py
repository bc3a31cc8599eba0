"""Exact derivatives of expressions with respect to time or to a signal, by the rules of calculus.

    (u v)' = u' v + u v'        (u/v)' = u'/v - u v'/v²        (u^v)' = u^v (v' log u + v u'/u)        f(u)' = f'(u) u'

Factors 0 and 1 that the rules leave behind are dropped, so that derivatives stay short and defined where the
expression itself is: 3*time^2 becomes 6*time, without a division by time.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from nivel.lazy import dataclass
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.functions import FUNCTIONS, read
from nivel.machine.units.interpolation import SMOOTH
from nivel.machine.units.tree import (
    COMPARISONS,
    LOGICAL,
    Call,
    ExpressionError,
    Lookup,
    Negative,
    Node,
    Number,
    Operation,
    Signal,
    Time,
    leaves,
    names,
    signals,
    varies,
)

_MOST_LEAVES: Final = 4000  # second derivatives of long products grow with the cube of their length
_ZERO, _ONE, _TWO = Number(0.0), Number(1.0), Number(2.0)


def derivative(node: Node, path: str | None = None) -> Node:
    """The derivative of `node` with respect to time, or to the signal `path` while all others stay. Names must be bound.

    Raises ExpressionError for functions with corners, where the derivative would be too long, and for what may not vary: signals where it
    is by time, time where it is by a signal.
    """
    if names(node):
        raise ExpressionError(f"`{min(names(node))}` has no value")
    result = _Derivative(path).of(node)
    if sum(1 for _ in leaves(result)) > _MOST_LEAVES:
        raise ExpressionError("the expression is too long to be differentiated; shorten it or use a table")
    return result


@dataclass(frozen=True)
class _Derivative:
    """The rules with respect to time (None) or to a signal."""

    path: str | None

    @property
    def _what(self) -> str:
        """What the expression moves."""
        return "a driver" if self.path is None else "a coupling"

    def of(self, node: Node) -> Node:
        if not varies(node):
            return _ZERO
        match node:
            case Time():
                if self.path is not None:
                    raise ExpressionError(
                        "a coupling depends on joint coordinates alone; what follows `time` is the `value` of a driver"
                    )
                return _ONE
            case Signal(path):
                if self.path is None:
                    raise ExpressionError(
                        f"`{path}` is only known while the machine moves; a driver depends on `time` alone"
                    )
                return _ONE if path == self.path else _ZERO
            case Negative(operand):
                return minus(self.of(operand))
            case Operation(symbol, left, right):
                return self._of_operation(symbol, left, right)
            case Lookup(argument, kind, points, values, order):
                if kind not in SMOOTH:
                    raise ExpressionError(
                        f"a {kind} curve has corners, at its ends at least; {self._what} must be smooth: take quintic, or periodic"
                    )
                return times(Lookup(argument, kind, points, values, order + 1), self.of(argument))
            case Call(function, arguments):
                return self._of_call(function, arguments)
        raise AssertionError(node)

    def _of_operation(self, symbol: str, u: Node, v: Node) -> Node:
        if symbol in (*COMPARISONS, *LOGICAL):
            raise ExpressionError(f"`{symbol}` has corners; {self._what} must be smooth")
        match symbol:
            case "+":
                return plus(self.of(u), self.of(v))
            case "-":
                return minus(self.of(u), self.of(v))
            case "*":
                return plus(times(self.of(u), v), times(u, self.of(v)))
            case "/" if not varies(v):
                return over(self.of(u), v)
            case "/" if not varies(u) and isinstance(v, Time):
                return minus(_ZERO, over(times(u, self.of(v)), to_the(v, _TWO)))
            case "/":
                # no square of v, which would leave the range of numbers where v is near its end
                return minus(over(self.of(u), v), times(over(u, v), over(self.of(v), v)))
        if not varies(v):
            n = evaluate(v)
            return times(times(Number(n), to_the(u, Number(n - 1))), self.of(u))
        growth = times(self.of(v), Call("log", (u,)))
        return times(to_the(u, v), plus(growth, over(times(v, self.of(u)), u)))

    def _of_call(self, function: str, arguments: tuple[Node, ...]) -> Node:
        kind = FUNCTIONS[function]
        if not kind.derivative and not kind.is_form_alone:
            smooth = f"; `{kind.smooth}` is smooth" if kind.smooth else ""
            raise ExpressionError(f"`{function}` has corners; {self._what} must be smooth{smooth}")
        if not kind.derivative:
            return self.of(kind.written(kind.form, arguments))
        given = dict(zip(kind.names, arguments, strict=True))
        rates = {f"d{name}" for name in given}
        rule = read(kind.derivative, (*kind.names, *sorted(rates)))
        used = rates & set(signals(rule))
        if any(varies(each) for name, each in given.items() if f"d{name}" not in used):
            raise ExpressionError(f"the levels of `{function}` vary; {self._what} needs constant ones")
        return _with(rule, given | {f"d{name}": self.of(each) for name, each in given.items() if f"d{name}" in used})


def _with(rule: Node, given: Mapping[str, Node]) -> Node:
    """A rule with arguments and rates in it, without the factors 0 and 1 that come of them."""
    match rule:
        case Signal(path):
            return given[path]
        case Negative(operand):
            return minus(_with(operand, given))
        case Operation(symbol, left, right):
            return _RULES[symbol](_with(left, given), _with(right, given))
        case Call(function, arguments):
            return Call(function, tuple(_with(each, given) for each in arguments))
    return rule


def plus(u: Node, v: Node) -> Node:
    """u + v."""
    if _is(u, 0):
        return v
    return u if _is(v, 0) else _operation("+", u, v)


def minus(u: Node, v: Node | None = None) -> Node:
    """u - v, or -u."""
    if v is not None:
        if _is(u, 0):
            return minus(v)
        return u if _is(v, 0) else _operation("-", u, v)
    match u:
        case Negative(operand):
            return operand
        case Number(value, its):
            return Number(-value if value else 0.0, its)
    return Negative(u)


def times(u: Node, v: Node) -> Node:
    """u v; factors of -1 become signs."""
    if _is(u, 0) or _is(v, 0):
        return _ZERO
    if isinstance(u, Negative):
        return minus(times(u.operand, v))
    if isinstance(v, Negative):
        return minus(times(u, v.operand))
    if _is(u, 1):
        return v
    return u if _is(v, 1) else _operation("*", u, v)


def over(u: Node, v: Node) -> Node:
    """u / v."""
    if _is(u, 0):
        return _ZERO
    return u if _is(v, 1) else _operation("/", u, v)


def to_the(u: Node, v: Node) -> Node:
    """u ** v."""
    if _is(v, 0):
        return _ONE
    return u if _is(v, 1) else _operation("**", u, v)


_RULES: Final = {"+": plus, "-": minus, "*": times, "/": over, "**": to_the}


def _is(node: Node, value: float) -> bool:
    return isinstance(node, Number) and node.value == value


def _operation(symbol: str, u: Node, v: Node) -> Node:
    """The operation, or its value if that is a number of its own."""
    operation = Operation(symbol, u, v)
    if isinstance(u, Number) and isinstance(v, Number):
        try:
            return Number(evaluate(operation))
        except ExpressionError:
            return operation
    return operation
