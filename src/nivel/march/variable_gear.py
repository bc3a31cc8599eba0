"""BDF (Gear's methods) of orders 1 to 5, of variable step."""

from __future__ import annotations

from nivel.kernels.compile import entry
from nivel.march.multistep_polynomials import BDF
from nivel.march.run import TOLERANCE, run_at, step_signature
from nivel.march.variable_order import variable_step

MOST_ORDER = 5
SHARE = 0.1


@entry(step_signature)
def gear(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, BDF, MOST_ORDER, SHARE * run_at(history).clock[TOLERANCE])
