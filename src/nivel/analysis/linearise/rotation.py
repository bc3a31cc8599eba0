"""Steady rotation of a machine: an equilibrium relative to axes that turn with a constant Ω about a fixed line.

All bodies move as one, Ṙ = Ω × (R - c), ω̄ = Aᵀ Ω, with R̈ = Ω × (Ω × (R - c)) and constant ω̄; joints that the ground does not hold rest,
and so do modes. With these velocities and accelerations as functions of the positions, Newton's method solves

    r(q, v(q), v̇(q), λ) = 0        C(q) = 0

so that flexible bodies and beams are strained by the centrifugal forces, and hinged blades stand at their coning angle.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.linalg import lstsq

from nivel.analysis.assembly.equations import turned
from nivel.analysis.assembly.instant import Instant
from nivel.analysis.assembly.unknown_groups import unknown_name
from nivel.analysis.run.prepared_state import Moment
from nivel.errors import Fault, ModelError, SolveError
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import cross
from nivel.system.system import Array

FREE = 6  # velocities of a body that no joint of the tree holds
# shares of the largest below which a motion along the axis, gravity across it and rates of constraints are none
STILL, ACROSS, RATES = 1e-9, 1e-9, 1e-6
# Newton's method: longest change [-, rad], and the one that ends it; the speed is reached at once, or in so many parts
LONGEST, CLOSE, MOST, PARTS = 0.1, 1e-10, 40, (1, 4, 16)


class Rotation(Struct):
    """omega (3,) [rad/s] about a line through `centre` (3,) [m]. held (n,) : velocities of joints that the ground holds."""

    omega: Array
    centre: Array
    held: Array

    @classmethod
    def of(cls, own: Instant) -> "Rotation":
        """That of the body that turns fastest at an instant; none where all are at rest.

        Raises ModelError where that body moves along its axis, or gravity acts across the axis.
        """
        own.value()
        bodies, count = own.twin.bodies, own.system.body_count
        speeds = bodies.omega[:count, ..., 0]
        body = int(np.argmax(np.linalg.norm(speeds, axis=1))) if count else 0
        omega = speeds[body] if count else np.zeros(3)
        square = float(omega @ omega)
        if square == 0.0:  # a speed of zero in a diagram over speeds: an equilibrium
            return cls(np.zeros(3), np.zeros(3), np.zeros(own.n))
        rate = bodies.Rdot[body, ..., 0]
        name = own.system.bodies[body]
        if abs(rate @ omega) > STILL * square * own.system.size:
            raise _fault(f"{name} moves along the axis about which it turns")
        gravity = own.record.bodies.gravity
        aside = float(np.linalg.norm(np.cross(gravity, omega))) / np.sqrt(square)
        if aside > ACROSS * float(np.linalg.norm(gravity)):
            axis = ", ".join(f"{x:.4g}" for x in omega / np.sqrt(square))
            raise _fault(
                f"gravity acts across the axis ({axis}) about which {name} turns, so that no position of the machine is kept: write "
                f"`gravity: [0, 0, 0]`, or linearise about a moment of a run"
            )
        held = np.zeros(own.n)
        for _, first, last, free in _grounded(own):
            if not free:
                held[first:last] = own.y[own.positions + first : own.positions + last]
        return cls(omega, bodies.R[body, ..., 0] + np.cross(omega, rate) / square, held)

    def __mul__(self, share: float) -> "Rotation":
        return replace(self, omega=share * self.omega, held=share * self.held)

    def field(self, own: Instant) -> tuple[Array, Array, Array, Array]:
        """v, v̇ (n,) and their derivatives (n, n) with respect to positions, at those of an instant."""
        own.value()
        A, R = own.twin.bodies.A[..., 0], own.twin.bodies.R[..., 0]
        v, vdot = self.held.copy(), np.zeros(own.n)
        by_v, by_vdot, W = np.zeros((own.n, own.n)), np.zeros((own.n, own.n)), _tilde(self.omega)
        for body, first, last, free in _grounded(own):
            turns = [j for j in range(first, last) if own.place[j, 1] == 0]
            if turns:
                some = slice(turns[0], turns[0] + 3)
                v[some] = A[body].T @ self.omega
                by_v[some, some] = _tilde(v[some])
            if free:
                some, arm = slice(first, first + 3), R[body] - self.centre
                v[some], vdot[some] = W @ arm, W @ W @ arm
                by_v[some, some], by_vdot[some, some] = W, W @ W
        return v, vdot, by_v, by_vdot


def rotating(moment: Moment) -> Moment:
    """The machine of a moment in steady rotation, about the axis and with the speed of the body that turns fastest.

    Raises ModelError where the machine has no such motion, SolveError where it is not found.
    """
    own = Instant(moment.motion, moment.t, moment.y)
    if len(own.velocity_rows):
        raise _fault("wheels that do not slip keep no machine in steady rotation: linearise about a moment of a run")
    rotation, start = Rotation.of(own), own.y.copy()
    off = 0
    for parts in PARTS:
        own.move_to(moment.t, start, np.zeros(own.n))
        found = [_settle(own, rotation * ((k + 1) / parts)) for k in range(parts)]
        off = found[-1]
        if off < 0:
            break
    if off >= 0:
        speed, name = float(np.linalg.norm(rotation.omega)), unknown_name(own.system, int(own.free[off]))
        raise SolveError(
            f"no steady rotation at {speed:.6g} rad/s was found: {name} does not come to rest",
            time=moment.t,
            advice="Begin with a lower speed, or place the bodies near to where they are while the machine turns.",
        )
    _refuse_moving(own)
    return replace(moment, y=own.y.copy())


def _settle(own: Instant, rotation: Rotation) -> int:
    """Move an instant to the steady rotation. Returns -1, or the place among the free unknowns that changed most in the end."""
    free, K = own.free, own.rows
    unit = np.concatenate([own.length[free], np.ones(K)])
    worst = 0
    for _ in range(MOST):
        v, vdot, by_v, by_vdot = rotation.field(own)
        own.y[own.positions : own.first_state], own.vdot = v, vdot
        value = own.value()
        chosen = np.ix_(free, free)
        q, rate, acceleration, lam = (own.along(what) for what in ("q", "v", "vdot", "lam"))
        stiffness = q.r[free] + rate.r[free] @ by_v[chosen] + acceleration.r[free] @ by_vdot[chosen]
        scale = float(np.max(np.abs(unit[: len(free), None] * stiffness * unit[: len(free)]), initial=0.0)) or 1.0
        rows = np.concatenate([own.length[free] / scale, 1.0 / own.row_scale])
        columns = np.concatenate([own.length[free], scale / own.row_scale])
        matrix = np.block([[stiffness, lam.r[free]], [q.C, np.zeros((K, K))]])
        first = own.n + own.state_count
        right = -np.concatenate([value[: own.n][free], value[first : first + K]])
        try:
            found: Any = lstsq(rows[:, None] * matrix * columns, rows * right, cond=1e-13)
        except ValueError:  # not a number
            return worst
        x = found[0]
        change = np.abs(x[: len(free)])
        worst, size = int(np.argmax(change)) if len(change) else 0, float(np.max(change, initial=0.0))
        x = x * min(1.0, LONGEST / size) if size > 0.0 else x
        _displace(own, x[: len(free)] * own.length[free])
        own.lam = own.lam + x[len(free) :] * scale / own.row_scale
        if size < CLOSE:
            v, vdot, _, _ = rotation.field(own)
            own.y[own.positions : own.first_state], own.vdot = v, vdot
            return -1
    return worst


def _displace(own: Instant, change: Array) -> None:
    """Positions := q ∘ exp ψ, for ψ over the free unknowns."""
    psi = np.zeros(own.n)
    psi[own.free] = change
    plain, turns = own.place[:, 1] == NONE, np.flatnonzero(own.place[:, 1] == 0)
    own.y[own.place[plain, 0]] += psi[plain]
    if len(turns):
        at = own.place[turns, 0][:, None] + np.arange(4)
        own.y[at] = turned(own.y[at], psi[turns[:, None] + np.arange(3)])
    own._count_turns()


def _refuse_moving(own: Instant) -> None:
    """Raise ModelError where a constraint is not kept while all turns as one."""
    first = own.n + own.state_count + own.rows
    rates = np.abs(own.value()[first : first + own.rows] / own.row_scale)
    speed = float(np.max(np.abs(own.y[own.positions : own.first_state] / own.length), initial=0.0))
    moving = np.flatnonzero(rates > RATES * speed)
    if len(moving):
        owners = dict.fromkeys(own.system.row_owner[row] for row in own.record.residual.row[moving].tolist())
        raise _fault(f"the machine does not turn as one: {', '.join(owners)} would have to move otherwise")


def _grounded(own: Instant) -> Iterator[tuple[int, int, int, bool]]:
    """Body, first velocity, one past the last, and whether nothing holds it, of every body that the ground carries."""
    system, nodes = own.system, own.record.tree.node
    if not len(nodes):
        for b in range(system.body_count):
            yield b, FREE * b, FREE * (b + 1), True
        return
    for node in nodes.tolist():
        if node[1] == system.body_count and node[5] > node[4]:
            yield node[0], node[4], node[5], node[5] - node[4] == FREE


def _tilde(x: Array) -> Array:
    return cross(np.eye(3), x)


def _fault(message: str) -> ModelError:
    return ModelError(Fault.at("about", message))
