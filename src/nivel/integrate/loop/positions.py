"""Kinematic analysis: the positions of a fully driven machine one after the other, without any integration.

From the last position, its velocities and accelerations, the next one is predicted to second order and closed by Newton's method
(`correct`); velocities and accelerations follow from C_q v = -C_t and C_q v̇ = γ. A step is halved where it is long, where it cannot be
closed, or where it is closed far from the prediction, which may be another branch.
"""

import numpy as np

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.loop import at_end, finite, is_due, write_frame
from nivel.integrate.loop.samples import time_of
from nivel.kernels.algebra.rotation import product
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.status import BUDGET_SPENT, BUFFER_FULL, CONTRADICTION, DONE, NOT_CLOSED, NOT_FINITE, OK
from nivel.kernels.output.observe import accept
from nivel.kernels.record.hook import call_correct
from nivel.kernels.record.record import record_at
from nivel.kernels.solve.saddle import contradicts, exceeds
from nivel.native.entry import entry
from nivel.native.function import leaf
from nivel.native.signature import Signature

FOLLOW = Signature("status", ("entry", "entry", "machine", "machine"))
# Rows of an accepted position are closed to this share of their scales.
CLOSED = 1e-12
# A step may move positions by this share of their scales; and its correction by half of what was predicted and a little.
LONGEST, PREDICTED, LITTLE = 0.3, 0.5, 0.01
# Steps shorter than this share of the way between two frames lead nowhere.
SHORTEST = 1e-10
ATTEMPTS = 4


@leaf
def predict(run, h):
    """run.y := the state h [s] after the accepted one, `previous`, by its velocities and accelerations."""
    y, before, rate = run.y, run.previous, run.rate
    copy(before, y)
    for k in range(run.plain.shape[0]):
        q, v = np.int64(run.plain[k, 0]), np.int64(run.plain[k, 1])
        y[q] += h * (rate[q] + 0.5 * h * rate[v])
        y[v] += h * rate[v]
    for k in range(run.turns.shape[0]):
        q, v = np.int64(run.turns[k, 0]), np.int64(run.turns[k, 1])
        x = h * (before[v] + 0.5 * h * rate[v])
        z0 = h * (before[v + 1] + 0.5 * h * rate[v + 1])
        z1 = h * (before[v + 2] + 0.5 * h * rate[v + 2])
        half = 0.5 * np.sqrt(x * x + z0 * z0 + z1 * z1)
        share = 0.5 * (np.sin(half) / half if half > 1e-6 else 1.0 - half * half / 6.0)
        turn = np.cos(half), share * x, share * z0, share * z1
        product(before[q : q + 4], turn, y[q : q + 4])
        for i in range(3):
            y[v + i] += h * rate[v + i]


@leaf
def largest_change(run, first, second):
    """The largest difference of the positions of two states, as a share of their scales."""
    largest = 0.0
    for k in range(run.plain.shape[0]):
        q = run.plain[k, 0]
        largest = max(largest, np.abs(first[q] - second[q]) / run.scale[q])
    for k in range(run.turns.shape[0]):
        q = np.int64(run.turns[k, 0])
        for i in range(4):
            largest = max(largest, np.abs(first[q + i] - second[q + i]))
    return largest


@leaf
def close(correct, machine, run, t):
    """Close run.y at the time t, near where it was predicted. Returns a status."""
    record = record_at(machine)
    copy(run.y, run.trial)
    way = largest_change(run, run.y, run.previous)
    if not way <= LONGEST:
        return NOT_CLOSED
    for attempt in range(ATTEMPTS):
        status = call_correct(correct, machine, t, run.y)
        if status != OK:
            return status
        # the second correction finds velocities with the factor at the position itself
        if attempt > 0 and not exceeds(record.saddle, record.constraints.C, record.constraints.scale, CLOSED):
            near = largest_change(run, run.y, run.trial) <= PREDICTED * way + LITTLE
            return OK if near and finite(run.y) else NOT_CLOSED
    return NOT_CLOSED


@leaf
def keep(machine, run, t):
    """Accept the state run.y at the time t, whose rate is `scratch`."""
    for i in range(run.y.shape[0]):
        run.previous[i] = run.y[i]
        run.rate[i] = run.scratch[i]
    run.clock[of_run.TIME], run.clock[of_run.ACCEPTED], run.clock[of_run.REACHED] = t, t, t
    accept(machine, t)


@leaf
def evaluated(evaluate, machine, run, t):
    """`scratch` := the rate of run.y. Returns a status."""
    record = record_at(machine)
    status = of_run.evaluate_at(evaluate, machine, run, t, run.y, run.scratch)
    if status == OK and not finite(run.scratch):
        return NOT_FINITE
    if status == OK and contradicts(record.saddle, record.constraints, record.control.failure):
        return CONTRADICTION
    return status


@leaf
def reach(evaluate, correct, machine, run, target):
    """Go from the accepted position to that at the time `target`, in as many steps as it takes. Returns a status."""
    clock = run.clock
    h, least = run.numbers[0], SHORTEST * (target - clock[of_run.TIME])
    while clock[of_run.TIME] < target:
        left = target - clock[of_run.TIME]
        whole = not 0.0 < h < left * (1.0 - 1e-9)
        t = target if whole else clock[of_run.TIME] + h
        h = left if whole else h
        predict(run, h)
        status = close(correct, machine, run, t)
        if status == OK:
            status = evaluated(evaluate, machine, run, t)
        if status == CONTRADICTION:
            return status
        if status == OK:
            keep(machine, run, t)
            h = 2.0 * h
        else:
            h *= 0.5
            run.counter[of_run.REJECTED] += 1
            if h < least:
                copy(run.previous, run.y)
                return status
    run.numbers[0] = h
    return OK


@entry(FOLLOW)
def follow_positions(evaluate, correct, machine, history):
    """Positions at all times of frames, until the end, a full buffer, a spent budget or a failure; goes on where it stopped. Returns a
    status. Where it fails, `previous` at clock[ACCEPTED] is the last position that could be closed."""
    run = of_run.run_at(history)
    counter, budget = run.counter, run.counter[of_run.BUDGET]
    if counter[of_run.EVALUATED] == 0:
        t = run.clock[of_run.TIME]
        status = call_correct(correct, machine, t, run.y)
        if status == OK:
            status = evaluated(evaluate, machine, run, t)
        if status != OK:
            return status
        keep(machine, run, t)
        counter[of_run.EVALUATED] = 1
    while True:
        if is_due(run):
            if counter[of_run.FRAMES] == run.frames.shape[0]:
                return BUFFER_FULL
            write_frame(machine, history, run.clock[of_run.TIME], run.y)
        if at_end(run):
            return DONE
        if budget == 0:
            return BUDGET_SPENT
        budget -= 1
        status = reach(evaluate, correct, machine, run, time_of(run, counter[of_run.DONE_STEPS] + 1))
        if status != OK:
            return status
        counter[of_run.DONE_STEPS] += 1
