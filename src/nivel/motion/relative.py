"""Relative coordinates: joint coordinates of a spanning tree, loops closed by the constraints of the joints that are cut.

q = joint coordinates (Euler parameters of spherical and free joints), v = joint velocities. The mass matrix is factorised by the
articulated-body recursion, which gives W and z; multipliers of the cut joints follow as in all other coordinates.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.articulated import accelerate, factorise_tree, whiten_efforts, whiten_tree_rows
from nivel.kernels.compile import entry, stage
from nivel.kernels.hook import apply_forces, finish_forces
from nivel.kernels.record import FREE, SPHERICAL, correct_signature, evaluate_signature, record_at
from nivel.kernels.rigid import load_weight
from nivel.kernels.rotation import rates_of_parameters
from nivel.kernels.saddle import factorise_rows, multipliers
from nivel.kernels.status import OK
from nivel.kernels.tree import move_tree
from nivel.kernels.tree_markers import read_markers

WIDTH = 1


@stage
def parameters_of(kind, q):
    """Where the Euler parameters of a joint start among its positions at q; -1 where it has none."""
    if kind == SPHERICAL:
        return q
    return q + 3 if kind == FREE else -1


@stage
def normalise(machine, y):
    """θ := θ/|θ| for every spherical and free joint."""
    tree = record_at(machine).tree
    for n in range(tree.node.shape[0]):
        k = parameters_of(tree.node[n, 2], np.int64(tree.place[n, 0]))
        if k >= 0:
            square = y[k] * y[k] + y[k + 1] * y[k + 1] + y[k + 2] * y[k + 2] + y[k + 3] * y[k + 3]
            scale = 1.0 / square**0.5
            for i in range(4):
                y[k + i] *= scale


@stage
def read_state(machine, t, y):
    """Poses and velocities of bodies and of the markers in use, and the rows that are left. Returns a status."""
    record = record_at(machine)
    move_tree(record.bodies, record.tree, y)
    return read_markers(machine, t)


@stage
def factorise(machine):
    """Factors of the mass matrix and of S = W Wᵀ in the state last read. Returns a status."""
    record = record_at(machine)
    factorise_tree(record.bodies, record.tree)
    if record.saddle.block.shape[0] == 0:
        return OK
    whiten_tree_rows(machine)
    return factorise_rows(machine, WIDTH)


@stage
def write_positions(machine, y, change, out, n, first):
    """out = rates (or changes) of the positions of node n for the joint velocities (or their changes) from change[first] on."""
    tree = record_at(machine).tree
    node, q = tree.node[n], np.int64(tree.place[n, 0])
    kind, count = node[2], np.int64(node[5]) - np.int64(node[4])
    k = parameters_of(kind, q)
    if k < 0:
        for i in range(count):
            out[q + i] = change[first + i]
        return
    for i in range(count - 3):
        out[q + i] = change[first + i]
    rates_of_parameters(y[k : k + 4], change[first + count - 3 : first + count], out[k : k + 4])


@entry(evaluate_signature)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, v, x): x are the states of forces, the work of external forces and the dissipated energy [J].

    Leaves everything else in the record but what `nivel.kernels.carried` adds for frames.
    """
    record = record_at(machine)
    tree = record.tree
    status = read_state(machine, t, y)
    if status != OK:
        return status
    load_weight(record.bodies)
    status = apply_forces(machine, t, y)
    if status == OK:
        status = factorise(machine)
    if status != OK:
        return status
    whiten_efforts(machine)
    status = multipliers(machine, WIDTH)
    if status != OK:
        return status
    status = finish_forces(machine, t, ydot)
    positions, columns = np.int64(tree.positions[0]), tree.column.shape[0]
    for k in range(positions):
        tree.state[k] = y[k]
    accelerate(machine, ydot[positions : positions + columns])
    for n in range(tree.node.shape[0]):
        write_positions(machine, y, y, ydot, n, np.int64(tree.place[n, 1]))
    return status


@entry(correct_signature)
def keep(machine, t, y):
    """No correction; |θ| is brought back to one, which moves nothing."""
    normalise(machine, y)
    return OK
