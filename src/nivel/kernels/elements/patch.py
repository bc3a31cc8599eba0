"""The patch where two surfaces touch: its slip and spin, its load and reach, and the friction that holds it or brakes it.

A contact between markers i and j has one patch. Its middle p is that of the normal forces, N in all, along n from the body of j to that of
i. It has two or three coordinates that are known by their rates alone, slips along two tangents t and the spin:

    tᵀ[ṙ_i + ω × (p - r_i) - ṙ_j - Ω × (p - r_j)],   nᵀ(ω - Ω)

Where the surface of j moves over it (`nivel.kernels.elements.moving_surface`) its velocity and spin are taken from these.
The middle is no material point of a wheel, so with its own velocity ṗ the second derivatives have the terms ω × (ṗ - ṙ_i) - Ω × (ṗ - ṙ_j).
The efforts (F, M) on them are limited together: |F|² + (M/r)² ≤ (μ N)², r the radius of gyration of the normal forces about the middle
(limit surface: Goyal, Ruina, Papadopoulos 1991; as an ellipsoid: Howe, Cutkosky 1996). In it friction holds; a patch that slides has the
effort on the surface that loses most power.

For r there may be a number of the contact, or a share of that radius of gyration: points on the rim of a face stand for all of it.

Resistance to rolling is a second patch, behind the first, of two coordinates: turns about both tangents, tᵀ(ω - Ω), with the limit b N,
b the lever arm by which the normal force is ahead of the middle.

The value of the first coordinate is N and that of the second r, where the surfaces touch; nothing reads them as positions.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, plus
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# columns of `friction.number` of a patch: velocity of the surface of j over it along the tangent, or its spin; of its first effort r, or 0
# where it is this share of the radius of gyration, and 1 where resistance to rolling follows
OVER, REACH, SHARE, ROLLS = 11, 8, 9, 10
# cosine of an axis that is too near to the normal
NEAR_NORMAL = 0.8
# More iterations than the multiplier of a limit has ever taken, and what it is known to.
MOST, EXACT = 60, 1e-15
# Turns by which efforts come to what holds exactly.
REFINED = 3
# A radius of gyration below this share, squared, is none.
ROUND = 1e-12


@leaf
def middle_of(sums):
    """(middle, radius of gyration about it) of forces f at d, whose sums are Σ f, Σ f d, Σ f d²."""
    load = sums[0]
    d = sums[1] / load, sums[2] / load, sums[3] / load
    square = sums[4] / load - dot(d, d)
    # of one point it is round-off
    reach = np.sqrt(square) if real(square) > ROUND * real(sums[4] / load) else 0.0 * square
    return d, reach


@leaf
def tangents(A, n):
    """Two unit vectors across the unit vector n and each other, the first one in the plane of n and the x axis of A, or its y axis where
    that is near n."""
    a = axis(A, 0) if np.abs(real(dot(axis(A, 0), n))) < NEAR_NORMAL else axis(A, 1)
    out = dot(a, n)
    t = a[0] - out * n[0], a[1] - out * n[1], a[2] - out * n[2]
    length = np.sqrt(dot(t, t))
    t = t[0] / length, t[1] / length, t[2] / length
    return t, cross(n, t)


@stage
def write_row(machine, k, q, on_first, on_second, rate, bias):
    """Fill the parts (f, n) of both markers of coordinate q, the row of friction k, with its rate and its bias."""
    record = record_at(machine)
    coordinates, constraints, friction = record.coordinates, record.constraints, record.friction
    coordinates.rate[q], coordinates.bias[q] = rate, bias
    constraints.gamma[constraints.C.shape[0] + k] = -bias
    part, row = np.int64(coordinates.start[q]), np.int64(friction.part[k])
    for x in range(6):
        coordinates.J[part, x], coordinates.J[part + 1, x] = on_first[x], on_second[x]
        constraints.J[row, x], constraints.J[row + 1, x] = on_first[x], on_second[x]


@stage
def write_patch(machine, k, count, q, p, pdot, n, t, u, load, reach, surface, change, spin, spin_rate):
    """Fill the `count` rows from friction k and coordinate q on, for the middle p, its velocity, the normal n and the tangents t, u.

    surface, change : velocity of the surface of j over it at p, and its rate. spin, spin_rate : of that surface about n.
    """
    record = record_at(machine)
    coordinates, markers, bodies, friction = record.coordinates, record.markers, record.bodies, record.friction
    i, j = coordinates.what[q, 1], coordinates.what[q, 2]
    w, W = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    d, D = minus(p, markers.r[i]), minus(p, markers.r[j])
    slip = minus(minus(plus(markers.rdot[i], cross(w, d)), plus(markers.rdot[j], cross(W, D))), surface)
    rest = plus(markers.bias[i], cross(w, minus(pdot, markers.rdot[i])))
    rest = minus(minus(rest, plus(markers.bias[j], cross(W, minus(pdot, markers.rdot[j])))), change)
    for a in range(2):
        b = t if a == 0 else u
        x, y = cross(d, b), cross(D, b)
        first = (b[0], b[1], b[2], x[0], x[1], x[2])
        second = (-b[0], -b[1], -b[2], -y[0], -y[1], -y[2])
        write_row(machine, k + a, q + a, first, second, dot(b, slip), dot(b, rest) + dot(cross(W, b), slip))
        friction.number[k + a, OVER] = real(dot(b, surface))
    own = friction.number[k]
    coordinates.value[q], coordinates.value[q + 1] = load, own[REACH] + own[SHARE] * reach
    turning = minus(w, W)
    if count == 3:
        write_turn(machine, k + 2, q + 2, n, dot(n, turning) - spin, dot(cross(W, n), turning) - spin_rate)
        friction.number[k + 2, OVER] = real(spin)
    if own[ROLLS] == 1.0:
        coordinates.value[q + count], coordinates.value[q + count + 1] = load, 0.0 * load
        for a in range(2):
            b = t if a == 0 else u
            write_turn(machine, k + count + a, q + count + a, b, dot(b, turning), dot(cross(W, b), turning))


@stage
def write_turn(machine, k, q, axis, rate, bias):
    """Fill the row of friction k and coordinate q, the turn of both bodies against each other about an axis."""
    o = 0.0 * rate
    on_first, on_second = (o, o, o, axis[0], axis[1], axis[2]), (o, o, o, -axis[0], -axis[1], -axis[2])
    write_row(machine, k, q, on_first, on_second, rate, bias)


@stage
def leave_patch(machine, k, count, q):
    """The surfaces do not touch."""
    record = record_at(machine)
    coordinates, rolls = record.coordinates, record.friction.number[k, ROLLS] == 1.0
    if coordinates.value[q] == 0.0:
        return
    o = 0.0 * coordinates.value[q]
    coordinates.value[q], coordinates.value[q + 1] = o, o
    if rolls:
        coordinates.value[q + count] = o
    for a in range(count + 2 if rolls else count):
        write_row(machine, k + a, q + a, (o, o, o, o, o, o), (o, o, o, o, o, o), o, o)


@leaf
def solve_three(S, b):
    """x with S x = b, of the symmetric positive matrix (S_00, S_01, S_02, S_11, S_12, S_22)."""
    l1, l2 = S[1] / S[0], S[2] / S[0]
    d1, c = S[3] - l1 * S[1], S[4] - l2 * S[1]
    l3 = c / d1
    y1 = b[1] - l1 * b[0]
    y2 = b[2] - l2 * b[0] - l3 * y1
    x2 = y2 / (S[5] - l2 * S[2] - l3 * c)
    x1 = y1 / d1 - l3 * x2
    return b[0] / S[0] - l1 * x1 - l2 * x2, x1, x2


@leaf
def size_of(x):
    """Length of a 3-vector."""
    return np.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])


@leaf
def limited(S, least, b, limit):
    """x = (S + λ)⁻¹ b with the least λ ≥ 0 for which |x| ≤ limit: of all efforts in the sphere the one that loses most power.

    λ by Newton's iteration for 1/|x|, which comes to it from below (Moré, Sorensen 1983). Where no effort moves anything, S is singular and
    b is round-off, or a motion that is prescribed. So x is what x = T⁻¹ (b + e x) comes to in REFINED turns, with T = S + e + λ and e =
    `least`, of both tangents and of the spin: elsewhere it is exact but for (e T⁻¹) to the power of one more than these.
    """
    if limit == 0.0:
        return 0.0, 0.0, 0.0
    shift, size = 0.0, 0.0
    x = (0.0, 0.0, 0.0)
    for _ in range(MOST):
        more = least[0] + shift
        T = (S[0] + more, S[1], S[2], S[3] + more, S[4], S[5] + least[1] + shift)
        x = solve_three(T, b)
        slope = solve_three(T, x)  # -dx/dλ, by the same turns
        for _ in range(REFINED):
            x = solve_three(T, (b[0] + least[0] * x[0], b[1] + least[0] * x[1], b[2] + least[1] * x[2]))
            ahead = x[0] + least[0] * slope[0], x[1] + least[0] * slope[1], x[2] + least[1] * slope[2]
            slope = solve_three(T, ahead)
        size = size_of(x)
        if size <= limit:
            return x
        change = size * size / dot(x, slope) * (size / limit - 1.0)
        shift += change
        if change <= EXACT * shift:
            break
    share = limit / size
    return share * x[0], share * x[1], share * x[2]
