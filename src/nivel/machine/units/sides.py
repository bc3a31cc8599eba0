"""Sides of expressions: pairs of parts whose order decides about a value, and marks, whose signs change where it has a corner or jumps."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from nivel.machine.laws.table import Table
from nivel.machine.units.expression import Expression
from nivel.machine.units.functions import FUNCTIONS, inner_parts, is_truth
from nivel.machine.units.interpolation import SMOOTH
from nivel.machine.units.tree import (
    COMPARISONS,
    TIME,
    Call,
    Lookup,
    Node,
    Number,
    Operation,
    Signal,
    Time,
    signals,
    varies,
)

PI = 3.141592653589793


def sides(node: Node, counts: Callable[..., bool], *, curves: bool) -> Iterator[tuple[Node, Node | None]]:
    """Pairs of expressions whose order decides about a value within `node`, those of which `counts` says so. curves : with the points of
    curves."""
    for part in inner_parts(node):
        yield from sides(part, counts, curves=curves)
    match node:
        case Operation(symbol, left, right) if symbol in COMPARISONS and counts(left, right):
            yield left, right
        case Lookup(argument, kind, points, _, _) if curves and counts(argument) and kind not in SMOOTH:
            yield from ((argument, Number(point)) for point in points)
        case Call(function, arguments):
            own = FUNCTIONS[function].sides
            pairs = own(counts, *arguments) if own is not None else ()
            yield from ((first, second) for first, second in pairs if second is not None or not is_truth(first))


def jumps(node: Node, counts: Callable[[Node], bool]) -> bool:
    """Whether an expression may jump where one of its parts passes a value: a condition, a comparison, a remainder, of those of which
    `counts` says so."""
    match node:
        case Operation(symbol) if symbol in COMPARISONS and counts(node):
            return True
        case Call(function, (first, *_)) if FUNCTIONS[function].jumps and counts(first):
            return True
    return any(jumps(part, counts) for part in inner_parts(node))


def is_of_time_alone(node: Node) -> bool:
    """Whether a value depends on time, and on nothing else."""
    return varies(node) and not signals(node)


def marks(function: Table | Expression) -> Iterator[Node]:
    """Expressions that pass zero where the function has a corner or jumps; those of remainders have the sign of a sine."""
    if isinstance(function, Expression):
        for first, second in sides(function.tree, lambda *_: True, curves=True):
            yield first if second is None else Operation("-", first, second)
        yield from _of_remainders(function.tree)
    else:
        of = Time() if function.of == TIME else Signal(function.of)
        yield from (Operation("-", of, Number(float(point))) for point in function.times)


def _of_remainders(node: Node) -> Iterator[Node]:
    """Sines of the turns of `mod` and `floor`."""
    match node:
        case Call("mod", (x, y)):
            yield Call("sin", (Operation("*", Number(PI), Operation("/", x, y)),))
        case Call("floor", (x,)):
            yield Call("sin", (Operation("*", Number(PI), x),))
    for part in inner_parts(node):
        yield from _of_remainders(part)
