"""The state of a run: everything a loop needs to go on where it stopped."""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.algebra.rows import add_times, clear
from nivel.kernels.core.arrays import F1, F2, I1, U1, U2
from nivel.kernels.core.handle import reader
from nivel.kernels.record.hook import call_evaluate
from nivel.native.function import caller, leaf
from nivel.native.signature import Signature

# entries of Run.clock
TIME, STEP, START, END, REACHED, INTERVAL, TOLERANCE, LARGEST, CORRECTOR_TOLERANCE = 0, 1, 2, 3, 4, 5, 6, 7, 8
LENGTH, SHOWN, ACCEPTED, OPEN_LIMIT, BOUND, HORIZON = 9, 10, 11, 12, 13, 14
STEP_TICKS, TICK_RATE = 15, 16
CLOCKS = 17
# entries of Run.counter
DONE_STEPS, ALL_STEPS, EVERY, FRAMES, LAST_FRAME, BUDGET, EVALUATIONS, EVALUATED = 0, 1, 2, 3, 4, 5, 6, 7
ITERATIONS, REJECTED, RESTART, DENSE, INSIDE, STOPPED, EVENTS, ORDER, MOST_ITERATIONS, NEWTON = (
    8, 9, 10, 11, 12, 13, 14, 15, 16, 17,
)  # fmt: skip
POWERS, UNCONSERVED, CONSERVE, KNOWN, SWITCHED, FACTORISATIONS, CORNER, COUNTED = 18, 19, 20, 21, 22, 23, 24, 25
COUNTS = 26
# rows of Run.event_values
BEFORE, AFTER, SIDE, WHEN, RATE_BEFORE, RATE_AFTER = 0, 1, 2, 3, 4, 5
# those of switches
MIDDLE, LAST, JUMP, WAIT, PATIENCE, SLOPE, PAST = 6, 7, 8, 9, 10, 11, 12
# those of events, beside SLOPE and PAST
TWICE, TO, BETWEEN = 6, 7, 8
VALUE_ROWS = 13
# most rows of Run.dense
DENSE_ROWS = 13
# rows of Run.pace, and parts of the duration
ALLOWED, TAKEN, LEAST, TURNED, MOVING, STEPPED, ITERATED, MOST_ITERATED = 0, 1, 2, 3, 4, 5, 6, 7
PACES, PARTS = 8, 1024
# columns of Run.windows
FROM, UNTIL, SHORT = 0, 1, 2


class Run(NamedTuple):
    """History and output of one run. All of it is here, so the result does not depend on how the run is cut into chunks.

    An integrator with a fixed step finds ALL_STEPS > 0 and leaves clock[STEP] and clock[REACHED] alone. One that chooses its steps finds
    ALL_STEPS = 0, tries clock[STEP], and leaves the time reached in clock[REACHED] (never past clock[BOUND]) and the step to try next in
    clock[STEP].
    """

    # TIME of the accepted state, STEP, START, END, REACHED by the last step, INTERVAL of frames [s]; TOLERANCE, LARGEST step, ...;
    # LENGTH of the step that `dense` describes, longer than the one done where that ends at an event; SHOWN, time of the last frame;
    # ACCEPTED, time of the state `previous`; OPEN_LIMIT, share of the scales of the constraints beyond which positions are not accepted;
    # BOUND, time of the next sample or corner, or of the end; HORIZON, time that no step begins at or after;
    # STEP_TICKS / TICK_RATE, the length of fixed steps as a ratio of whole numbers
    clock: F1
    # steps done, steps in all (0: not known), steps between frames, frames in the buffer, number of the last frame, budget, evaluations,
    # whether `rate` is that of y; corrector iterations, steps rejected, whether the history must be forgotten, rows of `dense` in use,
    # whether frames and events inside the last step have to be handed out, number of the event that ended the run (from 1), events in
    # the buffer, order in use, ..., whether the state reached is evaluated already (its rate is `scratch`), whether contacts and
    # switches change sides,
    # matrices of Newton's iteration found, number of the next corner, iterations of all steps noted in `pace`
    counter: I1
    y: F1  # (ny,) state
    rate: F1  # (ny,) ẏ at the accepted state
    previous: F1  # (ny,) the accepted state: where a failed step started
    scratch: F1  # (ny,) rates that nobody needs
    trial: F1  # (ny,) states inside a step
    scale: F1  # (ny,) what errors are measured by: a floor from the machine, raised to the largest |y| so far
    raised: U1  # (ny,) whether it is raised: 0 of masses of fluid, whose pressure is a small part of them
    stages: F2  # (·, ny) work and history of the integrator
    numbers: F1  # (·,) further history of the integrator
    matrix: F2  # (ny, ny) of Newton's iteration, or (0, 0)
    pivot: U1  # (ny,)
    # Where a position stands in y and where its rate: plain ones, q̇ = v; and rotations, four Euler parameters and three body-axis
    # angular velocities, each group by its first place.
    plain: U2  # (·, 2)
    turns: U2  # (·, 2)
    dense: F2  # (DENSE_ROWS, ny) the state inside the last step, see `nivel.integrate.loop.dense`
    frames: F2  # (capacity, width) output
    # BEFORE and AFTER the last step, SIDE, share of the step WHEN it changed, the rates before and after; see
    # `nivel.integrate.loop.events`. Of switches, whose SIDE is 1, or 0 where they are let go: the margin in the MIDDLE of the step, the
    # LAST side, the JUMP of the rates at its change as a share of their scales [1/s], steps to WAIT until it is kept again and the
    # PATIENCE that it had last, the mean SLOPE of the margin in the step before [1/s], the length of that, PAST [s], or 0: other sides.
    # Of events the same two; whether they were passed TWICE, the side that they changed TO, and values BETWEEN the ends of the step
    event_values: F2  # (VALUE_ROWS, values watched)
    samples: I1  # (sampled states,) taken so far of those with a period
    # [s] ascending: explicit methods that choose their steps end one there; implicit ones know corners themselves
    corners: F1
    # (PACES, PARTS) of each part of the duration: the longest step ALLOWED to begin there [s] where steps are chosen, the longest one
    # TAKEN and the shortest, LEAST [s], the largest angle that a body TURNED by in a step [rad], the largest kinetic energy of all
    # bodies MOVING at some steps [J]; of the steps that ended there, their number, STEPPED, the iterations of all of them and the most
    # of one
    pace: F2
    events: F2  # (capacity, 3) time [s], number of the event, direction 1 or -1
    # (capacity,) [s] times at which steps ended, step n in place n modulo the capacity; none where nobody asks for them
    ends: F1
    # (capacity, 3) times [s] FROM and UNTIL which steps are no longer than SHORT [s], where steps are chosen; infinite: none
    windows: F2


run_at = reader(Run)
# (evaluate, machine, history) and (evaluate, correct, step, machine, history)
STEP_SIGNATURE = Signature("status", ("entry", "machine", "machine"))
ADVANCE = Signature("status", ("entry", "entry", "entry", "machine", "machine"))
call_step = caller(STEP_SIGNATURE)


@leaf
def evaluate_at(evaluate, machine, run, t, y, rate):
    """rate := ẏ of y at t, one of the EVALUATIONS. Returns a status."""
    run.counter[EVALUATIONS] += 1
    return call_evaluate(evaluate, machine, t, y, rate)


@leaf
def add_rows(rows, h, weights, count, out):
    """out += h Σ weights[j] rows[j] over the first `count` rows."""
    for j in range(count):
        if weights[j] != 0.0:
            factor, row = h * weights[j], rows[j]
            add_times(factor, row, out)


@leaf
def sum_rows(rows, h, weights, count, out):
    """out = h Σ weights[j] rows[j] over the first `count` rows."""
    clear(out)
    add_rows(rows, h, weights, count, out)
