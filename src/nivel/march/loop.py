"""The only loop: steps until the end, a full buffer, a spent budget or a failure, and resumes exactly where it stopped."""

from __future__ import annotations

from nivel.kernels.compile import entry, leaf
from nivel.kernels.handle import address_type
from nivel.kernels.observe import accept, observe
from nivel.kernels.record import record_at
from nivel.kernels.saddle import contradicts
from nivel.kernels.status import BUDGET_SPENT, BUFFER_FULL, CONTRADICTION, DONE, NOT_FINITE, OK
from nivel.march.run import (
    ALL_STEPS,
    BUDGET,
    DONE_STEPS,
    END,
    EVALUATED,
    EVALUATIONS,
    EVERY,
    FRAMES,
    LAST_FRAME,
    START,
    STEP,
    TIME,
    correct_type,
    evaluate_type,
    run_at,
    step_type,
)


@leaf
def time_of(run, n):
    """Time after n steps; not a running sum, so it carries no round-off from step to step. The last step ends at the end."""
    if n == run.counter[ALL_STEPS]:
        return run.clock[END]
    return run.clock[START] + n * run.clock[STEP]


@leaf
def finite(y):
    """Whether every entry is a number (a NaN or an infinity makes the difference a NaN)."""
    total = 0.0
    for i in range(y.shape[0]):
        total += y[i] - y[i]
    return total == 0.0


@leaf
def unfed_evaluation(evaluate, machine, history):
    """Evaluate again without Baumgarte's feedback where there is one: its multipliers and accelerations steer the numbers back, they
    are not those of the machine (with eq. 111 the difference is per cent and does not vanish with the step). `rate` stays."""
    run = run_at(history)
    feedback = record_at(machine).control.stabilise
    twice_alpha, beta_squared = feedback[0], feedback[1]
    if twice_alpha == 0.0 and beta_squared == 0.0:
        return OK
    feedback[0], feedback[1] = 0.0, 0.0
    status = evaluate(machine, run.clock[TIME], run.y, run.scratch)
    feedback[0], feedback[1] = twice_alpha, beta_squared
    run.counter[EVALUATIONS] += 1
    return status


@entry((evaluate_type, correct_type, step_type, address_type, address_type))
def advance(evaluate, correct, step, machine, history):
    """March until something has to be done outside; returns a status of `nivel.kernels.status`.

    Each step: evaluate at the accepted state, accept it, write a frame if one is due, step, correct. Where a step fails, `run.y` is
    not that of an accepted state; `run.previous` and `run.clock` are.
    """
    run = run_at(history)
    clock, counter = run.clock, run.counter
    h = clock[STEP]
    budget = counter[BUDGET]
    while True:
        n = counter[DONE_STEPS]
        clock[TIME] = time_of(run, n)
        last = n == counter[ALL_STEPS]
        due = (n % counter[EVERY] == 0 or last) and counter[LAST_FRAME] != n
        if due and counter[FRAMES] == run.frames.shape[0]:
            return BUFFER_FULL
        if counter[EVALUATED] == 0:
            for i in range(run.y.shape[0]):
                run.previous[i] = run.y[i]
            status = evaluate(machine, clock[TIME], run.y, run.rate)
            counter[EVALUATIONS] += 1
            if status != OK:
                return status
            if not finite(run.rate):
                return NOT_FINITE
            record = record_at(machine)
            if contradicts(record.saddle, record.constraints, record.control.failure):
                return CONTRADICTION
            counter[EVALUATED] = 1
            accept(machine, clock[TIME])
            if due:
                status = unfed_evaluation(evaluate, machine, history)
                if status != OK:
                    return status
                frame = run.frames[counter[FRAMES]]
                frame[0] = clock[TIME]
                observe(machine, clock[TIME], run.y, frame)
                counter[FRAMES] += 1
                counter[LAST_FRAME] = n
        if last:
            return DONE
        if budget == 0:
            return BUDGET_SPENT
        budget -= 1
        clock[STEP] = time_of(run, n + 1) - clock[TIME] if n + 1 == counter[ALL_STEPS] else h
        status = step(evaluate, machine, history)
        clock[STEP] = h
        counter[EVALUATED] = 0
        if status == OK:
            status = correct(machine, time_of(run, n + 1), run.y)
        if status != OK:
            return status
        if not finite(run.y):
            return NOT_FINITE
        counter[DONE_STEPS] = n + 1
