"""Joint coordinates and velocities of an assembled machine, and the constants of the joints of its tree."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from nivel.elements.joints.kind import Seen, TreeJoint
from nivel.kernels.record.record import NONE, Coordinates, Markers
from nivel.lazy import Struct, nivel, scipy
from nivel.machine.core import orientation
from nivel.machine.core.vectors import cross
from nivel.machine.machine_record import MachineRecord
from nivel.system.system import Array, System

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline


MOST = 50  # iterations
CLOSE = 1e-14  # of the length of the beam


class Rail(Struct):
    """The nodes of a beam: places along the unstressed line (N,) [m], positions (N, 3), axes of the sections (N, 3, 3), velocities and
    angular velocities (N, 3), in global axes. near : where the slider is, about [m]."""

    station: Array
    near: float
    r: Array
    axes: Array
    rdot: Array
    omega: Array


def slider_start(kind: str, pose: tuple[Array, Array, Array, Array], rail: Rail) -> tuple[list[float], list[float]]:
    """Positions and velocities of the joint. pose : position, axes, velocity and angular velocity of the slider's marker."""
    p, A, v, w = pose
    sigma, e = _nearest(rail, p)
    line, moving = _line(rail, e), _line(rail, e, rates=True)
    T = line(sigma, 1)
    rate = float(T @ (v - moving(sigma)) / (T @ T))
    if kind == "point-on-beam":
        return [sigma, *orientation.euler_parameters_from_matrix(A)], [rate, *(A.T @ w)]
    (x, xdot), (y, ydot) = (_axis(rail, e, sigma, rate, k) for k in (0, 1))
    e2 = np.cross(x, y)
    e2 /= np.linalg.norm(e2)
    if kind == "keyed-on-beam":
        e1 = y / np.linalg.norm(y)
        e3 = np.cross(e1, e2)
        over = e2 @ ydot / np.linalg.norm(y)
        of_axes = np.array([(x @ e1 * over - e2 @ xdot) / (x @ e3), -(e3 @ ydot) / np.linalg.norm(y), over])
    else:
        e3 = x / np.linalg.norm(x)
        e1 = np.cross(e2, e3)
        across = e2 @ xdot / np.linalg.norm(x)
        of_axes = np.array([-across, e1 @ xdot / np.linalg.norm(x), (e2 @ ydot - y @ e3 * across) / (y @ e1)])
    F = np.column_stack([e1, e2, e3])
    Q, own = F.T @ A, F.T @ w - of_axes
    if kind == "translational-on-beam":
        return [sigma], [rate]
    if kind == "cylindrical-on-beam":
        return [sigma, float(np.arctan2(Q[1, 0], Q[0, 0]))], [rate, float(own[2])]
    first, second = float(np.arctan2(Q[2, 1], Q[1, 1])), float(np.arctan2(Q[0, 2], Q[0, 0]))
    return [sigma, first, second], [rate, float(own[0]), float(Q[:, 1] @ own)]


def _line(rail: Rail, e: int, *, rates: bool = False) -> CubicHermiteSpline:
    """The line between the nodes e and e + 1, or its rates at fixed places."""
    ends = slice(e, e + 2)
    axes = rail.axes[ends, :, 0]
    values, slopes = (rail.rdot, np.cross(rail.omega[ends], axes)) if rates else (rail.r, axes)
    return scipy.interpolate.CubicHermiteSpline(rail.station[ends], values[ends], slopes)


def _axis(rail: Rail, e: int, sigma: float, rate: float, k: int) -> tuple[Array, Array]:
    """Axis k of the sections between the nodes e and e + 1, and its rate at a place that moves with a rate."""
    axes = rail.axes[:, :, k]
    between = nivel.elements.joints.on_beams.between
    axis, moving = between(rail.station, axes, e), between(rail.station, np.cross(rail.omega, axes), e)
    return axis(sigma), moving(sigma) + rate * axis(sigma, 1)


def _nearest(rail: Rail, p: Array) -> tuple[float, int]:
    """Place of the point p along the beam and the number of the node before it, by Newton's iteration as
    `nivel.kernels.bodies.rail.closest`."""
    sigma = rail.near
    for _ in range(MOST):
        e = nivel.elements.joints.on_beams.element_of(rail.station, sigma)
        line = _line(rail, e)
        d, T = p - line(sigma), line(sigma, 1)
        most = 2.0 * (rail.station[e + 1] - rail.station[e])
        change = float(np.clip(T @ d / (T @ T - d @ line(sigma, 2)), -most, most))
        sigma += change
        if abs(change) <= CLOSE * rail.station[-1]:
            break
    return sigma, nivel.elements.joints.on_beams.element_of(rail.station, sigma)


class Node(Struct):
    """One node of the tree: bodies, joint (or FREE), the markers of the joint on them (NONE: their frames), and where its positions and
    velocities stand in the state. modes : of a node of a flexible body. along : of a slider on a beam, its place among the coordinates."""

    child: int
    parent: int
    joint: int
    kind: str
    near: int
    far: int
    position: int
    velocity: int
    modes: int = 0
    along: int = -1


class Bent(Struct):
    """What lies between the frames of a flexible body: its modal coordinates where the node has any, and how it turns the child, as Euler
    parameters."""

    modal: Array
    turn: Array


class Frames(Struct):
    """The frames that the bodies (then the ground, then frames at interfaces) have in these coordinates: axes (·, 3, 3) and origins (·, 3)
    in their own."""

    axes: Array
    origin: Array

    def marker(self, markers: Markers, k: int, body: int) -> tuple[Array, Array]:
        """Axes and point of marker k of `body` in the body's frame of these coordinates; NONE: of its own frame."""
        frame, point = (np.eye(3), np.zeros(3)) if k == NONE else (markers.frame_b[k], markers.position_b[k])
        return self.axes[body].T @ frame, self.axes[body].T @ (point - self.origin[body])


def carried_frames(markers: Markers, nodes: list[Node], count: int) -> Frames:
    """Every one of `count` bodies and frames takes the marker by which it is carried for its frame."""
    axes, origin = np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3))
    for node in nodes:
        if node.far != NONE:
            axes[node.child], origin[node.child] = markers.frame_b[node.far], markers.position_b[node.far]
    return Frames(axes, origin)


class JointStart(Struct):
    """State (q, v) in joint coordinates; number, first, theta and own_theta as in `nivel.kernels.record.record.Tree`. turned : Euler
    parameters of
    the frames of all bodies and interfaces in these coordinates."""

    q: Array
    v: Array
    number: Array
    first: Array
    theta: Array
    own_theta: Array
    turned: Array


class Poses(Struct):
    """Poses and velocities of all bodies, then the ground, then frames at interfaces; global axes. theta : of the bodies."""

    R: Array
    theta: Array
    A: Array
    Rdot: Array
    omega: Array


def joint_start(
    own: Poses,
    markers: Markers,
    frames: Frames,
    nodes: list[Node],
    machine: MachineRecord,
    carrying: Callable[[str], TreeJoint],
    coordinates: Coordinates,
    bent: Mapping[int, Bent] | None = None,
) -> JointStart:
    """Joint coordinates of all nodes for poses of the bodies' own frames.

    carrying(kind) : how a node of a kind does. bent : the nodes that are no joints.
    """
    bodies, bent = _moved(own, frames), bent or {}
    q: list[float] = []
    v: list[float] = []
    count = len(nodes)
    number, first, theta = np.zeros((count, 7)), np.zeros((count, 3, 3)), np.zeros((count, 4))
    turned = np.tile([1.0, 0.0, 0.0, 0.0], (len(own.R), 1))
    for n, node in enumerate(nodes):
        first[n], number[n, 4:] = frames.marker(markers, node.near, node.parent)
        theta[n] = orientation.euler_parameters_from_matrix(first[n])
        if n in bent:
            q += bent[n].modal.tolist()
            v += [0.0] * len(bent[n].modal)
            joint = bent[n].turn
        elif node.along >= 0:
            pose = bodies.R[node.child], bodies.A[node.child], bodies.Rdot[node.child], bodies.omega[node.child]
            positions, velocities = slider_start(
                node.kind, pose, _rail(bodies, markers, frames, coordinates, node.along)
            )
            q += positions
            v += velocities
            joint = orientation.euler_parameters_from_matrix(bodies.A[node.child])
        else:
            seen = _seen(bodies, node, first[n], number[n, 4:])
            tree = carrying(node.kind)
            assert tree.start is not None  # only sliders have none
            positions, velocities, number[n, :4] = tree.start(
                seen, machine.joints[node.joint] if node.joint >= 0 else None
            )
            q += positions
            v += velocities
            joint = tree.turn(positions, number[n]) if tree.turn else orientation.euler_parameters_from_matrix(seen.Q)
        turned[node.child] = orientation.product(orientation.product(turned[node.parent], theta[n]), joint)
    own_theta = orientation.product(orientation.conjugate(turned[: len(bodies.theta)]), bodies.theta)
    return JointStart(np.array(q), np.array(v), number, first, theta, own_theta, turned)


def _rail(bodies: Poses, markers: Markers, frames: Frames, coordinates: Coordinates, along: int) -> Rail:
    """The beam of a slider, as its nodes are."""
    parts = slice(int(coordinates.start[along]) + 1, int(coordinates.start[along + 1]))
    r, axes, rdot, omega = [], [], [], []
    for k in coordinates.part_marker[parts].tolist():
        b = int(markers.body[k])
        frame, point = frames.marker(markers, k, b)
        u = bodies.A[b] @ point
        r.append(bodies.R[b] + u)
        axes.append(bodies.A[b] @ frame)
        rdot.append(bodies.Rdot[b] + cross(bodies.omega[b], u))
        omega.append(bodies.omega[b])
    return Rail(coordinates.station[parts], float(coordinates.reference[along]), *map(np.array, (r, axes, rdot, omega)))


def poses(absolute: System, y: Array) -> Poses:
    """Of the bodies and the ground, in the state y of absolute coordinates (R, θ; Ṙ, ω̄)."""
    count = absolute.body_count
    q, v = y[: 7 * count].reshape(count, 7), y[7 * count : 13 * count].reshape(count, 6)
    theta = q[:, 3:] / np.linalg.norm(q[:, 3:], axis=1, keepdims=True)
    A = np.array([*(orientation.matrix_from_euler_parameters(e) for e in theta), np.eye(3)])
    zero = np.zeros((1, 3))
    omega = np.vstack([np.einsum("bij,bj->bi", A[:-1], v[:, 3:]), zero])
    return Poses(np.vstack([q[:, :3], zero]), theta, A, np.vstack([v[:, :3], zero]), omega)


def _moved(own: Poses, frames: Frames) -> Poses:
    """The frames of these coordinates."""
    u = np.einsum("bij,bj->bi", own.A, frames.origin)
    speed = np.asarray(own.Rdot + cross(own.omega, u), dtype=np.float64)
    return Poses(own.R + u, own.theta, own.A @ frames.axes, speed, own.omega)


def _seen(bodies: Poses, node: Node, frame: Array, point: Array) -> Seen:
    b, c = node.parent, node.child
    Ai = bodies.A[b] @ frame
    distance = bodies.R[c] - bodies.R[b]
    omega = bodies.omega[c] - bodies.omega[b]
    speed = bodies.Rdot[c] - bodies.Rdot[b] - cross(bodies.omega[b], distance)
    return Seen(Ai.T @ bodies.A[c], Ai.T @ distance - frame.T @ point, Ai.T @ omega, Ai.T @ speed)
