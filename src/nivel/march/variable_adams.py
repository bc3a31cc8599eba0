"""Adams–Moulton of orders 1 to 12, of variable step."""

from __future__ import annotations

from nivel.march.difference_matrix import find_matrix, solve_matrix
from nivel.march.multistep_polynomials import ADAMS
from nivel.march.run import STEP_SIGNATURE, run_at
from nivel.march.step_control import allowed
from nivel.march.variable_corrector import corrector
from nivel.march.variable_order import multistep
from nivel.native.entry import entry

MOST_ORDER = 11
SHARE = 0.03

variable_step = multistep(ADAMS, MOST_ORDER, *corrector(find_matrix, solve_matrix))


@entry(STEP_SIGNATURE)
def adams(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, allowed(run_at(history), SHARE))
