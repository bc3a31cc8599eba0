"""Crossing of a beam's node by a slider that the beam carries.

Within a step the polynomials of the element where the step began go on beyond its end: nothing jumps for a method of integration, whose
order that would spoil. Behind the step those of the element reached take their place. They meet the others with their slopes, so places
differ by the square of the step; and velocities u of the machine change so that its motion w = B u does by forces of joints alone, as
little as it can,

    B₊ᵀ M (B₊ u₊ - w₋) = 0,   w₋ = B₋ u₋ = B₊ u₋ + x

x being what the slider, and all that it carries, move otherwise before than after. Rows of joints that are cut hold again:
[M, C_qᵀ; C_q, 0] (u₊ - u₋, μ) = (B₊ᵀ M x, C_q x). The right side is the difference of two residuals, one with x added to accelerations.

Methods that solve for accelerations at the end of a step do it again on the element reached: stiff beams would feel the places differ.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import add, clear, copy
from nivel.kernels.core.lanes import is_whole
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook, family
from nivel.kernels.record.record import LOCK, NONE, RESIDUAL, RESUME, record_at
from nivel.kernels.residual.balance import find_matrix
from nivel.kernels.solve.newton_matrix import solve_entries
from nivel.kernels.tree.slider import element_of
from nivel.native.function import stage


@stage
def element_reached(record, k):
    """The element where slider k is in `residual.y`."""
    tree = record.tree
    sigma = record.residual.y[tree.place[tree.slider[k, 0], 0]]
    _, _, e = element_of(record.coordinates, np.int64(tree.slider[k, 1]), sigma)
    return np.uint32(e)


@stage
def hold(record):
    """Hold all sliders on the elements where they are."""
    tree = record.tree
    for k in range(tree.slider.shape[0]):
        tree.element[k, 0], tree.element[k, 1] = element_reached(record, k), NONE


@stage
def add_motion(record, k, sign, out):
    """Add `sign` times the motion (ω, ṙ) of slider k in the state last evaluated."""
    tree, bodies = record.tree, record.bodies
    child = tree.node[tree.slider[k, 0], 0]
    for c in range(3):
        out[c] += sign * bodies.omega[child, c]
        out[3 + c] += sign * bodies.Rdot[child, c]


@stage
def add_asked(record, sign):
    """Add `sign` times what the residual last evaluated says of velocities and C̈ to `newton.balance.b`."""
    own, newton = record.residual, record.newton
    n, states, rows = own.vdot.shape[0], newton.state.shape[0], own.lam.shape[0]
    for i in range(n):
        newton.balance.b[i] += sign * own.value[i]
    for r in range(rows):
        newton.balance.b[n + states + r] += sign * own.value[n + states + 2 * rows + r]


@stage
def leave(machine, t):
    """Note the velocities of `residual.y`, and the motion of sliders that have left their elements; hold these where they are. Returns a
    status."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    some = False
    for k in range(tree.slider.shape[0]):
        tree.element[k, 1] = NONE
        some = some or tree.element[k, 0] != element_reached(record, k)
    if not some:
        return OK
    status = call_hook(machine, RESIDUAL, 0, t)
    n = own.vdot.shape[0]
    positions = np.int64(own.y.shape[0]) - n - record.newton.state.shape[0] - 2
    for i in range(n):
        tree.change[i] = own.y[positions + i]
    for k in range(tree.slider.shape[0]):
        reached = element_reached(record, k)
        if tree.element[k, 0] != reached:
            for c in range(6):
                tree.before[k, c] = 0.0
            add_motion(record, k, 1.0, tree.before[k])
            tree.element[k, 1], tree.element[k, 0] = tree.element[k, 0], reached
    return status


@stage
def find_asked(machine, t):
    """B₊ᵀ M x and C_q x in `newton.balance.b`, and the factors there, for the velocities noted. Returns a status."""
    record = record_at(machine)
    tree, own, newton = record.tree, record.residual, record.newton
    b = newton.balance.b
    status = call_hook(machine, RESIDUAL, 0, t)
    if status == OK:
        status = find_matrix(machine, t)
    if status != OK:
        return status
    newton.balanced[0] = 1.0
    clear(b)
    add_asked(record, -1.0)
    for k in range(tree.slider.shape[0]):
        x = own.acceleration[tree.node[tree.slider[k, 0], 0]]
        add_motion(record, k, -1.0, tree.before[k])
        for c in range(6):
            tree.before[k, 6 + c] = x[c]
    for k in range(tree.slider.shape[0]):
        if tree.element[k, 1] != NONE:
            # less what it gets from a slider that carries it
            x = own.acceleration[tree.node[tree.slider[k, 0], 0]]
            for c in range(6):
                tree.jump[k, c] = tree.before[k, c] - (x[c] - tree.before[k, 6 + c])
            status = call_hook(machine, RESIDUAL, 0, t)
            if status != OK:
                return status
    add_asked(record, 1.0)
    return OK


@stage
def load_missed(machine, t):
    """`newton.balance.b` := the right side once more, `newton.last` := accelerations and multipliers. Returns a status."""
    record = record_at(machine)
    own, newton = record.residual, record.newton
    first = own.vdot.shape[0] + newton.state.shape[0]
    clear(newton.balance.b)
    copy(own.vdot, newton.last)
    for r in range(own.lam.shape[0]):
        newton.last[first + r] = own.lam[r]
    status = call_hook(machine, RESIDUAL, 0, t)
    add_asked(record, 1.0)
    return status


@stage
def settle_change(machine, t):
    """Add to the change in `newton.b` the slopes that it has by those of the matrix, of which the factors have none: what the residual,
    moved by the change, misses of the right side in `newton.balance.b`."""
    record = record_at(machine)
    own, newton = record.residual, record.newton
    f, first = newton.balance, own.vdot.shape[0] + newton.state.shape[0]
    add(newton.b, own.vdot)
    for r in range(own.lam.shape[0]):
        own.lam[r] += newton.b[first + r]
    call_hook(machine, RESIDUAL, 0, t)
    add_asked(record, -1.0)
    copy(newton.last, own.vdot)
    for r in range(own.lam.shape[0]):
        own.lam[r] = newton.last[first + r]
    for i in range(f.b.shape[0]):
        f.b[i] -= real(f.b[i])
    solve_entries(newton, f)
    add(f.b, newton.b)


@stage
def go_on(machine, t):
    """The velocities of `residual.y` from those noted, where sliders have left their elements. Returns a status."""
    record = record_at(machine)
    tree, own, newton = record.tree, record.residual, record.newton
    f, n = newton.balance, own.vdot.shape[0]
    positions = np.int64(own.y.shape[0]) - n - newton.state.shape[0] - 2
    for i in range(n):
        own.y[positions + i] = tree.change[i]
    status = find_asked(machine, t)
    if status == OK:
        solve_entries(newton, f)
        copy(f.b, newton.b)
        if is_whole(machine):
            status = load_missed(machine, t)
    for k in range(tree.slider.shape[0]):
        tree.element[k, 1] = NONE
        for c in range(6):
            tree.jump[k, c] = 0.0
    if status != OK:
        return status
    if is_whole(machine):
        settle_change(machine, t)
    for i in range(n):
        own.y[positions + i] += newton.b[i]
    return OK


@family
def pass_nodes(machine, job, t):
    """LOCK: hold sliders where they are in the state `residual.y`. DEPART: note what moves before they pass nodes, hold them behind.
    RESUME: change the velocities of the state, found again or not on the elements reached, to go with that. Returns a status."""
    if job == LOCK:
        hold(record_at(machine))
        return OK
    return go_on(machine, t) if job == RESUME else leave(machine, t)
