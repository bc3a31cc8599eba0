"""Scalars measured between two markers: value, rate, Jacobian with respect to the markers' velocities, second derivative.

i is the first marker, j the second, d = r_j - r_i. rate = f_iᵀ ṙ_i + n_iᵀ ω_i + f_jᵀ ṙ_j + n_jᵀ ω_j in global axes: Ji = (f_i, n_i)
and Jj = (f_j, n_j) are the parts of the row of C_q; entries that are always zero are never written. `bias` is the second
derivative for bodies without acceleration. Joints, drivers, couplings, springs, motors, stops, friction and sensors are made of these.

ROTATION      angle of the second marker about the first's z axis: from x_i to x_j.
CROSS_FIRST   universal joint, about z_i: from x_i to the arm z_j.
CROSS_SECOND  universal joint, of the second body about its arm z_j: minus the angle from x_j to z_i.
POLAR         angle of the second marker's point about the first's z axis, from x_i.
TRANSLATION   of the second marker's point along axis `axis` of the first marker.
DISTANCE      between the points.
COSINE        between axis `axis // 3` of the first marker and `axis % 3` of the second.
MOMENT        z_i · (d × z_j): common normal of the two z axes times the sine of the angle between them.
RADIUS        distance of the second point from the first's z axis.
ALONG … TWIST of a slider on a beam, which touch all its nodes: see `nivel.kernels.bodies.rail`.
"""

import numpy as np

from nivel.kernels.algebra.analytic import arctan2, real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.native.function import leaf, stage

ROTATION, CROSS_FIRST, CROSS_SECOND, POLAR, TRANSLATION, DISTANCE, COSINE, MOMENT, RADIUS = 0, 1, 2, 3, 4, 5, 6, 7, 8
LAST_ANGLE = POLAR
# from here on those of a slider, the first marker: place along the beam [m], distances along the section axes y and z [m], cosines of the
# slider's x and y axes with the line, of its y axis with the section's
ALONG, ACROSS_Y, ACROSS_Z, LEAN_X, LEAN_Y, TWIST = 9, 10, 11, 12, 13, 14


@leaf
def axes_product(a0, a1, a2, b0, b1, b2, wi, wj):
    """aᵀb of axes turning with ω_i and ω_j: (value, n of n·(ω_i - ω_j) = rate (3), rate, second derivative for α = 0).

    (ω_i × a)ᵀ b + aᵀ (ω_j × b) = (a × b)ᵀ (ω_i - ω_j); (ω_i × a)ᵀ (ω_j × b) = (ω_iᵀω_j)(aᵀb) - (ω_iᵀb)(aᵀω_j).
    """
    n0, n1, n2 = a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0
    rate = n0 * (wi[0] - wj[0]) + n1 * (wi[1] - wj[1]) + n2 * (wi[2] - wj[2])
    wia = wi[0] * a0 + wi[1] * a1 + wi[2] * a2
    wib = wi[0] * b0 + wi[1] * b1 + wi[2] * b2
    wja = wj[0] * a0 + wj[1] * a1 + wj[2] * a2
    wjb = wj[0] * b0 + wj[1] * b1 + wj[2] * b2
    ab = a0 * b0 + a1 * b1 + a2 * b2
    second = wia * wib + wja * wjb + 2.0 * (dot(wi, wj) * ab - wib * wja) - ab * (dot(wi, wi) + dot(wj, wj))
    return ab, n0, n1, n2, rate, second


@leaf
def near(angle, reference):
    """The angle plus the whole turns that bring it within half a turn of the reference."""
    return angle + 2.0 * np.pi * np.floor((real(reference) - real(angle)) / (2.0 * np.pi) + 0.5)


@stage
def angle(bodies, markers, kind, i, j, reference, Ji, Jj):
    """(angle, rate, bias) of the kinds up to LAST_ANGLE; fills Ji, Jj.

    With c, s the components of a unit vector b along two axes of the other marker and ρ = c² + s²:
    rate = (c ṡ - s ċ)/ρ, second derivative (c s̈ - s c̈)/ρ - rate ρ̇/ρ.
    """
    Ai, Aj = markers.A[i], markers.A[j]
    wi, wj = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    if kind == CROSS_SECOND:
        # seen from the second marker: a turns with ω_j, and the angle counts backwards
        a, b, wa, wb, o, sign = Aj, Ai, wj, wi, 2, -1.0
    else:
        a, b, wa, wb, o, sign = Ai, Aj, wi, wj, 0 if kind == ROTATION else 2, 1.0
    c, nc0, nc1, nc2, cdot, cddot = axes_product(a[0, 0], a[1, 0], a[2, 0], b[0, o], b[1, o], b[2, o], wa, wb)
    s, ns0, ns1, ns2, sdot, sddot = axes_product(a[0, 1], a[1, 1], a[2, 1], b[0, o], b[1, o], b[2, o], wa, wb)
    square = c * c + s * s
    rate = (c * sdot - s * cdot) / square
    bias = (c * sddot - s * cddot) / square - rate * 2.0 * (c * cdot + s * sdot) / square
    n0, n1, n2 = (c * ns0 - s * nc0) / square, (c * ns1 - s * nc1) / square, (c * ns2 - s * nc2) / square
    # n·(ω_a - ω_b), and sign = -1 where a is the second marker's: both cancel in the place of n
    Ji[3], Ji[4], Ji[5] = n0, n1, n2
    Jj[3], Jj[4], Jj[5] = -n0, -n1, -n2
    return near(sign * arctan2(s, c), reference), sign * rate, sign * bias


@stage
def translation(bodies, markers, i, p, j, Ji, Jj):
    """(aᵀd, rate, bias) with a = axis p of the first marker; fills Ji, Jj. As d2 (eq. 32)."""
    Ai, ri, rj = markers.A[i], markers.r[i], markers.r[j]
    vi, vj = markers.rdot[i], markers.rdot[j]
    gi, gj = markers.bias[i], markers.bias[j]
    w = bodies.omega[markers.body[i]]
    a0, a1, a2 = Ai[0, p], Ai[1, p], Ai[2, p]
    d0, d1, d2 = rj[0] - ri[0], rj[1] - ri[1], rj[2] - ri[2]
    e0, e1, e2 = vj[0] - vi[0], vj[1] - vi[1], vj[2] - vi[2]
    # rate = (ω_i × a)ᵀ d + aᵀ ḋ = (a × d)ᵀ ω_i + aᵀ (ṙ_j - ṙ_i)
    n0, n1, n2 = a1 * d2 - a2 * d1, a2 * d0 - a0 * d2, a0 * d1 - a1 * d0
    Ji[0], Ji[1], Ji[2] = -a0, -a1, -a2
    Ji[3], Ji[4], Ji[5] = n0, n1, n2
    Jj[0], Jj[1], Jj[2] = a0, a1, a2
    rate = n0 * w[0] + n1 * w[1] + n2 * w[2] + a0 * e0 + a1 * e1 + a2 * e2
    # [ω_i × (ω_i × a)]ᵀ d + 2 (ω_i × a)ᵀ ḋ + aᵀ (bias_j - bias_i)
    wa = w[0] * a0 + w[1] * a1 + w[2] * a2
    wd = w[0] * d0 + w[1] * d1 + w[2] * d2
    ad = a0 * d0 + a1 * d1 + a2 * d2
    s0, s1, s2 = w[1] * a2 - w[2] * a1, w[2] * a0 - w[0] * a2, w[0] * a1 - w[1] * a0
    bias = wa * wd - ad * dot(w, w) + 2.0 * (s0 * e0 + s1 * e1 + s2 * e2)
    bias += a0 * (gj[0] - gi[0]) + a1 * (gj[1] - gi[1]) + a2 * (gj[2] - gi[2])
    return ad, rate, bias


@stage
def distance(markers, i, j, Ji, Jj):
    """(|d|, rate, bias), fills Ji, Jj; at d = 0, where no direction is defined, the rate and J are zero."""
    ri, rj, vi, vj = markers.r[i], markers.r[j], markers.rdot[i], markers.rdot[j]
    gi, gj = markers.bias[i], markers.bias[j]
    d0, d1, d2 = rj[0] - ri[0], rj[1] - ri[1], rj[2] - ri[2]
    v0, v1, v2 = vj[0] - vi[0], vj[1] - vi[1], vj[2] - vi[2]
    length = np.sqrt(d0 * d0 + d1 * d1 + d2 * d2)
    inverse = 1.0 / length if real(length) > 0.0 else 0.0 * length
    e0, e1, e2 = d0 * inverse, d1 * inverse, d2 * inverse
    rate = e0 * v0 + e1 * v1 + e2 * v2
    bias = (v0 * v0 + v1 * v1 + v2 * v2 - rate * rate) * inverse
    bias += e0 * (gj[0] - gi[0]) + e1 * (gj[1] - gi[1]) + e2 * (gj[2] - gi[2])
    Ji[0], Ji[1], Ji[2] = -e0, -e1, -e2
    Jj[0], Jj[1], Jj[2] = e0, e1, e2
    return length, rate, bias


@stage
def cosine(bodies, markers, i, p, j, o, Ji, Jj):
    """(aᵀb, rate, bias) with axis p of the first marker and o of the second; fills Ji, Jj. As d1 (eq. 31)."""
    Ai, Aj = markers.A[i], markers.A[j]
    wi, wj = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    value, n0, n1, n2, rate, bias = axes_product(Ai[0, p], Ai[1, p], Ai[2, p], Aj[0, o], Aj[1, o], Aj[2, o], wi, wj)
    Ji[3], Ji[4], Ji[5] = n0, n1, n2
    Jj[3], Jj[4], Jj[5] = -n0, -n1, -n2
    return value, rate, bias


@stage
def moment(bodies, markers, i, j, Ji, Jj):
    """(aᵀ(d × b), rate, bias) with the z axes a and b; fills Ji, Jj.

    rate = ω_iᵀ [a × (d × b)] + ω_jᵀ [b × (a × d)] + (b × a)ᵀ ḋ.
    """
    wi, wj = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    a = (markers.A[i, 0, 2], markers.A[i, 1, 2], markers.A[i, 2, 2])
    b = (markers.A[j, 0, 2], markers.A[j, 1, 2], markers.A[j, 2, 2])
    ri, rj, vi, vj = markers.r[i], markers.r[j], markers.rdot[i], markers.rdot[j]
    gi, gj = markers.bias[i], markers.bias[j]
    d = (rj[0] - ri[0], rj[1] - ri[1], rj[2] - ri[2])
    v = (vj[0] - vi[0], vj[1] - vi[1], vj[2] - vi[2])
    g = (gj[0] - gi[0], gj[1] - gi[1], gj[2] - gi[2])
    db, ba, ad = cross(d, b), cross(b, a), cross(a, d)
    ni, nj = cross(a, db), cross(b, ad)
    for k in range(3):
        Ji[k], Ji[3 + k], Jj[k], Jj[3 + k] = -ba[k], ni[k], ba[k], nj[k]
    rate = dot(ni, wi) + dot(nj, wj) + dot(ba, v)
    w_i, w_j = (wi[0], wi[1], wi[2]), (wj[0], wj[1], wj[2])
    adot, bdot = cross(w_i, a), cross(w_j, b)
    addot, bddot = cross(w_i, adot), cross(w_j, bdot)
    bias = dot(addot, db) + dot(ad, bddot) + dot(ba, g)
    bias += 2.0 * (dot(adot, cross(v, b)) + dot(adot, cross(d, bdot)) + dot(a, cross(v, bdot)))
    return dot(a, db), rate, bias


@stage
def displacement(bodies, markers, kind, i, j, axis, reference, Ji, Jj, other_i, other_j):
    """(value, rate, bias) of TRANSLATION, or of RADIUS and POLAR: √(X² + Y²) and atan2(Y, X) of the second point in the axes of the
    first marker; fills Ji, Jj, `other` is work."""
    X, Xdot, Xbias, Y, Ydot, Ybias = 0.0 * Ji[0], 0.0 * Ji[0], 0.0 * Ji[0], 0.0 * Ji[0], 0.0 * Ji[0], 0.0 * Ji[0]
    first, last = (axis, axis) if kind == TRANSLATION else (0, 1)
    for p in range(first, last + 1):
        if p == first:
            X, Xdot, Xbias = translation(bodies, markers, i, p, j, Ji, Jj)
        else:
            Y, Ydot, Ybias = translation(bodies, markers, i, p, j, other_i, other_j)
    if kind == TRANSLATION:
        return X, Xdot, Xbias
    square = X * X + Y * Y
    if kind == RADIUS:
        value = np.sqrt(square)
        rate = (X * Xdot + Y * Ydot) / value
        bias = (Xdot * Xdot + Ydot * Ydot + X * Xbias + Y * Ybias - rate * rate) / value
        for k in range(6):
            Ji[k] = (X * Ji[k] + Y * other_i[k]) / value
        for k in range(3):
            Jj[k] = (X * Jj[k] + Y * other_j[k]) / value
        return value, rate, bias
    rate = (X * Ydot - Y * Xdot) / square
    bias = (X * Ybias - Y * Xbias - 2.0 * rate * (X * Xdot + Y * Ydot)) / square
    for k in range(6):
        Ji[k] = (X * other_i[k] - Y * Ji[k]) / square
    for k in range(3):
        Jj[k] = (X * other_j[k] - Y * Jj[k]) / square
    return near(arctan2(Y, X), reference), rate, bias


@stage
def measure(bodies, markers, coordinates, k):
    """(value, rate, bias) of coordinate k; its parts of C_q are filled."""
    kind, i, j = coordinates.what[k, 0], coordinates.what[k, 1], coordinates.what[k, 2]
    part = coordinates.start[k]
    axis, Ji, Jj = coordinates.what[k, 3], coordinates.J[part], coordinates.J[part + 1]
    if kind < POLAR:
        return angle(bodies, markers, kind, i, j, coordinates.reference[k], Ji, Jj)
    if kind == DISTANCE:
        return distance(markers, i, j, Ji, Jj)
    if kind == COSINE:
        return cosine(bodies, markers, i, axis // 3, j, axis % 3, Ji, Jj)
    if kind == MOMENT:
        return moment(bodies, markers, i, j, Ji, Jj)
    last = coordinates.J.shape[0]
    other_i, other_j = coordinates.J[last - 2], coordinates.J[last - 1]
    return displacement(bodies, markers, kind, i, j, axis, coordinates.reference[k], Ji, Jj, other_i, other_j)
