"""Embedded explicit Runge–Kutta methods: step with an error estimate. Their stages are the rows of `run.stages`."""

from nivel.integrate.loop import step_control
from nivel.integrate.loop.run import RESTART, STEP, TIME, add_rows, evaluate_at, run_at
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.status import OK
from nivel.native.function import leaf, shared

# entries of run.numbers: the error of the last accepted step; whether this step was rejected before
LAST_ERROR, REPEATED = 0, 1


@leaf
def evaluate_stages(evaluate, machine, history, h, A, c, first, last):
    """Stages k_first … k_last - 1 of the table A, c. The argument of the last one is left in `run.trial`. Returns a status."""
    run = run_at(history)
    for s in range(first, last):
        copy(run.previous, run.trial)
        add_rows(run.stages, h, A[s], s, run.trial)
        status = evaluate_at(evaluate, machine, run, run.clock[TIME] + c[s] * h, run.trial, run.stages[s])
        if status != OK:
            return status
    return OK


@leaf
def begin(evaluate, machine, history, order, tolerance):
    """At the begin of a step, see `step_control.enter`; the first stage is the rate of the accepted state. The error falls with h^order."""
    run = run_at(history)
    step_control.enter(evaluate, machine, history, order - 1.0, tolerance)
    if step_control.is_fresh(run):
        run.numbers[LAST_ERROR] = 1.0
        run.counter[RESTART] = 0
    run.numbers[REPEATED] = 0.0
    copy(run.rate, run.stages[0])


@leaf
def is_accepted(machine, history, h, order, status, error):
    """Whether a step h whose error is `error` times the allowed one is taken; then y is the new state, `run.trial`. Sets clock[STEP].

    The last evaluation was one at the end of the step.
    """
    run = run_at(history)
    if status == OK and error <= 1.0 and step_control.exceeds_rotation_limit(machine, h) < 1.0:
        step_control.reject(run, h, step_control.exceeds_rotation_limit(machine, h))
        run.numbers[REPEATED] = 1.0
        return False
    if status != OK or not error <= 1.0:
        step_control.reject(run, h, step_control.factor_after_rejection(status, error, order))
        run.numbers[REPEATED] = 1.0
        return False
    run.clock[STEP] = h * step_control.factor_after_success(
        error, run.numbers[LAST_ERROR], order, run.numbers[REPEATED] == 1.0
    )
    run.numbers[LAST_ERROR] = error
    copy(run.trial, run.y)
    return True


@shared
def take_step(evaluate, machine, history, order, share, attempt):
    """Tries until a step is accepted: its status, and its size h [s], 0 where steps become too small. The error falls with h^order.

    share : of the tolerance that an error may have. attempt(evaluate, machine, history, h) : status and error of one try, compiled into
    this one.
    """
    run = run_at(history)
    tolerance = step_control.allowed(run, share)
    begin(evaluate, machine, history, order, tolerance)
    status, error = OK, 0.0
    while True:
        h = step_control.reach(run)
        if h == 0.0:
            return step_control.too_small(run, status, error), 0.0
        status, error = attempt(evaluate, machine, history, h)
        if is_accepted(machine, history, h, order, status, error / tolerance):
            return status, h
