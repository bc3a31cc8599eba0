"""Modes of flexible bodies in the Jacobian of the constraints, at the undeformed machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.machine.machine_record import MachineRecord
from nivel.system.flexible import Bending, bending_bodies
from nivel.system.states.floating import carried_markers
from nivel.system.system import Array, System


@dataclass(frozen=True)
class ModalRows:
    """Columns of C_q for the modes of `bending`; carried : flexible body and interface of every marker that is at one."""

    bending: Sequence[Bending]
    carried: Mapping[int, tuple[int, int]]

    @property
    def count(self) -> int:
        """How many modes there are."""
        return sum(len(each.reduced.eigenvalues) for each in self.bending)

    def columns(self, motion: MotionEquations) -> Array:
        """(rows, modes) C_p in the state last evaluated, for ṗ √m l: m the mass of the body, l the length of the machine.

        The node at an interface moves by A φ ṗ and turns by A ψ ṗ; a marker at u from it moves by (A ψ ṗ) × u more.
        """
        record, system = motion.system.record, motion.system
        first = np.cumsum([0, *(len(each.reduced.eigenvalues) for each in self.bending)])
        out = np.zeros((system.machine_rows, self.count))
        for row, part, marker, body in record.saddle.block[: int(record.saddle.blocks[0])].tolist():
            if marker not in self.carried or row >= system.machine_rows:
                continue
            f, k = self.carried[marker]
            reduced, A = self.bending[f].reduced, record.bodies.A[body]
            interface = reduced.interfaces[k]
            force, torque = record.constraints.J[part, :3], record.constraints.J[part, 3:]
            u = A @ (record.markers.position_b[marker] - interface.position)
            entries = (A.T @ force) @ interface.phi
            if interface.turns:
                entries = entries + (A.T @ (torque + np.cross(u, force))) @ interface.psi
            out[row, first[f] : first[f + 1]] += entries * np.sqrt(reduced.mass) * system.size
        return out


def modal_rows(machine: MachineRecord, system: System) -> ModalRows | None:
    """Of a machine in absolute coordinates; None where nothing bends. Raises ModelError where a marker is at no interface."""
    if not machine.is_flexible:
        return None
    bending = bending_bodies(machine)
    return ModalRows(bending, carried_markers(system, machine, bending))
