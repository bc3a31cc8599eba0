"""BDF (Gear's methods) of orders 1 to 5, of variable step.

It damps and delays every period a little, so its errors add up: a step gets SHARE of the tolerance, or when that would be more than TOTAL
for all the steps so far, a share of TOTAL. After many periods the errors have then grown as the logarithm of the number of steps.
"""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import DONE_STEPS, STEP_SIGNATURE, run_at
from nivel.integrate.loop.step_control import allowed
from nivel.integrate.variable_order.difference_matrix import find_matrix, solve_matrix
from nivel.integrate.variable_order.multistep_polynomials import BDF
from nivel.integrate.variable_order.variable_corrector import corrector
from nivel.integrate.variable_order.variable_order import multistep
from nivel.integrate.variable_order.variable_workspace import NUMBERS, ROWS
from nivel.native.entry import entry
from nivel.native.function import leaf

MOST_ORDER = 5
SHARE, TOTAL = 0.001, 0.3

variable_step = multistep(BDF, MOST_ORDER, *corrector(find_matrix, solve_matrix))


@leaf
def of_step(history):
    """What the next step may be wrong by, as a share of the scales."""
    run = run_at(history)
    return allowed(run, min(SHARE, TOTAL / (1.0 + run.counter[DONE_STEPS])))


@entry(STEP_SIGNATURE)
def gear(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, of_step(history))


FACTS = (IntegratorFacts("gear", gear, MOST_ORDER, ROWS, NUMBERS, kind="corrector", multistep=True),)
