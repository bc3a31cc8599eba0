"""Point forces and torques of the user, and the power they bring into the machine."""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import stage
from nivel.kernels.function import evaluate_function

FORCE, TORQUE = 0, 1
GLOBAL_AXES, BODY_AXES = 0, 1


@stage
def apply_loads(record, t):
    """Add every load at time t to the wrench of its body; leave magnitude and power of each and the total power."""
    bodies, markers, loads = record.bodies, record.markers, record.loads
    record.control.power[0] = 0.0
    record.control.power[1] = 0.0
    for k in range(loads.what.shape[0]):
        marker = loads.what[k, 1]
        b = markers.body[marker]
        x = evaluate_function(record.functions, loads.functions[k, 0], t)
        y = evaluate_function(record.functions, loads.functions[k, 1], t)
        z = evaluate_function(record.functions, loads.functions[k, 2], t)
        loads.magnitude[k] = np.sqrt(x * x + y * y + z * z)
        if loads.what[k, 2] == BODY_AXES:
            A = bodies.A[b]
            x, y, z = (
                A[0, 0] * x + A[0, 1] * y + A[0, 2] * z,
                A[1, 0] * x + A[1, 1] * y + A[1, 2] * z,
                A[2, 0] * x + A[2, 1] * y + A[2, 2] * z,
            )
        F = bodies.wrench[b]
        if loads.what[k, 0] == FORCE:
            u = markers.u[marker]
            F[0] += x
            F[1] += y
            F[2] += z
            F[3] += u[1] * z - u[2] * y
            F[4] += u[2] * x - u[0] * z
            F[5] += u[0] * y - u[1] * x
            v = markers.rdot[marker]
            loads.power[k] = x * v[0] + y * v[1] + z * v[2]
        else:
            F[3] += x
            F[4] += y
            F[5] += z
            w = bodies.omega[b]
            loads.power[k] = x * w[0] + y * w[1] + z * w[2]
        record.control.power[0] += loads.power[k]
