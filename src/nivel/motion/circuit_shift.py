"""Linear equations (1 - s J) k = f of a machine whose only stiffness is that of its circuits and modes, in relative coordinates.

    k_x = f_x + s (G_x k_x + G_s k_s + G_r k_r)        k_r = J o_v + s C (E_x k_x + E_s k_s + E_r k_r)        k_s = J f_q + s k_r

for states x of circuits, coordinates s on which they act and their rates r, with the slopes G of ẋ and E of the efforts e by hand
(`nivel.elements.circuits.tangent`) and the compliance C = J M⁻¹ Jᵀ of the mechanics. Then

    k_v = o_v + s M⁻¹ Jᵀ e        k_q = f_q + s T k_v

o is k without circuits: f of rigid bodies; with modes that of `nivel.motion.modal_shift`, and M is the mass of its factors.

All else that moves the machine (weight, velocity forces) is slow against a step of these and taken as it is: a method that is of its order
for any J needs no more.
"""

import numpy as np

from nivel.elements.circuits.ledger import TAKEN_IN, mass_apart
from nivel.kernels.algebra.rows import add_times, clear
from nivel.kernels.algebra.vectors import moment
from nivel.kernels.bodies.floating_frame import modes_of
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.record import MODAL, NONE, OUTWARD, record_at
from nivel.kernels.solve.saddle import solve_rows, subtract_rows
from nivel.kernels.tree.articulated import accelerate, hand_all_inwards, hand_wrench
from nivel.kernels.tree.flexible_whitening import accelerate_flexible, bend_by, hand_efforts_inwards
from nivel.motion.tree_motion import WIDTH, write_positions
from nivel.native.function import leaf, shared, stage

# Compliance of a machine in relative coordinates to efforts on some of its coordinates, in the state last evaluated.
#
#     direction  J = ∂ṡ/∂v        response  v̇ = M⁻¹ Jᵀ, constraints kept        compliance  J M⁻¹ Jᵀ
#
# from the factors of that evaluation: an effort costs one pass over the tree inwards and one outwards.


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
        about_origin = moment(J, u)
        for i in range(3):
            F[i] += about_origin[i]
            F[3 + i] += J[i]


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
    clear(b)
    for k in range(saddle.blocks[0]):
        b[saddle.block[k, 0]] += saddle.W[k, 0] * saddle.z[saddle.block[k, 3], 0]
    status = solve_rows(machine, 0.0)
    subtract_rows(saddle, WIDTH)
    return status


@stage
def respond(machine, response):
    """`response` := accelerations for `tree.wrench` alone. Returns a status."""
    hand_all_inwards(machine)
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
    clear(modal.effort)


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


@leaf
def factorise_rows_in_order(matrix):
    """Overwrite a matrix (n, n) with its factors L U, no rows exchanged; places of zeros cost a look. Returns the first row without a
    pivot, or -1."""
    n = matrix.shape[0]
    for i in range(n):
        row = matrix[i]
        for k in range(i):
            if row[k] != 0.0:
                above = matrix[k, k + 1 : n]
                factor = row[k] * matrix[k, k]
                row[k] = factor
                rest = matrix[i, k + 1 : n]
                for j in range(above.shape[0]):
                    rest[j] -= factor * above[j]
        if not np.abs(row[i]) > 0.0:
            return i
        row[i] = 1.0 / row[i]
    return -1


@leaf
def solve_in_order(matrix, b):
    """Overwrite b (n,) with the solution, for factors whose diagonal is that of U inverted."""
    n = b.shape[0]
    for i in range(n):
        row, total = matrix[i, :i], b[i]
        for j in range(i):
            total -= row[j] * b[j]
        b[i] = total
    for m in range(n):
        i = n - 1 - m
        row, total = matrix[i], b[i]
        for j in range(i + 1, n):
            total -= row[j] * b[j]
        b[i] = total * row[i]


@leaf
def soften(tangent):
    """The last rows of `slopes` := compliance times `effort`: second derivatives of the coordinates."""
    first = tangent.state.shape[0]
    for c in range(tangent.coordinate.shape[0]):
        row = tangent.slopes[first + c]
        clear(row)
        for d in range(tangent.coordinate.shape[0]):
            share, effort = tangent.compliance[c, d], tangent.effort[d]
            add_times(share, effort, row)


@leaf
def factorise_circuit(machine, number, s):
    """Factors `number` of the equations for this s. Returns a status; the state without a pivot is left in control.failure."""
    record = record_at(machine)
    tangent = record.circuit.tangent
    matrix, slopes = tangent.matrix[number], tangent.slopes
    states, count = tangent.state.shape[0], tangent.coordinate.shape[0]
    for i in range(states + count):
        row, slope = matrix[i], slopes[i]
        for j in range(states):
            row[j] = -s * slope[j]
        for c in range(count):
            row[states + c] = -s * (slope[states + count + c] + s * slope[states + c])
        row[i] += 1.0
    failed = factorise_rows_in_order(matrix)
    if failed < 0:
        return OK
    record.control.failure[0] = failed
    return NOT_CONVERGED


@leaf
def solve_circuit(machine, number, s, f, other):
    """Fill b with k of the states and rates of coordinates, `load` with e, and add the change of the coordinates to `travel` of these
    factors, for the rate f (ny,) of the state last evaluated and `other` (ny,), o."""
    record = record_at(machine)
    tangent, coordinates = record.circuit.tangent, record.coordinates
    b, states, count = tangent.b, tangent.state.shape[0], tangent.coordinate.shape[0]
    positions, columns = np.int64(record.tree.positions[0]), record.tree.column.shape[0]
    first = positions + columns
    for i in range(states):
        b[i] = f[first + np.int64(tangent.state[i])]
    for c in range(count):
        total, direction = 0.0, tangent.direction[c]
        for k in range(columns):
            total += direction[k] * other[positions + k]
        b[states + c] = total
    for c in range(count):
        moved = s * coordinates.rate[tangent.coordinate[c]]
        for i in range(states + count):
            b[i] += moved * tangent.slopes[i, states + c]
    solve_in_order(tangent.matrix[number], b)
    for c in range(count):
        total, effort = 0.0, tangent.effort[c]
        for j in range(states):
            total += effort[j] * b[j]
        for d in range(count):
            along = coordinates.rate[tangent.coordinate[d]] + s * b[states + d]
            total += effort[states + d] * along + effort[states + count + d] * b[states + d]
        tangent.load[c] = total
        tangent.travel[number, c] += s * (coordinates.rate[tangent.coordinate[c]] + s * b[states + c])


@leaf
def advance_circuit(machine, number, s, f, other, y, into):
    """into := y + s k with (1 - s J) k = f, for factors `number` of this s and o in `other`; y is the state last evaluated."""
    record = record_at(machine)
    tangent, tree = record.circuit.tangent, record.tree
    solve_circuit(machine, number, s, f, other)
    positions, columns = np.int64(tree.positions[0]), tree.column.shape[0]
    first = positions + columns
    for k in range(columns):
        total = 0.0
        for c in range(tangent.coordinate.shape[0]):
            total += tangent.response[c, k] * tangent.load[c]
        tree.change[k] = s * (other[positions + k] + s * total)
        into[positions + k] = y[positions + k] + tree.change[k]
    for n in range(tree.node.shape[0]):
        write_positions(machine, y, tree.change, tree.moved, n, np.int64(tree.node[n, 4]))
    for k in range(positions):
        into[k] = y[k] + s * (f[k] + tree.moved[k])
    for j in range(y.shape[0] - first):
        into[first + j] = y[first + j] + s * f[first + j]
    for j in range(tangent.unknown.shape[0]):
        if tangent.unknown[j] != NONE:
            into[first + j] = y[first + j] + s * tangent.b[tangent.unknown[j]]
    # what tanks give by the same rule: see `nivel.elements.circuits.ledger`
    gained, node = mass_apart(machine, f), record.circuit.node
    for k in range(node.shape[0]):
        if node[k, 1] != NONE:
            gained += tangent.b[tangent.unknown[node[k, 1]]]
    taken = y.shape[0] - TAKEN_IN
    into[taken] = y[taken] + s * gained
