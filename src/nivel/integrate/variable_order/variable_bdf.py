"""BDF of orders 1 to 5, of variable step, for stiff machines: Newton's iteration with exact tangents
(`nivel.kernels.residual.shifted_along`)."""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import STEP_SIGNATURE
from nivel.integrate.variable_order.exact_matrix import find_matrix, solve_matrix
from nivel.integrate.variable_order.multistep_polynomials import BDF
from nivel.integrate.variable_order.variable_corrector import corrector
from nivel.integrate.variable_order.variable_gear import MOST_ORDER, of_step
from nivel.integrate.variable_order.variable_order import multistep
from nivel.integrate.variable_order.variable_workspace import NUMBERS, ROWS
from nivel.native.entry import entry

variable_step = multistep(BDF, MOST_ORDER, *corrector(find_matrix, solve_matrix))


@entry(STEP_SIGNATURE)
def bdf(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, of_step(history))


FACTS = (IntegratorFacts("bdf", bdf, MOST_ORDER, ROWS, NUMBERS, kind="corrector", needs="directions", multistep=True),)
