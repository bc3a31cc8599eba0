"""Exact derivatives of expressions with respect to time or to a signal, by the rules of calculus.

    (u v)' = u' v + u v'        (u/v)' = u'/v - u v'/v²        (u^v)' = u^v (v' log u + v u'/u)        f(u)' = f'(u) u'

Factors 0 and 1 that the rules leave behind are dropped, so that derivatives stay short and defined where the
expression itself is: 3*time^2 becomes 6*time, without a division by time.
"""

from collections.abc import Mapping
from typing import Final

from nivel.lazy import Struct
from nivel.machine.units import tree
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.functions import FUNCTIONS, SMOOTH, read

_MOST_LEAVES: Final = 4000  # second derivatives of long products grow with the cube of their length
_ZERO, _ONE, _TWO = tree.Number(0.0), tree.Number(1.0), tree.Number(2.0)


def derivative(node: tree.Node, path: str | None = None) -> tree.Node:
    """The derivative of `node` with respect to time, or to the signal `path` while all others stay. Names must be bound.

    Raises ExpressionError for functions with corners, where the derivative would be too long, and for what may not vary: signals where it
    is by time, time where it is by a signal.
    """
    if tree.names(node):
        raise tree.ExpressionError(f"`{min(tree.names(node))}` has no value")
    result = _Derivative(path).of(node)
    if sum(1 for _ in tree.leaves(result)) > _MOST_LEAVES:
        raise tree.ExpressionError("the expression is too long to be differentiated; shorten it or use a table")
    return result


class _Derivative(Struct):
    """The rules with respect to time (None) or to a signal."""

    path: str | None

    @property
    def _what(self) -> str:
        """What the expression moves."""
        return "a driver" if self.path is None else "a coupling"

    def of(self, node: tree.Node) -> tree.Node:
        if not tree.varies(node):
            return _ZERO
        match node:
            case tree.Time():
                if self.path is not None:
                    raise tree.ExpressionError(
                        "a coupling depends on joint coordinates alone; what follows `time` is the `value` of a driver"
                    )
                return _ONE
            case tree.Signal(path):
                if self.path is None:
                    raise tree.ExpressionError(
                        f"`{path}` is only known while the machine moves; a driver depends on `time` alone"
                    )
                return _ONE if path == self.path else _ZERO
            case tree.Negative(operand):
                return minus(self.of(operand))
            case tree.Operation(symbol, left, right):
                return self._of_operation(symbol, left, right)
            case tree.Lookup(argument, kind, points, values, order):
                if kind not in SMOOTH:
                    raise tree.ExpressionError(
                        f"a {kind} curve has corners, at its ends at least; {self._what} must be smooth: take quintic, or periodic"
                    )
                return times(tree.Lookup(argument, kind, points, values, order + 1), self.of(argument))
            case tree.Call(function, arguments):
                return self._of_call(function, arguments)
        raise AssertionError(node)

    def _of_operation(self, symbol: str, u: tree.Node, v: tree.Node) -> tree.Node:
        if symbol in (*tree.COMPARISONS, *tree.LOGICAL):
            raise tree.ExpressionError(f"`{symbol}` has corners; {self._what} must be smooth")
        match symbol:
            case "+":
                return plus(self.of(u), self.of(v))
            case "-":
                return minus(self.of(u), self.of(v))
            case "*":
                return plus(times(self.of(u), v), times(u, self.of(v)))
            case "/" if not tree.varies(v):
                return over(self.of(u), v)
            case "/" if not tree.varies(u) and isinstance(v, tree.Time):
                return minus(_ZERO, over(times(u, self.of(v)), to_the(v, _TWO)))
            case "/":
                # no square of v, which would leave the range of numbers where v is near its end
                return minus(over(self.of(u), v), times(over(u, v), over(self.of(v), v)))
        if not tree.varies(v):
            n = evaluate(v)
            return times(times(tree.Number(n), to_the(u, tree.Number(n - 1))), self.of(u))
        growth = times(self.of(v), tree.Call("log", (u,)))
        return times(to_the(u, v), plus(growth, over(times(v, self.of(u)), u)))

    def _of_call(self, function: str, arguments: tuple[tree.Node, ...]) -> tree.Node:
        kind = FUNCTIONS[function]
        if not kind.derivative and not kind.is_form_alone:
            smooth = f"; `{kind.smooth}` is smooth" if kind.smooth else ""
            raise tree.ExpressionError(f"`{function}` has corners; {self._what} must be smooth{smooth}")
        if not kind.derivative:
            return self.of(kind.written(kind.form, arguments))
        given = dict(zip(kind.names, arguments, strict=True))
        rates = {f"d{name}" for name in given}
        rule = read(kind.derivative, (*kind.names, *sorted(rates)))
        used = rates & set(tree.signals(rule))
        if any(tree.varies(each) for name, each in given.items() if f"d{name}" not in used):
            raise tree.ExpressionError(f"the levels of `{function}` vary; {self._what} needs constant ones")
        return _with(rule, given | {f"d{name}": self.of(each) for name, each in given.items() if f"d{name}" in used})


def _with(rule: tree.Node, given: Mapping[str, tree.Node]) -> tree.Node:
    """A rule with arguments and rates in it, without the factors 0 and 1 that come of them."""
    match rule:
        case tree.Signal(path):
            return given[path]
        case tree.Negative(operand):
            return minus(_with(operand, given))
        case tree.Operation(symbol, left, right):
            return _RULES[symbol](_with(left, given), _with(right, given))
        case tree.Call(function, arguments):
            return tree.Call(function, tuple(_with(each, given) for each in arguments))
    return rule


def plus(u: tree.Node, v: tree.Node) -> tree.Node:
    """u + v."""
    if _is(u, 0):
        return v
    return u if _is(v, 0) else _operation("+", u, v)


def minus(u: tree.Node, v: tree.Node | None = None) -> tree.Node:
    """u - v, or -u."""
    if v is not None:
        if _is(u, 0):
            return minus(v)
        return u if _is(v, 0) else _operation("-", u, v)
    match u:
        case tree.Negative(operand):
            return operand
        case tree.Number(value, its):
            return tree.Number(-value if value else 0.0, its)
    return tree.Negative(u)


def times(u: tree.Node, v: tree.Node) -> tree.Node:
    """u v; factors of -1 become signs."""
    if _is(u, 0) or _is(v, 0):
        return _ZERO
    if isinstance(u, tree.Negative):
        return minus(times(u.operand, v))
    if isinstance(v, tree.Negative):
        return minus(times(u, v.operand))
    if _is(u, 1):
        return v
    return u if _is(v, 1) else _operation("*", u, v)


def over(u: tree.Node, v: tree.Node) -> tree.Node:
    """u / v."""
    if _is(u, 0):
        return _ZERO
    return u if _is(v, 1) else _operation("/", u, v)


def to_the(u: tree.Node, v: tree.Node) -> tree.Node:
    """u ** v."""
    if _is(v, 0):
        return _ONE
    return u if _is(v, 1) else _operation("**", u, v)


_RULES: Final = {"+": plus, "-": minus, "*": times, "/": over, "**": to_the}


def _is(node: tree.Node, value: float) -> bool:
    return isinstance(node, tree.Number) and node.value == value


def _operation(symbol: str, u: tree.Node, v: tree.Node) -> tree.Node:
    """The operation, or its value if that is a number of its own."""
    operation = tree.Operation(symbol, u, v)
    if isinstance(u, tree.Number) and isinstance(v, tree.Number):
        try:
            return tree.Number(evaluate(operation))
        except tree.ExpressionError:
            return operation
    return operation
