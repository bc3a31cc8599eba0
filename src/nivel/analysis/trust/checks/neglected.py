"""Cost of inertia invariants that flexible bodies move without, by how far they bend in a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Run
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import blocks
from nivel.results.trust import Item, Threshold, number
from nivel.system.flexible import bending_bodies

if TYPE_CHECKING:
    from nivel.flexible.body.invariants import Invariants

Array = NDArray[np.float64]
THRESHOLD = Threshold(
    1e-3,
    1e-2,
    "Inertia of real bodies is rarely known to 1 %. Above this limit the neglected inertia invariants matter. 1e-3 is a decade below.",
)


@dataclass(frozen=True)
class Neglected:
    """A body whose modal coordinates are the columns first to last - 1 of a run, its invariants, and names of those it moves without."""

    body: str
    first: int
    last: int
    invariants: Invariants
    names: tuple[str, ...]

    def errors(self, q: Array) -> Array:
        """(frames,) what its mass matrix lacks, as a share, for modal coordinates q (frames, n).

        I8 and I9 are parts of the inertia, compared with that of the undeformed body; I5 couples turns and modes of unit mass, and is
        compared with the geometric mean of both.
        """
        its, inertia = self.invariants, float(np.abs(self.invariants.I7).max())
        parts = [np.zeros((len(q), 1))]
        if "I5" in self.names:
            parts.append(np.abs(np.einsum("tj,jak->tak", q, its.I5)).reshape(len(q), -1) / np.sqrt(inertia))
        if "I8" in self.names:
            both = its.I8 + its.I8.transpose(0, 2, 1)
            parts.append(np.abs(np.einsum("tj,jab->tab", q, both)).reshape(len(q), -1) / inertia)
        if "I9" in self.names:
            square = np.einsum("tj,tk,jkab->tab", q, q, its.I9, optimize=True)
            parts.append(np.abs(square).reshape(len(q), -1) / inertia)
        return np.concatenate(parts, axis=1).max(axis=1)


@dataclass(frozen=True)
class Cost:
    """The largest share of a mass matrix that was neglected, its body, the names of what was neglected there, and the time [s]."""

    share: float
    body: str
    names: tuple[str, ...]
    time: float


def look(run: Run) -> Cost | None:
    """The largest cost of a run; None where nothing is neglected."""
    result = run.result
    found: Cost | None = None
    for each in neglected(run.machine):
        for frames in blocks(result):
            errors = each.errors(result.array("modal_coordinate", frames)[:, each.first : each.last])
            if not len(errors):
                continue
            k = int(np.argmax(errors))
            if found is None or not errors[k] <= found.share:
                found = Cost(float(errors[k]), each.body, each.names, float(result.time[frames.start + k]))
    return found


def say(found: Cost) -> Item:
    """What a flexible body lacks that moves without some inertia invariants."""
    names = " and ".join(found.names)
    lacks = f"without {names} the mass matrix of {found.body} lacks at most {number(found.share)} for the deflections of this run"
    said = f"Neglected: {lacks}, at t = {found.time:.6g} s"
    return THRESHOLD.item("neglected", said, found.share, found.time, found.body)


def neglected(machine: MachineRecord) -> tuple[Neglected, ...]:
    """The flexible bodies that move without some inertia invariants."""
    out, first = [], 0
    for each in bending_bodies(machine) if machine.is_flexible else ():
        last = first + len(each.reduced.eigenvalues)
        if each.neglected:
            name = machine.bodies[each.body].name
            out.append(Neglected(name, first, last, each.reduced.invariants, each.neglected))
        first = last
    return tuple(out)


CHECKS = (Check("neglected", Run, look, say, 100, (), "Neglected", THRESHOLD),)
