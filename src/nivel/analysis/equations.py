"""The compiled equations of motion of one machine, called from Python: for assembly, checks and tests; never in a time loop."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.handle import Handle
from nivel.kernels.status import OK
from nivel.machine.machine_record import MachineRecord
from nivel.motion.catalogue import FORMULATIONS
from nivel.system.build import build
from nivel.system.system import Array, Equations, System, parameter_rates


@dataclass(frozen=True)
class MotionEquations:
    """A system with its compiled `evaluate` and `keep`."""

    system: System
    kernels: Any

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
        """C_q of the joint rows (R, 6 B) for the state last evaluated, with respect to (Ṙ, ω̄) of each body [-, m]."""
        record, system = self.system.record, self.system
        block = record.saddle.block[record.saddle.block[:, 1] < 2].astype(int)
        row, side, marker, body = block.T
        rows = record.constraints.J.reshape(-1, 2, 6)[row, side]
        f, n = rows[:, :3], rows[:, 3:]
        n_b = np.einsum("kji,kj->ki", record.bodies.A[body], n + np.cross(record.markers.u[marker], f))
        out = np.zeros((system.joint_rows, system.body_count, 6))
        np.add.at(out, (row, body), np.hstack([f, n_b]))
        return out.reshape(system.joint_rows, 6 * system.body_count)


def equations(machine: MachineRecord, formulation: str) -> MotionEquations:
    """Numbers and compiled equations of `machine` in absolute coordinates; compiles on first use."""
    facts = FORMULATIONS[formulation]
    system = build(machine, Equations(facts.velocities, facts.normalisation))
    return MotionEquations(system, import_module(facts.module))


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
    half = e0 * f - f0 * e - np.cross(e, f)
    half = np.where(np.sum(p[:, 3:] * q[:, 3:], axis=1, keepdims=True) < 0.0, -half, half)
    sine = np.linalg.norm(half, axis=1, keepdims=True)
    angle = 2.0 * np.arcsin(np.clip(sine, 0.0, 1.0))
    turn = np.divide(half, sine, out=np.zeros_like(half), where=sine > 0.0) * angle
    return np.hstack([q[:, :3] - p[:, :3], turn])
