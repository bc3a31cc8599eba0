"""Elements of cables in absolute nodal coordinates: slender beams without shear, by places and slopes of their nodes.

With the slope d = r' and r'', the stretch is ε = |d| - 1 and the curvature K = d × r''/|d|², the turn of the tangent over unstressed
length (Gerstmayr, Shabana 2006; Gerstmayr, Irschik 2008, for what curvature goes with a moment where the cable is stretched). A cable bends
alike in all directions. Nodes turn about their slopes, and the twist between two of them is what is left of their turn after the
least one that takes one slope to the other; its rate is (ω_b - ω_a)·(t_a + t_b)/(1 + t_a·t_b). Stretch is integrated at three points and
bending at two: the fewest that leave no motion free, which keeps a thin cable free of locking.
"""

import numpy as np

from nivel.elements.beams.exact import gauss
from nivel.elements.beams.gradients import STEP, Array, hermite, lengths_of, line_at, moved_vectors
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import arctan2
from nivel.kernels.algebra.gradients import (
    DAMPING,
    OWN,
    RATE,
    VECTOR,
    add_along_line,
    along_line,
    push_vectors,
    read_vectors,
)
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, plus, times
from nivel.kernels.forces.wrench import add_torque
from nivel.kernels.record.record import record_at
from nivel.known import Beam
from nivel.native.function import stage

WIDTH = 2  # vectors of a node
# columns of `columns`, behind the points: markers with the axes of the nodes
AXES = 4
# columns of `number`: EA, EI, GJ over the length of the element; for each point of stretch its weight [m] and weights of r'; for each
# point of bending these and weights of r''
STRETCH, BENDING, TWIST, STRETCHED, BENT = OWN, OWN + 1, OWN + 2, OWN + 3, OWN + 18
NUMBERS = OWN + 36
STRETCH_POINTS, BENDING_POINTS = 3, 2


@stage
def stretch_point(n, q, control):
    """What one point of stretch stores, loses and pulls. q : its columns."""
    weights = q[1:5]
    d = along_line(n, VECTOR, weights, WIDTH)
    length = np.sqrt(dot(d, d))
    strain, rate = length - 1.0, dot(d, along_line(n, RATE, weights, WIDTH)) / length
    viscous = n[DAMPING] * n[STRETCH] * rate
    control.stored[0] += 0.5 * q[0] * n[STRETCH] * strain * strain
    control.power[1] += q[0] * viscous * rate
    f = q[0] * (n[STRETCH] * strain + viscous) / length
    add_along_line(n, weights, WIDTH, times(f, d))


@stage
def bending_point(n, q, control):
    """The same of one point of bending. What stores acts across the tangent, so the curvature's own turn with it does no work."""
    slopes, bends = q[1:5], q[5:9]
    d, dd = along_line(n, VECTOR, slopes, WIDTH), along_line(n, VECTOR, bends, WIDTH)
    v, vv = along_line(n, RATE, slopes, WIDTH), along_line(n, RATE, bends, WIDTH)
    over = 1.0 / dot(d, d)
    c, first, second = cross(d, dd), cross(v, dd), cross(d, vv)
    K = times(over, c)
    rate = minus(times(over, plus(first, second)), times(2.0 * over * dot(d, v), K))
    rate = minus(rate, times(over * dot(rate, d), d))
    EI, lag = n[BENDING], n[DAMPING]
    control.stored[0] += 0.5 * q[0] * EI * dot(K, K)
    control.power[1] += q[0] * lag * EI * dot(rate, rate)
    M = times(q[0] * EI * over, plus(K, times(lag, rate)))
    add_along_line(n, slopes, WIDTH, minus(cross(dd, M), times(2.0 * dot(K, M), d)))
    add_along_line(n, bends, WIDTH, cross(M, d))


@stage
def twist_of(A, B):
    """Turn from axes A to axes B about their x axes, beyond the least turn that takes one x axis to the other [rad]."""
    t, s, y, e, z = axis(A, 0), axis(B, 0), axis(A, 1), axis(B, 1), axis(B, 2)
    share = dot(s, y) / (1.0 + dot(t, s))
    carried = minus(y, times(share, plus(t, s)))
    return arctan2(-dot(carried, z), dot(carried, e))


@stage
def twist_nodes(bodies, markers, index, n, control):
    """What twist between the nodes stores, loses and turns."""
    a, b = index[AXES], index[AXES + 1]
    A, B, first, second = markers.A[a], markers.A[b], markers.body[a], markers.body[b]
    s, x = axis(A, 0), axis(B, 0)
    m = times(1.0 / (1.0 + s[0] * x[0] + s[1] * x[1] + s[2] * x[2]), plus(s, x))
    angle = twist_of(A, B)
    rate = dot(m, bodies.omega[second]) - dot(m, bodies.omega[first])
    viscous = n[DAMPING] * n[TWIST] * rate
    control.stored[0] += 0.5 * n[TWIST] * angle * angle
    control.power[1] += viscous * rate
    torque = n[TWIST] * angle + viscous
    add_torque(bodies, first, times(torque, m))
    add_torque(bodies, second, times(-torque, m))


@element
def apply(machine, index, n, t):
    """An element."""
    record = record_at(machine)
    bodies, markers, control = record.bodies, record.markers, record.control
    read_vectors(markers, index, n, WIDTH)
    for g in range(STRETCH_POINTS):
        stretch_point(n, n[STRETCHED + 5 * g : STRETCHED + 5 * g + 5], control)
    for g in range(BENDING_POINTS):
        bending_point(n, n[BENT + 9 * g : BENT + 9 * g + 9], control)
    twist_nodes(bodies, markers, index, n, control)
    push_vectors(bodies, markers, index, n, WIDTH)


def cable_numbers(beam: Beam) -> list[list[float]]:
    """Numbers from OWN on, an element each."""
    C = beam.properties.stiffness
    (xi, weight), (at, share) = gauss(STRETCH_POINTS), gauss(BENDING_POINTS)
    out = []
    for length in lengths_of(beam).tolist():
        slope, own, bend = hermite(xi, length, 1), hermite(at, length, 1), hermite(at, length, 2)
        stretch = np.column_stack([weight * length, slope])
        bending = np.column_stack([share * length, own, bend])
        out.append([C[0, 0], C[4, 4], C[3, 3] / length, *stretch.ravel().tolist(), *bending.ravel().tolist()])
    return out


def cable_strains(beam: Beam, v: Array, xi: Array) -> tuple[Array, Array]:
    """Stretch (…, n, g) and curvature vector (…, n, g, 3) [1/m], global axes, of a cable at xi (g,); for complex vectors too."""
    line = line_at(beam, v, xi)
    square = np.sum(line.slope**2, axis=-1)
    return np.sqrt(square) - 1.0, np.cross(line.slope, line.bend) / square[..., None]


def twists(axes: Array) -> Array:
    """(…, N - 1) [rad] between nodes with axes (…, N, 3, 3), beyond the least turn from one x axis to the next."""
    A, B = axes[..., :-1, :, :], axes[..., 1:, :, :]
    carried = carried_over(A[..., 1], A[..., 0], B[..., 0])
    return np.arctan2(-np.sum(carried * B[..., 2], axis=-1), np.sum(carried * B[..., 1], axis=-1))


def carried_over(y: Array, t: Array, s: Array) -> Array:
    """Vectors y (…, 3) across t, turned by the least turn that takes the unit vector t to s."""
    share = np.sum(s * y, axis=-1) / (1.0 + np.sum(t * s, axis=-1))
    return y - share[..., None] * (t + s)


def cable_stiffness(beam: Beam, length: float) -> Array:
    """Stiffness of an element of this length [m], straight and unstressed, for the vectors of its nodes."""
    C, moved = beam.properties.stiffness, moved_vectors(beam)
    (xi, weight), (at, share) = gauss(STRETCH_POINTS), gauss(BENDING_POINTS)
    stretch = cable_strains(beam, moved, xi)[0][:, 0].imag / STEP
    bend = cable_strains(beam, moved, at)[1][:, 0].imag / STEP
    K = C[0, 0] * np.einsum("ig,jg,g->ij", stretch, stretch, weight * length)
    K += C[4, 4] * np.einsum("iga,jga,g->ij", bend, bend, share * length)
    return np.asarray(K, dtype=float)
