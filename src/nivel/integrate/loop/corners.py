"""Known corners of functions of time: an implicit step ends there, and what follows begins with what holds on their far side.

Beyond a corner of a force the accelerations are others. Beyond one of a driver the speeds are: they jump, as by an impulse of the driver
through the joints, by the least change in the mass metric; its work is that of the driver.
"""

import numpy as np

from nivel.integrate.loop.run import run_at
from nivel.kernels.algebra.rows import add, clear, copy
from nivel.kernels.core.status import OK
from nivel.kernels.record.function import NEAR
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import RESIDUAL, record_at
from nivel.kernels.residual.tangent import POSITIONS, differentiate
from nivel.kernels.solve.newton_matrix import factorise, solve
from nivel.native.function import leaf

# [s] steps for which stiffness and damping are nothing beside the mass
INSTANT = 1e-12
# Solutions after the first one with penalties: of 1e4 times the mass behind a row, each leaves 1e-4 of what is open.
FURTHER = 3
# Speeds that differ by less, as a share of their scales, have no corner.
SMOOTH = 1e-9


@leaf
def is_near(a, b):
    """Whether two times differ by round-off only."""
    return np.abs(a - b) <= NEAR * max(np.abs(a), np.abs(b))


@leaf
def next_corner(machine, t, target):
    """The first corner after t and not after `target`; infinity where there is none. Corners within the round-off of t are behind it."""
    corners = record_at(machine).newton.corners
    near = NEAR * max(np.abs(t), np.abs(target))
    for k in range(corners.shape[0]):
        if corners[k] > t + near:
            return corners[k] if corners[k] <= target + near else np.inf
    return np.inf


@leaf
def jump_at(machine, t, near):
    """The first of the corners up to t that follow each other within `near`, and whether none follows t so."""
    corners, first, found = record_at(machine).newton.corners, t, True
    while found:
        found = False
        for k in range(corners.shape[0]):
            if first - near <= corners[k] < first and not is_near(corners[k], first):
                first, found = corners[k], True
    return first, not next_corner(machine, t, t + near) < np.inf


@leaf
def before(t):
    """A time before t by some units in its last place: functions that have a corner at t still are what they were."""
    return t - 2.0 * NEAR * np.abs(t)


@leaf
def speeds_are_open(residual, scale, first):
    """Whether a velocity constraint is violated, by more than round-off."""
    rows, largest = residual.lam.shape[0], 0.0
    for k in range(residual.row.shape[0]):
        largest = max(largest, np.abs(residual.value[first + rows + k]) / scale[residual.row[k]])
    return largest > SMOOTH


@leaf
def work_of_drivers(constraints):
    """-Σ μ f' of all drivers for impulses μ in `constraints.lam` [J]."""
    work = 0.0
    for k in range(constraints.combination.shape[0]):
        work -= constraints.lam[constraints.combination[k, 0]] * constraints.motion[k]
    return work


@leaf
def find_jump(machine):
    """newton.b := the change of the velocities and the impulses that close them. Overwrites `before`.

    With penalties the matrix leaves C_q Δv + Ċ = μ/α of the impulses μ, which the next solutions take away as the augmented Lagrangian.
    """
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    b, total = newton.b, newton.before
    first, rows = residual.vdot.shape[0] + newton.state.shape[0], residual.lam.shape[0]
    clear(b)
    for k in range(residual.row.shape[0]):
        b[first + k] = -residual.value[first + rows + k]
    solve(machine)
    if newton.compliance.shape[0] == 0:
        return
    copy(b, total)
    for _ in range(FURTHER):
        for k in range(b.shape[0]):
            is_held = first <= k < first + newton.compliance.shape[0]
            b[k] = -newton.compliance[k - first] * b[k] if is_held else 0.0
        solve(machine)
        add(b, total)
    copy(total, b)


@leaf
def pass_corner(machine, history, t):
    """Let the speeds of run.y be those beyond the corner at time t. Returns a status, and whether they jump."""
    run, record = run_at(history), record_at(machine)
    newton, residual, constraints = record.newton, record.residual, record.constraints
    n, first = residual.vdot.shape[0], residual.vdot.shape[0] + newton.state.shape[0]
    positions, rows = np.int64(run.y.shape[0]) - first - 2, residual.row.shape[0]
    copy(run.y, residual.y)
    status, jumps = call_hook(machine, RESIDUAL, 0, t), False
    if status == OK and speeds_are_open(residual, constraints.scale, first):
        jumps = True
        clear(newton.change)
        # friction is a force, not an impulse
        stick, record.control.stick[0] = record.control.stick[0], np.inf
        status = differentiate(machine, t, INSTANT * INSTANT, INSTANT, INSTANT, POSITIONS)
        record.control.stick[0] = stick
        if status == OK:
            status = factorise(machine)
        if status != OK:
            return status, jumps
        find_jump(machine)
        for k in range(n):
            run.y[positions + k] += newton.b[k]
        clear(constraints.lam)
        for k in range(rows):
            constraints.lam[residual.row[k]] = newton.b[first + k]
        # an impulse does the mean of the work that it would do at the speeds on either side
        work = work_of_drivers(constraints)
        for k in range(residual.lam.shape[0]):
            residual.lam[k] = newton.b[first + k]
        status = call_hook(machine, RESIDUAL, 0, before(t))
        run.y[run.y.shape[0] - 2] += 0.5 * (work + work_of_drivers(constraints))
    return status, jumps
