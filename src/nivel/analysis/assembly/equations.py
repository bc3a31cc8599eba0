"""The compiled equations of motion of one machine, called from Python: for assembly, checks and tests; never in a time loop."""

from collections.abc import Sequence
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct
from nivel.machine.core.vectors import cross
from nivel.machine.machine_record import MachineRecord
from nivel.system.build import build
from nivel.system.system import Array, Equations, System, parameter_rates


class MotionEquations(Struct):
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

    def jacobian_in_lengths(self) -> Array:
        """The same with lengths in units of the machine's length."""
        J = self.jacobian().reshape(self.system.machine_rows, self.system.body_count, 6)
        J[:, :, :3] *= self.system.size
        return J.reshape(len(J), 6 * self.system.body_count)

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
    return np.hstack([q[:, :3] - p[:, :3], rotation_between(p[:, 3:], q[:, 3:])])


def rotation_between(p: Array, q: Array) -> Array:
    """Rotation vectors (…, 3) [rad] in the axes of p that lead from Euler parameters p to q, both (…, 4)."""
    p, q = (each / np.linalg.norm(each, axis=-1, keepdims=True) for each in (p, q))
    # vector part of the turn between two unit quaternions: its length is sin(angle/2)
    half = p[..., :1] * q[..., 1:] - q[..., :1] * p[..., 1:] - cross(p[..., 1:], q[..., 1:])
    cosine = np.sum(p * q, axis=-1, keepdims=True)
    half = np.where(cosine < 0.0, -half, half)
    sine = np.linalg.norm(half, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, np.abs(cosine))
    return np.divide(half, sine, out=np.zeros_like(half), where=sine > 0.0) * angle


def turned(theta: Array, psi: Array) -> Array:
    """Euler parameters (·, 4) of A(θ) exp(ψ̃), of unit length, for rows θ and rotation vectors ψ (·, 3) in the turned axes."""
    half = 0.5 * np.linalg.norm(psi, axis=1, keepdims=True)
    e = 0.5 * np.sinc(half / np.pi) * psi
    f0, e0, v = np.cos(half), theta[:, :1], theta[:, 1:]
    out = np.hstack([e0 * f0 - np.sum(v * e, axis=1, keepdims=True), e0 * e + f0 * v + cross(v, e)])
    return out / np.linalg.norm(out, axis=1, keepdims=True)


class Unknowns:
    """The unknowns of the residual of `motion`.

    n : velocities, after the `positions` of y; rows : multipliers; state_count : states, from `first_state` of y on. place (n, 2) :
    position that each velocity moves, and the axis of a turn. length (n,) : what positions are measured by. free : unknowns that mean
    something (points do not turn).
    """

    def __init__(self, motion: MotionEquations) -> None:
        self.motion, self.system, self.record = motion, motion.system, motion.system.record
        residual = self.record.residual
        self.n, self.rows, self.state_count = len(residual.vdot), len(residual.lam), len(self.system.states)
        self.positions = self.system.positions
        self.first_state = self.positions + self.n
        self.place = self.record.newton.place.astype(np.int64)
        units = np.array(self.system.map.units)[self.place[:, 0]]
        self.length = np.where(units == "m", self.system.size, 1.0)
        self.length[units == "kg^0.5 m"] = self.system.modal_sizes()
        self.free = np.flatnonzero(~self._idle())

    def _idle(self) -> NDArray[np.bool_]:
        """Unknowns that mean nothing: turns of point masses."""
        body, count = np.full(self.n, -1), self.system.body_count
        nodes = self.record.tree.node
        if len(nodes):
            for node in nodes.tolist():
                # frames at interfaces are no points
                body[node[4] : node[5]] = node[0] if node[0] < count else -1
        else:
            body[: 6 * count] = np.repeat(np.arange(count), 6)
        return np.append(self.system.point_masses, False)[body] & (self.place[:, 1] != NONE)

    def displaced(self, y: Array, psi: Array) -> Array:
        """The state q ∘ exp ψ, with the rest of y as it is."""
        y = y.copy()
        plain = self.place[:, 1] == NONE
        y[self.place[plain, 0]] += psi[plain]
        first = np.flatnonzero(self.place[:, 1] == 0)
        if len(first):
            at = self.place[first, 0][:, None] + np.arange(4)
            y[at] = turned(y[at], psi[first[:, None] + np.arange(3)])
        return y

    def position_rates(self, y: Array, psi: Array) -> Array:
        """(positions,) change of q for tangent increments psi (n,)."""
        out = np.zeros(self.positions)
        plain = self.place[:, 1] == NONE
        out[self.place[plain, 0]] = psi[plain]
        first = np.flatnonzero(self.place[:, 1] == 0)
        if len(first):
            at = self.place[first, 0][:, None] + np.arange(4)
            out[at] = parameter_rates(y[at], psi[first[:, None] + np.arange(3)])
        return out
