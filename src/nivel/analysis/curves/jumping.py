"""Functions of a machine that jump where something of its motion passes a value."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.arithmetic import COMPARISONS, Call, Lookup, Negative, Node, Operation, signals
from nivel.machine.units.expression import Expression
from nivel.words.wording import shown

JUMPING: Final = ("sign", "floor", "mod", "if", "not")


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
        case Negative(operand):
            yield from _jumps(operand)
        case Operation(symbol, left, right):
            yield symbol in COMPARISONS and bool(signals(node))
            yield from _jumps(left)
            yield from _jumps(right)
        case Lookup(argument):
            yield from _jumps(argument)
        case Call(function, arguments):
            yield function in JUMPING and bool(signals(arguments[0]))
            for argument in arguments:
                yield from _jumps(argument)
