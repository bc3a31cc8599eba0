"""Deciding parameters: those of a file whose size decides between pieces of an expression, as p of `max(p, 30)` or `if(p > 2, a, b)`.

Numbers follow such a parameter by several formulas, of which a few values of it may show one (`nivel.analysis.preparation.parameters`).
What decides while the machine runs, as `if(time > p, a, b)`, is none of these.
"""

from collections.abc import Iterator
from typing import Any

from nivel.files.outline import section_of
from nivel.files.tree import Tree
from nivel.machine.units.functions import FUNCTIONS
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import COMPARISONS, Call, ExpressionError, Node, Operation, names, parts, varies


def deciding(tree: Tree) -> frozenset[str]:
    """Names of parameters that decide in the expressions of a file, or may do so in the parts that it gives them to."""
    given = section_of(tree, "parameters")
    found = {name for node in _trees(tree.data) for name in _decided(node)}
    found |= {name for node in _trees(section_of(tree, "assemblies")) for name in names(node)}
    while (
        more := {name for each in found & given.keys() for node in _trees(given[each]) for name in names(node)} - found
    ):
        found |= more
    return frozenset(found & given.keys())


def _trees(data: Any) -> Iterator[Node]:
    """Of all texts that are expressions."""
    if isinstance(data, dict | list):
        for each in data.values() if isinstance(data, dict) else data:
            yield from _trees(each)
    elif isinstance(data, str):
        try:
            yield parse(data)
        except ExpressionError:
            return


def _decided(node: Node) -> Iterator[str]:
    """Names in the parts of an expression that decide before the machine runs. Functions of the file, and curves, decide by all that they
    are given."""
    for part in parts(node):
        yield from _decided(part)
    match node:
        case Operation(symbol) if symbol in COMPARISONS and not varies(node):
            yield from names(node)
        case Call(function, arguments):
            kind = FUNCTIONS.get(function)
            if kind is None:
                for part in arguments:
                    yield from () if varies(part) else names(part)
            elif kind.sides is not None:
                for pair in kind.sides(lambda *each: not any(map(varies, each)), *arguments):
                    yield from (name for each in pair if each is not None for name in names(each))
            elif kind.jumps and not any(map(varies, arguments)):
                yield from names(node)
