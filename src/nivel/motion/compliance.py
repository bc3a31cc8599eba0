"""Compliance of a machine in relative coordinates to efforts on some of its coordinates, in the state last evaluated.

    direction  J = ∂ṡ/∂v        response  v̇ = M⁻¹ Jᵀ, constraints kept        compliance  J M⁻¹ Jᵀ

from the factors of that evaluation: an effort costs one pass over the tree inwards and one outwards.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.bodies.floating_frame import modes_of
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import MODAL, OUTWARD, record_at
from nivel.kernels.solve.saddle import solve_rows, subtract_rows
from nivel.kernels.tree.articulated import accelerate, hand_wrench, transmit
from nivel.kernels.tree.flexible_whitening import accelerate_flexible, bend_by, hand_efforts_inwards
from nivel.motion.tree_motion import WIDTH
from nivel.native.function import leaf, shared, stage


@leaf
def load_unit(machine, q):
    """`tree.wrench` := that of a unit effort on coordinate q, (moment about the frame's origin, force)."""
    record = record_at(machine)
    tree, markers, coordinates = record.tree, record.markers, record.coordinates
    for b in range(tree.wrench.shape[0]):
        for i in range(6):
            tree.wrench[b, i] = 0.0
    for part in range(coordinates.start[q], coordinates.start[q + 1]):
        m = coordinates.part_marker[part]
        J, u, F = coordinates.J[part], markers.u[m], tree.wrench[markers.body[m]]
        F[0] += J[3] + u[1] * J[2] - u[2] * J[1]
        F[1] += J[4] + u[2] * J[0] - u[0] * J[2]
        F[2] += J[5] + u[0] * J[1] - u[1] * J[0]
        F[3] += J[0]
        F[4] += J[1]
        F[5] += J[2]


@stage
def project(machine, direction):
    """`direction` := generalised forces of `tree.wrench`."""
    record = record_at(machine)
    tree, ground = record.tree, record.bodies.mass.shape[0]
    count = tree.node.shape[0]
    for m in range(count):
        node = tree.node[count - 1 - m]
        child, parent, wrench = node[0], node[1], tree.wrench[node[0]]
        for k in range(np.int64(node[4]), np.int64(node[5])):
            s = tree.column[k]
            turning = s[0] * wrench[0] + s[1] * wrench[1] + s[2] * wrench[2]
            direction[k] = turning + s[3] * wrench[3] + s[4] * wrench[4] + s[5] * wrench[5]
        if parent != ground:
            hand_wrench(wrench, tree.arm[child], tree.wrench[parent])


@stage
def hold_rows(machine):
    """z := what is left of it where constraints are kept. Returns a status."""
    saddle = record_at(machine).saddle
    if saddle.row.shape[0] == 0:
        return OK
    b = saddle.b
    for k in range(b.shape[0]):
        b[k] = 0.0
    for k in range(saddle.blocks[0]):
        b[saddle.block[k, 0]] += saddle.W[k, 0] * saddle.z[saddle.block[k, 3], 0]
    status = solve_rows(machine, 0.0)
    subtract_rows(saddle, WIDTH)
    return status


@stage
def respond(machine, response):
    """`response` := accelerations for `tree.wrench` alone. Returns a status."""
    record = record_at(machine)
    tree, saddle, ground = record.tree, record.saddle, record.bodies.mass.shape[0]
    count = tree.node.shape[0]
    for m in range(count):
        node = tree.node[count - 1 - m]
        child, parent, first, last = node[0], node[1], np.int64(node[4]), np.int64(node[5])
        wrench = tree.wrench[child]
        for c in range(last - first):
            saddle.z[last - 1 - c, 0] = transmit(tree, last - 1 - c, wrench)
        if parent != ground:
            hand_wrench(wrench, tree.arm[child], tree.wrench[parent])
    status = hold_rows(machine)
    accelerate(machine, response)
    return status


@shared
def apply_compliance(machine, project, respond):
    """Fill `direction`, `response` and `compliance` of the circuit's coordinates. Returns a status.

    project, respond : what follows from a wrench in the tree, compiled into this one.
    """
    tangent = record_at(machine).circuit.tangent
    count = tangent.coordinate.shape[0]
    for c in range(count):
        load_unit(machine, tangent.coordinate[c])
        project(machine, tangent.direction[c])
        load_unit(machine, tangent.coordinate[c])
        status = respond(machine, tangent.response[c])
        if status != OK:
            return status
        for d in range(c + 1):
            total, row, other = 0.0, tangent.direction[d], tangent.response[c]
            for k in range(row.shape[0]):
                total += row[k] * other[k]
            tangent.compliance[c, d], tangent.compliance[d, c] = total, total
    return OK


@stage
def no_efforts(modal):
    """No efforts on modes."""
    for j in range(modal.effort.shape[0]):
        modal.effort[j] = 0.0


@stage
def project_flexible(machine, direction):
    """`direction` := generalised forces of `tree.wrench`."""
    record = record_at(machine)
    tree, own, modal, ground = record.tree, record.flexible, record.modal, record.bodies.mass.shape[0]
    count = tree.node.shape[0]
    no_efforts(modal)
    for m in range(count):
        n = count - 1 - m
        node = tree.node[n]
        child, parent, kind, low = node[0], node[1], node[2], np.int64(node[4])
        wrench = tree.wrench[child]
        if kind == OUTWARD:
            k = modal.link[n]
            first, size = modes_of(own, own.frame[k, 0])
            bend_by(own.turn[k], own.displacement[k], wrench, modal.effort[first : first + size], size)
        elif kind == MODAL:
            f = modal.link[n]
            first, size = modes_of(own, f)
            carried = modal.carrier[f] < own.frame.shape[0]
            for j in range(size):
                total = modal.effort[first + j]
                for i in range(6):
                    if carried:
                        total += modal.column[f, i, j] * wrench[i]
                direction[low + j] = total
        else:
            for k in range(low, np.int64(node[5])):
                s = tree.column[k]
                turning = s[0] * wrench[0] + s[1] * wrench[1] + s[2] * wrench[2]
                direction[k] = turning + s[3] * wrench[3] + s[4] * wrench[4] + s[5] * wrench[5]
        if parent != ground:
            hand_wrench(wrench, tree.arm[child], tree.wrench[parent])


@stage
def respond_flexible(machine, response):
    """`response` := accelerations for `tree.wrench` alone. Returns a status."""
    no_efforts(record_at(machine).modal)
    hand_efforts_inwards(machine)
    status = hold_rows(machine)
    accelerate_flexible(machine, response)
    return status
