"""Adams–Moulton of variable step and order, 1 to 11; with functional iteration a step goes on from the next order."""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import STEP_SIGNATURE, run_at
from nivel.integrate.loop.step_control import allowed
from nivel.integrate.variable_order.difference_matrix import find_matrix, solve_matrix
from nivel.integrate.variable_order.multistep_polynomials import ADAMS
from nivel.integrate.variable_order.variable_corrector import corrector
from nivel.integrate.variable_order.variable_order import multistep
from nivel.integrate.variable_order.variable_workspace import NUMBERS, ROWS
from nivel.native.entry import entry

MOST_ORDER = 11
SHARE = 0.03

variable_step = multistep(ADAMS, MOST_ORDER, *corrector(find_matrix, solve_matrix))


@entry(STEP_SIGNATURE)
def adams(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, allowed(run_at(history), SHARE))


FACTS = (IntegratorFacts("adams", adams, MOST_ORDER + 1, ROWS, NUMBERS, kind="corrector", multistep=True),)
