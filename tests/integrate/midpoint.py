"""The integrator of docs/extending.md, "An integrator"."""

from nivel.integrate.loop.run import EVALUATIONS, STEP, STEP_SIGNATURE, TIME, run_at
from nivel.kernels.record.hook import call_evaluate
from nivel.native.entry import entry


@entry(STEP_SIGNATURE)
def midpoint(evaluate, machine, history):
    """Explicit midpoint rule (Runge 1895), order 2."""
    run = run_at(history)
    t, h, y, k = run.clock[TIME], run.clock[STEP], run.y, run.stages[0]
    for i in range(y.shape[0]):
        run.trial[i] = y[i] + 0.5 * h * run.rate[i]
    status = call_evaluate(evaluate, machine, t + 0.5 * h, run.trial, k)
    for i in range(y.shape[0]):
        y[i] += h * k[i]
    run.counter[EVALUATIONS] += 1
    return status
