"""An evaluation in relative coordinates, whatever the recursion over the tree is made of: `nivel.motion.relative` of rigid bodies,
`nivel.motion.flexible_tree` of flexible ones as well."""

import numpy as np

from nivel.kernels.algebra.rotation import normalise_parameters, rates_of_parameters
from nivel.kernels.bodies.constraint import constraint_rows
from nivel.kernels.bodies.marker import move_marker, place_point, turn_axes
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import measure_active
from nivel.kernels.record.record import record_at
from nivel.motion.direct import VELOCITIES, correct_levels, find_accelerations
from nivel.native.function import shared, stage


@stage
def read_markers(machine, t):
    """The markers in use, the rows that are left and the coordinates that something needs. Returns a status."""
    record = record_at(machine)
    bodies, markers = record.bodies, record.markers
    for n in range(record.tree.marker.shape[0]):
        k = record.tree.marker[n]
        place_point(bodies, markers, k)
        if record.tree.turning[n] != 0:
            turn_axes(bodies, markers, k)
        move_marker(bodies, markers, k)
    constraint_rows(bodies, markers, record.constraints)
    return measure_active(machine, t)


WIDTH = 1


@stage
def parameters_of(tree, n):
    """Where the Euler parameters of node n start in y: they are the last four of its positions where it has one more of these than
    velocities; -1 where it has none."""
    last = n + 1 == tree.place.shape[0]
    end = np.int64(tree.positions[0]) if last else np.int64(tree.place[n + 1, 0])
    positions, velocities = end - np.int64(tree.place[n, 0]), np.int64(tree.node[n, 5]) - np.int64(tree.node[n, 4])
    return end - 4 if positions > velocities else -1


@stage
def normalise(machine, y):
    """θ := θ/|θ| for every joint that has Euler parameters."""
    tree = record_at(machine).tree
    for n in range(tree.node.shape[0]):
        k = parameters_of(tree, n)
        if k >= 0:
            normalise_parameters(y[k : k + 4])


@stage
def write_positions(machine, y, change, out, n, first):
    """out = rates (or changes) of the positions of node n for the joint velocities (or their changes) from change[first] on."""
    tree = record_at(machine).tree
    node, q = tree.node[n], np.int64(tree.place[n, 0])
    count, k = np.int64(node[5]) - np.int64(node[4]), parameters_of(tree, n)
    if k < 0:
        for i in range(count):
            out[q + i] = change[first + i]
        return
    for i in range(count - 3):
        out[q + i] = change[first + i]
    rates_of_parameters(y[k : k + 4], change[first + count - 3 : first + count], out[k : k + 4])


@shared
def evaluate_tree(machine, t, y, ydot, read, load, factorise, whiten, accelerate):
    """ẏ of y = (q, v, x): x are the states of forces, the work of external forces and the dissipated energy [J]. Returns a status.

    read, load, factorise, whiten, accelerate : the parts of the recursion, compiled into this one.
    """
    tree = record_at(machine).tree
    status = read(machine, t, y)
    if status == OK:
        status = find_accelerations(machine, t, y, ydot, WIDTH, load, factorise, whiten)
    if status != OK:
        return status
    positions, columns = np.int64(tree.positions[0]), tree.column.shape[0]
    for k in range(positions):
        tree.state[k] = y[k]
    accelerate(machine, ydot[positions : positions + columns])
    for n in range(tree.node.shape[0]):
        write_positions(machine, y, y, ydot, n, np.int64(tree.place[n, 1]))
    return status


@stage
def move_coordinates(machine, y, what):
    """Apply the change of joint velocities in `tree.change` to the positions, or to the velocities."""
    tree = record_at(machine).tree
    positions = np.int64(tree.positions[0])
    if what == VELOCITIES:
        for k in range(tree.column.shape[0]):
            y[positions + k] += tree.change[k]
        return
    for n in range(tree.node.shape[0]):
        write_positions(machine, y, tree.change, tree.moved, n, np.int64(tree.node[n, 4]))
    for k in range(positions):
        y[k] += tree.moved[k]
    normalise(machine, y)


@shared
def correct_tree(machine, t, y, read, factorise, change):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`. Returns a status."""
    normalise(machine, y)
    if record_at(machine).saddle.row.shape[0] == 0:
        return OK
    return correct_levels(machine, t, y, WIDTH, read, factorise, change)
