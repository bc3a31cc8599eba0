"""The equations of a machine at rows of states, in independent velocities: one call answers a question for all rows.

    M a + h = τ        all free velocities are Z v + drift,  M = Zᵀ M_free Z,  h = Zᵀ r for a = 0

Values are those of the residual, M_free and C_q slopes of its twin on dual numbers. Rows C of loops are solved for the dependent
velocities. With multipliers that leave no effort on these, the slopes of r along motions that fit the loops are those of τ.
"""

from typing import NamedTuple

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.lu import factorise_lu, solve_lu
from nivel.kernels.algebra.rotation import normalise_parameters
from nivel.kernels.algebra.rows import clear, copy
from nivel.kernels.core.arrays import F1, F2, I1, U1, U2
from nivel.kernels.core.handle import reader
from nivel.kernels.core.lanes import slope, unit
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family, call_hook
from nivel.kernels.record.record import RESIDUAL, record_at
from nivel.kernels.residual.tangent import POSITION, VELOCITY, load_twin, move_part
from nivel.native.duals import LANES
from nivel.native.entry import entry
from nivel.native.function import leaf
from nivel.native.signature import Signature

# questions: efforts for accelerations, M, accelerations for efforts, Jacobian of a point, slopes of the efforts by positions and velocities
EFFORTS, MASS, FORWARD, JACOBIAN, SLOPES = range(5)


class States(NamedTuple):
    """What leads from rows of states to the machine's own unknowns: f free velocities, m independent ones, K rows, P positions."""

    free: U1  # (f,) unknowns
    selected: U1  # (m,) places among them of the independent velocities
    dependent: U1  # (K,) of the others
    turn: U1  # first places of Euler parameters
    angle: U2  # (·, 2) coordinate of the tree that counts turns, place in q
    open: F1  # (K,) greatest C of closed loops
    shown: F2  # (P, 2) sign and offset of what q has in place of each position
    sign: F1  # (m,) of the independent velocities
    still: F1  # (ny,) state, its positions to be overwritten
    Z: F2  # (f, m) of the dependent velocities to be overwritten
    arm: F1  # (3,) the point whose Jacobian is asked for, in the axes in which the tree has its body
    # work
    M: F2  # (f, f)
    J: F2  # (K, f)
    factors: F2  # (K, K) of the dependent columns of J
    transposed: F2
    right: F1  # (max(f, K),)
    columns: F2  # (6, f) or (f, m)
    reduced: F2  # (m, m)
    body: I1  # (1,) that of the point
    pivot: I1
    exchange: I1
    order: I1  # (m,)


states_at = reader(States)


@leaf
def be_at(record, ask, q, first):
    """Be at the positions from q[first] on, at rest."""
    own, positions = record.residual, ask.shown.shape[0]
    copy(ask.still, own.y)
    for i in range(positions):
        own.y[i] = ask.shown[i, 0] * (q[first + i] - ask.shown[i, 1])
    for k in range(ask.turn.shape[0]):
        normalise_parameters(own.y[np.int64(ask.turn[k]) : np.int64(ask.turn[k]) + 4])
    for k in range(ask.angle.shape[0]):
        record.coordinates.reference[ask.angle[k, 0]] = q[first + np.int64(ask.angle[k, 1])]
    if record.tree.node.shape[0] > 0:
        for i in range(positions):
            record.tree.state[i] = own.y[i]
    clear(own.vdot)
    clear(own.lam)


@leaf
def solve_dependent(ask, factors, pivot, out, at):
    """out[at + …] of the dependent velocities := the solution for `right`."""
    count = ask.dependent.shape[0]
    solve_lu(factors, pivot, ask.right[:count])
    for i in range(count):
        out[at + np.int64(ask.free[ask.dependent[i]])] = ask.right[i]


@leaf
def add_motion(ask, x, first, out, at):
    """Add Z x to the free unknowns of out[at:]; x from x[first] on."""
    for i in range(ask.free.shape[0]):
        for j in range(ask.selected.shape[0]):
            out[at + np.int64(ask.free[i])] += ask.Z[i, j] * ask.sign[j] * x[first + j]


@leaf
def find_columns(machine, ask):
    """M of the free velocities and C_q at the state. Returns a status."""
    record = record_at(machine)
    newton, rows = record.newton, ask.J.shape[0]
    last_rows = record.residual.value.shape[0] - rows
    for first in range(0, ask.free.shape[0], LANES):
        last = min(first + LANES, ask.free.shape[0])
        twin, moving = load_twin(machine)
        for j in range(first, last):
            moving.vdot[ask.free[j]] += unit(j - first, 1.0)
        status = call_family(newton.address[2], twin, 0, 0.0)
        if status != OK:
            return status
        for j in range(first, last):
            for i in range(ask.free.shape[0]):
                ask.M[i, j] = slope(moving.value[ask.free[i]], j - first)
            for i in range(rows):
                ask.J[i, j] = slope(moving.value[last_rows + i], j - first)
    return OK


@leaf
def find_motions(ask):
    """Z of the motions that the rows leave. Returns whether the dependent velocities follow from them."""
    count = ask.dependent.shape[0]
    for i in range(count):
        for j in range(count):
            ask.factors[i, j] = ask.transposed[j, i] = ask.J[i, ask.dependent[j]]
    if not (factorise_lu(ask.factors, ask.pivot) and factorise_lu(ask.transposed, ask.exchange)):
        return False
    for j in range(ask.selected.shape[0]):
        for i in range(count):
            ask.right[i] = -ask.J[i, ask.selected[j]]
        solve_lu(ask.factors, ask.pivot, ask.right[:count])
        for i in range(count):
            if not np.isfinite(ask.right[i]):
                return False
            ask.Z[ask.dependent[i], j] = ask.right[i]
    return True


@leaf
def is_closed(record, ask):
    """Whether C is none at the state last evaluated."""
    rows = ask.open.shape[0]
    first = record.residual.value.shape[0] - 3 * rows
    for i in range(rows):
        if not abs(record.residual.value[first + i]) <= ask.open[i]:
            return False
    return True


@leaf
def move(machine, ask, v, first_v, a, first_a):
    """Give the machine, which is at rest, independent velocities and accelerations, none where there are no numbers, and evaluate the
    residual. Returns a status."""
    record = record_at(machine)
    own, rows, positions = record.residual, ask.open.shape[0], ask.shown.shape[0]
    velocities = own.value.shape[0] - 2 * rows
    if rows > 0:
        for i in range(rows):
            ask.right[i] = -own.value[velocities + i]
        solve_dependent(ask, ask.factors, ask.pivot, own.y, positions)
    if v.shape[0] > 0:
        add_motion(ask, v, first_v, own.y, positions)
    if rows > 0:
        status = call_hook(machine, RESIDUAL, 0, 0.0)
        if status != OK:
            return status
        for i in range(rows):
            ask.right[i] = -own.value[velocities + rows + i]
        solve_dependent(ask, ask.factors, ask.pivot, own.vdot, 0)
    if a.shape[0] > 0:
        add_motion(ask, a, first_a, own.vdot, 0)
    return call_hook(machine, RESIDUAL, 0, 0.0)


@leaf
def write_efforts(record, ask, out, first):
    """Zᵀ r."""
    for j in range(ask.selected.shape[0]):
        total = 0.0
        for i in range(ask.free.shape[0]):
            total += ask.Z[i, j] * record.residual.value[ask.free[i]]
        out[first + j] = ask.sign[j] * total


@leaf
def find_mass(ask):
    """`reduced` := Zᵀ M Z."""
    M, Z, count, chosen = ask.M, ask.Z, ask.free.shape[0], ask.selected.shape[0]
    if ask.open.shape[0] == 0:
        for i in range(chosen):
            for j in range(chosen):
                ask.reduced[i, j] = ask.sign[i] * M[i, j] * ask.sign[j]
        return
    for i in range(count):
        for j in range(chosen):
            total = 0.0
            for k in range(count):
                total += M[i, k] * Z[k, j]
            ask.columns[i, j] = total
    for i in range(chosen):
        for j in range(chosen):
            total = 0.0
            for k in range(count):
                total += Z[k, i] * ask.columns[k, j]
            ask.reduced[i, j] = ask.sign[i] * total * ask.sign[j]


@leaf
def write_jacobian(machine, ask, out, at):
    """Velocity and angular velocity of the point per independent velocity, (6, m). Returns a status."""
    record = record_at(machine)
    b, arm, chosen, count = ask.body[0], ask.arm, ask.selected.shape[0], ask.free.shape[0]
    for first in range(0, count, LANES):
        last = min(first + LANES, count)
        twin, moving = load_twin(machine)
        for j in range(first, last):
            moving.y[ask.shown.shape[0] + np.int64(ask.free[j])] += unit(j - first, 1.0)
        status = call_family(record.newton.address[2], twin, 0, 0.0)
        if status != OK:
            return status
        bodies = record_at(twin).bodies
        A, Rdot, omega = bodies.A[b], bodies.Rdot[b], bodies.omega[b]
        x = real(A[0, 0]) * arm[0] + real(A[0, 1]) * arm[1] + real(A[0, 2]) * arm[2]
        y = real(A[1, 0]) * arm[0] + real(A[1, 1]) * arm[1] + real(A[1, 2]) * arm[2]
        z = real(A[2, 0]) * arm[0] + real(A[2, 1]) * arm[1] + real(A[2, 2]) * arm[2]
        for j in range(first, last):
            lane = j - first
            u, v, w = slope(omega[0], lane), slope(omega[1], lane), slope(omega[2], lane)
            ask.columns[0, j] = slope(Rdot[0], lane) + v * z - w * y
            ask.columns[1, j] = slope(Rdot[1], lane) + w * x - u * z
            ask.columns[2, j] = slope(Rdot[2], lane) + u * y - v * x
            ask.columns[3, j], ask.columns[4, j], ask.columns[5, j] = u, v, w
    for row in range(6):
        for j in range(chosen):
            total = 0.0
            for i in range(count):
                total += ask.columns[row, i] * ask.Z[i, j]
            out[at + row * chosen + j] = total * ask.sign[j]
    return OK


@leaf
def move_dependent(machine, ask, moving, twin, lanes, out, at, rows_at):
    """Move the dependent of the velocities, or accelerations, out[at:] of the twin so that its rows from `rows_at` on do not change along
    any direction. Returns a status."""
    status = call_family(record_at(machine).newton.address[2], twin, 0, 0.0)
    for lane in range(lanes):
        for i in range(ask.open.shape[0]):
            ask.right[i] = -slope(moving.value[rows_at + i], lane)
        solve_lu(ask.factors, ask.pivot, ask.right[: ask.open.shape[0]])
        for i in range(ask.open.shape[0]):
            out[at + np.int64(ask.free[ask.dependent[i]])] += unit(lane, ask.right[i])
    return status


@leaf
def write_slopes(machine, ask, out, at):
    """∂τ/∂q and ∂τ/∂v, (2, m, m), at the state last evaluated. Returns a status."""
    record = record_at(machine)
    own, newton, rows, chosen = record.residual, record.newton, ask.open.shape[0], ask.selected.shape[0]
    for i in range(rows):
        ask.right[i] = -own.value[ask.free[ask.dependent[i]]]
    solve_lu(ask.transposed, ask.exchange, ask.right[:rows])
    copy(ask.right[:rows], own.lam)
    velocities = own.value.shape[0] - 2 * rows
    for first in range(0, 2 * chosen, LANES):
        last = min(first + LANES, 2 * chosen)
        twin, moving = load_twin(machine)
        for k in range(first, last):
            for i in range(ask.free.shape[0]):
                size = ask.Z[i, k % chosen] * ask.sign[k % chosen]
                if size != 0.0:
                    part = POSITION if k < chosen else VELOCITY
                    move_part(newton, moving, np.int64(ask.free[i]), unit(k - first, size), part)
        if rows > 0:
            positions, lanes = ask.shown.shape[0], last - first
            status = move_dependent(machine, ask, moving, twin, lanes, moving.y, positions, velocities)
            if status == OK:
                status = move_dependent(machine, ask, moving, twin, lanes, moving.vdot, 0, velocities + rows)
            if status != OK:
                return status
        status = call_family(newton.address[2], twin, 0, 0.0)
        if status != OK:
            return status
        for k in range(first, last):
            for j in range(chosen):
                total = 0.0
                for i in range(ask.free.shape[0]):
                    total += ask.Z[i, j] * slope(moving.value[ask.free[i]], k - first)
                out[at + (k // chosen * chosen + j) * chosen + k % chosen] = ask.sign[j] * total
    return OK


@leaf
def answer(machine, ask, job, q, v, x, out):
    """The answer for one state. q, v, x : where its numbers begin in the rows. Returns whether there is one."""
    record = record_at(machine)
    (q, at_q), (v, at_v), (x, at_x), (out, at) = q, v, x, out
    chosen, has_loops = ask.selected.shape[0], ask.open.shape[0] > 0
    be_at(record, ask, q, at_q)
    if has_loops and not (call_hook(machine, RESIDUAL, 0, 0.0) == OK and is_closed(record, ask)):
        return False
    if (has_loops or job in (MASS, FORWARD)) and find_columns(machine, ask) != OK:
        return False
    if has_loops and not find_motions(ask):
        return False
    if job == JACOBIAN:
        return write_jacobian(machine, ask, out, at) == OK
    if job in (MASS, FORWARD):
        find_mass(ask)
    if job == MASS:
        for i in range(chosen):
            copy(ask.reduced[i], out[at + i * chosen : at + (i + 1) * chosen])
        return True
    if move(machine, ask, v, at_v, x[:0] if job == FORWARD else x, at_x) != OK:
        return False
    if job == SLOPES:
        return write_slopes(machine, ask, out, at) == OK
    write_efforts(record, ask, out, at)
    if job == FORWARD:
        for j in range(chosen):
            out[at + j] = x[at_x + j] - out[at + j]
        if not factorise_lu(ask.reduced, ask.order):
            return False
        solve_lu(ask.reduced, ask.order, out[at : at + chosen])
    return True


@entry(Signature("status", ("machine", "machine", "count", "count", "count", "vector", "vector", "vector", "vector")))
def answer_rows(machine, states, job, first, rows, q, v, x, out):
    """Answer the question `job` for rows from `first` on: q (rows, P), v (rows, m), x (rows, m) accelerations or efforts, one behind the
    other in `out`. Of q, v and x there may be one row for all, of v and x none. Returns the number of the first row without an answer: its
    loops are open, or singular; or the number of rows."""
    ask = states_at(states)
    positions, chosen, width = ask.shown.shape[0], ask.selected.shape[0], out.shape[0] // rows
    for k in range(first, rows):
        at_q = k * positions if q.shape[0] > positions else 0
        at_v = k * chosen if v.shape[0] > chosen else 0
        at_x = k * chosen if x.shape[0] > chosen else 0
        if not answer(machine, ask, job, (q, at_q), (v, at_v), (x, at_x), (out, k * width)):
            return k
    return rows
