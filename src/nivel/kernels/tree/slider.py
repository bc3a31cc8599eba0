"""Motion of a body that is carried by a beam along which it slides: its place and axes from the nodes beside it, its wrench on them.

The line X(σ) and the interpolated section axes x and y are those of `nivel.kernels.bodies.rail`; σ is a joint coordinate. With e2 along x
× y, and
e3 along x (or e1 along y where the slider turns about y: keyed), the slider has

    r = X,   A = [e1 e2 e3] Q(q)            q: nothing, an angle about e3, or two angles about e1 and about the slider's y axis

and a point that turns freely has axes of its own. The axes turn so that e2 stays across x and y, and e3 along x (e1 along y):

    ω = e1 (k0 e2·ẋ + k1 e2·ẏ) + e2 (k2 e1·ẋ + k3 e3·ẏ) + e3 (k4 e2·ẋ + k5 e2·ẏ)

The same map of x', y' gives the column of σ̇; of what nodes do with x and y, how they turn the slider; and of
v̈ - 2 ω × v̇ + ω × (ω × v), v = x or y, the angular acceleration. Its transpose hands the slider's wrench to the nodes (Mäkinen, Marjamäki:
B, Ḃ q̇ and Bᵀ of a slave that slides).
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot, multiply
from nivel.kernels.bodies.marker import move_marker, place_marker
from nivel.kernels.bodies.rail import (
    BEYOND,
    along_rail,
    axis_of,
    beside,
    following,
    interpolated_axis,
    spans,
    spread,
    two,
    weights,
)
from nivel.kernels.core.status import NOT_ON_RAIL, OK
from nivel.kernels.record.record import (
    CYLINDRICAL_ON_BEAM,
    KEYED_ON_BEAM,
    NONE,
    POINT_ON_BEAM,
    TRANSLATIONAL_ON_BEAM,
    record_at,
)
from nivel.kernels.tree.joints import plus, set_column, times, turn_by_parameters
from nivel.native.function import leaf, stage

# columns of `Tree.frame`: σ, e1, e2, e3, k0 … k5; of the four nodes about σ the weights of their places in X, of their x axes in X, and of
# their axes in x and y
SIGMA, E1, E2, E3, K, PLACE, SLOPE, AXES = 0, 1, 4, 7, 10, 16, 20, 24


@leaf
def element_of(coordinates, q, sigma):
    """(first node of the rail of coordinate q, the last but one, the one before σ) among the parts of coordinates."""
    first, last = np.int64(coordinates.start[q]) + 1, np.int64(coordinates.start[q + 1]) - 2
    e = first
    while e < last and real(sigma) > coordinates.station[e + 1]:
        e += 1
    return first, last, e


@leaf
def element_at(tree, coordinates, number, sigma):
    """The same of a slider: the element on which it is held, or that where it is."""
    first, last, e = element_of(coordinates, np.int64(tree.slider[number, 1]), sigma)
    return first, last, e if tree.element[number, 0] == NONE else np.int64(tree.element[number, 0])


@leaf
def vector(row, k):
    """Three entries of a row from k on."""
    return row[k], row[k + 1], row[k + 2]


@stage
def set_frame(frame, kind, x, y):
    """The axes of the beam and how they turn, for section axes x and y."""
    n = cross(x, y)
    e2 = times(1.0 / np.sqrt(dot(n, n)), n)
    k0, k1, k2, k3, k4, k5 = 0.0 * x[0], 0.0 * x[0], 0.0 * x[0], 0.0 * x[0], 0.0 * x[0], 0.0 * x[0]
    if kind == KEYED_ON_BEAM:
        size = np.sqrt(dot(y, y))
        e1 = times(1.0 / size, y)
        e3 = cross(e1, e2)
        k0, k1 = -1.0 / dot(x, e3), dot(x, e1) / dot(x, e3) / size
        k3, k5 = -1.0 / size, 1.0 / size
    else:
        size = np.sqrt(dot(x, x))
        e3 = times(1.0 / size, x)
        e1 = cross(e2, e3)
        if kind != POINT_ON_BEAM:
            k0, k2 = -1.0 / size, 1.0 / size
            k4, k5 = -dot(y, e3) / dot(y, e1) / size, 1.0 / dot(y, e1)
    for i in range(3):
        frame[E1 + i], frame[E2 + i], frame[E3 + i] = e1[i], e2[i], e3[i]
    frame[K], frame[K + 1], frame[K + 2], frame[K + 3], frame[K + 4], frame[K + 5] = k0, k1, k2, k3, k4, k5


@stage
def turning(frame, x, y):
    """ω of the axes for rates x and y of the section axes."""
    e1, e2, e3 = vector(frame, E1), vector(frame, E2), vector(frame, E3)
    of_x, of_y = dot(e2, x), dot(e2, y)
    first = frame[K] * of_x + frame[K + 1] * of_y
    third = frame[K + 4] * of_x + frame[K + 5] * of_y
    return plus(two(first, e1, third, e3), times(frame[K + 2] * dot(e1, x) + frame[K + 3] * dot(e3, y), e2))


@stage
def bending(frame, N):
    """(what a moment N on the axes asks of x, of y): the transpose of `turning`."""
    e1, e2, e3 = vector(frame, E1), vector(frame, E2), vector(frame, E3)
    a, b, c = dot(e1, N), dot(e2, N), dot(e3, N)
    of_x = two(frame[K] * a + frame[K + 4] * c, e2, frame[K + 2] * b, e1)
    return of_x, two(frame[K + 1] * a + frame[K + 5] * c, e2, frame[K + 3] * b, e3)


@stage
def carried_acceleration(machine, number, frame, acceleration_of, origin_of, first_column):
    """(X, x, y) of the accelerations of the nodes: angular ones (B, ·) in `acceleration_of`, those of origins in `origin_of`, each from
    `first_column` on."""
    record = record_at(machine)
    markers, coordinates = record.markers, record.coordinates
    first, last, e = element_at(record.tree, coordinates, number, frame[SIGMA])
    X = times(0.0, vector(frame, E1))
    x, y = X, X
    for n in range(4):
        m = coordinates.part_marker[beside(first, last, e, n)]
        b = markers.body[m]
        alpha, a = vector(acceleration_of[b], 0), vector(origin_of[b], first_column)
        of_x, of_y = cross(alpha, axis_of(markers.A[m], 0)), cross(alpha, axis_of(markers.A[m], 1))
        X = plus(X, two(frame[PLACE + n], plus(a, cross(alpha, markers.u[m])), frame[SLOPE + n], of_x))
        x, y = two(1.0, x, frame[AXES + n], of_x), two(1.0, y, frame[AXES + n], of_y)
    return X, x, y


@stage
def seen_turning(v, rate, second, w):
    """v̈ - 2 ω × v̇ + ω × (ω × v): what of v̈ turns the axes further."""
    return two(1.0, second, 1.0, cross(w, two(-2.0, rate, 1.0, cross(w, v))))


@stage
def turn_slider(kind, frame, identity, q, v, A, w, alpha, column, k):
    """Axes A of the slider and its columns behind that of σ̇; ω and α of the axes of the beam become its own."""
    zero = (0.0, 0.0, 0.0)
    e1, e2, e3 = vector(frame, E1), vector(frame, E2), vector(frame, E3)
    if kind == POINT_ON_BEAM:
        turn_by_parameters(identity, q[1:], A)
        for i in range(3):
            axis = axis_of(A, i)
            set_column(column[k + 1 + i], axis, zero)
            for j in range(3):
                w[j] += v[1 + i] * axis[j]
        return
    for i in range(3):
        A[i, 0], A[i, 1], A[i, 2] = e1[i], e2[i], e3[i]
    if kind == TRANSLATIONAL_ON_BEAM:
        return
    if kind == CYLINDRICAL_ON_BEAM:
        c, s = np.cos(q[1]), np.sin(q[1])
        for i in range(3):
            A[i, 0], A[i, 1] = c * e1[i] + s * e2[i], c * e2[i] - s * e1[i]
        add_turn(w, alpha, v[1], e3, column[k + 1])
        return
    c, s = np.cos(q[1]), np.sin(q[1])
    y, z = two(c, e2, s, e3), two(c, e3, -s, e2)
    c, s = np.cos(q[2]), np.sin(q[2])
    for i in range(3):
        A[i, 0], A[i, 1], A[i, 2] = c * e1[i] - s * z[i], y[i], c * z[i] + s * e1[i]
    add_turn(w, alpha, v[1], e1, column[k + 1])
    add_turn(w, alpha, v[2], y, column[k + 2])


@stage
def add_turn(w, alpha, rate, axis, column):
    """Turn with this rate about an axis that moves with ω, in addition."""
    own = times(rate, axis)
    further = cross(w, own)
    for i in range(3):
        alpha[i] += further[i]
        w[i] += own[i]
    set_column(column, axis, (0.0, 0.0, 0.0))


@stage
def set_weights(machine, frame, number, sigma):
    """Place the four nodes about σ, and set their weights. Returns (first node, last but one, the one before σ, u, length)."""
    record = record_at(machine)
    bodies, markers, coordinates = record.bodies, record.markers, record.coordinates
    first, last, e = element_at(record.tree, coordinates, number, sigma)
    length = coordinates.station[e + 1] - coordinates.station[e]
    u = (sigma - coordinates.station[e]) / length
    before, after = spans(coordinates.station, first, last, e)
    w, axes = weights(u, length, 0), spread(u, length, 0, before, after)
    frame[SIGMA] = sigma
    for n in range(4):
        m = coordinates.part_marker[beside(first, last, e, n)]
        place_marker(bodies, markers, m)
        move_marker(bodies, markers, m)
        frame[PLACE + n], frame[SLOPE + n], frame[AXES + n] = 0.0, 0.0, axes[n]
    for n in range(2):
        frame[PLACE + 1 + n], frame[SLOPE + 1 + n] = w[n], w[2 + n]
    return first, last, e, u, length


@stage
def section_axis_along(machine, first, last, e, u, length, k, rate):
    """(v, v̇, v̈ without accelerations of bodies and σ̈), v' of axis k of the sections at the slider, which moves with σ̇ = rate."""
    record = record_at(machine)
    bodies, markers, coordinates = record.bodies, record.markers, record.coordinates
    before, after = spans(coordinates.station, first, last, e)
    v = interpolated_axis(bodies, markers, coordinates, first, last, e, spread(u, length, 0, before, after), k)
    slope = interpolated_axis(bodies, markers, coordinates, first, last, e, spread(u, length, 1, before, after), k)
    bend = interpolated_axis(bodies, markers, coordinates, first, last, e, spread(u, length, 2, before, after), k)
    return following(v, slope, bend[0], rate, 0.0), slope[0]


@stage
def move_slider(machine, n, y):
    """Pose and velocity of the child of node n, its acceleration while no joint velocity changes, and the columns of its joint. Returns a
    status."""
    record = record_at(machine)
    bodies, markers, coordinates, tree = record.bodies, record.markers, record.coordinates, record.tree
    child, kind, k = tree.node[n, 0], tree.node[n, 2], np.int64(tree.node[n, 4])
    number = tree.slider_of[n]
    along, frame = np.int64(tree.slider[number, 1]), tree.frame[number]
    sigma, rate = y[tree.place[n, 0]], y[tree.place[n, 1]]
    whole = coordinates.station[coordinates.start[along + 1] - 1]
    if real(sigma) < -BEYOND * whole or real(sigma) > (1.0 + BEYOND) * whole:
        record.control.failure[0] = along
        return NOT_ON_RAIL
    first, last, e, u, length = set_weights(machine, frame, number, sigma)
    i, j = coordinates.part_marker[e], coordinates.part_marker[e + 1]
    X = along_rail(bodies, markers, i, j, weights(u, length, 0), 0)
    T = along_rail(bodies, markers, i, j, weights(u, length, 1), 0)
    bend = along_rail(bodies, markers, i, j, weights(u, length, 2), 0)
    axis, slope = section_axis_along(machine, first, last, e, u, length, 0, rate)
    side, side_slope = section_axis_along(machine, first, last, e, u, length, 1, rate)
    set_frame(frame, kind, axis[0], side[0])
    carried = carried_acceleration(machine, number, frame, tree.alpha0, tree.Rddot0, 0)
    w = turning(frame, axis[1], side[1])
    alpha = turning(
        frame,
        seen_turning(axis[0], axis[1], plus(axis[2], carried[1]), w),
        seen_turning(side[0], side[1], plus(side[2], carried[2]), w),
    )
    alpha = plus(alpha, vector(tree.jump[number], 0))
    acceleration = plus(plus(X[2], carried[0]), vector(tree.jump[number], 3))
    acceleration = plus(acceleration, two(2.0 * rate, T[1], rate * rate, bend[0]))
    velocity = two(1.0, X[1], rate, T[0])
    for c in range(3):
        bodies.R[child, c], bodies.Rdot[child, c], bodies.omega[child, c] = X[0][c], velocity[c], w[c]
        tree.alpha0[child, c], tree.Rddot0[child, c] = alpha[c], acceleration[c]
        tree.arm[child, c] = 0.0
    set_column(tree.column[k], turning(frame, slope, side_slope), T[0])
    turn_slider(
        kind,
        frame,
        tree.first[n],
        y[tree.place[n, 0] :],
        y[tree.place[n, 1] :],
        bodies.A[child],
        bodies.omega[child],
        tree.alpha0[child],
        tree.column,
        k,
    )
    multiply(bodies.A[child], bodies.centre_b[child], bodies.c[child])
    return OK


@stage
def carry_slider(machine, n, acceleration):
    """Acceleration (α, a) of the child of node n, without that of its own joint, from those of the nodes, all as rows of `acceleration`."""
    tree = record_at(machine).tree
    number = tree.slider_of[n]
    frame, x = tree.frame[number], acceleration[tree.node[n, 0]]
    moved = carried_acceleration(machine, number, frame, acceleration, acceleration, 3)
    w = turning(frame, moved[1], moved[2])
    for c in range(3):
        x[c], x[3 + c] = w[c], moved[0][c]


@stage
def hand_slider(machine, n, wrench):
    """Add the wrench (moment, force) of the child of node n to those of the nodes of the beam, all as rows of `wrench`."""
    record = record_at(machine)
    markers, coordinates, tree = record.markers, record.coordinates, record.tree
    number = tree.slider_of[n]
    frame, own = tree.frame[number], wrench[tree.node[n, 0]]
    first, last, e = element_at(tree, coordinates, number, frame[SIGMA])
    force = (own[3], own[4], own[5])
    of_x, of_y = bending(frame, (own[0], own[1], own[2]))
    for k in range(4):
        m = coordinates.part_marker[beside(first, last, e, k)]
        out, share = wrench[markers.body[m]], times(frame[PLACE + k], force)
        lever = cross(markers.u[m], share)
        x = cross(axis_of(markers.A[m], 0), two(frame[SLOPE + k], force, frame[AXES + k], of_x))
        y = cross(axis_of(markers.A[m], 1), times(frame[AXES + k], of_y))
        for c in range(3):
            out[c] += lever[c] + x[c] + y[c]
            out[3 + c] += share[c]
