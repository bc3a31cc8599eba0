"""Formulas that blocks are computed with: expressions of symbols and numbers, put together here and not by users; linear functions of
signals and of the time need no compiler."""

from collections.abc import Sequence

from nivel.lazy import Struct
from nivel.machine.units.arithmetic import bind, evaluate
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import TIME, Negative, Node, Number, Operation, Signal, Time, signals, varies


class Formula(Struct):
    """A value that follows from symbols and the time. tree : without unbound names."""

    tree: Node

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the symbols, each once; `time` is none."""
        return signals(self.tree)


def formula(text: str, **names: str | float) -> Formula:
    """The formula of a text in which `names` stand for symbols (by their paths) and numbers."""
    meaning = {name: Signal(each) if isinstance(each, str) else Number(float(each)) for name, each in names.items()}
    return Formula(bind(parse(text), meaning))


def sum_of(terms: Sequence[Node]) -> Node:
    """The sum, by halves, so that many terms nest little."""
    half = len(terms) // 2
    return Operation("+", sum_of(terms[:half]), sum_of(terms[half:])) if half else terms[0]


class LinearFunction(Struct):
    """offset + Σ factor · signal, with signals by their paths or `time`."""

    terms: tuple[tuple[float, str], ...]
    offset: float = 0.0

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the signals, each once; `time` is none."""
        return tuple(dict.fromkeys(path for _, path in self.terms if path != TIME))

    def __str__(self) -> str:
        """As arithmetic that binds like a single name."""
        if self.offset == 0 and len(self.terms) == 1 and self.terms[0][0] == 1:
            return self.terms[0][1]
        parts = [times(factor, path) for factor, path in self.terms]
        return f"({' + '.join([*parts, repr(self.offset)] if self.offset else parts)})"


def times(factor: float, text: str) -> str:
    """The text of a multiple of what `text` is."""
    return text if factor == 1 else f"-{text}" if factor == -1 else f"{factor!r}*{text}"


def linear(*terms: tuple[float, str], offset: float = 0.0) -> LinearFunction:
    """offset + Σ factor · signal, without terms of factor zero."""
    return LinearFunction(tuple((float(factor), path) for factor, path in terms if factor != 0.0), offset)


def linear_function(node: Node) -> LinearFunction | None:
    """The linear function that an arithmetic tree is, or None. Names must be bound."""
    if not varies(node):
        return LinearFunction((), evaluate(node))
    match node:
        case Time():
            return LinearFunction(((1.0, TIME),))
        case Signal(path):
            return LinearFunction(((1.0, path),))
        case Negative(operand):
            return _scaled(linear_function(operand), -1.0)
        case Operation("+" | "-" as sign, left, right):
            return _sum(linear_function(left), _scaled(linear_function(right), 1.0 if sign == "+" else -1.0))
        case Operation("*", left, right) if not varies(left):
            return _scaled(linear_function(right), evaluate(left))
        case Operation("*", left, right) if not varies(right):
            return _scaled(linear_function(left), evaluate(right))
        case Operation("/", left, right) if not varies(right) and evaluate(right) != 0.0:
            return _scaled(linear_function(left), 1.0 / evaluate(right))
    return None


def _scaled(function: LinearFunction | None, factor: float) -> LinearFunction | None:
    if function is None:
        return None
    return LinearFunction(tuple((factor * each, path) for each, path in function.terms), factor * function.offset)


def _sum(first: LinearFunction | None, second: LinearFunction | None) -> LinearFunction | None:
    if first is None or second is None:
        return None
    return LinearFunction((*first.terms, *second.terms), first.offset + second.offset)
