"""Bushings: linear elastic connections of two markers in all six directions.

The deflection x = (A_iᵀ d, ψ) has the displacement of the second point and the rotation vector ψ of the second frame, both in the axes of
the first. The force is -(∂x/∂·)ᵀ (K x + D ẋ) with the exact derivative, so the elastic part has the potential ½ xᵀ K x at rotations of
any size below a whole turn.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.analytic import arctan2, real
from nivel.kernels.compile import stage
from nivel.kernels.forces.push import push_marker, twist_body
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.spatial import dot
from nivel.kernels.status import OK

# columns of `columns`; outputs: magnitude of the force, power, force (3) and torque (3) on the second body, axes of the first
OUTPUT, FIRST, SECOND = 0, 1, 2
# columns of `number`: stiffness (36), damping (36), then 18 of work
STIFFNESS, DAMPING, X, RATE, EFFORT = 0, 36, 72, 78, 84


@stage
def rotation_vector(A, B, psi):
    """ψ (3,) of AᵀB, |ψ| ≤ π, through the Euler parameters of the largest component's branch (Shepperd 1978)."""
    r00 = A[0, 0] * B[0, 0] + A[1, 0] * B[1, 0] + A[2, 0] * B[2, 0]
    r11 = A[0, 1] * B[0, 1] + A[1, 1] * B[1, 1] + A[2, 1] * B[2, 1]
    r22 = A[0, 2] * B[0, 2] + A[1, 2] * B[1, 2] + A[2, 2] * B[2, 2]
    r01 = A[0, 0] * B[0, 1] + A[1, 0] * B[1, 1] + A[2, 0] * B[2, 1]
    r10 = A[0, 1] * B[0, 0] + A[1, 1] * B[1, 0] + A[2, 1] * B[2, 0]
    r02 = A[0, 0] * B[0, 2] + A[1, 0] * B[1, 2] + A[2, 0] * B[2, 2]
    r20 = A[0, 2] * B[0, 0] + A[1, 2] * B[1, 0] + A[2, 2] * B[2, 0]
    r12 = A[0, 1] * B[0, 2] + A[1, 1] * B[1, 2] + A[2, 1] * B[2, 2]
    r21 = A[0, 2] * B[0, 1] + A[1, 2] * B[1, 1] + A[2, 2] * B[2, 1]
    trace = r00 + r11 + r22
    x, y, z, w = real(r00), real(r11), real(r22), real(trace)
    if w >= x and w >= y and w >= z:
        e0, e1, e2, e3 = 1.0 + trace, r21 - r12, r02 - r20, r10 - r01
    elif x >= y and x >= z:
        e0, e1, e2, e3 = r21 - r12, 1.0 + 2.0 * r00 - trace, r10 + r01, r02 + r20
    elif y >= z:
        e0, e1, e2, e3 = r02 - r20, r10 + r01, 1.0 + 2.0 * r11 - trace, r21 + r12
    else:
        e0, e1, e2, e3 = r10 - r01, r02 + r20, r21 + r12, 1.0 + 2.0 * r22 - trace
    sign = 1.0 if real(e0) >= 0.0 else -1.0
    sine = np.sqrt(e1 * e1 + e2 * e2 + e3 * e3)
    length = np.sqrt(e0 * e0 + sine * sine)
    # ψ = 2 atan2(sine, e0) e/sine; 2 e/e0 in the limit
    factor = sign * 2.0 * arctan2(sine, sign * e0) / sine if real(sine) > 1e-9 * real(length) else 2.0 / e0
    psi[0], psi[1], psi[2] = factor * e1, factor * e2, factor * e3


@stage
def tangent_product(psi, w, transpose, out):
    """out = T⁻¹ w (ψ̇ for the relative angular velocity w in the axes of the first marker) or T⁻ᵀ w.

    T⁻¹ = 1 - ½ ψ̃ + η ψ̃², η = (1 - ½ θ cot ½θ)/θ²: 1/12 + θ²/720 for small θ. ψ̇ = T⁻¹ w with w = ω_j - ω_i in the axes of i, where
    the turned frame is AᵀB and its angular velocity is given in fixed axes.
    """
    square = dot(psi, psi)
    theta = np.sqrt(square)
    eta = (1.0 - 0.5 * theta / np.tan(0.5 * theta)) / square if real(theta) > 1e-3 else 1.0 / 12.0 + square / 720.0
    half = 0.5 if transpose else -0.5
    c0, c1, c2 = psi[1] * w[2] - psi[2] * w[1], psi[2] * w[0] - psi[0] * w[2], psi[0] * w[1] - psi[1] * w[0]
    d0, d1, d2 = psi[1] * c2 - psi[2] * c1, psi[2] * c0 - psi[0] * c2, psi[0] * c1 - psi[1] * c0
    out[0] = w[0] + half * c0 + eta * d0
    out[1] = w[1] + half * c1 + eta * d1
    out[2] = w[2] + half * c2 + eta * d2


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
        power = push_marker(bodies, markers, j, f0, f1, f2) + twist_body(bodies, markers.body[j], m0, m1, m2)
        # the first body gets the counter-force at its own marker, and the moment of the offset d
        power += push_marker(bodies, markers, i, -f0, -f1, -f2)
        t0, t1, t2 = m0 + d1 * f2 - d2 * f1, m1 + d2 * f0 - d0 * f2, m2 + d0 * f1 - d1 * f0
        power += twist_body(bodies, markers.body[i], -t0, -t1, -t2)
        for a in range(3):
            record.outputs.value[out + 2 + a] = effort[a]
            record.outputs.value[out + 5 + a] = rate[a]
        record.outputs.value[out] = np.sqrt(f0 * f0 + f1 * f1 + f2 * f2)
        record.outputs.value[out + 1] = power
    return OK
