"""The order in which parts are computed, and faults between blocks: algebraic loops, names that are taken."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

from nivel.lazy import Struct
from nivel.machine.control.block import Block
from nivel.machine.control.part import Part, PartFunction, signals_read
from nivel.machine.core.index import Index
from nivel.machine.core.record import Problem
from nivel.machine.laws.symbols import UnknownSymbolError, find_in, is_output, of_forces
from nivel.machine.units.arithmetic import RESERVED
from nivel.machine.units.unit import UNITS


class PartOf(Struct):
    """A part of a block."""

    block: Block
    part: Part

    @property
    def path(self) -> str:
        """Its symbol."""
        return self.block.path(self.part.name)

    @property
    def is_instantaneous(self) -> bool:
        """Whether it is computed from what others are at the same instant: always, or when it begins."""
        return self.part.role in ("signal", "sample") or self.part.begins is not None

    @property
    def present(self) -> PartFunction:
        """What it is computed with then."""
        return self.part.function if self.part.begins is None else self.part.begins

    @property
    def signals(self) -> tuple[str, ...]:
        """Paths that its function reads."""
        return signals_read(self.part.function)

    @property
    def feedthrough(self) -> tuple[str, ...]:
        """Paths that it reads at the instant at which it is computed; a sample that reads itself reads its value before, and one that comes
        later than its block's reads what was computed then."""
        if self.part.offset:
            return ()
        paths = signals_read(self.present)
        return paths if self.part.role == "signal" else tuple(path for path in paths if path != self.path)


def parts_of(blocks: Sequence[Block]) -> list[PartOf]:
    """The parts of all blocks."""
    return [PartOf(block, part) for block in blocks for part in block.parts]


def in_order(parts: Sequence[PartOf]) -> tuple[list[PartOf], list[list[PartOf]]]:
    """What is computed at an instant, each after all that it reads there, and the algebraic loops among it.

    What stands in a loop is ordered somehow. Tarjan's strongly connected components (1972) of the graph of direct feedthrough.
    """
    nodes = {each.path: each for each in parts if each.is_instantaneous}
    reads = {path: [other for other in each.feedthrough if other in nodes] for path, each in nodes.items()}
    order, loops = [], []
    for component in _components(reads):
        order += [nodes[path] for path in component]
        if len(component) > 1 or component[0] in reads[component[0]]:
            loops.append([nodes[path] for path in component])
    return order, loops


def _components(reads: Mapping[str, Sequence[str]]) -> Iterator[list[str]]:
    """Strongly connected components, each after those that it reads."""
    number: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    for root in reads:
        if root in number:
            continue
        work: list[tuple[str, Iterator[str]]] = [(root, iter(reads[root]))]
        number[root] = low[root] = len(number)
        stack.append(root)
        while work:
            path, left = work[-1]
            for other in left:
                if other not in number:
                    number[other] = low[other] = len(number)
                    stack.append(other)
                    work.append((other, iter(reads[other])))
                    break
                if other in stack:
                    low[path] = min(low[path], number[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[path])
                if low[path] == number[path]:
                    at = stack.index(path)
                    component, stack[at:] = stack[at:], []
                    yield component


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
