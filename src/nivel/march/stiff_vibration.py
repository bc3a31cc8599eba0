"""Vibrations of stiff springs in BDF: told from what is slow, damped by order two, and not followed where they are below the tolerance.

Above order two BDF lets vibrations grow while a step is about as long as their period, and the error of a step then keeps it so short for
ever. So where a step does not get longer, its error is looked at by `nivel.march.error_filter`, for steps REACH times as long. If little of
it is slow, amplitude and energy of the vibration within the tolerance, and the slow motion good for a step of order two as long, the
polynomial is reduced to that order: through the same points, as a new begin with order one would shake the spring. From there on the error
of what is slow decides. No order is above two until steps do not get longer any more, by when the vibration is damped; then orders are
free, and steps get so long that all of them damp what is left. Where they do not, the vibration grows again, and the next time order two
lasts longer.

What drivers prescribe is slow, and what stiff springs make of it: a filtered error keeps both. The work of a driver at which a vibrating
spring pulls has an error that changes its sign with the vibration; it is not slow.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf
from nivel.kernels.record import NONE, record_at
from nivel.kernels.rotation import angular_velocity, rates_of_parameters
from nivel.kernels.status import OK
from nivel.march.alpha_error import REACH, rate_of_motion, size_of_displacement, split
from nivel.march.error_filter import find_filter, weigh
from nivel.march.run import FACTORISATIONS, ORDER, REACHED, TOLERANCE, run_at
from nivel.march.step_control import EXACT, size
from nivel.march.variable_workspace import (
    CHANGE,
    ENERGIES,
    ENTRY,
    ESTIMATE,
    FAST,
    LONGEST,
    LOOKED,
    PATIENCE,
    RATE,
    SCALED,
    SLOW,
    SPAN,
    TRIES,
    UNCHECKED,
    VIBRATING,
    Z,
)

# Of the tolerance of the run: twice the amplitude of a vibration may be the first share of it, the energy the second. What a vibration does
# to slow motion is about as large as its energy, and the motion is to be within ten tolerances.
AMPLITUDE, ENERGY = 0.1, 10.0
# Errors below the first share of the allowed one are not looked at; a vibration leaves less than the second share of an error, and where
# the slow part is more than the third there is none.
FREE, LITTLE, HELPS = 0.05, 0.02, 0.5
# Steps without growth after which orders are free again, twice as many with every time that a vibration grew by it.
SETTLED, MOST_TRIES = 4.0, 9.0
# With equal steps order two errs by this many h³ y⃛/6.
SECOND = 4.0 / 3.0
# Steps that got so much longer have left the vibration behind; vibrations so much larger than may be stepped over are followed again.
MUCH = 4.0
# Steps get longer, but what a vibration is stays what it was when it was told from what is slow: so many times faster than what is faster
# than the span, as far as that can be told from the share of it that the filter leaves. A contact or a soft spring is not taken for one.
CLEAR, LEAST = 5.0, 1e-24
# With free orders a step that became this share of the longest is held by a vibration that grew; one of the step last looked at is worth a
# look.
SHRUNK = 0.4
LEAST_PATIENCE, MOST_PATIENCE = 8.0, 64.0
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
def count_positions(machine, run):
    """How many positions stand before the velocities in y."""
    newton = record_at(machine).newton
    return np.int64(run.y.shape[0]) - newton.place.shape[0] - newton.state.shape[0] - ENERGIES


@leaf
def load_velocities(run, source, positions):
    """SLOW := the entries of velocities and states of forces of `source` (ny,)."""
    for i in range(positions, source.shape[0] - ENERGIES):
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
def drop_energies(run):
    """ESTIMATE of the energies := 0. Returns the larger one, as a share of the scales."""
    estimate, n, largest = run.stages[ESTIMATE], run.y.shape[0], 0.0
    for i in range(n - ENERGIES, n):
        largest = max(largest, np.abs(estimate[i]) / run.scale[i])
        estimate[i] = 0.0
    return largest


@leaf
def double_energy(machine, history, x):
    """Returns a status, and the product of x (·,) and M times what is in RATE: of vibrations twice an energy, where both are velocities, or
    displacements and accelerations."""
    run, total = run_at(history), 0.0
    status = weigh(machine, run.clock[REACHED], run.stages[RATE])
    forces = record_at(machine).newton.filter.b
    for k in range(record_at(machine).newton.place.shape[0]):
        total += x[k] * forces[k]
    return status, total


@leaf
def find_vibrations(machine, history, h):
    """Make the filter for a step h ready. Returns a status, and how large the vibrations of the accepted state are, as a share of what may
    be stepped over: twice their amplitude, or their energy, of which a slow motion may live (a bead on a rod that vibrates)."""
    run, newton = run_at(history), record_at(machine).newton
    rate, t, positions = rate_of_motion(machine, history), run.clock[REACHED], count_positions(machine, run)
    slow, fast, work, moving = run.stages[SLOW], run.stages[FAST], run.stages[RATE], newton.place.shape[0]
    reach = min(REACH * h, MOST_TURN / max(rate, 1e-300))
    if run.numbers[VIBRATING] == NO:
        run.numbers[SPAN] = reach
    else:
        reach = min(reach, run.numbers[SPAN])
    status = find_filter(machine, t, reach * reach, reach, reach)
    run.counter[FACTORISATIONS] += 1
    load_velocities(run, run.rate, positions)
    if status == OK:
        status = split(machine, history, t, SLOW, FAST, True)
    amplitude = 2.0 * size_of_displacement(run, newton, FAST, reach * reach, reach)
    potential, kinetic = 0.0, 0.0
    for k in range(moving):
        work[k] = run.rate[positions + k] - slow[k]
        fast[k] *= reach * reach
    if status == OK:
        status, potential = double_energy(machine, history, fast)
    load_velocities(run, run.y, positions)
    if status == OK:
        status = split(machine, history, t, SLOW, FAST, True)
    for k in range(moving):
        work[k] = run.y[positions + k] - slow[k]
    if status == OK:
        status, kinetic = double_energy(machine, history, work)
    share = 0.5 * (potential + kinetic) / max(run.scale[-2], run.scale[-1])
    tolerance = run.clock[TOLERANCE]
    return status, max(amplitude / max(AMPLITUDE * tolerance, EXACT), share / max(ENERGY * tolerance, EXACT))


@leaf
def keep_slow(machine, history):
    """ESTIMATE := what of it is slow, by the filter of `find_vibrations`. Returns a status, and the largest displacement of it that was
    fast, as a share of what vibrations may be wrong by."""
    run, newton = run_at(history), record_at(machine).newton
    positions, t = count_positions(machine, run), run.clock[REACHED]
    load_velocities(run, run.stages[ESTIMATE], positions)
    status = split(machine, history, t, SLOW, FAST, True)
    for k in range(run.y.shape[0] - ENERGIES - positions):
        run.stages[ESTIMATE, positions + k] = run.stages[SLOW, k]
    load_positions(run, newton)
    if status == OK:
        status = split(machine, history, t, SLOW, FAST, True)
    displacement, energy = keep_slow_positions(run, newton), drop_energies(run)
    tolerance = run.clock[TOLERANCE]
    return status, max(displacement / max(AMPLITUDE * tolerance, EXACT), energy / max(tolerance, EXACT))


@leaf
def lasts(machine, history, h, tolerance):
    """Whether the slow motion allows order two a step h as well. Overwrites ESTIMATE."""
    run = run_at(history)
    if run.counter[ORDER] <= 2:
        return True
    scaled = h / run.numbers[SCALED]
    for i in range(run.y.shape[0]):
        run.stages[ESTIMATE, i] = SECOND * scaled**3 * run.stages[Z + 3, i]
    status, _ = keep_slow(machine, history)
    return status == OK and size(run, run.stages[ESTIMATE]) <= tolerance


@leaf
def begin(run, h):
    """The polynomial is to be reduced, for a step h."""
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
        c[PATIENCE] = min(2.0 * c[PATIENCE], MOST_PATIENCE)


@leaf
def look(machine, history, h, factor, tolerance):
    """The error of the step just attempted, `factor` times ESTIMATE, as a share of the allowed one. Where it begins to be that of what is
    slow alone, numbers[VIBRATING] is BEGINS, and the step is to be tried again with order two."""
    run = run_at(history)
    c, plain, motion = run.numbers, factor * size(run, run.stages[ESTIMATE]) / tolerance, 0.0
    c[UNCHECKED] += 1.0
    if c[VIBRATING] == NO:
        known = rate_of_motion(machine, history) * REACH * h <= 1.0
        patience = LEAST_PATIENCE if h < SHRUNK * c[LOOKED] else c[PATIENCE]
        if not FREE < plain < np.inf or c[UNCHECKED] < patience or not known:
            return plain
        c[UNCHECKED], c[LOOKED] = 0.0, h
        motion = factor * size(run, run.stages[ESTIMATE, : run.y.shape[0] - ENERGIES]) / tolerance
        for i in range(run.y.shape[0]):
            run.stages[CHANGE, i] = run.stages[ESTIMATE, i]
    status, vibrations = find_vibrations(machine, history, h)
    fast = 0.0
    if status == OK:
        status, fast = keep_slow(machine, history)
    slow = factor * size(run, run.stages[ESTIMATE]) / tolerance
    if c[VIBRATING] == NO:
        if status == OK and slow < LITTLE * motion and vibrations <= 1.0 and lasts(machine, history, h, tolerance):
            # (1 + (ω span)²)⁻⁴ of a vibration is left: from that ω span, which becomes CLEAR
            c[SPAN] *= CLEAR / np.sqrt(max(slow / motion, LEAST) ** -0.25 - 1.0)
            begin(run, h)
            return slow
        c[PATIENCE] = min(2.0 * c[PATIENCE], MOST_PATIENCE)
        for i in range(run.y.shape[0]):
            run.stages[ESTIMATE, i] = run.stages[CHANGE, i]
        return plain
    if status != OK or vibrations > MUCH:
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
        # steps are counted, not tries
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
    elif c[UNCHECKED] >= SETTLED * 2.0 ** (c[TRIES] - 1.0):
        c[VIBRATING], c[LONGEST] = SETTLES, h
