"""`nivel.motion.compliance` in trees with flexible bodies: columns of motion are those of joints and of modes."""

from __future__ import annotations

import numpy as np

from nivel.kernels.bodies.floating_frame import modes_of
from nivel.kernels.record.record import MODAL, OUTWARD, record_at
from nivel.kernels.tree.articulated import hand_wrench
from nivel.kernels.tree.flexible_whitening import accelerate_flexible, bend_by, hand_efforts_inwards
from nivel.motion.compliance import hold_rows
from nivel.native.function import stage


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
