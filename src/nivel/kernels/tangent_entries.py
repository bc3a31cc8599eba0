"""Residual and tangent for Python: for checks, linearisation and tests; time loops call the same code from inside."""

from __future__ import annotations

from numba import types

from nivel.kernels.compile import entry
from nivel.kernels.handle import address_type
from nivel.kernels.hook import call_hook
from nivel.kernels.record import RESIDUAL
from nivel.kernels.tangent import POSITIONS, differentiate

_number = types.float64


@entry(types.int64(address_type, _number))
def evaluate_residual(machine, t):
    """Fill `residual.value` for the state, accelerations and multipliers there. Returns a status."""
    return call_hook(machine, RESIDUAL, 0, t)


@entry(types.int64(address_type, _number, _number, _number, _number))
def find_tangent(machine, t, cq, cv, cx):
    """Fill `newton.value`, see `nivel.kernels.tangent.differentiate`. Returns a status."""
    return differentiate(machine, t, cq, cv, cx, POSITIONS)
