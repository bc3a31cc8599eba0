"""Accelerations and multipliers as those for which the residual vanishes: for machines whose mass matrix has no blocks of single bodies.

The residual is linear in them. The matrix [M, C_qᵀ; C_q, 0] of some state before serves as long as it brings the residual down fast
enough; with that of the state itself one solution and its refinement end at round-off.
"""

import numpy as np

from nivel.kernels.algebra.rotation import rates_of_parameters
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.lanes import is_whole
from nivel.kernels.core.status import NOT_CONVERGED, NOT_FINITE, OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import MOMENTARY, NONE, record_at
from nivel.kernels.residual.residual import acceleration_of
from nivel.kernels.residual.tangent import differentiate_first, own_rates
from nivel.kernels.solve.newton_matrix import factorise_entries, solve_entries
from nivel.native.function import stage

# A change this small against the accelerations is round-off; with the state's own matrix so is one that gets smaller by no more than SLOW.
EXACT, SLOW, MOST = 1e-14, 0.2, 40
# Changes for the slopes alone: the matrix leaves less than SLOW of what they are wrong by.
SETTLING = 4
# Changes that grow by more than this, with the state's own matrix, are none of round-off.
GROWN = 10.0


@stage
def find_matrix(machine, t):
    """The factors at the state, accelerations and multipliers in `residual`. Returns a status."""
    record = record_at(machine)
    newton = record.newton
    newton.asked[2] = 1.0
    M = newton.balance.value
    own_rates(newton, np.int64(newton.place.shape[0]), M)
    status = differentiate_first(machine, 1, (M, M, M), t)
    return factorise_entries(newton, newton.balance, record.control.failure) if status == OK else status


@stage
def change_accelerations(machine):
    """Change v̇ and λ by what the residual asks for. Returns the largest change of v̇ as a share of the largest value, and as it is
    [m/s²]; turns count as what they move at the length of the machine: one that vanishes beside other ones is round-off of these."""
    record = record_at(machine)
    newton, own = record.newton, record.residual
    f, value = newton.balance, own.value
    b, n, states, rows = f.b, own.vdot.shape[0], newton.state.shape[0], own.lam.shape[0]
    first = n + states
    for i in range(n):
        b[i] = -value[i]
    for i in range(states):
        b[n + i] = 0.0
    for k in range(rows):
        b[first + k] = -value[first + 2 * rows + k]
    solve_entries(newton, f)
    largest, of_largest = 0.0, 1e-300
    for k in range(n):
        own.vdot[k] += b[k]
        arm = 1.0 if newton.place[k, 1] == NONE else newton.balanced[1]
        largest, of_largest = max(largest, arm * np.abs(b[k])), max(of_largest, arm * np.abs(own.vdot[k]))
    for k in range(rows):
        own.lam[k] += b[first + k]
    return largest / of_largest, largest


@stage
def settle_slopes(machine, t):
    """Slopes of accelerations and multipliers whose values are found: further changes with the matrix there. Returns a status."""
    status = OK
    for _ in range(SETTLING):
        if status == OK:
            status = call_hook(machine, MOMENTARY, 0, t)
            change_accelerations(machine)
    return status


@stage
def balance(machine, t, y):
    """Fill `residual.vdot` and `residual.lam` for the state y at time t, and all that the residual leaves. Returns a status.

    They start from what they were, which for a step small against the motion is near.
    """
    record = record_at(machine)
    own, newton = record.residual, record.newton
    copy(y, own.y)
    for i in range(own.vdot.shape[0]):
        if not np.abs(own.vdot[i]) < np.inf:
            own.vdot[i] = 0.0
    for k in range(own.lam.shape[0]):
        if not np.abs(own.lam[k]) < np.inf:
            own.lam[k] = 0.0
    last, noise, fresh = np.inf, 0.0, False
    for _ in range(MOST):
        status = call_hook(machine, MOMENTARY, 0, t)
        if status != OK:
            return status
        for i in range(own.value.shape[0]):
            if not np.abs(own.value[i]) < np.inf:
                return NOT_FINITE
        if newton.balanced[0] == 0.0:
            status = find_matrix(machine, t)
            if status != OK:
                return status
            newton.balanced[0], fresh, last = 1.0, True, np.inf
        size, change = change_accelerations(machine)
        if size <= EXACT:
            return settle_slopes(machine, t) if is_whole(machine) else OK
        if size <= SLOW * last:
            last = size
        elif not fresh:
            newton.balanced[0], last = 0.0, np.inf
        elif size < SLOW or change <= GROWN * noise:
            return settle_slopes(machine, t) if is_whole(machine) else OK
        elif noise > 0.0:
            return NOT_CONVERGED
        else:
            # where all accelerations vanish they are round-off, and so are all changes of them: these do not grow
            noise = change
    return NOT_CONVERGED


@stage
def write_balanced_rates(machine, y, ydot):
    """ẏ of the state y that is balanced, and the accelerations of the bodies and of frames at interfaces for what results show."""
    record = record_at(machine)
    bodies, own, newton, rate = record.bodies, record.residual, record.newton, record.elements.state_rate
    n, states = own.vdot.shape[0], rate.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    for k in range(n):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if axis == NONE:
            ydot[p] = y[positions + k]
        elif axis == 0:
            rates_of_parameters(y[p : p + 4], y[positions + k : positions + k + 3], ydot[p : p + 4])
        ydot[positions + k] = own.vdot[k]
    for i in range(states):
        ydot[positions + n + i] = rate[i]
    ydot[positions + n + states] = record.control.power[0]
    ydot[positions + n + states + 1] = record.control.power[1]
    for b in range(own.acceleration.shape[0]):
        A, x = bodies.A[b], acceleration_of(machine, np.int64(b))
        for i in range(3):
            bodies.Rddot[b, i] = x[3 + i]
            bodies.alpha_b[b, i] = A[0, i] * x[0] + A[1, i] * x[1] + A[2, i] * x[2]
