"""Basic constraints (report 44, §§2.2–2.7): value, Jacobian with respect to the markers' velocities, acceleration term.

A row of J is (f_i, n_i, f_j, n_j) with Ċ = f_iᵀ ṙ_i + n_iᵀ ω_i + f_jᵀ ṙ_j + n_jᵀ ω_j, all in global axes; γ is the right-hand
side of C_q v̇ = γ, that is minus everything in C̈ that does not contain accelerations of the coordinates. i is the first marker.
"""

from __future__ import annotations

from nivel.kernels.compile import stage
from nivel.kernels.spatial import dot


@stage
def constraint_values(bodies, markers, constraints):
    """C of every basic constraint, from the markers' positions alone."""
    for k in range(constraints.s.shape[0]):
        i, j, row = constraints.s[k, 0], constraints.s[k, 1], constraints.s[k, 2]
        for x in range(3):
            constraints.C[row + x] = markers.r[j, x] - markers.r[i, x]
    for k in range(constraints.d1.shape[0]):
        i, p, j, o, row = (
            constraints.d1[k, 0],
            constraints.d1[k, 1],
            constraints.d1[k, 2],
            constraints.d1[k, 3],
            constraints.d1[k, 4],
        )
        Ai, Aj = markers.A[i], markers.A[j]
        constraints.C[row] = Ai[0, p] * Aj[0, o] + Ai[1, p] * Aj[1, o] + Ai[2, p] * Aj[2, o]
    for k in range(constraints.d2.shape[0]):
        i, p, j, row = constraints.d2[k, 0], constraints.d2[k, 1], constraints.d2[k, 2], constraints.d2[k, 3]
        Ai, ri, rj = markers.A[i], markers.r[i], markers.r[j]
        constraints.C[row] = Ai[0, p] * (rj[0] - ri[0]) + Ai[1, p] * (rj[1] - ri[1]) + Ai[2, p] * (rj[2] - ri[2])


@stage
def constraint_rows(bodies, markers, constraints):
    """J, Ċ and γ of every basic constraint, from the markers' positions and velocities."""
    for k in range(constraints.s.shape[0]):
        coincident(markers, constraints, constraints.s[k])
    for k in range(constraints.d1.shape[0]):
        perpendicular_axes(bodies, markers, constraints, constraints.d1[k])
    for k in range(constraints.d2.shape[0]):
        perpendicular_distance(bodies, markers, constraints, constraints.d2[k])


@stage
def coincident(markers, constraints, table):
    """s: two points coincide, C = r_j - r_i = 0 in global axes (eqs. 11, 33). J is constant and set when the machine is built."""
    i, j, row = table[0], table[1], table[2]
    for x in range(3):
        constraints.Cdot[row + x] = markers.rdot[j, x] - markers.rdot[i, x]
        constraints.gamma[row + x] = markers.bias[i, x] - markers.bias[j, x]


@stage
def perpendicular_axes(bodies, markers, constraints, table):
    """d1: axis a of the first marker is perpendicular to axis b of the second, C = aᵀb = 0 (eqs. 6, 31)."""
    i, p, j, o, row = table[0], table[1], table[2], table[3], table[4]
    Ai, Aj = markers.A[i], markers.A[j]
    wi, wj = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    a0, a1, a2 = Ai[0, p], Ai[1, p], Ai[2, p]
    b0, b1, b2 = Aj[0, o], Aj[1, o], Aj[2, o]
    # Ċ = (ω_i × a)ᵀ b + aᵀ (ω_j × b) = (a × b)ᵀ (ω_i - ω_j)
    n0, n1, n2 = a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0
    J = constraints.J[row]
    J[3], J[4], J[5] = n0, n1, n2
    J[9], J[10], J[11] = -n0, -n1, -n2
    constraints.Cdot[row] = n0 * (wi[0] - wj[0]) + n1 * (wi[1] - wj[1]) + n2 * (wi[2] - wj[2])
    # γ = -[ω_i × (ω_i × a)]ᵀ b - aᵀ [ω_j × (ω_j × b)] - 2 (ω_i × a)ᵀ (ω_j × b)
    wia = wi[0] * a0 + wi[1] * a1 + wi[2] * a2
    wib = wi[0] * b0 + wi[1] * b1 + wi[2] * b2
    wja = wj[0] * a0 + wj[1] * a1 + wj[2] * a2
    wjb = wj[0] * b0 + wj[1] * b1 + wj[2] * b2
    ab = a0 * b0 + a1 * b1 + a2 * b2
    wiwj = dot(wi, wj)
    # (ω_i × a)ᵀ (ω_j × b) = (ω_iᵀω_j)(aᵀb) - (ω_iᵀb)(aᵀω_j)
    constraints.gamma[row] = ab * (dot(wi, wi) + dot(wj, wj)) - wia * wib - wja * wjb - 2.0 * (wiwj * ab - wib * wja)


@stage
def perpendicular_distance(bodies, markers, constraints, table):
    """d2: axis a of the first marker is perpendicular to d = r_j - r_i, C = aᵀd = 0 (eqs. 8, 32). Valid at d = 0, too."""
    i, p, j, row = table[0], table[1], table[2], table[3]
    Ai, ri, rj = markers.A[i], markers.r[i], markers.r[j]
    vi, vj = markers.rdot[i], markers.rdot[j]
    gi, gj = markers.bias[i], markers.bias[j]
    w = bodies.omega[markers.body[i]]
    a0, a1, a2 = Ai[0, p], Ai[1, p], Ai[2, p]
    d0, d1, d2 = rj[0] - ri[0], rj[1] - ri[1], rj[2] - ri[2]
    e0, e1, e2 = vj[0] - vi[0], vj[1] - vi[1], vj[2] - vi[2]
    # Ċ = (ω_i × a)ᵀ d + aᵀ ḋ = (a × d)ᵀ ω_i + aᵀ (ṙ_j - ṙ_i)
    n0, n1, n2 = a1 * d2 - a2 * d1, a2 * d0 - a0 * d2, a0 * d1 - a1 * d0
    J = constraints.J[row]
    J[0], J[1], J[2] = -a0, -a1, -a2
    J[3], J[4], J[5] = n0, n1, n2
    J[6], J[7], J[8] = a0, a1, a2
    constraints.Cdot[row] = n0 * w[0] + n1 * w[1] + n2 * w[2] + a0 * e0 + a1 * e1 + a2 * e2
    # γ = -[ω_i × (ω_i × a)]ᵀ d - 2 (ω_i × a)ᵀ ḋ - aᵀ (bias_j - bias_i)
    wa = w[0] * a0 + w[1] * a1 + w[2] * a2
    wd = w[0] * d0 + w[1] * d1 + w[2] * d2
    ad = a0 * d0 + a1 * d1 + a2 * d2
    s0, s1, s2 = w[1] * a2 - w[2] * a1, w[2] * a0 - w[0] * a2, w[0] * a1 - w[1] * a0
    constraints.gamma[row] = (
        ad * dot(w, w)
        - wa * wd
        - 2.0 * (s0 * e0 + s1 * e1 + s2 * e2)
        - a0 * (gj[0] - gi[0])
        - a1 * (gj[1] - gi[1])
        - a2 * (gj[2] - gi[2])
    )
