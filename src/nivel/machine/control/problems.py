"""Faults between the blocks of a control: algebraic loops, names that are taken."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Any

from nivel.machine.control.block import Block
from nivel.machine.control.order import PartOf, in_order, parts_of
from nivel.machine.core.checked import Problem
from nivel.machine.core.index import Index
from nivel.machine.laws.symbols import UnknownSymbolError, find_in, is_output, of_forces
from nivel.machine.units.arithmetic import RESERVED
from nivel.machine.units.unit import UNITS

CONDITIONS = ("when", "states")  # keys of what is made of comparisons


def can_be_named(name: str, parameters: Collection[str]) -> bool:
    """Whether the name of a block alone can stand for its value, beside these parameters."""
    return name not in parameters and name not in RESERVED and name not in UNITS


def problems_of_control(machine: Any) -> Iterator[Problem]:
    """Names that expressions would take for something else, symbols of conditions that are not there, and algebraic loops."""
    blocks: Sequence[Block] = machine.control
    if not blocks:
        return
    parts, index = parts_of(blocks), Index.of(machine)
    for at, block in enumerate(blocks):
        if block.name in RESERVED or block.name in UNITS:
            what = "is a unit" if block.name in UNITS else "has a meaning already"
            yield Problem(("control", at, "name"), f"`{block.name}` {what}; choose another name", at_key=True)
    for each in parts:
        for path in each.signals if each.part.key in CONDITIONS else ():
            place = ("control", blocks.index(each.block), each.part.key)
            try:
                symbol = find_in(path, index)
            except UnknownSymbolError as problem:
                yield Problem(place, str(problem))
                continue
            if not each.block.is_sampled and is_output(symbol, index):
                yield Problem(place, of_forces(path))
    _, loops = in_order(parts)
    for loop in loops:
        yield _algebraic_loop(loop, blocks)


def _algebraic_loop(loop: Sequence[PartOf], blocks: Sequence[Block]) -> Problem:
    """The fault of a loop, at the first block of it in the file."""
    names = [block.name for block in blocks if any(each.block is block for each in loop)]
    of_first = [each for each in loop if each.block.name == names[0]]
    first = next((each for each in of_first if each.part.key), of_first[0])
    at = blocks.index(first.block)
    place = ("control", at, first.part.key) if first.part.key else ("control", at)
    if len(names) == 1:
        told = f"`{names[0]}` depends on its own value at the same instant"
    else:
        told = f"{', '.join(f'`{name}`' for name in names)} depend on each other at the same instant"
    sampled = any(each.block.is_sampled for each in loop)
    remedy = "give one of them a `latency`, or put a `delay` between" if sampled else "put a lag between, a `low-pass`"
    return Problem(place, f"{told}: an algebraic loop; {remedy}")
