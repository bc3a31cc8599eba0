"""Multistep methods of variable step and order: Adams–Moulton of orders 1 to 11, which with functional iteration goes on from the next
order, and BDF of orders 1 to 5, with matrices from differences or with exact tangents."""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import DONE_STEPS, STEP_SIGNATURE, run_at
from nivel.integrate.loop.step_control import allowed
from nivel.integrate.variable_order.multistep_polynomials import ADAMS, BDF
from nivel.integrate.variable_order.newton_matrices import (
    find_exact_matrix,
    find_matrix,
    solve_exact_matrix,
    solve_matrix,
)
from nivel.integrate.variable_order.nordsieck import NUMBERS, ROWS
from nivel.integrate.variable_order.variable_corrector import corrector
from nivel.integrate.variable_order.variable_order import multistep
from nivel.native.entry import entry
from nivel.native.function import leaf

MOST_ORDER = 11
SHARE = 0.03

variable_step = multistep(ADAMS, MOST_ORDER, *corrector(find_matrix, solve_matrix))


@entry(STEP_SIGNATURE)
def adams(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, allowed(run_at(history), SHARE))


# BDF (Gear's methods) of orders 1 to 5, of variable step.
#
# It damps and delays every period a little, so its errors add up: a step gets BDF_SHARE of the tolerance, or when that would be more than
# BDF_TOTAL for all the steps so far, a share of BDF_TOTAL. After many periods the errors have then grown as the logarithm of the number of
# steps.

MOST_BDF_ORDER = 5
BDF_SHARE, BDF_TOTAL = 0.001, 0.3

gear_step = multistep(BDF, MOST_BDF_ORDER, *corrector(find_matrix, solve_matrix))


@leaf
def of_step(history):
    """What the next step may be wrong by, as a share of the scales."""
    run = run_at(history)
    return allowed(run, min(BDF_SHARE, BDF_TOTAL / (1.0 + run.counter[DONE_STEPS])))


@entry(STEP_SIGNATURE)
def gear(evaluate, machine, history):
    """One accepted step."""
    return gear_step(evaluate, machine, history, of_step(history))


# BDF of orders 1 to 5, of variable step, for stiff machines: Newton's iteration with exact tangents
# (`nivel.kernels.residual.shifted_along`).

bdf_step = multistep(BDF, MOST_BDF_ORDER, *corrector(find_exact_matrix, solve_exact_matrix))


@entry(STEP_SIGNATURE)
def bdf(evaluate, machine, history):
    """One accepted step."""
    return bdf_step(evaluate, machine, history, of_step(history))


FACTS = (
    IntegratorFacts("adams", adams, MOST_ORDER + 1, ROWS, NUMBERS, kind="corrector", multistep=True),
    IntegratorFacts("gear", gear, MOST_BDF_ORDER, ROWS, NUMBERS, kind="corrector", multistep=True),
    IntegratorFacts("bdf", bdf, MOST_BDF_ORDER, ROWS, NUMBERS, kind="corrector", needs="directions", multistep=True),
)
