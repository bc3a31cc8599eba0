"""Newton's matrix of multistep methods that choose their steps, from exact derivatives of the equations of motion; sparse."""

from __future__ import annotations

from nivel.integrate.loop.run import REACHED, run_at
from nivel.integrate.variable_order.variable_workspace import SHARE
from nivel.kernels.residual.shifted_along import prepare_shifted, solve_shifted
from nivel.native.function import leaf


@leaf
def find_matrix(evaluate, machine, history, share, rate):
    """The factors that 1 - share ∂f/∂y takes at run.trial, last evaluated with f = `rate`. Returns a status."""
    run = run_at(history)
    return prepare_shifted(machine, run.clock[REACHED], run.trial, rate, share)


@leaf
def solve_matrix(machine, history, x):
    """Overwrite x (ny,) with the solution. Returns a status."""
    run = run_at(history)
    return solve_shifted(machine, run.clock[REACHED], x, run.numbers[SHARE], 0.0)
