"""Axes in which small motions of a spinning body have constant coefficients.

Turns about the axes of a body that spins about its axis of symmetry are not the motions that are seen: their equations turn with the body,
and where they are constant nevertheless, as of a top, every frequency is off by the spin. So changes δq, δv are resolved in axes P that
keep the axis of symmetry but not the spin, and turn with the angular velocity ω_P,

    q' = T δq,   v' = T δv,   T = diag(Pᵀ on places, Pᵀ A on turns),   Ṫ Tᵀ = diag(-ω̃_P, (ω - ω_P)~), components in P

An axis of symmetry a that precesses steadily, ȧ = Ω n × a, has ω_P = Ω n = ȧ × ä/|ȧ|²; one that keeps its direction has ω_P = 0. A body
without such an axis has ω_P = ω: its frequencies are those that an observer on it sees.
"""

from collections.abc import Iterator

import numpy as np
from scipy.spatial.transform import Rotation

from nivel.analysis.assembly.instant import Instant
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct, replace
from nivel.system.system import Array

# shares by which principal moments and lengths are equal, and speeds nothing
ALIKE, STILL = 1e-9, 1e-9
FREE = 6  # velocities of a body that no joint of the tree holds


class TurnedAxes(Struct):
    """turn (f, f) T, orthogonal; rate (f, f) Ṫ Tᵀ, over the free unknowns."""

    turn: Array
    rate: Array


class SpinningBody(Struct):
    """A body that spins, its turns from velocity `first` on, its place from `place` on (NONE: a joint measures it).

    axes (3, 3) : of the body at the time `begin` [s]. omega (3,) [rad/s] : of P, global; None: P turns with the body.
    """

    name: str
    body: int
    first: int
    place: int
    begin: float
    axes: Array
    omega: Array | None

    def blocks(self, own: Instant) -> Iterator[tuple[int, Array, Array]]:
        """First unknown, T and Ṫ Tᵀ (3, 3 each) of the place and of the turns at an instant, last evaluated."""
        A = own.twin.bodies.A[self.body, ..., 0]
        spin = A @ own.y[own.positions + self.first :][:3]
        if self.omega is None:
            P, omega = A @ self.axes.T, spin
        else:
            P, omega = Rotation.from_rotvec(self.omega * (own.t - self.begin)).as_matrix(), self.omega
        if self.place != NONE:
            yield self.place, P.T, -_cross(P.T @ omega)
        yield self.first, P.T @ A, _cross(P.T @ (spin - omega))


class Frames(Struct):
    """The axes of all bodies that spin; none: the unknowns stay what they are."""

    bodies: tuple[SpinningBody, ...] = ()

    def at(self, own: Instant) -> TurnedAxes | None:
        """T and its rate at an instant."""
        if not self.bodies:
            return None
        own.value()
        turn, rate = np.eye(own.n), np.zeros((own.n, own.n))
        for body in self.bodies:
            for first, T, R in body.blocks(own):
                some = slice(first, first + 3)
                turn[some, some], rate[some, some] = T, R
        chosen = np.ix_(own.free, own.free)
        return TurnedAxes(turn[chosen], rate[chosen])

    def notes(self) -> list[str]:
        """From where the motions are seen."""
        return [_said(body) for body in self.bodies]


def _said(body: SpinningBody) -> str:
    if body.omega is None:
        return f"turns of {body.name} are about axes that turn with it: its frequencies are those seen from there"
    if not np.any(body.omega):
        return f"turns of {body.name} are about axes that do not spin with it"
    speed = float(np.linalg.norm(body.omega))
    direction = ", ".join(f"{round(float(x), 4) + 0.0:g}" for x in body.omega / speed)
    said = f"motions of {body.name} are seen from axes that do not spin with it, but turn at {speed:.6g} rad/s about ({direction})"
    return said + (f": there a displacement without stiffness has ± {speed:.6g}i 1/s" if body.place != NONE else "")


def candidates(own: Instant) -> list[Frames]:
    """Axes in which the equations of a moving machine may have constant coefficients, the most telling first."""
    spinning = list(_spinning(own))
    if not spinning:
        return [Frames()]
    axes = own.twin.bodies.A[..., 0].copy()
    carried = tuple(SpinningBody(*each, begin=own.t, axes=axes[each[1]], omega=None) for each in spinning)
    kept = tuple(replace(body, omega=_turning_of(own, body)) for body in carried)
    return [Frames(kept), Frames(carried)]


def _spinning(own: Instant) -> Iterator[tuple[str, int, int, int]]:
    """Name, body, first velocity of the turns and of the place of every body that spins and is carried by the ground."""
    own.value()
    system, nodes = own.system, own.record.tree.node
    if len(nodes):
        of_ground = [node for node in nodes.tolist() if node[1] == system.body_count and node[0] < system.body_count]
        spans = [(node[0], node[4], node[5]) for node in of_ground]
    else:
        spans = [(b, FREE * b, FREE * (b + 1)) for b in range(system.body_count)]
    fastest = float(np.max(np.abs(own.y[own.positions : own.first_state] / own.length), initial=0.0))
    for body, start, end in spans:
        turns = [j for j in range(start, end) if own.place[j, 1] == 0]
        if not turns or system.point_masses[body]:
            continue
        omega = own.y[own.positions + turns[0] :][:3]
        if np.linalg.norm(omega) > STILL * fastest:
            yield system.bodies[body], body, turns[0], start if end - start == FREE else NONE


def _turning_of(own: Instant, body: SpinningBody) -> Array | None:
    """ω_P of a body with an axis of symmetry; None for others."""
    omega_b, alpha_b = own.y[own.positions + body.first :][:3], own.vdot[body.first :][:3]
    axis = _axis_of_symmetry(own, body.body, omega_b)
    if axis is None:
        return None
    a, omega, alpha = (body.axes @ each for each in (axis, omega_b, alpha_b))
    first = np.cross(omega, a)
    if np.linalg.norm(first) <= STILL * np.linalg.norm(omega):
        return np.zeros(3)
    second = np.cross(alpha, a) + np.cross(omega, first)
    return np.cross(first, second) / float(first @ first)


def _axis_of_symmetry(own: Instant, body: int, omega_b: Array) -> Array | None:
    """(3,) in body axes; that of the turn where all are alike; None where there is none through the frame's origin."""
    bodies = own.record.bodies
    moments, axes = np.linalg.eigh(bodies.inertia_b[body])
    near = np.diff(moments) <= ALIKE * moments[-1]
    if near.all():
        axis = omega_b / np.linalg.norm(omega_b)
    elif near.any():
        axis = axes[:, 2] if near[0] else axes[:, 0]
    else:
        return None
    aside = np.linalg.norm(np.cross(bodies.centre_b[body], axis))
    return axis if aside <= ALIKE * own.system.size else None


def _cross(x: Array) -> Array:
    """x̃"""
    return np.array([[0.0, -x[2], x[1]], [x[2], 0.0, -x[0]], [-x[1], x[0], 0.0]])
