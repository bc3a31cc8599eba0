"""Functions of a machine that jump where something of its motion passes a value."""

from __future__ import annotations

from collections.abc import Iterator

from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.expression import Expression
from nivel.machine.units.functions import FUNCTIONS, inner_parts
from nivel.machine.units.tree import COMPARISONS, Call, Node, Operation, signals
from nivel.words.wording import shown


def jumping_functions(machine: MachineRecord) -> tuple[str, ...]:
    """Names and texts of the functions that jump where something of the motion passes a value; those of samples jump anyway."""
    return tuple(
        f"{shown(each.function.text)} of {each.section}.{each.part}"
        for each in machine.functions
        if each.sampling is None and isinstance(each.function, Expression) and any(_jumps(each.function.tree))
    )


def _jumps(node: Node) -> Iterator[bool]:
    """Of each part of an expression whether it jumps with a signal."""
    match node:
        case Operation(symbol):
            yield symbol in COMPARISONS and bool(signals(node))
        case Call(function, (first, *_)):
            yield FUNCTIONS[function].jumps and bool(signals(first))
    for part in inner_parts(node):
        yield from _jumps(part)
