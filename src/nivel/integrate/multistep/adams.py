"""Explicit Adams methods with a fixed step: Bashforth's, and the pairs that predict, evaluate and correct once (report 44, Fig. 15)."""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import EVALUATIONS, ITERATIONS, ORDER, REACHED, STEP, STEP_SIGNATURE, run_at
from nivel.integrate.loop.workspace import KNOWN, NUMBERS, RATE, ROWS
from nivel.integrate.multistep.adams_weights import BASHFORTH, MOULTON, add_rates, predict_moulton, rates_before
from nivel.integrate.multistep.multistep import begin, remember
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_evaluate
from nivel.native.entry import entry


@entry(STEP_SIGNATURE)
def bashforth(evaluate, machine, history):
    """One step of Adams–Bashforth of counter[ORDER]."""
    run = run_at(history)
    order = run.counter[ORDER]
    if remember(history, order, 0) < order:
        return begin(evaluate, machine, history, order)
    add_rates(history, BASHFORTH[order], order, run.y)
    return OK


@entry(STEP_SIGNATURE)
def predict_correct(evaluate, machine, history):
    """One step of Adams–Bashforth–Moulton of counter[ORDER]: predict, evaluate, correct; the loop evaluates at the accepted state."""
    run = run_at(history)
    order = run.counter[ORDER]
    count = rates_before(order)
    if remember(history, count, 0) < count:
        return begin(evaluate, machine, history, order)
    predict_moulton(history, order)
    known, rate, share = run.stages[KNOWN], run.stages[RATE], run.clock[STEP] * MOULTON[order, 0]
    status = call_evaluate(evaluate, machine, run.clock[REACHED], run.y, rate)
    run.counter[EVALUATIONS] += 1
    run.counter[ITERATIONS] += 1
    if status != OK:
        return status
    for i in range(known.shape[0]):
        run.y[i] = known[i] + share * rate[i]
    return OK


# by order: the largest |rate| times step that Bashforth's methods hold
HELD = {1: 2.0, 2: 1.0, 3: 0.5, 4: 0.3, 5: 0.16}
FACTS = (
    *(
        IntegratorFacts(f"ab{order}", bashforth, order, ROWS, NUMBERS, multistep=True, held=held)
        for order, held in HELD.items()
    ),
    *(IntegratorFacts(f"abm{order}", predict_correct, order, ROWS, NUMBERS, multistep=True) for order in HELD),
)
