"""Elements of beams in absolute nodal coordinates: shape functions, consistent mass, and the strains of a beam that is unstressed.

The vectors of a node are its place r and gradients: along the beam ∂r/∂X, and of `ancf-beam` across it ∂r/∂Y and ∂r/∂Z too. A point
(X, Y, Z) of an element is at Σ N_j(X) s_j v_j, s = 1, 1, Y, Z: Hermite's cubic polynomials for r and ∂r/∂X, linear ones for the others
(Shabana, Yakoub 2001; Gerstmayr, Shabana 2006).
"""

from typing import Any

import numpy as np

from nivel.elements.beams.exact import gauss
from nivel.elements.facts import Coupled
from nivel.kernels.record.hook import Family
from nivel.known import Beam, BeamSection, SystemBuilder
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

VECTORS = 72  # places, rates and forces of an element
STEP = 1e-30  # of a complex step


def vectors_of_node(beam: Beam) -> int:
    """How many vectors a node of the beam has."""
    return 2 if beam.model == "ancf-cable" else 4


def reach_of(beam: Beam) -> float:
    """Distance of the tips of gradients from their node [m]: the mean length of an element."""
    return beam.line.length / (len(beam.shares) - 1)


def lengths_of(beam: Beam) -> Array:
    """(n,) [m] of the elements, along the unstressed line."""
    return beam.line.length * np.diff(beam.shares)


def hermite(xi: Array, length: float, derivative: int = 0) -> Array:
    """(…, 4) shape functions of (place, gradient) of both nodes at xi in [0, 1], or their derivatives with respect to the length."""
    one = np.ones_like(xi)
    if derivative == 0:
        place = 3.0 * xi**2 - 2.0 * xi**3
        parts = [1.0 - place, length * (xi - 2.0 * xi**2 + xi**3), place, length * (xi**3 - xi**2)]
    elif derivative == 1:
        place = 6.0 * (xi - xi**2) / length
        parts = [-place, 1.0 - 4.0 * xi + 3.0 * xi**2, place, 3.0 * xi**2 - 2.0 * xi]
    elif derivative == 2:
        place = (6.0 - 12.0 * xi) / length**2
        parts = [-place, (6.0 * xi - 4.0) / length, place, (6.0 * xi - 2.0) / length]
    else:
        parts = [12.0 * one / length**3, 6.0 * one / length**2, -12.0 * one / length**3, 6.0 * one / length**2]
    return np.stack(parts, axis=-1)


def section_moments(section: BeamSection) -> Array:
    """(3, 3) ∫ρ s_i s_j dA of s = (1, Y, Z) [kg/m, kg, kg m], from the line of the beam."""
    m, (_, y, z), J = section.mass, section.mass_centre, section.inertia
    return np.array(
        [
            [m, m * y, m * z],
            [m * y, J[2, 2] + m * y * y, m * y * z - J[1, 2]],
            [m * z, m * y * z - J[1, 2], J[1, 1] + m * z * z],
        ]
    )


def consistent_mass(beam: Beam, length: float) -> Array:
    """(2 w, 2 w) [kg, …] mass matrix of an element for its w vectors a node."""
    width = vectors_of_node(beam)
    xi, weight = gauss(4)
    cubic, linear = hermite(xi, length), np.stack([1.0 - xi, xi], axis=-1)
    of_node = [np.stack([cubic[:, 2 * a], cubic[:, 2 * a + 1], linear[:, a], linear[:, a]], axis=-1) for a in (0, 1)]
    N = np.concatenate([each[:, :width] for each in of_node], axis=1)
    kind = np.tile(np.array([0, 0, 1, 2])[:width], 2)
    moments = section_moments(beam.properties)[np.ix_(kind, kind)]
    return np.asarray(length * np.einsum("g,gi,gj->ij", weight, N, N) * moments, dtype=float)


def lumped_mass(beam: Beam, length: float) -> tuple[Array, Array]:
    """(w, w) of either node: what of an element's mass belongs to one body. Place and first moments are those of the consistent mass, so
    weight and momentum are; the second moment along the beam is any that makes a body: the pair of nodes has the rest in common."""
    width, S = vectors_of_node(beam), section_moments(beam.properties)
    both = []
    for sign in (1.0, -1.0):
        W = np.zeros((4, 4))
        W[np.ix_([0, 2, 3], [0, 2, 3])] = 0.5 * length * S
        W[1, [0, 2, 3]] = W[[0, 2, 3], 1] = sign * length**2 / 12.0 * S[0]
        W[1, 1] = length**3 / 36.0 * S[0, 0]
        both.append(W[:width, :width])
    return both[0], both[1]


def as_points(width: int, reach: float) -> Array:
    """(w, w) T with vectors = T points: of the node and the tips of its gradients."""
    T = np.eye(width)
    T[1:] /= reach
    T[1:, 0] = -1.0 / reach
    return T


def gradients(axes: Array, modal: Array, change: Array) -> Array:
    """(…, 3, k) gradients of nodes, by axes (…, 3, 3) and modal coordinates (…, m); change : (k, 3, m) of each gradient in them, axes of
    the node."""
    k = len(change)
    local = np.eye(3)[:k] + np.einsum("kim,...m->...ki", change, modal)
    return np.einsum("...ij,...kj->...ik", axes, local)


def unstressed_vectors(beam: Beam) -> Array:
    """(N, w, 3) of the nodes of a beam as it is given."""
    place, axes = beam.frames(beam.shares)
    return np.concatenate([place[:, None], np.swapaxes(axes, 1, 2)], axis=1)[:, : vectors_of_node(beam)]


class Line(Struct):
    """The line of a beam at points of its elements: r', r'' and r''' (…, n, g, 3), with respect to unstressed length."""

    slope: Array
    bend: Array
    third: Array


def line_at(beam: Beam, v: Array, xi: Array) -> Line:
    """At xi (g,) in every element, for the vectors v (…, N, w, 3) of the nodes."""
    lengths = lengths_of(beam)
    vectors = np.concatenate([v[..., :-1, :2, :], v[..., 1:, :2, :]], axis=-2)
    first, second, third = (np.stack([hermite(xi, length, k) for length in lengths]) for k in (1, 2, 3))
    return Line(*(np.einsum("ngj,...nji->...ngi", each, vectors) for each in (first, second, third)))


def points_of(builder: SystemBuilder, beam: Beam) -> list[list[int]]:
    """Markers of each node and of the tips of its gradients; the same ones at every call."""
    reach, width = reach_of(beam), vectors_of_node(beam)
    with builder.within(f"beams.{beam.name}"):
        return [
            [builder.frame(name), *(builder.tip(name, axis, reach) for axis in range(width - 1))]
            for name in beam.node_names
        ]


def moved_vectors(beam: Beam) -> Any:
    """(n, 2, w, 3) complex vectors of both nodes, each of the n of their numbers moved by i STEP."""
    v: Any = unstressed_vectors(beam).astype(complex)
    count = v.size
    return v + 1j * STEP * np.eye(count).reshape(count, *v.shape)


def add_gradients(builder: SystemBuilder, beam: Beam, family: Family, numbers: list[list[float]]) -> None:
    """The elements of a beam, whose nodes are bodies and whose gradients are points on these. numbers : of each, behind its vectors."""
    points, axes = points_of(builder, beam), [builder.frame(name) for name in beam.node_names]
    head = [beam.damping, reach_of(beam), reach_of(beam), *[0.0] * VECTORS]
    for e, own in enumerate(numbers):
        index = [*points[e], *points[e + 1]]
        if beam.model == "ancf-cable":
            index += axes[e : e + 2]
        builder.elements.add(family, index, [*head, *own])
        builder.noted.append(Coupled(frozenset(builder.markers.body[node] for node in axes[e : e + 2])))
