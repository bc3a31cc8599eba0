"""Joint coordinates and velocities of an assembled machine, and the constants of the joints of its tree."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.kernels.record import Markers
from nivel.machine.machine_record import MachineRecord
from nivel.machine.orientation import matrix_from_euler_parameters
from nivel.system.system import Array, System


@dataclass(frozen=True)
class Node:
    """One node of the tree: bodies, joint (or FREE), markers, and where its positions and velocities stand in the state."""

    child: int
    parent: int
    joint: int
    kind: str
    turned: bool
    first: int
    second: int
    position: int
    velocity: int


@dataclass(frozen=True)
class JointStart:
    """State (q, v) in joint coordinates; `number` and `theta` as in `nivel.kernels.record.Tree`."""

    q: Array
    v: Array
    number: Array
    theta: Array


@dataclass(frozen=True)
class _Bodies:
    """Poses and velocities of all bodies and, last, the ground; global axes."""

    R: Array
    theta: Array
    A: Array
    Rdot: Array
    omega: Array


@dataclass(frozen=True)
class _Relative:
    """Motion of a second marker seen from the first: turn Q, displacement d, relative velocities, in the first marker's axes."""

    Q: Array
    d: Array
    omega: Array
    velocity: Array


def joint_start(absolute: System, y: Array, markers: Markers, nodes: list[Node], machine: MachineRecord) -> JointStart:
    """Joint coordinates of all nodes in the state y of absolute coordinates (R, θ; Ṙ, ω̄)."""
    bodies = _bodies(absolute, y)
    q: list[float] = []
    v: list[float] = []
    number, theta = np.zeros((len(nodes), 4)), np.zeros((len(nodes), 2, 4))
    for n, node in enumerate(nodes):
        seen = _seen(bodies, markers, node)
        pitch = machine.joints[node.joint].pitch or 0.0 if node.kind == "screw" else 0.0
        positions, velocities, number[n] = _coordinates(node.kind, seen, pitch / (2.0 * np.pi))
        q += positions
        v += velocities
        theta[n] = _constant_turns(bodies, markers, node, joint_turn(node.kind, positions, number[n]))
    return JointStart(np.array(q), np.array(v), number, theta)


def _bodies(absolute: System, y: Array) -> _Bodies:
    count = absolute.body_count
    q, v = y[: 7 * count].reshape(count, 7), y[7 * count : 13 * count].reshape(count, 6)
    theta = np.vstack([q[:, 3:] / np.linalg.norm(q[:, 3:], axis=1, keepdims=True), [[1.0, 0.0, 0.0, 0.0]]])
    A = np.array([matrix_from_euler_parameters(e) for e in theta])
    zero = np.zeros((1, 3))
    omega = np.vstack([np.einsum("bij,bj->bi", A[:-1], v[:, 3:]), zero])
    return _Bodies(np.vstack([q[:, :3], zero]), theta, A, np.vstack([v[:, :3], zero]), omega)


def _seen(bodies: _Bodies, markers: Markers, node: Node) -> _Relative:
    i, j = node.first, node.second
    b, c = int(markers.body[i]), int(markers.body[j])
    Ai, Aj = bodies.A[b] @ markers.frame_b[i], bodies.A[c] @ markers.frame_b[j]
    ui, uj = bodies.A[b] @ markers.position_b[i], bodies.A[c] @ markers.position_b[j]
    distance = bodies.R[c] + uj - bodies.R[b] - ui
    speed = bodies.Rdot[c] + np.cross(bodies.omega[c], uj) - bodies.Rdot[b] - np.cross(bodies.omega[b], ui)
    return _Relative(
        Ai.T @ Aj,
        Ai.T @ distance,
        Ai.T @ (bodies.omega[c] - bodies.omega[b]),
        Ai.T @ (speed - np.cross(bodies.omega[b], distance)),
    )


def _coordinates(kind: str, seen: _Relative, lead: float) -> tuple[list[float], list[float], list[float]]:
    """(positions, velocities, numbers) of one joint; lead of a screw [m/rad]."""
    Q, d, w, v = seen.Q, seen.d, seen.omega, seen.velocity
    angle = float(np.arctan2(Q[1, 0], Q[0, 0]))
    numbers = [0.0, 0.0, 1.0, 0.0]
    match kind:
        case "revolute":
            return [angle], [w[2]], numbers
        case "translational" | "fixed":
            # markers that are given may be half a turn apart
            half = float(np.round(angle / np.pi)) * np.pi
            numbers[2:] = [float(np.cos(half)), 0.0]
            return ([d[2]], [v[2]], numbers) if kind == "translational" else ([], [], numbers)
        case "cylindrical":
            return [angle, d[2]], [w[2], v[2]], numbers
        case "screw":
            return [angle], [w[2]], [lead, d[2] - lead * angle, 1.0, 0.0]
        case "universal":
            arm = Q[:, 2]
            first, second = float(np.arctan2(arm[1], arm[0])), -float(np.arctan2(Q[2, 1], Q[2, 0]))
            # the second marker's rate about its own z axis
            return [first, second], [w[2], float(arm @ w)], numbers
        case "planar":
            return [d[0], d[1], angle], [v[0], v[1], w[2]], numbers
    theta = parameters_of(Q)
    if kind == "spherical":
        return [*theta], [*(Q.T @ w)], numbers
    return [*d, *theta], [*v, *(Q.T @ w)], numbers


def parameters_of(Q: Array) -> Array:
    """Euler parameters (4,) of a rotation matrix; the largest one is taken positive root (Shepperd 1978)."""
    trace = np.trace(Q)
    squares = np.array([1.0 + trace, *(1.0 + 2.0 * np.diag(Q) - trace)])
    k = int(np.argmax(squares))
    a, b, c = Q[2, 1] - Q[1, 2], Q[0, 2] - Q[2, 0], Q[1, 0] - Q[0, 1]
    d, e, f = Q[0, 1] + Q[1, 0], Q[0, 2] + Q[2, 0], Q[1, 2] + Q[2, 1]
    table = np.array([[squares[0], a, b, c], [a, squares[1], d, e], [b, d, squares[2], f], [c, e, f, squares[3]]])
    return table[k] / (2.0 * np.sqrt(squares[k]))


def joint_turn(kind: str, q: list[float], number: Array) -> Array:
    """Euler parameters of the second marker seen from the first, as in `nivel.kernels.carried.joint_turn`."""
    if kind == "spherical":
        return np.array(q)
    if kind == "free":
        return np.array(q[3:])
    if kind in ("translational", "fixed"):
        return np.array([1.0, 0.0, 0.0, 0.0])
    half = 0.5 * (q[2] if kind == "planar" else q[0])
    about = np.array([np.cos(half), 0.0, 0.0, np.sin(half)])
    if kind != "universal":
        return about
    crossed = product(about, np.array([0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)]))
    return product(crossed, np.array([np.cos(0.5 * q[1]), 0.0, 0.0, np.sin(0.5 * q[1])]))


def product(a: Array, b: Array) -> Array:
    """a ∘ b of Euler parameters."""
    vector = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.array([a[0] * b[0] - a[1:] @ b[1:], *vector])


def _conjugate(a: Array) -> Array:
    return a * np.array([1.0, -1.0, -1.0, -1.0])


def _constant_turns(bodies: _Bodies, markers: Markers, node: Node, turn: Array) -> tuple[Array, Array]:
    """The turns before and after that of the joint with which the child's Euler parameters are those of the assembled state."""
    near = node.second if node.turned else node.first
    before = parameters_of(markers.frame_b[near])
    if node.turned:
        turn = _conjugate(turn)
    so_far = product(product(bodies.theta[node.parent], before), turn)
    return before, product(_conjugate(so_far), bodies.theta[node.child])
