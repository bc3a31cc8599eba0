"""Residual and tangent for Python: for checks, linearisation and tests; time loops call the same code from inside."""

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import RESIDUAL, record_at
from nivel.kernels.residual.shifted_matrix import factorise_shifted, find_parts, keep_multipliers, solve_shifted_parts
from nivel.kernels.residual.tangent import POSITIONS, differentiate
from nivel.native.entry import entry
from nivel.native.signature import Signature


@entry(Signature("status", ("machine", "number")))
def evaluate_residual(machine, t):
    """Fill `residual.value` for the state, accelerations and multipliers there. Returns a status."""
    return call_hook(machine, RESIDUAL, 0, t)


@entry(Signature("status", ("machine", "number", "number", "number", "number")))
def find_tangent(machine, t, cq, cv, cx):
    """Fill `newton.value`, see `nivel.kernels.residual.tangent.differentiate`. Returns a status."""
    status = call_hook(machine, RESIDUAL, 0, t)
    return status if status != OK else differentiate(machine, t, cq, cv, cx, POSITIONS)


@entry(Signature("status", ("machine", "number", "vector", "vector", "number", "complex")))
def solve_shifted(machine, t, y, rate, s, z):
    """Overwrite `newton.shifted.real.r` and `pair.r` by the solutions of (1 - s ∂f/∂y) x = r and (1 - z ∂f/∂y) x = r, at the state y last
    evaluated, whose rate it is. Returns a status."""
    shifted = record_at(machine).newton.shifted
    keep_multipliers(machine)
    status = find_parts(machine, t, y, rate)
    if status == OK:
        status = factorise_shifted(machine, shifted.real, s)
    if status == OK:
        status = factorise_shifted(machine, shifted.pair, z)
    if status == OK:
        solve_shifted_parts(machine, shifted.real, s)
        solve_shifted_parts(machine, shifted.pair, z)
    return status
