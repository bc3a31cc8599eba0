"""The compiled equations of motion of one machine, called from Python: for assembly, checks and tests; never in a time loop."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import NONE
from nivel.lazy import dataclass
from nivel.machine.core.vectors import cross
from nivel.machine.machine_record import MachineRecord
from nivel.system.build import build
from nivel.system.system import Array, Equations, System, parameter_rates


@dataclass(frozen=True)
class MotionEquations:
    """A system with its compiled `evaluate` and `normalise_state`; twin : its record on dual numbers, where implicit methods need one."""

    system: System
    kernels: Any
    twin: Handle | None = None

    @cached_property
    def handle(self) -> Handle:
        """Address of the record for the kernels."""
        return Handle(self.system.record)

    def evaluate(self, t: float, y: Array) -> tuple[int, Array]:
        """(status, ẏ); positions, constraints and their Jacobian in the record are those of y whatever the status."""
        rate = np.zeros_like(y)
        return self.kernels.evaluate(self.handle.address, t, y, rate), rate

    def holds(self, t: float, y: Array) -> bool:
        """Whether the accelerations at y can be computed."""
        return self.evaluate(t, y)[0] == OK

    def jacobian(self) -> NDArray[np.float64]:
        """C_q (R, 6 B) of joints, couplings and drivers in the state last evaluated, for (Ṙ, ω̄) of each body [-, m]."""
        system = self.system
        row, body, block = self.jacobian_blocks()
        out = np.zeros((system.machine_rows, system.body_count, 6))
        np.add.at(out, (row, body), block)
        return out.reshape(system.machine_rows, 6 * system.body_count)

    def jacobian_blocks(self, coordinates: Sequence[int] = ()) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
        """Row (n,), body (n,) and entries (n, 6) of the blocks of `jacobian`, to be added up; as further rows the derivatives of
        `coordinates`, which are measured in every evaluation."""
        record, system = self.system.record, self.system
        own = record.saddle.block[: int(record.saddle.blocks[0])]
        row, part, marker, body = own[own[:, 1] != NONE].astype(np.int64).T
        q = np.array(coordinates, dtype=np.int64)
        spans = [np.arange(*record.coordinates.start[k : k + 2].astype(np.int64)) for k in q]
        measured = np.concatenate([np.zeros(0, np.int64), *spans])
        ends = record.coordinates.part_marker[measured].astype(np.int64)
        of_ends = record.markers.body[ends].astype(np.int64)
        moving = of_ends < system.body_count
        further = np.repeat(system.machine_rows + np.arange(len(q)), [len(span) for span in spans])
        parts = np.vstack([record.constraints.J[part], record.coordinates.J[measured][moving]])
        body = np.append(body, of_ends[moving])
        return np.append(row, further[moving]), body, self._on_bodies(parts, np.append(marker, ends[moving]), body)

    def _on_bodies(self, parts: Array, marker: Any, body: Any) -> Array:
        """Parts (n, 6) of rows with respect to (ṙ, ω) of markers as parts with respect to (Ṙ, ω̄) of their bodies."""
        f, n, record = parts[:, :3], parts[:, 3:], self.system.record
        n_b = np.einsum("kji,kj->ki", record.bodies.A[body], n + cross(record.markers.u[marker], f))
        return np.hstack([f, n_b])


def equations(machine: MachineRecord, formulation: str = "newton-euler", *, measured: bool = False) -> MotionEquations:
    """Numbers and compiled equations of `machine` in absolute coordinates, as placed; compiles on first use.

    formulation : "newton-euler", six velocities a body, or "lagrange", seven and normalisation.
    measured : every evaluation measures all joint coordinates, not only those that something needs.
    """
    lagrange = formulation == "lagrange"
    system = build(machine, Equations(7 if lagrange else 6, normalisation=lagrange), measured=measured)
    motion = MotionEquations(
        system, import_module("nivel.motion.lagrange" if lagrange else "nivel.motion.newton_euler")
    )
    if system.as_placed.any():
        # a combination is constant at the value that it has as the machine is placed
        motion.evaluate(0.0, system.start)
        constraints = system.record.constraints
        rows = constraints.combination[system.as_placed, 0]
        constraints.offset[system.as_placed] = constraints.C[rows]
    return motion


def moved(q: Array, change: Array) -> Array:
    """Positions q (7 B,) after a small tangent change (6 B,): translation [m] and body-axis rotation vector [rad] a body."""
    q = q.reshape(-1, 7).copy()
    change = change.reshape(-1, 6)
    q[:, :3] += change[:, :3]
    q[:, 3:] += parameter_rates(q[:, 3:], change[:, 3:])
    q[:, 3:] /= np.linalg.norm(q[:, 3:], axis=1, keepdims=True)
    return q.ravel()


def change_between(before: Array, after: Array) -> Array:
    """Tangent change (B, 6) from positions `before` (7 B,) to `after`: translation [m], body-axis rotation vector [rad]."""
    p, q = before.reshape(-1, 7), after.reshape(-1, 7)
    # vector part of the turn between two unit quaternions: its length is sin(angle/2)
    e0, e, f0, f = p[:, 3:4], p[:, 4:], q[:, 3:4], q[:, 4:]
    half = e0 * f - f0 * e - cross(e, f)
    half = np.where(np.sum(p[:, 3:] * q[:, 3:], axis=1, keepdims=True) < 0.0, -half, half)
    sine = np.linalg.norm(half, axis=1, keepdims=True)
    angle = 2.0 * np.arcsin(np.clip(sine, 0.0, 1.0))
    turn = np.divide(half, sine, out=np.zeros_like(half), where=sine > 0.0) * angle
    return np.hstack([q[:, :3] - p[:, :3], turn])
