"""Elements of geometrically exact beams (Reissner 1981; Simo 1985), objective by relative rotations (Crisfield, Jelenić 1999).

Along an element the line is x = Σ N_a x_a and the section turned by R = R_r exp(ψ̃), ψ = Σ N_a ψ_a, where ψ_a is the rotation vector of node
a seen from the reference node r, or, with total interpolation, from axes fixed in space. Strains in section axes and their variations,
with small rotations δθ̄ in section axes:

    Γ = Rᵀ x' - Γ_0        δΓ = Rᵀ δx' + Rᵀ x' × δθ̄          δθ̄ = exp(-ψ̃) δθ̄_r + T δψ
    Κ = T ψ' - Κ_0         δΚ = D(T ψ')·δψ + T δψ'            δψ = Σ N_a δψ_a,  δψ_a = T_a⁻¹ (δθ̄_a - exp(-ψ̃_a) δθ̄_r)

T = a 1 - b ψ̃ + c ψ ⊗ ψ with a = sin ψ/ψ, b = (1 - cos ψ)/ψ², c = (ψ - sin ψ)/ψ³. Forces and moments are C (strain + damping × its
rate), and what nodes feel follows from the same variations, so the elastic part has the potential ½ ∫ strain · C strain.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.inverse_tangent import inverse_tangent_by, inverse_tangent_factor
from nivel.kernels.algebra.relative_rotation import rotation_vector
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.bodies.floating_frame import turn_factors
from nivel.kernels.bodies.shared_mass import less, product, transposed_product
from nivel.native.function import stage

# columns of `columns`: markers of up to four nodes, how many they are, Gauss points, which of them is the reference node (MOST: none), the
# marker from whose axes the sections turn
NODE, COUNT, POINTS, REFERENCE, FRAME = 0, 4, 5, 6, 7
MOST = 4
# columns of `number`: time of damping [s], stiffness (36); for each Gauss point its weight [m], shape functions (4), their slopes (4),
# strain that counts as none (6); then work: rotation vectors of the nodes (12), what they ask for (12), their rates (12), forces and
# torques on the nodes (24)
DAMPING, STIFFNESS, POINT, WIDTH, PSI, ASKED, RATE, FORCE, TORQUE = 0, 1, 37, 15, 82, 94, 106, 118, 130
WEIGHT, SHAPE, SLOPE, STRAIN = 0, 1, 5, 9
NUMBERS = 142


@stage
def inverse_tangent_product(psi, w, sign):
    """T⁻¹ w, sign = 1; T⁻ᵀ w for sign = -1."""
    return inverse_tangent_by(inverse_tangent_factor(dot(psi, psi)), 0.5 * sign, psi, w)


@stage
def sum_of(a, x, b, y, c, z):
    """a x + b y + c z of 3-vectors."""
    return a * x[0] + b * y[0] + c * z[0], a * x[1] + b * y[1] + c * z[1], a * x[2] + b * y[2] + c * z[2]


@stage
def nearest_chart(near, psi):
    """ψ, or its complement (1 - 2π/ψ) ψ, which is the same rotation: whichever is nearer to the vector `near` (Mäkinen 2007)."""
    angle = np.sqrt(dot(psi, psi))
    if real(angle) > 1e-6:
        factor = 1.0 - 2.0 * np.pi / angle
        here = less(psi, near)
        there = factor * psi[0] - near[0], factor * psi[1] - near[1], factor * psi[2] - near[2]
        if real(dot(there, there)) < real(dot(here, here)):
            psi[0], psi[1], psi[2] = factor * psi[0], factor * psi[1], factor * psi[2]


@stage
def find_turns(bodies, markers, index, n):
    """Rotation vectors of the nodes relative to the reference node, and where there is damping their rates."""
    r, count = index[REFERENCE], index[COUNT]
    Ar, wr = markers.A[index[FRAME]], bodies.omega[markers.body[index[FRAME]]]
    for a in range(count):
        psi, A = n[PSI + 3 * a : PSI + 3 * a + 3], markers.A[index[NODE + a]]
        if a == r:
            psi[0], psi[1], psi[2] = 0.0, 0.0, 0.0
        else:
            rotation_vector(Ar, A, psi)
            if r == MOST and a > 0:
                nearest_chart(n[PSI : PSI + 3], psi)
        for i in range(3):
            n[ASKED + 3 * a + i], n[FORCE + 3 * a + i] = 0.0, 0.0
        if real(n[DAMPING]) > 0.0:
            relative = transposed_product(A, less(bodies.omega[markers.body[index[NODE + a]]], wr))
            rate = inverse_tangent_product(psi, relative, 1.0)
            for i in range(3):
                n[RATE + 3 * a + i] = rate[i]


@stage
def interpolated(n, shape, first, count):
    """Σ shape_a v_a of the nodes' vectors from n[first] on."""
    x, y, z = 0.0 * n[0], 0.0 * n[0], 0.0 * n[0]
    for a in range(count):
        x += shape[a] * n[first + 3 * a]
        y += shape[a] * n[first + 3 * a + 1]
        z += shape[a] * n[first + 3 * a + 2]
    return x, y, z


@stage
def along_line(place, index, slope, count):
    """x' = Σ N'_a x_a of the markers' places, or of their velocities."""
    x, y, z = 0.0 * place[0, 0], 0.0 * place[0, 0], 0.0 * place[0, 0]
    for a in range(count):
        r = place[index[NODE + a]]
        x += slope[a] * r[0]
        y += slope[a] * r[1]
        z += slope[a] * r[2]
    return x, y, z


@stage
def turned(a, b, psi, v):
    """exp(ψ̃) v = v + a ψ × v + b ψ × (ψ × v); with -a: exp(-ψ̃) v."""
    c = cross(psi, v)
    return sum_of(1.0, v, a, c, b, cross(psi, c))


@stage
def tangent_product(a, b, c, psi, v):
    """T v; with -b: Tᵀ v."""
    return sum_of(a, v, -b, cross(psi, v), c * dot(psi, v), psi)


@stage
def point_of_element(bodies, markers, index, n, q, control):
    """Add what Gauss point q stores, loses and asks of the nodes; returns the moment in section axes of the reference node."""
    count = index[COUNT]
    Ar, wr = markers.A[index[FRAME]], bodies.omega[markers.body[index[FRAME]]]
    shape, slope, unstrained = q[SHAPE : SHAPE + 4], q[SLOPE : SLOPE + 4], q[STRAIN : STRAIN + 6]
    psi, bend = interpolated(n, shape, PSI, count), interpolated(n, slope, PSI, count)
    square = dot(psi, psi)
    b, c, db, dc = turn_factors(square)
    a, da = 1.0 - square * c, -2.0 * c - square * dc
    stretch = turned(-a, b, psi, transposed_product(Ar, along_line(markers.r, index, slope, count)))
    kappa = tangent_product(a, b, c, psi, bend)
    e0, e1, e2 = stretch[0] - unstrained[0], stretch[1] - unstrained[1], stretch[2] - unstrained[2]
    e3, e4, e5 = kappa[0] - unstrained[3], kappa[1] - unstrained[4], kappa[2] - unstrained[5]
    weight, damping = q[WEIGHT], n[DAMPING]
    r0, r1, r2, r3, r4, r5 = 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0
    if real(damping) > 0.0:
        turning, bending = interpolated(n, shape, RATE, count), interpolated(n, slope, RATE, count)
        w = turned(-a, b, psi, transposed_product(Ar, wr))
        t = tangent_product(a, b, c, psi, turning)
        spin = w[0] + t[0], w[1] + t[1], w[2] + t[2]
        moved = turned(-a, b, psi, transposed_product(Ar, along_line(markers.rdot, index, slope, count)))
        g = cross(stretch, spin)
        k = tangent_product(a, b, c, psi, bending)
        # D(T ψ')·ψ̇
        along, across, both = dot(psi, turning), cross(psi, bend), dot(psi, bend)
        d = sum_of(da * along, bend, -db * along, across, -b, cross(turning, bend))
        f = sum_of(c * both, turning, c * dot(turning, bend) + dc * along * both, psi, 1.0, d)
        r0, r1, r2 = moved[0] + g[0], moved[1] + g[1], moved[2] + g[2]
        r3, r4, r5 = k[0] + f[0], k[1] + f[1], k[2] + f[2]
    s0, s1, s2, s3, s4, s5 = 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0
    stored, lost = 0.0 * e0, 0.0 * e0
    for i in range(6):
        C = n[STIFFNESS + 6 * i : STIFFNESS + 6 * i + 6]
        elastic = C[0] * e0 + C[1] * e1 + C[2] * e2 + C[3] * e3 + C[4] * e4 + C[5] * e5
        viscous = damping * (C[0] * r0 + C[1] * r1 + C[2] * r2 + C[3] * r3 + C[4] * r4 + C[5] * r5)
        strain = e0 if i == 0 else e1 if i == 1 else e2 if i == 2 else e3 if i == 3 else e4 if i == 4 else e5
        rate = r0 if i == 0 else r1 if i == 1 else r2 if i == 2 else r3 if i == 3 else r4 if i == 4 else r5
        stored += 0.5 * elastic * strain
        lost += viscous * rate
        total = weight * (elastic + viscous)
        if i == 0:
            s0 = total
        elif i == 1:
            s1 = total
        elif i == 2:
            s2 = total
        elif i == 3:
            s3 = total
        elif i == 4:
            s4 = total
        else:
            s5 = total
    control.stored[0] += weight * stored
    control.power[1] += weight * lost
    N, M = (s0, s1, s2), (s3, s4, s5)
    force = product(Ar, turned(a, b, psi, N))
    moment = cross(N, stretch)
    # what δψ and δψ' ask for: Tᵀ m + D(T ψ')ᵀ M and Tᵀ M
    along, across, both = dot(bend, M), dot(cross(psi, bend), M), dot(psi, bend)
    of_psi = sum_of(1.0, tangent_product(a, -b, c, psi, moment), -b, cross(bend, M), c * both, M)
    outwards = da * along - db * across + dc * dot(psi, M) * both
    of_psi = sum_of(1.0, of_psi, outwards, psi, c * dot(psi, M), bend)
    of_slope = tangent_product(a, -b, c, psi, M)
    for k in range(count):
        for i in range(3):
            n[ASKED + 3 * k + i] += shape[k] * of_psi[i] + slope[k] * of_slope[i]
            n[FORCE + 3 * k + i] -= slope[k] * force[i]
    return turned(a, b, psi, moment)


@stage
def push_node(bodies, markers, m, force, torque):
    """Add a force at marker m and a torque, global axes, to what its body feels."""
    F, u = bodies.wrench[markers.body[m]], markers.u[m]
    moment = cross(u, force)
    for i in range(3):
        F[i] += force[i]
        F[3 + i] += torque[i] + moment[i]


@stage
def element_forces(bodies, markers, index, n, control):
    """What an element stores and asks of its nodes, on their bodies; forces and torques on the nodes stay in n[FORCE:], n[TORQUE:]."""
    find_turns(bodies, markers, index, n)
    m0, m1, m2 = 0.0 * n[0], 0.0 * n[0], 0.0 * n[0]
    for g in range(index[POINTS]):
        m = point_of_element(bodies, markers, index, n, n[POINT + WIDTH * g : POINT + WIDTH * (g + 1)], control)
        m0, m1, m2 = m0 + m[0], m1 + m[1], m2 + m[2]
    r = index[REFERENCE]
    t0, t1, t2 = product(markers.A[index[FRAME]], (m0, m1, m2))
    for a in range(index[COUNT]):
        if a != r:
            node, psi, torque = (
                index[NODE + a],
                n[PSI + 3 * a : PSI + 3 * a + 3],
                n[TORQUE + 3 * a : TORQUE + 3 * a + 3],
            )
            asked = inverse_tangent_product(psi, n[ASKED + 3 * a : ASKED + 3 * a + 3], -1.0)
            x, y, z = product(markers.A[node], asked)
            torque[0], torque[1], torque[2] = -x, -y, -z
            push_node(bodies, markers, node, n[FORCE + 3 * a : FORCE + 3 * a + 3], torque)
            t0, t1, t2 = t0 - x, t1 - y, t2 - z
    if r != MOST:
        torque = n[TORQUE + 3 * r : TORQUE + 3 * r + 3]
        torque[0], torque[1], torque[2] = -t0, -t1, -t2
        push_node(bodies, markers, index[NODE + r], n[FORCE + 3 * r : FORCE + 3 * r + 3], torque)
