"""Explicit Runge–Kutta methods with a fixed step."""

from __future__ import annotations

from nivel.kernels.compile import entry
from nivel.kernels.status import OK
from nivel.march.run import EVALUATIONS, STEP, TIME, run_at, step_signature


@entry(step_signature)
def rk4(evaluate, machine, history):
    """Classical method of order 4 (Kutta 1901; report 44, eq. 102). `run.rate` is the first stage."""
    run = run_at(history)
    t, h, y = run.clock[TIME], run.clock[STEP], run.y
    k1, k2, k3, k4, trial = run.rate, run.stages[0], run.stages[1], run.stages[2], run.stages[3]
    n = y.shape[0]
    for i in range(n):
        trial[i] = y[i] + 0.5 * h * k1[i]
    status = evaluate(machine, t + 0.5 * h, trial, k2)
    if status != OK:
        return status
    for i in range(n):
        trial[i] = y[i] + 0.5 * h * k2[i]
    status = evaluate(machine, t + 0.5 * h, trial, k3)
    if status != OK:
        return status
    for i in range(n):
        trial[i] = y[i] + h * k3[i]
    status = evaluate(machine, t + h, trial, k4)
    if status != OK:
        return status
    for i in range(n):
        y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])
    run.counter[EVALUATIONS] += 3
    return OK
