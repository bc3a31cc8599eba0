"""Functions of a machine that jump where something of its motion passes a value."""

from __future__ import annotations

from collections.abc import Collection

from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.expression import Expression
from nivel.machine.units.sides import jumps
from nivel.machine.units.tree import Node, signals
from nivel.words.wording import shown


def jumping_functions(machine: MachineRecord, among: Collection[Node] | None = None) -> tuple[str, ...]:
    """Names and texts of the functions that jump where something of the motion passes a value; those of samples jump anyway.

    among : these functions alone.
    """
    return tuple(
        f"{shown(each.function.text)} of {each.section}.{each.part}"
        for each in machine.functions
        if each.sampling is None
        and isinstance(each.function, Expression)
        and (among is None or each.function.tree in among)
        and jumps(each.function.tree, _reads_signals)
    )


def _reads_signals(node: Node) -> bool:
    return bool(signals(node))
