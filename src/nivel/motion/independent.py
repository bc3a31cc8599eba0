"""Independent coordinates: the embedding technique on the velocities v = (Ṙ, ω̄) of all bodies (report 44, eqs. 78–89).

v̇ = B u̇ + D with the independent accelerations u̇ from Bᵀ M B u̇ = Bᵀ (Q - M D). The state is that of `newton_euler`, all of (q, v):
histories of multistep methods outlive a new partition. After every step the dependent velocities and positions are replaced by what
the independent ones leave them; that is what these coordinates mean, so every stabilisation begins with it.

Modes of flexible bodies are independent wherever the machine without them determines its dependent velocities.

With friction in joints the accelerations come from `newton_euler`: the efforts are found there, with the Schur complement. They are
the same accelerations.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import rates_of_parameters
from nivel.kernels.bodies.floating_dynamics import FRAMES, ROOTS
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.status import OK, SINGULAR
from nivel.kernels.record.hook import call_hook, family, finish_forces
from nivel.kernels.record.record import CORRECT, EVALUATE, FACTORS, record_at
from nivel.kernels.solve.embedding import depend_on, embed, generalised_forces
from nivel.kernels.solve.partition import divide, solve_dependent, solve_multipliers
from nivel.kernels.solve.saddle import PIVOTED
from nivel.motion.direct import STEEP
from nivel.motion.newton_euler import evaluate as evaluate_newton_euler
from nivel.motion.newton_euler import first_rate, load_bodies, normalise, read_state, write_rates
from nivel.native.entry import entry
from nivel.native.function import leaf, shared, stage

# Positions: passes at most, and shares of the scales of the rows: closed; near enough that the factor serves for the next pass; lost.
MOST_PASSES = 10
CLOSED, NEAR, LOST = 1e-13, 1e-6, 1e-6


@stage
def read_factorised(machine, t, y):
    """The state, and the factors of floating frames, by which dependent rows are weighed. Returns a status."""
    status = read_state(machine, t, y)
    return call_hook(machine, FACTORS, ROOTS, t) if status == OK else status


@stage
def take_accelerations(record):
    """Accelerations of bodies and modes from those of the partition."""
    bodies, acceleration = record.bodies, record.partition.v
    for b in range(bodies.mass.shape[0]):
        for i in range(3):
            bodies.Rddot[b, i], bodies.alpha_b[b, i] = acceleration[6 * b + i], acceleration[6 * b + 3 + i]
    for j in range(record.flexible.p.shape[0]):
        record.flexible.pddot[j] = acceleration[6 * bodies.mass.shape[0] + j]


@stage
def embedded_accelerations(machine):
    """Accelerations of the partition, and multipliers, for the state read and its forces. Returns a status."""
    record = record_at(machine)
    rank = np.int64(record.control.rank[0])
    status = divide(machine)
    if status != OK:
        return status
    generalised_forces(machine)
    solve_dependent(record.partition, rank, record.constraints.gamma)
    embed(machine)
    solve_multipliers(record.partition, rank, record.partition.Q, record.constraints.lam)
    # S is of an earlier state: `least_multipliers` would share loads by it
    record.control.rank[PIVOTED] = 1
    return OK


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, v, x): x are the states of forces, the work of external forces and the dissipated energy [J].

    Leaves everything else in the record.
    """
    record = record_at(machine)
    if record.friction.columns.shape[0] > 0:
        return evaluate_newton_euler(machine, t, y, ydot)
    status = read_factorised(machine, t, y)
    if status == OK:
        status = load_bodies(machine, t, y)
    if status == OK:
        status = embedded_accelerations(machine)
    if status != OK:
        return status
    status = finish_forces(machine, t, ydot)
    take_accelerations(record)
    call_hook(machine, FACTORS, FRAMES, t)
    write_rates(machine, ydot)
    return status


@leaf
def widest(machine):
    """(largest violation of the rows that determine the dependent positions, as a share of its scale, its row); NaN where one is."""
    record = record_at(machine)
    constraints, row = record.constraints, record.partition.row
    largest, worst = 0.0, 0
    for k in range(record.control.rank[0]):
        if np.isnan(constraints.C[row[k]]):
            return np.nan, row[k]
        share = np.abs(real(constraints.C[row[k]])) / constraints.scale[row[k]]
        if not share <= largest:
            largest, worst = share, row[k]
    return largest, worst


@leaf
def is_steep(machine):
    """Whether one of the rows that determine the dependent positions is violated by slopes."""
    record = record_at(machine)
    constraints, row = record.constraints, record.partition.row
    steep = False
    for k in range(record.control.rank[0]):
        steep = steep or steepest(constraints.C[row[k]]) > STEEP * real(constraints.scale[row[k]])
    return steep


@leaf
def move_dependent(machine, y):
    """Positions: subtract D from the dependent ones, as tangent increments."""
    record = record_at(machine)
    D, theta, change = record.partition.D, record.bodies.theta, record.partition.p
    count = record.bodies.mass.shape[0]
    for b in range(count):
        rates_of_parameters(theta[b], D[6 * b + 3 : 6 * b + 6], change)
        for i in range(3):
            y[7 * b + i] -= D[6 * b + i]
        for i in range(4):
            y[7 * b + 3 + i] -= change[i]
    for j in range(record.flexible.p.shape[0]):
        y[7 * count + j] -= D[6 * count + j]


@shared
def close(machine, y, attempt, factorised, before, divide, move):
    """One pass of `normalise_state` from the state last read: dependent positions nearer to C = 0, or where these are closed, dependent
    velocities from Ċ = 0.

    factorised : whether C_d of the last pass serves; before : the violation then. Returns (status, whether all is done, whether C_d serves
    for the next pass, the violation as a share of its scale).
    """
    record = record_at(machine)
    constraints, partition, rank = record.constraints, record.partition, np.int64(record.control.rank[0])
    first = first_rate(record)
    share, worst = widest(machine)
    if np.isnan(share):
        return OK, True, False, share  # the next evaluation finds out
    # below LOST a pass that does not halve the violation is stopped by round-off
    closed = not share > CLOSED or (share <= LOST and share > 0.5 * before)
    # what is closed may move with what it depends on
    closed = closed and not (is_whole(machine) and attempt < MOST_PASSES and is_steep(machine))
    if not closed and attempt == MOST_PASSES:
        record.control.failure[0] = worst
        return SINGULAR, True, False, share
    if closed or not factorised:
        status = divide(machine)
        if status != OK:
            return status, True, False, share
    solve_dependent(partition, rank, constraints.Cdot if closed else constraints.C)
    if closed:
        for i in range(partition.D.shape[0]):
            y[first + i] -= partition.D[i]
    else:
        move(machine, y)
    return OK, closed, share <= NEAR, share


@shared
def keep_independent(machine, t, y, read, divide, move):
    """Dependent positions from C = 0 by Newton's method with the independent ones held, then dependent velocities from Ċ = 0.

    read(machine, t, y) : the state; divide(machine) : its factors, move(machine, y) : the dependent positions; compiled into this one.
    Returns a status: SINGULAR where the positions cannot be found; control.failure is the row that is farthest open.
    """
    status, done, factorised, before = OK, False, False, np.inf
    for attempt in range(MOST_PASSES + 1):
        status = read(machine, t, y)
        if status == OK:
            status, done, factorised, before = close(machine, y, attempt, factorised, before, divide, move)
        if status != OK or done:
            break
    return status


@stage
def read_normalised(machine, t, y):
    """The same with Euler parameters of length one. Returns a status."""
    normalise(machine, y)
    return read_factorised(machine, t, y)


@entry(CORRECT)
def normalise_state(machine, t, y):
    """What depends on the independent coordinates, see `keep_independent`."""
    return keep_independent(machine, t, y, read_normalised, divide, move_dependent)


# the dependent coordinates are solved for with every stabilisation, so there is nothing left to correct directly
correct = normalise_state


@family
def depend(machine, job, t):
    """What depends on the independent coordinates, see `nivel.kernels.solve.embedding.depend_on`."""
    return depend_on(machine, t, normalise_state, read_state)
