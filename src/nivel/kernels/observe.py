"""What a run keeps of an evaluated state: joint coordinates, reactions, energies, one frame of output."""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import entry, stage
from nivel.kernels.handle import address_type
from nivel.kernels.record import record_at, state_type
from nivel.kernels.rigid import kinetic_energy, potential_energy

ROTATION, CROSS_FIRST, CROSS_SECOND, TRANSLATION = 0, 1, 2, 3


@stage
def direction(bodies, markers, kind, i, j):
    """(cos, sin) of an angle and their rates; for a translation (displacement, 0, rate, 0). i first, j second marker.

    ROTATION      of the second marker about the common z axis: from x_i to x_j.
    CROSS_FIRST   universal joint, about z_i: from x_i to the arm z_j.
    CROSS_SECOND  universal joint, of the second body about its arm z_j: minus the angle from x_j to z_i.
    TRANSLATION   of the second marker's point along z_i.
    """
    Ai, Aj = markers.A[i], markers.A[j]
    wi, wj = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    w0, w1, w2 = wj[0] - wi[0], wj[1] - wi[1], wj[2] - wi[2]
    if kind == TRANSLATION:
        ri, rj, vi, vj = markers.r[i], markers.r[j], markers.rdot[i], markers.rdot[j]
        d0, d1, d2 = rj[0] - ri[0], rj[1] - ri[1], rj[2] - ri[2]
        e0 = vj[0] - vi[0] - (wi[1] * d2 - wi[2] * d1)
        e1 = vj[1] - vi[1] - (wi[2] * d0 - wi[0] * d2)
        e2 = vj[2] - vi[2] - (wi[0] * d1 - wi[1] * d0)
        return (
            d0 * Ai[0, 2] + d1 * Ai[1, 2] + d2 * Ai[2, 2],
            0.0,
            e0 * Ai[0, 2] + e1 * Ai[1, 2] + e2 * Ai[2, 2],
            0.0,
        )
    if kind == ROTATION:
        a, b, p, o, q, sign = Ai, Aj, 0, 0, 1, 1.0
    elif kind == CROSS_FIRST:
        a, b, p, o, q, sign = Ai, Aj, 0, 2, 1, 1.0
    else:
        a, b, p, o, q, sign = Aj, Ai, 0, 2, 1, -1.0
    # the vector b_o seen in the axes (a_p, a_q); `sign` is -1 where a belongs to the second marker
    x0, x1, x2 = b[0, o], b[1, o], b[2, o]
    cosine = x0 * a[0, p] + x1 * a[1, p] + x2 * a[2, p]
    sine = x0 * a[0, q] + x1 * a[1, q] + x2 * a[2, q]
    # rate of b_o relative to the axes of a: sign (ω_j - ω_i) × b_o
    y0, y1, y2 = w1 * x2 - w2 * x1, w2 * x0 - w0 * x2, w0 * x1 - w1 * x0
    cosine_rate = sign * (y0 * a[0, p] + y1 * a[1, p] + y2 * a[2, p])
    sine_rate = sign * (y0 * a[0, q] + y1 * a[1, q] + y2 * a[2, q])
    return cosine, sign * sine, cosine_rate, sign * sine_rate


@stage
def count_turns(record):
    """Follow every joint angle across ±π; called once an accepted step, so a step may turn a joint by less than half a turn."""
    joints = record.joints
    for k in range(joints.coordinate.shape[0]):
        kind = joints.coordinate[k, 0]
        if kind == TRANSLATION:
            continue
        c, s, _, _ = direction(record.bodies, record.markers, kind, joints.coordinate[k, 1], joints.coordinate[k, 2])
        turn = joints.turn[k]
        side = turn[0] * s - turn[1] * c  # > 0: the short way from the last direction is counterclockwise
        if turn[1] >= 0.0 and s < 0.0 and side > 0.0:
            turn[2] += 1.0
        elif turn[1] < 0.0 and s >= 0.0 and side < 0.0:
            turn[2] -= 1.0
        turn[0] = c
        turn[1] = s


@stage
def _reactions(record, frame, at):
    """Force and torque of each joint on its first body at its first marker: -Σ λ (f_i, n_i), global axes, then marker axes."""
    joints, constraints, markers = record.joints, record.constraints, record.markers
    count = joints.first_marker.shape[0]
    for k in range(count):
        for i in range(3):
            force, torque = 0.0, 0.0
            for row in range(joints.rows[k, 0], joints.rows[k, 1]):
                force -= constraints.lam[row] * constraints.J[row, i]
                torque -= constraints.lam[row] * constraints.J[row, 3 + i]
            frame[at + 3 * k + i] = force
            frame[at + 3 * count + 3 * k + i] = torque
        A = markers.A[joints.first_marker[k]]
        for i in range(3):
            force, torque = 0.0, 0.0
            for j in range(3):
                force += A[j, i] * frame[at + 3 * k + j]
                torque += A[j, i] * frame[at + 3 * count + 3 * k + j]
            frame[at + 6 * count + 3 * k + i] = force
            frame[at + 9 * count + 3 * k + i] = torque
    return at + 12 * count


@stage
def _joint_coordinates(record, frame, at):
    """Joint coordinates (angles with all their turns), then their rates."""
    joints = record.joints
    count = joints.coordinate.shape[0]
    for k in range(count):
        kind = joints.coordinate[k, 0]
        c, s, cdot, sdot = direction(
            record.bodies, record.markers, kind, joints.coordinate[k, 1], joints.coordinate[k, 2]
        )
        if kind == TRANSLATION:
            frame[at + k] = c
            frame[at + count + k] = cdot
        else:
            frame[at + k] = np.arctan2(s, c) + 2.0 * np.pi * joints.turn[k, 2]
            frame[at + count + k] = (c * sdot - s * cdot) / (c * c + s * s)
    return at + 2 * count


@entry((address_type, state_type, state_type))
def observe(machine, y, frame):
    """Fill `frame[1:]` from the state last evaluated; the columns are those of `nivel.system.layout`."""
    record = record_at(machine)
    bodies, constraints, control = record.bodies, record.constraints, record.control
    nb = bodies.mass.shape[0]
    at = 1
    for b in range(nb):
        for i in range(3):
            frame[at + 3 * b + i] = bodies.R[b, i]
            frame[at + 7 * nb + 3 * b + i] = bodies.Rdot[b, i]
            frame[at + 10 * nb + 3 * b + i] = bodies.omega[b, i]
            frame[at + 13 * nb + 3 * b + i] = bodies.Rddot[b, i]
            alpha = 0.0
            for j in range(3):
                alpha += bodies.A[b, i, j] * bodies.alpha_b[b, j]
            frame[at + 16 * nb + 3 * b + i] = alpha
        length = 0.0
        for i in range(4):
            length += bodies.theta[b, i] * bodies.theta[b, i]
        for i in range(4):
            frame[at + 3 * nb + 4 * b + i] = bodies.theta[b, i] / np.sqrt(length)
    at += 19 * nb
    at = _reactions(record, frame, at)
    at = _joint_coordinates(record, frame, at)
    rows = constraints.C.shape[0]
    for row in range(rows):
        frame[at + row] = constraints.C[row]
        frame[at + rows + row] = constraints.Cdot[row]
        frame[at + 2 * rows + row] = constraints.lam[row]
    at += 3 * rows
    kinetic, potential = 0.0, 0.0
    work = record.saddle.z[0]
    for b in range(nb):
        kinetic += kinetic_energy(bodies, b, work)
        potential += potential_energy(bodies, b)
    control.energy[0], control.energy[1] = kinetic, potential
    external, dissipated = y[y.shape[0] - 2], y[y.shape[0] - 1]
    frame[at], frame[at + 1], frame[at + 2], frame[at + 3] = kinetic, potential, external, dissipated
    frame[at + 4] = kinetic + potential - control.energy[2] - external + dissipated
    at += 5
    for k in range(record.loads.power.shape[0]):
        frame[at + 2 * k] = record.loads.magnitude[k]
        frame[at + 2 * k + 1] = record.loads.power[k]
