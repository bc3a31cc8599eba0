"""Newton's matrix of multistep methods that choose their steps, from differences of f: for any equations of motion."""

from __future__ import annotations

from nivel.integrate.loop.run import REACHED, run_at
from nivel.integrate.multistep.newton import renew
from nivel.kernels.algebra.lu import solve_lu
from nivel.kernels.core.status import OK
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
