"""Shared parts of multistep methods: rates and states of the last steps, and the one-step method that provides the first of them.

The history is of equally long steps. The shorter last step of a run, and an event, break it: Kutta's method of order 4 takes over until
there is enough history again. Its local error falls with h⁵, as the global one of a method of order 5, and the steps without history
are few; for order 5 two half steps make their error a sixteenth, so that it is not the one that counts.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.explicit.runge_kutta import explicit
from nivel.integrate.loop.run import EVALUATIONS, RESTART, STEP, TIME, run_at
from nivel.integrate.loop.workspace import PAST, RATES, SPACING, STATES, WORK
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_evaluate
from nivel.native.function import leaf

# Steps that differ by less are equal: their times carry round-off of up to 1e-16 of the time since the start.
SAME = 1e-6


@leaf
def shift(rows, count, y):
    """Move the first `count` - 1 of these rows by one and put y in front."""
    for k in range(count - 1):
        newer, older = rows[count - 2 - k], rows[count - 1 - k]
        for i in range(y.shape[0]):
            older[i] = newer[i]
    for i in range(y.shape[0]):
        rows[0, i] = y[i]


@leaf
def remember(history, rates, states):
    """Put the accepted state into the history of so many rates and states. Returns how many accepted states are there."""
    run = run_at(history)
    h, numbers = run.clock[STEP], run.numbers
    if run.counter[RESTART] == 1 or np.abs(h - numbers[SPACING]) > SAME * h:
        run.counter[RESTART] = 0
        numbers[:] = 0.0
        numbers[SPACING] = h
    shift(run.stages[RATES:STATES], rates, run.rate)
    shift(run.stages[STATES:], states, run.y)
    numbers[PAST] += 1.0
    return numbers[PAST]


@leaf
def begin(evaluate, machine, history, order):
    """A step without history, for a method of `order`. Returns a status."""
    run = run_at(history)
    t, h, n = run.clock[TIME], run.clock[STEP], run.y.shape[0]
    for i in range(n):
        run.stages[WORK, i] = run.rate[i]
    if order <= 4:
        return explicit(evaluate, machine, history, 4, t, h, WORK)
    status = explicit(evaluate, machine, history, 4, t, 0.5 * h, WORK)
    if status != OK:
        return status
    status = call_evaluate(evaluate, machine, t + 0.5 * h, run.y, run.stages[WORK])
    run.counter[EVALUATIONS] += 1
    if status != OK:
        return status
    return explicit(evaluate, machine, history, 4, t + 0.5 * h, 0.5 * h, WORK)
