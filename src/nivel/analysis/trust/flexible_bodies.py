"""Flexible bodies of a machine, as the checks look at them: their modes, and where these stand in a result."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.machine.machine_record import MachineRecord
from nivel.system.flexible import Bending, bending_bodies

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ModalBody:
    """A body that bends: its modal coordinates are the columns first to last - 1 of a run. eigenvalues (n,) [1/s²]; position (N, 3) [m] and
    modes (N, 3, n) of its nodes; stiffened : whether it has geometric stiffness."""

    name: str
    first: int
    last: int
    eigenvalues: Array
    position: Array
    modes: Array
    stiffened: bool

    @property
    def extent(self) -> float:
        """The diagonal of the box around its nodes [m]."""
        return float(np.linalg.norm(np.ptp(self.position, axis=0)))

    @property
    def axis(self) -> Array:
        """(3,) the direction in which it is longest."""
        return np.linalg.svd(self.position - self.position.mean(axis=0), full_matrices=False)[2][0]


@dataclass(frozen=True)
class Bent:
    """What was found of a body, its largest value, and when [s]."""

    body: str
    value: float
    time: float


def modal_bodies(machine: MachineRecord) -> list[ModalBody]:
    """The flexible bodies of the machine; those that stand for beams bend by any amount."""
    return [body for _, body in numbered_bodies(machine)]


def numbered_bodies(machine: MachineRecord) -> Iterator[tuple[tuple[int, Bending], ModalBody]]:
    """Each flexible body that stands for no node of a beam, with its number among those that bend."""
    first = 0
    for f, each in enumerate(bending_bodies(machine) if machine.is_flexible else ()):
        its, last = each.reduced, first + len(each.reduced.eigenvalues)
        if not each.beam:
            name, modes = machine.bodies[each.body].name, np.nan_to_num(its.modes[:, :3])
            body = ModalBody(name, first, last, its.eigenvalues, its.position, modes, bool(its.stiffening))
            yield (f, each), body
        first = last
