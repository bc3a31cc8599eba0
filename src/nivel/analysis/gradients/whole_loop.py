"""The loop of a run on dual numbers: records of the machine and of the run of which all numbers are dual, and the same code for these."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.run.dynamics import Loop
from nivel.integrate.loop.loop import advance
from nivel.kernels.core.arrays import whole_twin
from nivel.kernels.core.block import Handle
from nivel.kernels.record.hook import FAMILIES
from nivel.kernels.record.record import Record
from nivel.native.entry import Entry
from nivel.system.laws.laws import dual_address


def whole_entries(loop: Loop) -> list[Entry]:
    """The machine code that the loop needs on dual numbers, but for laws and expressions."""
    record: Record = loop.machine.record
    used = [*record.hooks.address, *record.elements.address]
    families = [FAMILIES[int(address)].whole for address in dict.fromkeys(used) if address]
    return [loop.evaluate.whole, loop.correct.whole, loop.step.whole, advance.whole, *families]


class WholeLoop:
    """The loop of a run on dual numbers. machine, run : its records, without slopes yet."""

    def __init__(self, loop: Loop) -> None:
        machine: Record = loop.machine.record
        twin = whole_twin(machine)
        laws = [dual_address(int(each)) if each else 0 for each in machine.functions.address]
        self.machine: Record = twin._replace(
            hooks=twin.hooks._replace(address=_wholly(machine.hooks.address)),
            elements=twin.elements._replace(address=_wholly(machine.elements.address)),
            functions=twin.functions._replace(address=np.array(laws, dtype=np.uint64)),
            # what the twin by which Newton's matrix is found shares: elements that hold sliders, whether contacts keep their side
            tree=twin.tree._replace(element=machine.tree.element),
            watched=twin.watched._replace(followed=machine.watched.followed),
        )
        self.run: Any = whole_twin(loop.history.record)
        self._handles = Handle(self.machine), Handle(self.run)
        codes = loop.evaluate.whole, loop.correct.whole, loop.step.whole
        self._addresses = *(code.address for code in codes), *(int(each.address) for each in self._handles)

    def advance(self) -> int:
        """Go on for the budget of steps in the counter of the run. Returns a status."""
        return advance.whole(*self._addresses)


def _wholly(addresses: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Addresses of the same families for records of which all numbers are dual."""
    return np.array([FAMILIES[int(each)].whole.address if each else 0 for each in addresses], dtype=np.uint64)


def leaves(record: Any, path: str = "") -> Iterator[tuple[str, NDArray[Any]]]:
    """The arrays of a record with their names, in its order."""
    for name, value in zip(record._fields, record, strict=True):
        own = f"{path}.{name}" if path else name
        if isinstance(value, tuple):
            yield from leaves(value, own)
        else:
            yield own, value
