"""Entries of statics: derivatives of its residual with respect to positions, multipliers and time, each on its own."""

from nivel.kernels.core.lanes import slope, unit
from nivel.kernels.core.status import OK
from nivel.kernels.output.observe import accept
from nivel.kernels.record.hook import call_family
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.tangent import differentiate_parts, load_twin
from nivel.native.entry import entry
from nivel.native.signature import Signature


@entry(Signature("status", ("machine", "number")))
def find_parts(machine, t):
    """Fill newton.shifted.M, D and K for `residual.y`, `vdot` and `lam`. Returns a status."""
    return differentiate_parts(machine, t)


@entry(Signature("status", ("machine", "number", "vector")))
def find_time_slope(machine, t, out):
    """out := ∂/∂t of all entries of `residual.value`, of functions of time alone. Returns a status."""
    record = record_at(machine)
    newton = record.newton
    twin, moving = load_twin(machine)
    status = call_family(newton.address[1], twin, 0, t + unit(0, 1.0))
    if status != OK:
        return status
    for k in range(out.shape[0]):
        out[k] = slope(moving.value[k], 0)
    return OK


@entry(Signature("nothing", ("machine", "number")))
def accept_state(machine, t):
    """Follow the angles of joints, and keep what forces remember, in the state last evaluated."""
    accept(machine, t)
