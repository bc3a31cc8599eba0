"""Vibrations of stiff springs in BDF: told from what is slow, damped by low orders, and not followed where they are below the tolerance.

Above order two BDF lets vibrations grow while a step is about as long as their period, and the error of a step then keeps it so short for
ever. So where a step does not get longer, its error is looked at by `nivel.march.error_filter`, for steps REACH times as long. If little of
it is slow, and the amplitude of the vibration within the tolerance of the run, the polynomial begins anew with order one, and no order is
above two until steps do not get longer any more: the error of the slow motion decides, the vibration is damped, and steps get so long that
all orders damp what is left of it. Where they do not, the vibration grows again, and the next time low orders last longer.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf
from nivel.kernels.record import NONE, record_at
from nivel.kernels.rotation import angular_velocity, rates_of_parameters
from nivel.kernels.status import NOT_CONVERGED, OK
from nivel.march.alpha_error import MOST_MOVED, REACH, rate_of_motion, size_of_displacement, split
from nivel.march.error_filter import find_filter
from nivel.march.run import FACTORISATIONS, REACHED, TOLERANCE, run_at
from nivel.march.step_control import EXACT, size
from nivel.march.variable_workspace import (
    CHANGE,
    ENTRY,
    ESTIMATE,
    FAST,
    LONGEST,
    LOOKED,
    PATIENCE,
    SLOW,
    TRIES,
    UNCHECKED,
    VIBRATING,
)

# Twice the amplitude of a vibration may be this share of the tolerance of the run.
AMPLITUDE = 0.1
# Errors below the first share of the allowed one are not looked at; a vibration is what of an error leaves less than the second share.
FREE, LITTLE, HELPS = 0.05, 0.02, 0.5
# Steps without growth after which orders are free again, twice as many with every time that a vibration grew by it.
SETTLED, MOST_TRIES = 4.0, 9.0
# Steps with low orders are to be so much longer than those before; by MUCH the vibration is left behind.
WORTH, MUCH = 2.0, 4.0
# With free orders a step that became this share of the longest is held by a vibration that grew; one of the step last looked at is worth a
# look.
SHRUNK = 0.4
LEAST_PATIENCE, MOST_PATIENCE = 8.0, 1024.0
# The filter is for no time in which the machine moves by more, in radians or its own lengths: of that it is to take away little.
MOST_TURN = 0.3
# values of numbers[VIBRATING]
NO, BEGINS, GOES_ON, SETTLES = 0.0, 1.0, 2.0, 3.0


@leaf
def forget(run):
    """No vibration is known of."""
    c = run.numbers
    c[VIBRATING], c[UNCHECKED], c[PATIENCE], c[LONGEST], c[TRIES], c[ENTRY] = NO, 0.0, LEAST_PATIENCE, 0.0, 0.0, 0.0
    c[LOOKED] = 0.0


@leaf
def load_velocities(run, source, positions):
    """SLOW := the entries of velocities and states of forces of `source` (ny,)."""
    for i in range(positions, source.shape[0] - 2):
        run.stages[SLOW, i - positions] = source[i]


@leaf
def load_positions(run, newton):
    """SLOW := what ESTIMATE moves positions by, turns as small rotations in body axes; of states of forces nothing."""
    estimate, slow = run.stages[ESTIMATE], run.stages[SLOW]
    for i in range(slow.shape[0]):
        slow[i] = 0.0
    for k in range(newton.place.shape[0]):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if axis == NONE:
            slow[k] = estimate[p]
        elif axis == 0:
            angular_velocity(run.y[p : p + 4], estimate[p : p + 4], slow[k : k + 3])


@leaf
def keep_slow_positions(run, newton):
    """ESTIMATE of positions := SLOW. Returns the largest change that makes, as a share of the scales."""
    estimate, slow, work, fast = run.stages[ESTIMATE], run.stages[SLOW], run.stages[FAST], 0.0
    for k in range(newton.place.shape[0]):
        p, axis, count = np.int64(newton.place[k, 0]), newton.place[k, 1], 1
        if axis == NONE:
            work[0] = slow[k]
        elif axis == 0:
            count = 4
            rates_of_parameters(run.y[p : p + 4], slow[k : k + 3], work[:4])
        else:
            continue
        for i in range(count):
            fast = max(fast, np.abs(estimate[p + i] - work[i]) / run.scale[p + i])
            estimate[p + i] = work[i]
    return fast


@leaf
def keep_slow(machine, history, h):
    """ESTIMATE := what of it is slow. Returns a status, the largest displacement of it that was fast, and twice the amplitude of the
    vibrations of the accepted state; both as a share of what vibrations may be wrong by."""
    run, newton = run_at(history), record_at(machine).newton
    rate, t = rate_of_motion(machine, history), run.clock[REACHED]
    if rate * h > MOST_MOVED:
        return NOT_CONVERGED, 0.0, 0.0
    moving = newton.place.shape[0] + newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - moving - 2
    reach = min(REACH * h, MOST_TURN / max(rate, 1e-300))
    status = find_filter(machine, t, reach * reach, reach, reach)
    run.counter[FACTORISATIONS] += 1
    load_velocities(run, run.rate, positions)
    if status == OK:
        status = split(machine, history, t, SLOW, FAST)
    amplitude = size_of_displacement(run, newton, FAST, reach * reach, reach)
    load_velocities(run, run.stages[ESTIMATE], positions)
    if status == OK:
        status = split(machine, history, t, SLOW, FAST)
    for k in range(moving):
        run.stages[ESTIMATE, positions + k] = run.stages[SLOW, k]
    load_positions(run, newton)
    if status == OK:
        status = split(machine, history, t, SLOW, FAST)
    fast = keep_slow_positions(run, newton)
    most = max(AMPLITUDE * run.clock[TOLERANCE], EXACT)
    return status, fast / most, 2.0 * amplitude / most


@leaf
def begin(run, h):
    """The polynomial is to begin anew, after a step h."""
    c = run.numbers
    if c[VIBRATING] == NO:
        c[ENTRY] = h
    c[VIBRATING], c[UNCHECKED], c[TRIES] = BEGINS, 0.0, min(c[TRIES] + 1.0, MOST_TRIES)


@leaf
def leave(run, h, helped):
    """Errors are measured as they are again, after a step h. Where it did not help, it is long until the next try, but for steps that
    become much shorter than that."""
    c = run.numbers
    c[VIBRATING], c[LONGEST], c[LOOKED] = NO, 0.0, h
    if helped:
        c[TRIES], c[PATIENCE] = 0.0, LEAST_PATIENCE
    else:
        c[PATIENCE] = min(4.0 * c[PATIENCE], MOST_PATIENCE)


@leaf
def look(machine, history, h, factor, tolerance):
    """The error of the step just attempted, `factor` times ESTIMATE, as a share of the allowed one. Where it begins to be that of what is
    slow alone, numbers[VIBRATING] is BEGINS, and the polynomial has to begin anew."""
    run = run_at(history)
    c, plain = run.numbers, factor * size(run, run.stages[ESTIMATE]) / tolerance
    c[UNCHECKED] += 1.0
    if c[VIBRATING] == NO:
        known = rate_of_motion(machine, history) * REACH * h <= 1.0
        patience = LEAST_PATIENCE if h < SHRUNK * c[LOOKED] else c[PATIENCE]
        if not FREE < plain < np.inf or c[UNCHECKED] < patience or not known:
            return plain
        c[UNCHECKED], c[LOOKED] = 0.0, h
        for i in range(run.y.shape[0]):
            run.stages[CHANGE, i] = run.stages[ESTIMATE, i]
    status, fast, amplitude = keep_slow(machine, history, h)
    slow = factor * size(run, run.stages[ESTIMATE]) / tolerance
    if c[VIBRATING] == NO:
        if status == OK and slow < LITTLE * plain and amplitude <= 1.0:
            begin(run, h)
            return slow
        c[PATIENCE] = min(2.0 * c[PATIENCE], MOST_PATIENCE)
        for i in range(run.y.shape[0]):
            run.stages[ESTIMATE, i] = run.stages[CHANGE, i]
        return plain
    if status != OK:
        leave(run, h, False)
        return plain
    if c[VIBRATING] == SETTLES:
        c[LONGEST] = max(c[LONGEST], h)
        if plain <= FREE or slow >= HELPS * plain:
            leave(run, h, h >= MUCH * c[ENTRY])
        elif factor * fast > max(slow, FREE) or h < SHRUNK * c[LONGEST]:
            begin(run, h)
    error = max(slow, factor * fast)
    if c[VIBRATING] == GOES_ON and not error <= 1.0:
        # steps are counted, not tries: those from order one begin short
        c[UNCHECKED] -= 1.0
    return error


@leaf
def settle(run, h, grows):
    """After an accepted step h: whether it `grows`. Steps that stay as they are have the length that what is slow asks for."""
    c = run.numbers
    if c[VIBRATING] != GOES_ON:
        return
    if grows:
        c[UNCHECKED] = 0.0
    elif c[UNCHECKED] >= SETTLED and h < WORTH * c[ENTRY]:
        leave(run, h, False)
    elif c[UNCHECKED] >= SETTLED * 2.0 ** (c[TRIES] - 1.0):
        c[VIBRATING], c[LONGEST] = SETTLES, h
