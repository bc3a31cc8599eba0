"""Adams–Moulton methods with a fixed step, their equations solved by iteration; order 1 is the implicit Euler method, 2 the
trapezoidal rule."""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import ORDER, REACHED, STEP, STEP_SIGNATURE, run_at
from nivel.integrate.loop.workspace import NUMBERS, ROWS
from nivel.integrate.multistep.adams_weights import MOULTON, predict_moulton, rates_before
from nivel.integrate.multistep.corrector import solve
from nivel.integrate.multistep.diagonal import begin_implicit
from nivel.integrate.multistep.multistep import remember
from nivel.native.entry import entry


@entry(STEP_SIGNATURE)
def moulton(evaluate, machine, history):
    """One step of Adams–Moulton of counter[ORDER]."""
    run = run_at(history)
    order = run.counter[ORDER]
    count = rates_before(order)
    if remember(history, count, 0) < count:
        return begin_implicit(evaluate, machine, history, order)
    predict_moulton(history, order)
    return solve(evaluate, machine, history, run.clock[REACHED], run.clock[STEP] * MOULTON[order, 0])


FACTS = tuple(
    IntegratorFacts(f"am{order}", moulton, order, ROWS, NUMBERS, kind="corrector", multistep=True)
    for order in range(1, len(MOULTON))
)
