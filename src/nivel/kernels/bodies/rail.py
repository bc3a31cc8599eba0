"""Coordinates of a point and axes of a body that slide along a beam, from element to element.

The line X(σ) goes through the places r_a of the nodes and along their x axes, by cubic Hermite polynomials in σ, the unstressed length
from the start: with its slope T = X' it has no kink where the slider passes a node (a kink would strike it). What turns the slider, the
section axes x and y, are interpolated by cubic polynomials whose slope at a node is that between its neighbours (Catmull, Rom 1974), so
that the slider's turning rate does not jump there either. The axes y and z across which it is held are interpolated linearly: they
matter off the line only. p is the slider's point, d = p - X(σ), and σ is where Tᵀd = 0. Then

    σ̇ = [Tᵀ(ṗ - ∂X/∂t) + dᵀ ∂T/∂t] / D,   D = TᵀT - dᵀX''

and by differentiating once more σ̈, with d/dt = ∂/∂t + σ̇ ∂/∂σ. A point is on the line where yᵀd = zᵀd = 0; axes of the slider lean by
aᵀx and turn about the line by aᵀy. Each is a product of two vectors that σ and the nodes move, so are their derivatives: exact off the
line, too. Sliding joints: Simo, Vu-Quoc 1986 (interpolated place); Sugiyama, Escalona, Shabana 2003 (σ eliminated).
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.bodies.coordinate import ACROSS_Y, ACROSS_Z, ALONG, LEAN_X, TWIST
from nivel.kernels.core.status import NOT_ON_RAIL, OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

MOST = 50  # iterations
CLOSE = 1e-12  # of the length of the beam: the iteration after such a change is the last one
BEYOND = 0.02  # of its length by which a slider may be beyond an end, as it is where a soft stop holds it


@stage
def two(a, x, b, y):
    """a x + b y of 3-vectors."""
    return a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]


@stage
def axis_of(A, k):
    """Column k."""
    return A[0, k], A[1, k], A[2, k]


@stage
def weights(u, length, order):
    """Weights of the places and of the x axes of both nodes in the derivative of this order of X; u from 0 to 1 within the element."""
    if order == 0:
        h = u * u * (3.0 - 2.0 * u)
        return 1.0 - h, h, length * u * (1.0 - u) * (1.0 - u), length * u * u * (u - 1.0)
    if order == 1:
        h = 6.0 * u * (1.0 - u) / length
        return -h, h, 1.0 - 4.0 * u + 3.0 * u * u, 3.0 * u * u - 2.0 * u
    if order == 2:
        h = (6.0 - 12.0 * u) / (length * length)
        return -h, h, (6.0 * u - 4.0) / length, (6.0 * u - 2.0) / length
    h = (0.0 * u - 12.0) / (length * length * length)
    return -h, h, (6.0 + 0.0 * u) / (length * length), (6.0 + 0.0 * u) / (length * length)


@stage
def node_share(bodies, markers, m, place, turning, k):
    """(v, v̇, v̈ without accelerations of bodies) of v = place r + turning a, a being axis k of marker m."""
    w, a = bodies.omega[markers.body[m]], axis_of(markers.A[m], k)
    first = cross(w, a)
    return (
        two(place, markers.r[m], turning, a),
        two(place, markers.rdot[m], turning, first),
        two(place, markers.bias[m], turning, cross(w, first)),
    )


@stage
def along_rail(bodies, markers, m, n, w, k):
    """(v, ∂v/∂t, ∂²v/∂t²) of nodes m and n with the weights w: of both places, of both axes k."""
    a, adot, abias = node_share(bodies, markers, m, w[0], w[2], k)
    b, bdot, bbias = node_share(bodies, markers, n, w[1], w[3], k)
    return two(1.0, a, 1.0, b), two(1.0, adot, 1.0, bdot), two(1.0, abias, 1.0, bbias)


@stage
def place_of(markers, m, n, w):
    """Σ of places and x axes of the nodes m and n with the weights w."""
    a = two(w[0], markers.r[m], w[1], markers.r[n])
    b = two(w[2], axis_of(markers.A[m], 0), w[3], axis_of(markers.A[n], 0))
    return two(1.0, a, 1.0, b)


@stage
def closest(markers, coordinates, q, along):
    """(σ, part of the first of the two nodes beside it, whether it was found) for the slider of coordinate q.

    Newton's iteration from where the coordinate `along` was at the last accepted state. One more iteration than real numbers need makes
    the imaginary part right.
    """
    parts, station = coordinates.part_marker, coordinates.station
    slider, first, last = coordinates.start[q], coordinates.start[q] + 1, coordinates.start[q + 1] - 2
    p = markers.r[parts[slider]]
    sigma = coordinates.reference[along] + 0.0 * p[0]
    e, settled = first, False
    for _ in range(MOST):
        while e < last and real(sigma) > station[e + 1]:
            e += 1
        while e > first and real(sigma) < station[e]:
            e -= 1
        if settled:
            return sigma, e, True
        length = station[e + 1] - station[e]
        u = (sigma - station[e]) / length
        m, n = parts[e], parts[e + 1]
        d = two(1.0, p, -1.0, place_of(markers, m, n, weights(u, length, 0)))
        T = place_of(markers, m, n, weights(u, length, 1))
        D = dot(T, T) - dot(d, place_of(markers, m, n, weights(u, length, 2)))
        if not real(D) > 0.0:
            break
        change = dot(T, d) / D
        # from farther away the polynomials of this element say little
        change *= min(1.0, 2.0 * length / max(np.abs(real(change)), 1e-300))
        sigma += change
        settled = np.abs(real(change)) <= CLOSE * station[last + 1]
    return sigma, e, False


@stage
def add_to_node(J, factor, place, turning, a, v):
    """Add factor × (what vᵀ δ(place r + turning a) asks of the node) to its part J (6,)."""
    n = cross(a, v)
    for i in range(3):
        J[i] += factor * place * v[i]
        J[3 + i] += factor * turning * n[i]


@stage
def add_to_nodes(markers, J, m, n, w, k, v, factor):
    """Add factor × vᵀ δ(Σ w (places, axes k)) to the parts J (2, 6) of both nodes."""
    add_to_node(J[0], factor, w[0], w[2], axis_of(markers.A[m], k), v)
    add_to_node(J[1], factor, w[1], w[3], axis_of(markers.A[n], k), v)


@stage
def product_rates(a, b):
    """(aᵀb, its rate, its second derivative) of two vectors with theirs."""
    rate = dot(a[1], b[0]) + dot(a[0], b[1])
    return dot(a[0], b[0]), rate, dot(a[2], b[0]) + 2.0 * dot(a[1], b[1]) + dot(a[0], b[2])


@stage
def following(v, slope, bend, rate, second):
    """(v, dv/dt, d²v/dt²) along with the slider from (v, ∂v/∂t, ∂²v/∂t²), those of v' and v'' itself, and σ̇, σ̈."""
    total = two(1.0, v[1], rate, slope[0])
    more = two(1.0, two(2.0 * rate, slope[1], second, slope[0]), rate * rate, bend)
    return v[0], total, two(1.0, v[2], 1.0, more)


@stage
def section_axis(bodies, markers, m, n, u, length, k):
    """(weights of y or z, (v, ∂v/∂t, ∂²v/∂t²), the same of v') of section axis k."""
    zero, slope = 0.0 * u, 1.0 / length + 0.0 * u
    N = zero, zero, 1.0 - u, u
    return N, along_rail(bodies, markers, m, n, N, k), along_rail(bodies, markers, m, n, (zero, zero, -slope, slope), k)


@stage
def across(markers, J, own, m, n, k, w, axis, away, rate, second):
    """(value, rate, second derivative) of dᵀ times section axis k; adds to the parts what does not come from σ."""
    N, v, slope = axis
    d = away[0]
    for i in range(3):
        own[i] += v[0][i]
    add_to_nodes(markers, J, m, n, w, 0, v[0], -1.0)
    add_to_nodes(markers, J, m, n, N, k, d, 1.0)
    section = following(v, slope, two(0.0, d, 0.0, d), rate, second)
    return product_rates(section, away)


@leaf
def spread(u, length, order, before, after):
    """Weights of four nodes in the derivative of this order of an interpolated axis, u from 0 to 1 between the second and the third.

    before : from the first to the third [m], or 0 where there is no first; after : from the second to the last, likewise.
    """
    a, b, c, d = weights(u, length, order)
    if before > 0.0:
        first, b = -c / before, b + c / before
    else:
        first, a, b = 0.0 * c, a - c / length, b + c / length
    if after > 0.0:
        return first, a - d / after, b, d / after
    return first, a - d / length, b + d / length, 0.0 * d


@leaf
def beside(first, last, e, k):
    """Part of the k-th of four nodes about element e of nodes `first` to `last` + 1; beyond an end, of its node."""
    return min(max(e + k - 1, first), last + 1)


@leaf
def spans(station, first, last, e):
    """`before` and `after` of `spread`."""
    return (
        station[e + 1] - station[e - 1] if e > first else 0.0,
        station[e + 2] - station[e] if e < last else 0.0,
    )


@stage
def interpolated_axis(bodies, markers, coordinates, first, last, e, w, k):
    """(v, ∂v/∂t, ∂²v/∂t²) of axis k of four nodes about element e with the weights w."""
    v, rate, bias = node_share(bodies, markers, coordinates.part_marker[beside(first, last, e, 0)], 0.0, w[0], k)
    for n in range(1, 4):
        a, adot, abias = node_share(bodies, markers, coordinates.part_marker[beside(first, last, e, n)], 0.0, w[n], k)
        v, rate, bias = two(1.0, v, 1.0, a), two(1.0, rate, 1.0, adot), two(1.0, bias, 1.0, abias)
    return v, rate, bias


@stage
def turned_by(bodies, markers, coordinates, q, own, e, u, length, k, axis, rate, second):
    """(value, rate, second derivative) of the slider's `axis` times axis k of the sections, and its slope; adds to the parts."""
    first, last = np.int64(coordinates.start[q]) + 1, np.int64(coordinates.start[q + 1]) - 2
    before, after = spans(coordinates.station, first, last, e)
    w = spread(u, length, 0, before, after)
    v = interpolated_axis(bodies, markers, coordinates, first, last, e, w, k)
    slope = interpolated_axis(bodies, markers, coordinates, first, last, e, spread(u, length, 1, before, after), k)
    bend = interpolated_axis(bodies, markers, coordinates, first, last, e, spread(u, length, 2, before, after), k)
    turn = cross(axis[0], v[0])
    for i in range(3):
        own[3 + i] += turn[i]
    for n in range(4):
        part = beside(first, last, e, n)
        add_to_node(coordinates.J[part], 1.0, 0.0, w[n], axis_of(markers.A[coordinates.part_marker[part]], k), axis[0])
    return product_rates(axis, following(v, slope, bend[0], rate, second)), dot(axis[0], slope[0])


@family
def apply(machine, q, t):
    """Value, rate, second derivative and parts of coordinate q of a slider on a rail."""
    record = record_at(machine)
    bodies, markers, coordinates = record.bodies, record.markers, record.coordinates
    kind, slider, start = coordinates.what[q, 0], coordinates.what[q, 1], coordinates.start[q]
    along = np.int64(q) if kind == ALONG else np.int64(coordinates.what[q, 3])
    sigma, e, found = closest(markers, coordinates, q, along)
    whole = coordinates.station[coordinates.start[q + 1] - 1]
    if not found or real(sigma) < -BEYOND * whole or real(sigma) > (1.0 + BEYOND) * whole:
        record.control.failure[0] = along
        return NOT_ON_RAIL
    for part in range(start, coordinates.start[q + 1]):
        for i in range(6):
            coordinates.J[part, i] = 0.0
    length = coordinates.station[e + 1] - coordinates.station[e]
    u = (sigma - coordinates.station[e]) / length
    m, n = coordinates.part_marker[e], coordinates.part_marker[e + 1]
    J, own = coordinates.J[e : e + 2], coordinates.J[start]
    w0, w1 = weights(u, length, 0), weights(u, length, 1)
    X, T = along_rail(bodies, markers, m, n, w0, 0), along_rail(bodies, markers, m, n, w1, 0)
    bend = along_rail(bodies, markers, m, n, weights(u, length, 2), 0)
    third = place_of(markers, m, n, weights(u, length, 3))
    # d and its derivatives at fixed σ, then those of σ
    d, v = two(1.0, markers.r[slider], -1.0, X[0]), two(1.0, markers.rdot[slider], -1.0, X[1])
    D = dot(T[0], T[0]) - dot(d, bend[0])
    rate = (dot(T[0], v) + dot(d, T[1])) / D
    moving, turned = two(1.0, v, -rate, T[0]), two(1.0, T[1], rate, bend[0])
    a = two(1.0, two(1.0, markers.bias[slider], -1.0, X[2]), -1.0, two(2.0 * rate, T[1], rate * rate, bend[0]))
    bent = two(1.0, two(1.0, T[2], 2.0 * rate, bend[1]), rate * rate, third)
    second = (dot(T[0], a) + 2.0 * dot(turned, moving) + dot(d, bent)) / D
    away = d, moving, two(1.0, a, -second, T[0])
    values, slope = (sigma, rate, second), 1.0 + 0.0 * u
    if kind in (ACROSS_Y, ACROSS_Z):
        k = 1 if kind == ACROSS_Y else 2
        axis = section_axis(bodies, markers, m, n, u, length, k)
        values = across(markers, J, own, m, n, k, w0, axis, away, rate, second)
        slope = dot(axis[2][0], d) - dot(axis[1][0], T[0])
    elif kind != ALONG:
        axis = node_share(bodies, markers, slider, 0.0, 1.0, 0 if kind == LEAN_X else 1)
        along_axis = 1 if kind == TWIST else 0
        values, slope = turned_by(bodies, markers, coordinates, q, own, e, u, length, along_axis, axis, rate, second)
    # what σ contributes
    share = slope / D
    for i in range(3):
        own[i] += share * T[0][i]
    add_to_nodes(markers, J, m, n, w0, 0, T[0], -share)
    add_to_nodes(markers, J, m, n, w1, 0, d, share)
    coordinates.value[q], coordinates.rate[q], coordinates.bias[q] = values
    return OK
