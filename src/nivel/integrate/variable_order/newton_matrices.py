"""Newton's matrices of multistep methods that choose their steps: from differences of f, for any equations of motion; and from exact
derivatives of the equations of motion, sparse."""

from __future__ import annotations

from nivel.integrate.loop.run import REACHED, run_at
from nivel.integrate.multistep.newton import renew
from nivel.integrate.variable_order.nordsieck import SHARE
from nivel.kernels.algebra.lu import solve_lu
from nivel.kernels.core.status import OK
from nivel.kernels.residual.shifted_along import prepare_shifted, solve_shifted
from nivel.native.function import leaf


@leaf
def find_matrix(evaluate, machine, history, share, rate):
    """run.matrix := factors of 1 - share ∂f/∂y at run.trial, where `rate` is f. Returns a status."""
    run = run_at(history)
    return renew(evaluate, machine, history, run.clock[REACHED], share, run.trial, rate)


@leaf
def solve_matrix(machine, history, x):
    """Overwrite x (ny,) with the solution. Returns a status."""
    run = run_at(history)
    solve_lu(run.matrix, run.pivot, x)
    return OK


@leaf
def find_exact_matrix(evaluate, machine, history, share, rate):
    """The factors that 1 - share ∂f/∂y takes at run.trial, last evaluated with f = `rate`. Returns a status."""
    run = run_at(history)
    return prepare_shifted(machine, run.clock[REACHED], run.trial, rate, share)


@leaf
def solve_exact_matrix(machine, history, x):
    """Overwrite x (ny,) with the solution. Returns a status."""
    run = run_at(history)
    return solve_shifted(machine, run.clock[REACHED], x, run.numbers[SHARE], 0.0)
