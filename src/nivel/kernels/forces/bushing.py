"""Bushings: linear elastic connections of two markers in all six directions.

The deflection x = (A_iᵀ d, ψ) has the displacement of the second point and the rotation vector ψ of the second frame, both in the axes of
the first. The force is -(∂x/∂·)ᵀ (K x + D ẋ) with the exact derivative, so the elastic part has the potential ½ xᵀ K x at rotations of
any size below a whole turn.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.relative_rotation import rotation_vector, tangent_product
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_marker_force, add_torque
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at

# columns of `columns`; outputs, which springs between segments of beams do not have (NONE): magnitude of the force, power, force (3) and
# torque (3) on the second body, axes of the first
OUTPUT, FIRST, SECOND = 0, 1, 2
# columns of `number`: stiffness (36), damping (36), then 18 of work
STIFFNESS, DAMPING, X, RATE, EFFORT = 0, 36, 72, 78, 84


@family
def apply(machine, number, t):
    """All bushings."""
    record = record_at(machine)
    bodies, markers, elements, control = record.bodies, record.markers, record.elements, record.control
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        i, j, out = elements.columns[k, FIRST], elements.columns[k, SECOND], elements.columns[k, OUTPUT]
        n = elements.number[k]
        x, rate, effort = n[X:RATE], n[RATE:EFFORT], n[EFFORT : EFFORT + 6]
        A, ri, rj, vi, vj = markers.A[i], markers.r[i], markers.r[j], markers.rdot[i], markers.rdot[j]
        wi, wj = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
        d0, d1, d2 = rj[0] - ri[0], rj[1] - ri[1], rj[2] - ri[2]
        # ḋ seen from the first marker: ṙ_j - ṙ_i - ω_i × d
        e0 = vj[0] - vi[0] - (wi[1] * d2 - wi[2] * d1)
        e1 = vj[1] - vi[1] - (wi[2] * d0 - wi[0] * d2)
        e2 = vj[2] - vi[2] - (wi[0] * d1 - wi[1] * d0)
        w0, w1, w2 = wj[0] - wi[0], wj[1] - wi[1], wj[2] - wi[2]
        for a in range(3):
            x[a] = A[0, a] * d0 + A[1, a] * d1 + A[2, a] * d2
            rate[a] = A[0, a] * e0 + A[1, a] * e1 + A[2, a] * e2
            effort[a] = A[0, a] * w0 + A[1, a] * w1 + A[2, a] * w2
        rotation_vector(A, markers.A[j], x[3:6])
        tangent_product(x[3:6], effort[0:3], False, rate[3:6])
        stored, loss = 0.0, 0.0
        for a in range(6):
            elastic, damping = 0.0, 0.0
            for b in range(6):
                elastic += n[STIFFNESS + 6 * a + b] * x[b]
                damping += n[DAMPING + 6 * a + b] * rate[b]
            stored += 0.5 * elastic * x[a]
            loss += damping * rate[a]
            effort[a] = -elastic - damping
        control.stored[0] += stored
        control.power[1] += loss
        # the rotation vector's rates are no longer needed: their place takes the torque
        tangent_product(x[3:6], effort[3:6], True, rate[0:3])
        f0 = A[0, 0] * effort[0] + A[0, 1] * effort[1] + A[0, 2] * effort[2]
        f1 = A[1, 0] * effort[0] + A[1, 1] * effort[1] + A[1, 2] * effort[2]
        f2 = A[2, 0] * effort[0] + A[2, 1] * effort[1] + A[2, 2] * effort[2]
        m0 = A[0, 0] * rate[0] + A[0, 1] * rate[1] + A[0, 2] * rate[2]
        m1 = A[1, 0] * rate[0] + A[1, 1] * rate[1] + A[1, 2] * rate[2]
        m2 = A[2, 0] * rate[0] + A[2, 1] * rate[1] + A[2, 2] * rate[2]
        power = add_marker_force(bodies, markers, j, f0, f1, f2) + add_torque(bodies, markers.body[j], m0, m1, m2)
        # the first body gets the counter-force at its own marker, and the moment of the offset d
        power += add_marker_force(bodies, markers, i, -f0, -f1, -f2)
        t0, t1, t2 = m0 + d1 * f2 - d2 * f1, m1 + d2 * f0 - d0 * f2, m2 + d0 * f1 - d1 * f0
        power += add_torque(bodies, markers.body[i], -t0, -t1, -t2)
        if out != NONE:
            for a in range(3):
                record.outputs.value[out + 2 + a] = effort[a]
                record.outputs.value[out + 5 + a] = rate[a]
            record.outputs.value[out] = np.sqrt(f0 * f0 + f1 * f1 + f2 * f2)
            record.outputs.value[out + 1] = power
    return OK
