"""Sides of expressions: pairs of parts whose order decides about a value, and marks, whose signs change where it has a corner or jumps."""

from collections.abc import Callable, Iterator

from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.units import tree
from nivel.machine.units.functions import FUNCTIONS, SMOOTH, inner_parts, is_truth

PI = 3.141592653589793


def sides(
    node: tree.Node, counts: Callable[..., bool], *, curves: bool
) -> Iterator[tuple[tree.Node, tree.Node | None]]:
    """Pairs of expressions whose order decides about a value within `node`, those of which `counts` says so. curves : with the points of
    curves."""
    for part in inner_parts(node):
        yield from sides(part, counts, curves=curves)
    match node:
        case tree.Operation(symbol, left, right) if symbol in tree.COMPARISONS and counts(left, right):
            yield left, right
        case tree.Lookup(argument, kind, points, _, _) if curves and counts(argument) and kind not in SMOOTH:
            yield from ((argument, tree.Number(point)) for point in points)
        case tree.Call(function, arguments):
            own = FUNCTIONS[function].sides
            pairs = own(counts, *arguments) if own is not None else ()
            yield from ((first, second) for first, second in pairs if second is not None or not is_truth(first))


def jumps(node: tree.Node, counts: Callable[[tree.Node], bool]) -> bool:
    """Whether an expression may jump where one of its parts passes a value: a condition, a comparison, a remainder, of those of which
    `counts` says so."""
    match node:
        case tree.Operation(symbol) if symbol in tree.COMPARISONS and counts(node):
            return True
        case tree.Call(function, (first, *_)) if FUNCTIONS[function].jumps and counts(first):
            return True
    return any(jumps(part, counts) for part in inner_parts(node))


def is_of_time_alone(node: tree.Node) -> bool:
    """Whether a value depends on time, and on nothing else."""
    return tree.varies(node) and not tree.signals(node)


def marks(function: Table | Expression) -> Iterator[tree.Node]:
    """Expressions that pass zero where the function has a corner or jumps; those of remainders have the sign of a sine."""
    if isinstance(function, Expression):
        for first, second in sides(function.tree, lambda *_: True, curves=True):
            yield first if second is None else tree.Operation("-", first, second)
        yield from _of_remainders(function.tree)
    else:
        of = tree.Time() if function.of == tree.TIME else tree.Signal(function.of)
        yield from (tree.Operation("-", of, tree.Number(float(point))) for point in function.times)


def _of_remainders(node: tree.Node) -> Iterator[tree.Node]:
    """Sines of the turns of `mod` and `floor`."""
    match node:
        case tree.Call("mod", (x, y)):
            yield tree.Call("sin", (tree.Operation("*", tree.Number(PI), tree.Operation("/", x, y)),))
        case tree.Call("floor", (x,)):
            yield tree.Call("sin", (tree.Operation("*", tree.Number(PI), x),))
    for part in inner_parts(node):
        yield from _of_remainders(part)
