"""Newton's iteration of implicit methods: accelerations, rates of states and multipliers for which the residual vanishes.

Every method gives the state as an affine function of the unknown accelerations v̇ and rates ẋ (`nivel.integrate.newmark.newton_state`).

With index 3 the multipliers close the positions. With index 2 they close the velocities, and `correction` the positions: along
(M + cv D + cq K)⁻¹ C_qᵀ, so that stiff springs are not stretched by it (the stabilised form of Gear, Gupta, Leimkuhler 1985). With
index 1 they close the accelerations, with the feedback of velocities and positions. Penalties leave what is closed open by λ/α, in
units of accelerations, and with them the matrix has -1/α at the multipliers: where these are iterated nothing is left open, so that
each iteration is one of the augmented Lagrangian. So are those of a redundant machine, whose rows are all met in least squares
(`nivel.analysis.assembly.penalties.soft_rows`).

In independent coordinates (index 0) all constraints are closed whenever the residual is evaluated, and a change is one along them:
δC̈ = 0 in the same matrix. It has positions and velocities move with the accelerations, also those that are dependent, which differ
from the formulas by the curvature of the constraints over a step. So the iteration contracts by the square of the step with a new
matrix, by the step where a stiff spring acts on what is dependent, and not better.

Policy: a matrix is kept, also from step to step, as long as the step is the same and the iterations that it still asks for are cheaper than
a new one and the iterations with that. One evaluation on dual numbers, for seven columns, takes about as long as DEAR of them. A new
matrix is made at the iterate; on request it is made anew for every iteration. The iteration ends where the contraction seen so far puts
the next change below the tolerance; all changes are shares of the scales of the positions and velocities that they move, so neither
units nor the step decide.

A change larger than the one before by GROWTH leads astray, and of a matrix of a step before one that is not smaller. From there
Newton's method may find a solution of another branch, a beam wound up. So the iteration gives up where its method knows other states to
start from; where not, what another step's matrix did is taken back and a new one made where it began, and what one of this step did is
taken back by halves (natural monotonicity test, Deuflhard 2004).

Changes that stop getting smaller, with a matrix that is known to be a good one, are round-off. Where they are below the tolerance of a
fixed step that is enough for chosen ones too, which ask for a share of their error. With index 3, and without constraints, velocities are
as exact as positions over the step, and positions are known to their round-off: there a larger change is accepted where round-off explains
all of it, unknown by unknown (`is_round_off`).

Slopes, where numbers are dual, follow once the values are found, with the same matrix: a new one would give the values of the next steps
other corrections of positions than the run without slopes has. How these depend on the matrix is looked at where that was made
(`nivel.integrate.newmark.correction_slopes`).
"""

import numpy as np

from nivel.integrate.loop.run import EVALUATIONS, FACTORISATIONS, ITERATIONS, run_at
from nivel.integrate.loop.step_control import ROUND_OFF
from nivel.integrate.newmark.correction_slopes import (
    add_moved,
    begin_moved,
    forget_moved,
    keep_made_at,
    settle_correction,
)
from nivel.integrate.newmark.friction_turns import begin_turns, follow_turns, keep_made, next_seed, release
from nivel.integrate.newmark.newton_state import find_state
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.status import NOT_CONVERGED, NOT_FINITE, OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import RESIDUAL, record_at
from nivel.kernels.residual.tangent import ACCELERATIONS, POSITIONS, differentiate, inverse_tangent
from nivel.kernels.solve.newton_matrix import factorise, solve
from nivel.native.duals import LANES
from nivel.native.function import leaf

GROWTH = 2.0
# Iterations that a new matrix costs, for each evaluation on dual numbers: 0.8 to 2 were measured, with elements of beams 4.
DEAR = 1.5
# Slower than this no matrix is good enough.
SLOW = 0.9
LEAST_SHARE = 0.02
# the contraction of a new matrix is taken for no better than this
SANGUINE = 0.05
CQ, CV, CX, CONTRACTION = 0, 1, 2, 3
TOLERANCE, MOST, FULL, ROUNDINGS = 0, 1, 2, 3
# Changes that contract by less have stopped getting smaller; a matrix with which they once contracted by as much is a good one.
STALLED, GOOD = 0.5, 0.1
# Changes below this share of the scales lead to no other solution.
FAR = 1e-4
# A change of the effort of a friction counts as this share of it.
CLOSE = 1e-4
# Slopes change no more where what is left to change is below this share of the scales; passes for that at most. Changes above LOST that
# contract by less than SLOWLY ask for a new matrix, those below are round-off.
SETTLED, LOST, MOST_SETTLING, SLOWLY = 1e-9, 1e-7, 20, 0.5
# samples of the round-off of the equations of motion, and how many times their mean size it may have
SAMPLES, SAFETY = 8, 4.0


@leaf
def write_defect(machine, cq, cv):
    """b := minus the residual; of the constraints, positions, velocities or accelerations as the index says, in units of accelerations."""
    record = record_at(machine)
    newton, residual, level = record.newton, record.residual, record.newton.level[0]
    b, value = newton.b, residual.value
    n, states, rows = residual.vdot.shape[0], newton.state.shape[0], residual.lam.shape[0]
    first, held = n + states, residual.row.shape[0]
    for i in range(n):
        b[i] = -value[i]
    for i in range(states):
        b[n + i] = value[n + i] - newton.rate[i]
    for k in range(held, rows):
        b[first + k] = -value[first + 2 * rows + k]
    for k in range(held):
        if level == 3:
            b[first + k] = -value[first + k] / cq
        elif level == 2:
            b[first + k] = -value[first + rows + k] / cv
        else:
            b[first + k] = -value[first + 2 * rows + k] if level == 1 else 0.0
    if level != 0 and record.control.iterations[0] <= 1:
        for k in range(newton.compliance.shape[0]):
            # redundant rows have compliance in the matrix alone
            b[first + k] += record.saddle.shift[k] * residual.lam[k]


@leaf
def close_positions(machine, cq, cv):
    """newton.moved := the further change of positions that closes them after the change in newton.b; `last` := all unknowns of it."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    b, value, kept = newton.b, residual.value, newton.last
    n, rows = residual.vdot.shape[0], residual.lam.shape[0]
    first = n + newton.state.shape[0]
    for i in range(b.shape[0]):
        kept[i] = b[i]
        b[i] = 0.0
    for k in range(residual.row.shape[0]):
        # C_q (cq δv̇) = -cq Ċ/cv is what the velocities' own change does to the positions
        b[first + k] = -value[first + k] + cq / cv * value[first + rows + k]
    solve(machine)
    copy(b, newton.moved)
    for i in range(b.shape[0]):
        b[i], kept[i] = kept[i], b[i]


@leaf
def apply_turns(newton, x):
    """Overwrite changes x (n,) of rotations after the iterate by those of their rotation vectors."""
    for k in range(newton.place.shape[0]):
        if newton.place[k, 1] == 0:
            x[k], x[k + 1], x[k + 2] = inverse_tangent(newton.change[k : k + 3], (x[k], x[k + 1], x[k + 2]))


@leaf
def size_of_change(machine, scale, cq, cv, cx):
    """Largest change of a position, velocity or state of forces by newton.b and newton.moved, as a share of its scale, or of the effort of
    a friction with stiction, as a share of itself and its limit times CLOSE; its unknown is left in control.failure."""
    record = record_at(machine)
    newton, failure = record.newton, record.control.failure
    b, moved = newton.b, newton.moved
    n, states = moved.shape[0], newton.state.shape[0]
    positions = scale.shape[0] - n - states - 2
    largest = 0.0
    for k in range(n):
        of_velocity, of_position = np.abs(cv * b[k]), np.abs(cq * b[k] + moved[k])
        at_velocity, at_position = scale[positions + k], scale[newton.place[k, 0]]
        # two quotients for each unknown would be as dear as a tenth of a solution
        if not (of_velocity <= largest * at_velocity and of_position <= largest * at_position):
            largest, failure[0] = max(of_velocity / at_velocity, of_position / at_position), k
    for k in range(n, n + states):
        share = np.abs(cx * b[k]) / scale[positions + k]
        if not share <= largest:
            largest, failure[0] = share, k
    first = n + states + record.residual.row.shape[0]
    for k in range(record.residual.stiction.shape[0]):
        effort = np.abs(record.residual.lam[first - n - states + k]) + record.residual.limit[k]
        share = CLOSE * np.abs(b[first + k]) / max(effort, 1e-300)
        if not share <= largest:
            largest, failure[0] = share, first + k
    return largest


@leaf
def take_change(newton, residual, b, moved, share):
    """Add `share` of the changes b and `moved` to the unknowns."""
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    for k in range(n):
        residual.vdot[k] += share * b[k]
        newton.correction[k] += share * moved[k]
    for k in range(states):
        newton.rate[k] += share * b[n + k]
    for k in range(residual.lam.shape[0]):
        residual.lam[k] += share * b[n + states + k]


@leaf
def keep_change(newton):
    """Remember the change just taken, which may have to be taken back."""
    copy(newton.b, newton.before)
    copy(newton.moved, newton.moved_before)


@leaf
def is_same(a, b):
    """Whether two coefficients differ by round-off only."""
    return np.abs(a - b) <= 1e-6 * np.abs(b)


@leaf
def is_kept(newton, cq, cv, cx):
    """Whether the factors are for these coefficients, but for the round-off of a step that is a difference of times."""
    return is_same(newton.kept[CQ], cq) and is_same(newton.kept[CV], cv) and is_same(newton.kept[CX], cx)


@leaf
def hold_repeated_rows(record):
    """Independent coordinates: the rows of the partition have no compliance, and multipliers of rows that repeat them vanish."""
    newton, row, rank = record.newton, record.partition.row, np.int64(record.control.rank[0])
    first = newton.state.shape[0] + record.residual.vdot.shape[0]
    for k in range(min(row.shape[0], newton.compliance.shape[0])):
        if k >= rank:
            record.residual.lam[row[k]] = 0.0
            for p in range(newton.row_start[first + row[k]], newton.row_start[first + row[k] + 1]):
                newton.value[p] = 0.0
        newton.value[newton.diagonal[row[k]]] = 0.0 if k < rank else 1.0


@leaf
def renew(machine, t, cq, cv, cx):
    """The factors of the matrix at the iterate. Returns a status."""
    record = record_at(machine)
    newton = record.newton
    status = differentiate(machine, t, cq, cv, cx, ACCELERATIONS if newton.level[0] < 2 else POSITIONS)
    if status == OK and newton.level[0] == 0:
        hold_repeated_rows(record)
    if status == OK:
        status = factorise(machine)
    newton.kept[CQ], newton.kept[CV], newton.kept[CX], newton.kept[CONTRACTION] = cq, cv, cx, SANGUINE
    keep_made(record.residual)
    return status


@leaf
def find_change(machine, cq, cv):
    """newton.b and newton.moved: the change of all unknowns that the residual just evaluated asks for."""
    newton = record_at(machine).newton
    write_defect(machine, cq, cv)
    solve(machine)
    if newton.level[0] == 2 and record_at(machine).residual.row.shape[0] > 0:
        close_positions(machine, cq, cv)
        apply_turns(newton, newton.moved)
    apply_turns(newton, newton.b)


@leaf
def is_round_off(machine, scale, cq, cv, cx, tolerance):
    """Whether the change in newton.before is of index 3 or without constraints, and no larger than the tolerance and what round-off does.

    A position q is known to ε |q|, a constraint to ε (r s + Σ |C_q| |q|): s is its scale, r the roundings in units in the last place on the
    way from the ground to it. What the latter does to the unknowns is found by the matrix, row by row. The equations of motion are known to
    ε Σ |∂r/∂q| |q|, in stiff machines a larger part of accelerations; of so many rows a few samples are taken, of changing signs.
    Overwrites `b` and `last`.
    """
    record = record_at(machine)
    newton, residual, constraints = record.newton, record.residual, record.constraints
    if newton.level[0] != 3 and residual.row.shape[0] > 0:
        return False
    b, floor, place = newton.b, newton.last, newton.place
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    first, positions = n + states, scale.shape[0] - n - states - 2
    for i in range(b.shape[0]):
        floor[i] = ROUND_OFF * max(scale[place[i, 0]], np.abs(residual.y[place[i, 0]])) / cq if i < n else 0.0
    seed = 1
    for _ in range(SAMPLES):
        b[:] = 0.0
        for i in range(n):
            known = 0.0
            for p in range(newton.row_start[i], newton.row_start[i + 1]):
                if newton.column[p] < n:
                    at = place[newton.column[p], 0]
                    known += np.abs(newton.value[p]) * max(scale[at], np.abs(residual.y[at]))
            seed = next_seed(seed)
            b[i] = ROUND_OFF * known / cq if seed % 2 == 0 else -ROUND_OFF * known / cq
        solve(machine)
        for i in range(b.shape[0]):
            floor[i] += SAFETY / SAMPLES * np.abs(b[i])
    for k in range(residual.row.shape[0]):
        known = newton.settings[ROUNDINGS] * constraints.scale[residual.row[k]]
        for p in range(newton.row_start[first + k], newton.row_start[first + k + 1]):
            if newton.column[p] < n:
                at = place[newton.column[p], 0]
                known += np.abs(newton.value[p]) * max(scale[at], np.abs(residual.y[at]))
        b[:] = 0.0
        b[first + k] = ROUND_OFF * known / cq
        solve(machine)
        for i in range(b.shape[0]):
            floor[i] += np.abs(b[i])
    for i in range(first):
        moves = max(cv / scale[positions + i], cq / scale[place[i, 0]]) if i < n else cx / scale[positions + i]
        if not (np.abs(newton.before[i]) - floor[i]) * moves <= tolerance:
            return False
    return True


@leaf
def is_finite(value):
    """Whether all entries are numbers; a difference of infinities is none either. Derivatives of other ones would be stale."""
    total = 0.0
    for i in range(value.shape[0]):
        total += value[i] - value[i]
    return total == 0.0


@leaf
def is_worth_a_new_one(newton, contraction, size, tolerance):
    """Whether the iterations still to come with the matrix that there is would cost more than another matrix and those with that."""
    if not contraction <= SLOW:
        return True
    price = DEAR * np.ceil((newton.group_start.shape[0] - 1.0) / LANES)
    return np.log(tolerance / size) * (1.0 / np.log(contraction) - 1.0 / np.log(SANGUINE)) > price


@leaf
def steepness_of_change(newton, scale, cq, cv, cx):
    """Largest slope of a change of a position, velocity or state of forces by newton.b and newton.moved, as a share of its scale."""
    b, moved = newton.b, newton.moved
    n, states = moved.shape[0], newton.state.shape[0]
    positions = scale.shape[0] - n - states - 2
    largest = 0.0
    for k in range(n):
        of_position = steepest(cq * b[k] + moved[k]) / real(scale[newton.place[k, 0]])
        largest = max(largest, of_position, steepest(cv * b[k]) / real(scale[positions + k]))
    for k in range(n, n + states):
        largest = max(largest, steepest(cx * b[k]) / real(scale[positions + k]))
    return largest


@leaf
def settle_slopes(machine, run, t, cq, cv, cx):
    """Slopes of the unknowns, whose values are found: changes with the matrix there, until they change no more (implicit function theorem).
    `residual.y` is the state then. Returns a status."""
    record = record_at(machine)
    newton, scale, last = record.newton, run.scale, 0.0
    status = settle_correction(machine, run, True) if newton.level[0] == 2 else OK
    for attempt in range(MOST_SETTLING):
        if status == OK:
            status = find_state(machine, t, cq, cv, cx)
        if status == OK:
            status = call_hook(machine, RESIDUAL, 0, t)
        if status == OK and newton.kept[CQ] == 0.0:
            status = renew(machine, t, cq, cv, cx)
            if newton.level[0] == 2:
                keep_made_at(machine, run, t, cq, cv, cx)
        if status != OK:
            return status
        find_change(machine, cq, cv)
        take_change(newton, record.residual, newton.b, newton.moved, 1.0)
        steepness = steepness_of_change(newton, scale, cq, cv, cx)
        contraction = steepness / last if attempt > 0 and last > 0.0 else 1.0
        left = min(1.0, contraction / (1.0 - contraction)) * steepness if contraction < SLOWLY else steepness
        if left <= SETTLED or (attempt > 0 and contraction >= SLOWLY and left <= LOST):
            break
        if attempt > 0 and contraction >= SLOWLY:
            newton.kept[CQ] = 0.0
        last = steepness
    return find_state(machine, t, cq, cv, cx)


@leaf
def end_correction(machine, run, t, cq, cv, cx):
    """Before a new matrix is made: slopes of what was corrected with the one there is, and the state with them. Returns a status."""
    # without coefficients the factors are of no step
    status = settle_correction(machine, run, False) if record_at(machine).newton.kept[CQ] != 0.0 else OK
    forget_moved(run)
    if status == OK:
        status = find_state(machine, t, cq, cv, cx)
    return call_hook(machine, RESIDUAL, 0, t) if status == OK else status


@leaf
def iterate(machine, history, t, cq, cv, cx, tolerance, others):
    """The unknowns for which the residual vanishes at time t, starting from those there are. `residual.y` is the state then.

    tolerance : share of the scales that the positions and velocities found may still change by. others : whether the method knows other
    states to start from. Returns a status.
    """
    run, record = run_at(history), record_at(machine)
    newton, counter = record.newton, run.counter
    full = newton.settings[FULL] == 1.0
    stale, inherited, last, share, best = full, True, np.inf, 1.0, np.inf
    begin_turns(record.residual)
    if is_whole(machine) and newton.level[0] == 2:
        begin_moved(run)
    for _ in range(np.int64(newton.settings[MOST])):
        status = find_state(machine, t, cq, cv, cx)
        if status == OK:
            status = call_hook(machine, RESIDUAL, 0, t)
        counter[EVALUATIONS] += 1
        counter[ITERATIONS] += 1
        if status == OK and not is_finite(record.residual.value):
            status = NOT_FINITE
        other, bidding, steep = False, False, False
        if status == OK and record.residual.stiction.shape[0] > 0:
            status, other, bidding, steep = follow_turns(machine, t)
        if other or steep:
            # another equation: changes that were before say nothing of those to come
            stale, last, share = stale or other, np.inf, 1.0
        if status == OK and (stale or not is_kept(newton, cq, cv, cx)):
            if is_whole(machine) and newton.level[0] == 2:
                status = end_correction(machine, run, t, cq, cv, cx)
            if status == OK:
                status = renew(machine, t, cq, cv, cx)
            counter[FACTORISATIONS] += 1
            stale, inherited = False, False
            if is_whole(machine) and newton.level[0] == 2:
                keep_made_at(machine, run, t, cq, cv, cx)
        if status != OK:
            newton.kept[CQ] = 0.0
            return status
        find_change(machine, cq, cv)
        size = size_of_change(machine, run.scale, cq, cv, cx)
        contraction = size / last if last < np.inf else (1.0 if steep else newton.kept[CONTRACTION])
        # small changes, and those that once became smaller, may stop to at round-off
        lost = best > GOOD and size > FAR
        astray = last < np.inf and not contraction <= (SLOW if inherited and lost else GROWTH)
        if astray and lost and others:
            newton.kept[CQ] = 0.0
            return NOT_CONVERGED
        if astray and lost and inherited:
            take_change(newton, record.residual, newton.before, newton.moved_before, -1.0)
            stale, last = True, np.inf
            continue
        if astray and share > LEAST_SHARE:
            share *= 0.5
            take_change(newton, record.residual, newton.before, newton.moved_before, -share)
            stale = True
            continue
        share = 1.0
        take_change(newton, record.residual, newton.b, newton.moved, share)
        if is_whole(machine) and newton.level[0] == 2:
            add_moved(machine, run)
        keep_change(newton)
        done = size <= tolerance or (contraction < 1.0 and contraction / (1.0 - contraction) * size <= tolerance)
        if bidding:
            release(record.residual)
            done, size = False, np.inf
        if not done and last < np.inf:
            best = min(best, contraction)
            if contraction > STALLED and (best <= GOOD or not inherited):
                done = size <= newton.settings[TOLERANCE] or is_round_off(machine, run.scale, cq, cv, cx, tolerance)
        if done:
            return (
                settle_slopes(machine, run, t, cq, cv, cx) if is_whole(machine) else find_state(machine, t, cq, cv, cx)
            )
        stale = full
        if last < np.inf:
            newton.kept[CONTRACTION] = max(contraction, 0.1 * SANGUINE)
            stale = full or is_worth_a_new_one(newton, contraction, size, tolerance)
        last = size
    newton.kept[CQ] = 0.0
    return NOT_CONVERGED
