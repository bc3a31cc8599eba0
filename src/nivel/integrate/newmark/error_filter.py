"""What of an error of accelerations is slow: F δ = (M + c_v D + c_q K)⁻¹ M δ, along the constraints.

A vibration of angular frequency ω keeps 1/(1 + c_q ω²) of its part of δ, what no spring acts on all of it. c_q F δ is the displacement that
the springs make of the forces M δ within about √c_q of time: of a vibration faster than that its amplitude.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.newmark.residual_newton import apply_turns
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.tangent import EPSILON, POSITIONS, differentiate, load_twin
from nivel.kernels.solve.newton_matrix import factorise_entries, solve_entries
from nivel.native.function import leaf


@leaf
def find_filter(machine, t, cq, cv, cx):
    """The factors at the state, accelerations and multipliers in `residual`, frictions with stiction neither holding nor braking what they
    hold: an error of that is one of its place for ever. Returns a status."""
    record = record_at(machine)
    newton, stick = record.newton, record.control.stick
    tau, stick[0] = stick[0], np.inf
    status = differentiate(machine, t, cq, cv, cx, POSITIONS)
    stick[0] = tau
    for p in range(newton.value.shape[0]):
        newton.filter.value[p] = newton.value[p]
    return factorise_entries(newton, newton.filter, record.control.failure) if status == OK else status


@leaf
def keep_slow(machine, t, x):
    """Overwrite x, accelerations and then rates of states of forces, by what of it is slow. Returns a status."""
    record = record_at(machine)
    newton, here = record.newton, record.residual
    b, n, states = newton.filter.b, here.vdot.shape[0], newton.state.shape[0]
    twin, moving = load_twin(newton, here)
    for k in range(n):
        moving.vdot[k] += 1j * EPSILON * x[k]
    status = call_family(newton.address[1], twin, 0, complex(t))
    if status != OK:
        return status
    for k in range(n):
        b[k] = moving.value[k].imag / EPSILON
    for k in range(states):
        b[n + k] = x[n + k]
    for k in range(n + states, b.shape[0]):
        b[k] = 0.0
    solve_entries(newton, newton.filter)
    apply_turns(newton, b)
    for k in range(n + states):
        x[k] = b[k]
    return OK
