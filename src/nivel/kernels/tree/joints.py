"""Joints of a tree: how a child moves and turns against the marker of its parent, a branch for each kind with a number.

Kinds from BY_ADDRESS on move by a `joint_motion` of their own, whose address is among the hooks. It takes what it needs from `joint_at`,
sets the axes of the child and the columns of its velocities, and ends with `carry_child`. Euler parameters follow from the axes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from nivel.kernels.algebra.trigonometry import cosine_and_sine
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import (
    CYLINDRICAL,
    FIXED,
    FREE,
    HOOKS,
    PLANAR,
    REVOLUTE,
    SCREW,
    SPHERICAL,
    TRANSLATIONAL,
    TRANSLATIONAL_ON_BEAM,
    UNIVERSAL,
    record_at,
)
from nivel.native.function import caller, leaf, stage
from nivel.native.signature import Signature

BY_ADDRESS: Final = TRANSLATIONAL_ON_BEAM + 1  # the motion of kind k is at Hooks.address[HOOKS + k - BY_ADDRESS]
# (machine, node, y)
MOTION = Signature("nothing", ("machine", "count", "vector"))
_call_motion = caller(MOTION)


def joint_motion(function: Callable[..., Any]) -> Family:
    """Decorator: `function(machine, n, y)`, the motion of the child of node n in the state y, as something with an address."""
    return Family(function, MOTION)


@leaf
def is_joint(kind):
    """Whether a node is a joint between two bodies: neither modes of a flexible body nor a slider on a beam."""
    return kind <= FREE or kind >= BY_ADDRESS


@stage
def call_motion(machine, n, y):
    """Let the motion of node n, of a kind from BY_ADDRESS on, move its child."""
    record = record_at(machine)
    _call_motion(record.hooks.address[HOOKS + record.tree.node[n, 2] - BY_ADDRESS], machine, n, y)


@stage
def joint_at(machine, n, y):
    """(four numbers, positions, velocities, axes of the parent's marker, axes of the child, columns) of the joint of node n. The axes of
    the child (3, 3) and the columns (velocities, 6) are to be set, in global axes."""
    record = record_at(machine)
    bodies, tree = record.bodies, record.tree
    node, place, axes = tree.node[n], tree.place[n], tree.first[n]
    if node[1] != bodies.mass.shape[0]:
        axes = tree.axes
    return tree.number[n], y[place[0] :], y[place[1] :], axes, bodies.A[node[0]], tree.column[node[4] : node[5]]


@stage
def carry_child(machine, n, d, alpha, a):
    """Displacement of the child of node n from the parent's marker, and the accelerations (angular, of its point) that it has against the
    parent while no joint velocity changes; global axes."""
    tree = record_at(machine).tree
    child = tree.node[n, 0]
    for i in range(3):
        tree.arm[child, i], tree.alpha0[child, i], tree.Rddot0[child, i] = d[i], alpha[i], a[i]


@stage
def turn_by_angle(A, angle, out):
    """out = A Rz(angle)."""
    c, s = cosine_and_sine(angle)
    turn_about_z(A, c, s, out)


@leaf
def turn_about_z(A, c, s, out):
    """out = A Rz, with the cosine and sine of the angle."""
    for i in range(3):
        x, y = A[i, 0], A[i, 1]
        out[i, 0], out[i, 1], out[i, 2] = c * x + s * y, c * y - s * x, A[i, 2]


@leaf
def turn_by_cross(A, q, out):
    """out = A Rz(a₁) X Rz(a₂): X lays the second z axis along the first x axis, the second x axis along the first z axis."""
    c, s = cosine_and_sine(q[0])
    e, f = cosine_and_sine(q[1])
    for i in range(3):
        x, y, z = A[i, 0], A[i, 1], A[i, 2]
        side = s * x - c * y
        out[i, 0], out[i, 1], out[i, 2] = e * z + f * side, e * side - f * z, c * x + s * y


@leaf
def turn_by_parameters(A, theta, out):
    """out = A Q(θ)."""
    e0, e1, e2, e3 = theta[0], theta[1], theta[2], theta[3]
    k = 2.0 / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3)
    q00, q01, q02 = 1.0 - k * (e2 * e2 + e3 * e3), k * (e1 * e2 - e0 * e3), k * (e1 * e3 + e0 * e2)
    q10, q11, q12 = k * (e1 * e2 + e0 * e3), 1.0 - k * (e1 * e1 + e3 * e3), k * (e2 * e3 - e0 * e1)
    q20, q21, q22 = k * (e1 * e3 - e0 * e2), k * (e2 * e3 + e0 * e1), 1.0 - k * (e1 * e1 + e2 * e2)
    for i in range(3):
        a, b, c = A[i, 0], A[i, 1], A[i, 2]
        out[i, 0] = a * q00 + b * q10 + c * q20
        out[i, 1] = a * q01 + b * q11 + c * q21
        out[i, 2] = a * q02 + b * q12 + c * q22


@leaf
def set_column(column, w, v):
    """A column (w, v)."""
    column[0], column[1], column[2], column[3], column[4], column[5] = w[0], w[1], w[2], v[0], v[1], v[2]


@leaf
def axis_of(A, axis):
    """A column of a rotation matrix."""
    return A[0, axis], A[1, axis], A[2, axis]


@leaf
def times(factor, a):
    """factor a."""
    return factor * a[0], factor * a[1], factor * a[2]


@leaf
def plus(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@stage
def move_joint(kind, number, q, A, out, column, k):
    """Axes of the child in `out` and columns from number k on, for a marker of the parent with axes A; returns A d."""
    zero = (0.0, 0.0, 0.0)
    z = axis_of(A, 2)
    if kind == REVOLUTE:
        turn_by_angle(A, q[0], out)
        set_column(column[k], z, zero)
        return zero
    if kind == TRANSLATIONAL:
        turn_about_z(A, number[2], number[3], out)
        set_column(column[k], zero, z)
        return times(q[0], z)
    if kind == UNIVERSAL:
        turn_by_cross(A, q, out)
        set_column(column[k], z, zero)
        set_column(column[k + 1], axis_of(out, 2), zero)
        return zero
    if kind == SPHERICAL:
        turn_by_parameters(A, q, out)
        for i in range(3):
            set_column(column[k + i], axis_of(out, i), zero)
        return zero
    if kind == CYLINDRICAL:
        turn_by_angle(A, q[0], out)
        set_column(column[k], z, zero)
        set_column(column[k + 1], zero, z)
        return times(q[1], z)
    if kind == SCREW:
        turn_by_angle(A, q[0], out)
        set_column(column[k], z, times(number[0], z))
        return times(number[0] * q[0] + number[1], z)
    x, y = axis_of(A, 0), axis_of(A, 1)
    if kind == PLANAR:
        turn_by_angle(A, q[2], out)
        set_column(column[k], zero, x)
        set_column(column[k + 1], zero, y)
        set_column(column[k + 2], z, zero)
        return plus(times(q[0], x), times(q[1], y))
    if kind == FIXED:
        turn_about_z(A, number[2], number[3], out)
        return zero
    turn_by_parameters(A, q[3:7], out)
    for i in range(3):
        set_column(column[k + i], zero, axis_of(A, i))
        set_column(column[k + 3 + i], axis_of(out, i), zero)
    return plus(times(q[2], z), plus(times(q[0], x), times(q[1], y)))


@leaf
def quaternion_product(a, b):
    """a ∘ b: first b, then a."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


@stage
def joint_turn(kind, number, q):
    """Euler parameters of the child seen from the marker of the parent: half angles of joint angles."""
    if kind == SPHERICAL:
        return q[0], q[1], q[2], q[3]
    if kind == FREE:
        return q[3], q[4], q[5], q[6]
    if kind in (TRANSLATIONAL, FIXED):
        # markers may be half a turn apart
        return (1.0, 0.0, 0.0, 0.0) if number[2] > 0.0 else (0.0, 0.0, 0.0, 1.0)
    half = 0.5 * (q[2] if kind == PLANAR else q[0])
    about_first = (np.cos(half), 0.0, 0.0, np.sin(half))
    if kind != UNIVERSAL:
        return about_first
    # X: half a turn about (1, 0, 1)/√2
    crossed = quaternion_product(about_first, (0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)))
    return quaternion_product(crossed, (np.cos(0.5 * q[1]), 0.0, 0.0, np.sin(0.5 * q[1])))
