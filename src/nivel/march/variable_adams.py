"""Adams–Moulton of orders 1 to 12, of variable step."""

from __future__ import annotations

from nivel.kernels.compile import entry
from nivel.march.multistep_polynomials import ADAMS
from nivel.march.run import TOLERANCE, run_at, step_signature
from nivel.march.variable_order import variable_step

MOST_ORDER = 12
SHARE = 0.1


@entry(step_signature)
def adams(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, ADAMS, MOST_ORDER, SHARE * run_at(history).clock[TOLERANCE])
