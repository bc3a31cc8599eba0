"""A hand: a spring with a damper from a point of the body that is chosen to a point in space."""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

OUTPUT, PULL, BODY, POINT, TOWARDS = 0, 1, 2, 3, 6  # of columns; functions, three each of the last two
SPRING, DAMPER = 0, 1  # of numbers: ω² and 2 ζ ω, per mass


@family
def apply(machine, number, t):
    """m pull (ω² (towards - p) - 2 ζ ω ṗ) at p = R + A u; its power counts as work from outside."""
    record = record_at(machine)
    bodies, elements, out = record.bodies, record.elements, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        first = index[OUTPUT]
        out[first] = out[first + 1] = 0.0
        pull = evaluate_function(machine, index[PULL], t)
        chosen = np.floor(real(evaluate_function(machine, index[BODY], t)) + 0.5)
        if real(pull) == 0.0 or not 0.0 <= chosen < bodies.mass.shape[0]:
            continue
        b = np.int64(chosen)
        A, R, V, w = bodies.A[b], bodies.R[b], bodies.Rdot[b], bodies.omega[b]
        x = evaluate_function(machine, index[POINT], t)
        y = evaluate_function(machine, index[POINT + 1], t)
        z = evaluate_function(machine, index[POINT + 2], t)
        u0 = A[0, 0] * x + A[0, 1] * y + A[0, 2] * z
        u1 = A[1, 0] * x + A[1, 1] * y + A[1, 2] * z
        u2 = A[2, 0] * x + A[2, 1] * y + A[2, 2] * z
        v0, v1, v2 = V[0] + w[1] * u2 - w[2] * u1, V[1] + w[2] * u0 - w[0] * u2, V[2] + w[0] * u1 - w[1] * u0
        x = evaluate_function(machine, index[TOWARDS], t) - R[0] - u0
        y = evaluate_function(machine, index[TOWARDS + 1], t) - R[1] - u1
        z = evaluate_function(machine, index[TOWARDS + 2], t) - R[2] - u2
        strength = pull * bodies.mass[b]
        f0 = strength * (n[SPRING] * x - n[DAMPER] * v0)
        f1 = strength * (n[SPRING] * y - n[DAMPER] * v1)
        f2 = strength * (n[SPRING] * z - n[DAMPER] * v2)
        F = bodies.wrench[b]
        F[0] += f0
        F[1] += f1
        F[2] += f2
        F[3] += u1 * f2 - u2 * f1
        F[4] += u2 * f0 - u0 * f2
        F[5] += u0 * f1 - u1 * f0
        power = f0 * v0 + f1 * v1 + f2 * v2
        out[first], out[first + 1] = np.sqrt(f0 * f0 + f1 * f1 + f2 * f2), power
        record.control.power[0] += power
    return OK
