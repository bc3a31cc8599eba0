"""Coordinates of a wheel that rolls on a plane: height of its lowest point, and velocities of that point along the plane.

i is the plane's marker (point O, normal n = z), j the wheel's (centre P, axle a = z). The rim is a torus: a circle of radius ρ about P, and
about it a crown of radius c. With σ = aᵀn and h = √(1 - σ²) the unit vector e = (σ a - n)/h leads from P to the lowest point of the
circle, t = a × n/h is the rolling direction, and the contact is at P + d:

    d = ρ e - c n,   D = P + d - O,   w = Ṗ + ω × d - Ȯ - Ω × D

CONTACT  height nᵀ(P - O) - ρ h - c, whose rate is nᵀw
SLIP     velocity bᵀw of the wheel's material against the plane's, along b = x or y of the plane's marker

The contact is no material point: ḋ = ρ [-(eᵀa') a + (σ/h)(tᵀa') t] + Ω × d with a' = (ω - Ω) × a, and

    d(bᵀw)/dt = bᵀ[P̈ + α × d + ω × ḋ - Ö - Ω̇ × D - Ω × Ḋ] + (Ω × b)ᵀw

A slip is the rate of nothing that positions have. Its value is zero, and it changes with positions as the row of C_q says: that is its
slope where positions are dual numbers, all that Newton's iterations for positions ask for. In gradients of runs `measure` takes it away:
positions that move with a parameter have nothing to close.
Source: O'Reilly 1996 for the sharp disc; Meijaard et al. 2007 for toroidal wheels; here with a plane that may move.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.native.function import stage

CONTACT, SLIP = 15, 16
CENTRE_CIRCLE, CROWN = 0, 1  # places of ρ and c among the two numbers of a coordinate


@stage
def axis_of(A, k):
    """Column k."""
    return A[0, k], A[1, k], A[2, k]


@stage
def plus(a, x, b, y):
    """a x + b y of 3-vectors."""
    return a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]


@stage
def lever(n, a, turning, circle, crown):
    """(d, ḋ for a plane at rest, h) for the normal n, the axle a and its rate `turning` against the plane."""
    sigma = dot(a, n)
    h = np.sqrt(1.0 - sigma * sigma)
    d = plus(-crown, n, 0.0, n)
    if circle == 0.0:  # a ball
        return d, plus(0.0, turning, 0.0, n), h
    e, t = plus(sigma / h, a, -1.0 / h, n), cross(a, n)
    t = plus(1.0 / h, t, 0.0, t)
    rate = plus(-circle * dot(e, turning), a, circle * sigma / h * dot(t, turning), t)
    return plus(circle, e, 1.0, d), rate, h


@stage
def virtual_displacement(markers, m, s):
    """What positions that are complex move the point at s in global axes by, from marker m; zero where they are real."""
    A = markers.A[m]
    k0 = real(A[0, 0]) * real(s[0]) + real(A[1, 0]) * real(s[1]) + real(A[2, 0]) * real(s[2])
    k1 = real(A[0, 1]) * real(s[0]) + real(A[1, 1]) * real(s[1]) + real(A[2, 1]) * real(s[2])
    k2 = real(A[0, 2]) * real(s[0]) + real(A[1, 2]) * real(s[1]) + real(A[2, 2]) * real(s[2])
    p = plus(1.0, markers.r[m], 1.0, plus(k0, axis_of(A, 0), 1.0, plus(k1, axis_of(A, 1), k2, axis_of(A, 2))))
    return p[0] - real(p[0]), p[1] - real(p[1]), p[2] - real(p[2])


@stage
def rolling(bodies, markers, coordinates, k):
    """(value, rate, second derivative without accelerations of bodies) of coordinate k; its parts of C_q are filled."""
    kind, i, j = coordinates.what[k, 0], coordinates.what[k, 1], coordinates.what[k, 2]
    part = coordinates.start[k]
    circle, crown = coordinates.station[part + CENTRE_CIRCLE], coordinates.station[part + CROWN]
    Ji, Jj = coordinates.J[part], coordinates.J[part + 1]
    W, w = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    n, a = axis_of(markers.A[i], 2), axis_of(markers.A[j], 2)
    d, drift, h = lever(n, a, cross(plus(1.0, w, -1.0, W), a), circle, crown)
    apart = plus(1.0, markers.r[j], -1.0, markers.r[i])
    D = plus(1.0, apart, 1.0, d)
    ddot = plus(1.0, drift, 1.0, cross(W, d))
    speed = plus(1.0, markers.rdot[j], -1.0, markers.rdot[i])
    Ddot = plus(1.0, speed, 1.0, ddot)
    slip = plus(1.0, speed, 1.0, plus(1.0, cross(w, d), -1.0, cross(W, D)))
    b = n if kind == CONTACT else axis_of(markers.A[i], coordinates.what[k, 3])
    on_plane, on_wheel = cross(D, b), cross(d, b)
    for x in range(3):
        Ji[x], Ji[3 + x], Jj[x], Jj[3 + x] = -b[x], -on_plane[x], b[x], on_wheel[x]
    rest = plus(1.0, markers.bias[j], -1.0, markers.bias[i])
    rest = plus(1.0, rest, 1.0, plus(1.0, cross(w, ddot), -1.0, cross(W, Ddot)))
    bias = dot(b, rest) + dot(cross(W, b), slip)
    if kind == CONTACT:
        value = dot(n, apart) - circle * h - crown
    else:
        moved = plus(1.0, virtual_displacement(markers, j, d), -1.0, virtual_displacement(markers, i, D))
        value = dot(b, moved)
    return value, dot(b, slip), bias
