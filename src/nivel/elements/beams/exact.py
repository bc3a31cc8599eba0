"""Elements of geometrically exact beams (Reissner 1981; Simo 1985), objective by relative rotations (Crisfield, Jelenić 1999).

Along an element the line is x = Σ N_a x_a and the section turned by R = R_r exp(ψ̃), ψ = Σ N_a ψ_a, where ψ_a is the rotation vector of node
a seen from the reference node r, or, with total interpolation, from axes fixed in space. Strains in section axes and their variations,
with small rotations δθ̄ in section axes:

    Γ = Rᵀ x' - Γ_0        δΓ = Rᵀ δx' + Rᵀ x' × δθ̄          δθ̄ = exp(-ψ̃) δθ̄_r + T δψ
    Κ = T ψ' - Κ_0         δΚ = D(T ψ')·δψ + T δψ'            δψ = Σ N_a δψ_a,  δψ_a = T_a⁻¹ (δθ̄_a - exp(-ψ̃_a) δθ̄_r)

T = a 1 - b ψ̃ + c ψ ⊗ ψ with a = sin ψ/ψ, b = (1 - cos ψ)/ψ², c = (ψ - sin ψ)/ψ³. Forces and moments are C (strain + damping × its
rate), and what nodes feel follows from the same variations, so the elastic part has the potential ½ ∫ strain · C strain.

Finite elements interpolate by Lagrange's polynomials. Stiffness is integrated at as many Gauss points as the order, which keeps it free of
locking; mass exactly.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.elements.beams.beam import Beam
from nivel.elements.facts import Coupled
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.inverse_tangent import inverse_tangent_by, inverse_tangent_factor
from nivel.kernels.algebra.relative_rotation import rotation_vector
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, opposite, plus, put, seen, times, turned
from nivel.kernels.bodies.floating_frame import turn_factors
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import FAMILIES, Family, family
from nivel.kernels.record.record import NONE, Record, record_at
from nivel.known import SystemBuilder
from nivel.lazy import Struct, scipy
from nivel.machine.core.orientation import matrix_from_euler_parameters
from nivel.machine.core.placement import placement
from nivel.machine.core.record import GROUND
from nivel.machine.core.vectors import Array
from nivel.native.function import leaf, stage

MOST = 4  # nodes of an element


class ElementRow(Row):
    """An element: markers of its nodes, how many they are, Gauss points, which of them is the reference node (MOST: none), and the marker
    from whose axes the sections turn; time of damping [s], stiffness, for each Gauss point its weight [m], shape functions (4), their
    slopes (4) and strain that counts as none (6). Then work: rotation vectors of the nodes, what they ask for, their rates, forces and
    torques on the nodes."""

    node: Sequence[int] = several(4)
    count: int
    points: int
    reference: int
    frame: int
    damping: float
    stiffness: Sequence[float] = several(36)
    point: Sequence[float] = several(45)
    psi: Sequence[float] = several(12, default=(0.0,) * 12)
    asked: Sequence[float] = several(12, default=(0.0,) * 12)
    rate: Sequence[float] = several(12, default=(0.0,) * 12)
    force: Sequence[float] = several(12, default=(0.0,) * 12)
    torque: Sequence[float] = several(12, default=(0.0,) * 12)


# columns of a Gauss point
WEIGHT, SHAPE, SLOPE, STRAIN, WIDTH = 0, 1, 5, 9, 15


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
        here = minus(psi, near)
        other = times(factor, psi)
        there = minus(other, near)
        if real(dot(there, there)) < real(dot(here, here)):
            put(psi, 0, other)


@stage
def find_turns(bodies, markers, index, n):
    """Rotation vectors of the nodes relative to the reference node, and where there is damping their rates."""
    r, count = index[ElementRow.REFERENCE], index[ElementRow.COUNT]
    Ar, wr = markers.A[index[ElementRow.FRAME]], bodies.omega[markers.body[index[ElementRow.FRAME]]]
    for a in range(count):
        psi, A = n[ElementRow.PSI + 3 * a : ElementRow.PSI + 3 * a + 3], markers.A[index[ElementRow.NODE + a]]
        if a == r:
            psi[0], psi[1], psi[2] = 0.0, 0.0, 0.0
        else:
            rotation_vector(Ar, A, psi)
            if r == MOST and a > 0:
                nearest_chart(n[ElementRow.PSI : ElementRow.PSI + 3], psi)
        for i in range(3):
            n[ElementRow.ASKED + 3 * a + i], n[ElementRow.FORCE + 3 * a + i] = 0.0, 0.0
        if real(n[ElementRow.DAMPING]) > 0.0:
            relative = seen(A, minus(bodies.omega[markers.body[index[ElementRow.NODE + a]]], wr))
            put(n, ElementRow.RATE + 3 * a, inverse_tangent_product(psi, relative, 1.0))


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
        r = place[index[ElementRow.NODE + a]]
        x += slope[a] * r[0]
        y += slope[a] * r[1]
        z += slope[a] * r[2]
    return x, y, z


@stage
def rotated(a, b, psi, v):
    """exp(ψ̃) v = v + a ψ × v + b ψ × (ψ × v); with -a: exp(-ψ̃) v."""
    c = cross(psi, v)
    return sum_of(1.0, v, a, c, b, cross(psi, c))


@stage
def tangent_product(a, b, c, psi, v):
    """T v; with -b: Tᵀ v."""
    return sum_of(a, v, -b, cross(psi, v), c * dot(psi, v), psi)


@leaf
def row_by(C, e):
    """A row of a 6×6 matrix times a vector of six."""
    return C[0] * e[0] + C[1] * e[1] + C[2] * e[2] + C[3] * e[3] + C[4] * e[4] + C[5] * e[5]


@stage
def six_by_six(C, e):
    """C e of a matrix (36,) by rows, as a tuple."""
    s0, s1, s2 = row_by(C, e), row_by(C[6:], e), row_by(C[12:], e)
    return s0, s1, s2, row_by(C[18:], e), row_by(C[24:], e), row_by(C[30:], e)


@stage
def section_forces(n, first, strain, rate, weight, damping, control):
    """Force and moment of a section over the length `weight` for its six strains and their rates; adds what it stores and loses. Its
    stiffness stands in n from `first` on."""
    C = n[first : first + 36]
    s, v = six_by_six(C, strain), six_by_six(C, rate)
    stored, lost = 0.0 * s[0], 0.0 * s[0]
    for i in range(6):
        stored += 0.5 * s[i] * strain[i]
        lost += damping * v[i] * rate[i]
    control.stored[0] += weight * stored
    control.power[1] += weight * lost
    f = weight * (s[0] + damping * v[0]), weight * (s[1] + damping * v[1]), weight * (s[2] + damping * v[2])
    return f, (weight * (s[3] + damping * v[3]), weight * (s[4] + damping * v[4]), weight * (s[5] + damping * v[5]))


@stage
def point_of_element(bodies, markers, index, n, q, control):
    """Add what Gauss point q stores, loses and asks of the nodes; returns the moment in section axes of the reference node."""
    count = index[ElementRow.COUNT]
    Ar, wr = markers.A[index[ElementRow.FRAME]], bodies.omega[markers.body[index[ElementRow.FRAME]]]
    shape, slope, unstrained = q[SHAPE : SHAPE + 4], q[SLOPE : SLOPE + 4], q[STRAIN : STRAIN + 6]
    psi, bend = interpolated(n, shape, ElementRow.PSI, count), interpolated(n, slope, ElementRow.PSI, count)
    square = dot(psi, psi)
    b, c, db, dc = turn_factors(square)
    a, da = 1.0 - square * c, -2.0 * c - square * dc
    stretch = rotated(-a, b, psi, seen(Ar, along_line(markers.r, index, slope, count)))
    kappa = tangent_product(a, b, c, psi, bend)
    strain = minus(stretch, unstrained) + minus(kappa, unstrained[3:])
    weight, damping = q[WEIGHT], n[ElementRow.DAMPING]
    zero = 0.0 * strain[0]
    rate = zero, zero, zero, zero, zero, zero
    if real(damping) > 0.0:
        turning = interpolated(n, shape, ElementRow.RATE, count)
        bending = interpolated(n, slope, ElementRow.RATE, count)
        w = rotated(-a, b, psi, seen(Ar, wr))
        t = tangent_product(a, b, c, psi, turning)
        spin = plus(w, t)
        moved = rotated(-a, b, psi, seen(Ar, along_line(markers.rdot, index, slope, count)))
        g = cross(stretch, spin)
        k = tangent_product(a, b, c, psi, bending)
        # D(T ψ')·ψ̇
        along, across, both = dot(psi, turning), cross(psi, bend), dot(psi, bend)
        d = sum_of(da * along, bend, -db * along, across, -b, cross(turning, bend))
        f = sum_of(c * both, turning, c * dot(turning, bend) + dc * along * both, psi, 1.0, d)
        rate = plus(moved, g) + plus(k, f)
    N, M = section_forces(n, ElementRow.STIFFNESS, strain, rate, weight, damping, control)
    force = turned(Ar, rotated(a, b, psi, N))
    moment = cross(N, stretch)
    # what δψ and δψ' ask for: Tᵀ m + D(T ψ')ᵀ M and Tᵀ M
    along, across, both = dot(bend, M), dot(cross(psi, bend), M), dot(psi, bend)
    of_psi = sum_of(1.0, tangent_product(a, -b, c, psi, moment), -b, cross(bend, M), c * both, M)
    outwards = da * along - db * across + dc * dot(psi, M) * both
    of_psi = sum_of(1.0, of_psi, outwards, psi, c * dot(psi, M), bend)
    of_slope = tangent_product(a, -b, c, psi, M)
    for k in range(count):
        for i in range(3):
            n[ElementRow.ASKED + 3 * k + i] += shape[k] * of_psi[i] + slope[k] * of_slope[i]
            n[ElementRow.FORCE + 3 * k + i] -= slope[k] * force[i]
    return rotated(a, b, psi, moment)


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
    """What an element stores and asks of its nodes, on their bodies; forces and torques on the nodes stay in n."""
    find_turns(bodies, markers, index, n)
    zero = 0.0 * n[0]
    whole = zero, zero, zero
    for g in range(index[ElementRow.POINTS]):
        q = n[ElementRow.POINT + WIDTH * g : ElementRow.POINT + WIDTH * (g + 1)]
        whole = plus(whole, point_of_element(bodies, markers, index, n, q, control))
    r = index[ElementRow.REFERENCE]
    whole = turned(markers.A[index[ElementRow.FRAME]], whole)
    for a in range(index[ElementRow.COUNT]):
        if a != r:
            node, psi, asked = index[ElementRow.NODE + a], n[ElementRow.PSI + 3 * a :], n[ElementRow.ASKED + 3 * a :]
            torque = turned(markers.A[node], inverse_tangent_product(psi, asked, -1.0))
            put(n, ElementRow.TORQUE + 3 * a, opposite(torque))
            push_node(bodies, markers, node, n[ElementRow.FORCE + 3 * a :], n[ElementRow.TORQUE + 3 * a :])
            whole = minus(whole, torque)
    if r != MOST:
        put(n, ElementRow.TORQUE + 3 * r, opposite(whole))
        node = index[ElementRow.NODE + r]
        push_node(bodies, markers, node, n[ElementRow.FORCE + 3 * r :], n[ElementRow.TORQUE + 3 * r :])


@element
def apply(machine, index, n, t):
    """An element."""
    record = record_at(machine)
    element_forces(record.bodies, record.markers, index, n, record.control)


@family
def apply_elastic(machine, number, t):
    """All elements without damping; their wrenches are kept."""
    record = record_at(machine)
    elements, wrench = record.elements, record.beams.wrench
    first = elements.span[number, 0]
    for k in range(first, elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        element_forces(record.bodies, record.markers, index, n, record.control)
        if wrench.shape[0] > 0:
            kept = wrench[k - first]
            for a in range(index[ElementRow.COUNT]):
                for i in range(3):
                    kept[6 * a + i] = n[ElementRow.FORCE + 3 * a + i].real
                    kept[6 * a + 3 + i] = n[ElementRow.TORQUE + 3 * a + i].real
    return OK


@family
def hold(machine, number, t):
    """The same with the wrenches that they had as last evaluated, so that what is left to differentiate is how these act."""
    record = record_at(machine)
    elements, wrench = record.elements, record.beams.wrench
    first = elements.span[number, 0]
    for k in range(first, elements.span[number, 1]):
        index, kept = elements.columns[k], wrench[k - first]
        for a in range(index[ElementRow.COUNT]):
            node = index[ElementRow.NODE + a]
            push_node(record.bodies, record.markers, node, kept[6 * a :], kept[6 * a + 3 :])
    return OK


# --- shape functions, strains and masses of an unstressed beam ---


class Elements(Struct):
    """The elements of a beam, n of them with p + 1 nodes each and g points.

    nodes : (n, p + 1) numbers of the beam's nodes. reference : which of an element's nodes rotations are relative to.
    N, slope : (n, g, p + 1) shape functions, and their derivatives with respect to the length [1/m]. weight : (n, g) [m].
    strain : (n, g, 6) (Γ, Κ) that counts as none [1, 1/m].
    """

    nodes: NDArray[np.int64]
    reference: int
    N: Array
    slope: Array
    weight: Array
    strain: Array


class Masses(Struct):
    """How the mass of a beam belongs to its nodes.

    mass : (N,) [kg] and inertia : (N, 3, 3) [kg m²] about the mass centre, section axes, lumped at the nodes.
    pairs : (m, 2) nodes that share mass, shared : (m,) [kg] how much, moment : (m, 3, 3) [kg m²] J_ab and turn : (m, 3, 3) from the axes of
    the first node to those of the second: a consistent mass is the lumped one, less what `nivel.kernels.bodies.shared_mass` does with
    these.
    """

    mass: Array
    inertia: Array
    pairs: NDArray[np.int64]
    shared: Array
    moment: Array
    turn: Array


def lagrange(order: int, xi: Array) -> tuple[Array, Array]:
    """Lagrange's polynomials of equally spaced nodes on [0, 1] at xi (g,), and their derivatives: (g, order + 1) each."""
    nodes = np.linspace(0.0, 1.0, order + 1)
    N, D = np.ones((len(xi), order + 1)), np.zeros((len(xi), order + 1))
    for a in range(order + 1):
        others = [b for b in range(order + 1) if b != a]
        for b in others:
            N[:, a] *= (xi - nodes[b]) / (nodes[a] - nodes[b])
        for c in others:
            term = np.full(len(xi), 1.0 / (nodes[a] - nodes[c]))
            for b in others:
                if b != c:
                    term *= (xi - nodes[b]) / (nodes[a] - nodes[b])
            D[:, a] += term
    return N, D


def gauss(count: int) -> tuple[Array, Array]:
    """Points and weights on [0, 1]."""
    xi, weight = np.polynomial.legendre.leggauss(count)
    return 0.5 * (xi + 1.0), 0.5 * weight


def elements_of(beam: Beam) -> Elements:
    """The elements of a beam as it is given, unstressed."""
    place, axes = beam.frames(beam.shares)
    p = beam.order
    nodes = np.arange(0, len(place) - 1, p)[:, None] + np.arange(p + 1)
    xi, weight = gauss(p)
    N, D = lagrange(p, xi)
    along = np.einsum("ga,nai->ngi", D, place[nodes])
    stretch = np.linalg.norm(along, axis=2)
    slope = D[None] / stretch[:, :, None]
    N = np.broadcast_to(N, slope.shape)
    strain = strains(place[nodes], axes[nodes], p // 2, N, slope)
    return Elements(nodes, p // 2, N.copy(), slope, weight * stretch, strain)


def strains(place: Array, axes: Array, reference: int, N: Array, slope: Array) -> Array:
    """(n, g, 6) Γ = Rᵀ x' and Κ, the axial vector of Rᵀ R', from places (n, p + 1, 3) and axes (n, p + 1, 3, 3) of the nodes."""
    psi = relative_turns(axes, reference)
    along = np.einsum("nga,nai->ngi", slope, place)
    turn, change = np.einsum("nga,nai->ngi", N, psi), np.einsum("nga,nai->ngi", slope, psi)
    R = axes[:, reference][:, None] @ rotation(turn)
    gamma = np.einsum("ngji,ngj->ngi", R, along)
    kappa = np.einsum("ngij,ngj->ngi", tangent(turn), change)
    return np.concatenate([gamma, kappa], axis=2)


def relative_turns(axes: Array, reference: int) -> Array:
    """(n, p + 1, 3) rotation vectors of the nodes' axes (n, p + 1, 3, 3) seen from those of one of them."""
    relative = np.swapaxes(axes[:, reference], 1, 2)[:, None] @ axes
    return (
        scipy.spatial.transform.Rotation.from_matrix(relative.reshape(-1, 3, 3)).as_rotvec().reshape(*axes.shape[:2], 3)
    )


def rotation(psi: Array) -> Array:
    """(…, 3, 3) of rotation vectors (…, 3)."""
    return scipy.spatial.transform.Rotation.from_rotvec(psi.reshape(-1, 3)).as_matrix().reshape(*psi.shape, 3)


def tangent(psi: Array) -> Array:
    """(…, 3, 3) T = sin ψ/ψ 1 - (1 - cos ψ)/ψ² ψ̃ + (ψ - sin ψ)/ψ³ ψ ⊗ ψ: angular velocity in turned axes is T ψ̇."""
    angle = np.linalg.norm(psi, axis=-1)[..., None, None]
    small = angle < 1e-4
    safe = np.where(small, 1.0, angle)
    first = np.where(small, 1.0 - angle**2 / 6.0, np.sin(safe) / safe)
    second = np.where(small, 0.5 - angle**2 / 24.0, (1.0 - np.cos(safe)) / safe**2)
    third = np.where(small, 1.0 / 6.0 - angle**2 / 120.0, (safe - np.sin(safe)) / safe**3)
    return first * np.eye(3) - second * skew(psi) + third * psi[..., :, None] * psi[..., None, :]


def skew(v: Array) -> Array:
    """(…, 3, 3) with skew(v) w = v × w."""
    zero = np.zeros(v.shape[:-1])
    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*v.shape, 3)


def masses_of(beam: Beam, *, shared: bool = True) -> Masses:
    """Mass of a beam at its nodes: angular velocities are interpolated in the axes of the unstressed sections, so that every rigid motion
    of the unstressed beam has its right energy. Without `shared` the moments of inertia of nodes are positive (shares N² in place of N)."""
    section = beam.properties
    place, axes = beam.frames(beam.shares)
    p, count = beam.order, len(place)
    nodes = np.arange(0, count - 1, p)[:, None] + np.arange(p + 1)
    xi, weight = gauss(p + 1)
    N, D = lagrange(p, xi)
    w = weight * np.linalg.norm(np.einsum("ga,nai->ngi", D, place[nodes]), axis=2)
    psi = np.einsum("ga,nai->ngi", N, relative_turns(axes[nodes], p // 2))
    R = axes[nodes][:, p // 2][:, None] @ rotation(psi)
    Q = np.einsum("ngji,najk->ngaik", R, axes[nodes])
    lumps = section.mass * np.einsum("ng,ga->na", w, N)
    share = N if shared else N**2 / np.sum(N**2, axis=1, keepdims=True)
    turning = np.einsum("ng,ga,ngaji,jk,ngakl->nail", w, share, Q, section.inertia, Q)
    mass, inertia = np.zeros(count), np.zeros((count, 3, 3))
    np.add.at(mass, nodes, lumps)
    np.add.at(inertia, nodes, turning)
    first, second = np.array([(a, b) for a in range(p + 1) for b in range(a + 1, p + 1)]).T
    common = section.mass * np.einsum("ng,ga,gb->nab", w, N, N)[:, first, second]
    moment = np.einsum("ng,ga,gb,ngaji,jk,ngbkl->nabil", w, N, N, Q, section.inertia, Q)[:, first, second]
    turn = np.einsum("nabji,nabjk->nabik", axes[nodes[:, second]][:, :, None], axes[nodes[:, first]][:, :, None])[
        :, :, 0
    ]
    pairs = np.stack([nodes[:, first], nodes[:, second]], axis=2)
    return Masses(
        mass,
        0.5 * (inertia + np.swapaxes(inertia, 1, 2)),
        pairs.reshape(-1, 2),
        common.ravel(),
        moment.reshape(-1, 3, 3),
        turn.reshape(-1, 3, 3),
    )


def add_elements(builder: SystemBuilder, beam: Beam, family: Family) -> None:
    """The elements of a beam, whose nodes are bodies; each couples its own nodes."""
    elements, section = elements_of(beam), beam.properties
    marker = np.array([builder.frame(name) for name in beam.node_names])
    names = dict(zip(marker.tolist(), beam.node_names, strict=True))
    count, total = beam.order + 1, beam.interpolation == "total"
    for nodes, N, slope, weight, strain in zip(
        marker[elements.nodes], elements.N, elements.slope, elements.weight, elements.strain, strict=True
    ):
        points = np.zeros((3, 15))
        points[: len(weight), 0] = weight
        points[: len(weight), 1 : 1 + count] = N
        points[: len(weight), 5 : 5 + count] = slope
        points[: len(weight), 9:] = strain
        frame, slot = nodes[elements.reference], elements.reference
        if total:
            axes = matrix_from_euler_parameters(placement(builder.machine.body_named[names[frame]])[1])
            frame, slot = builder.place((GROUND, np.zeros(3), axes)), MOST
        row = ElementRow(
            node=[*nodes.tolist(), *[NONE] * (MOST - count)],
            count=count,
            points=len(weight),
            reference=slot,
            frame=frame,
            damping=beam.damping,
            stiffness=section.stiffness.ravel().tolist(),
            point=points.ravel().tolist(),
        )
        builder.add(family, row)
        builder.noted.append(Coupled(frozenset(builder.markers.body[node] for node in nodes)))


def nodes_of_elements(record: Record) -> list[int]:
    """Markers that are nodes of geometrically exact beams."""
    out = set[int]()
    for address, (first, last) in zip(record.elements.address, record.elements.span.tolist(), strict=True):
        if FAMILIES[int(address)] in (apply, apply_elastic):
            for row in record.elements.columns[first:last].tolist():
                out.update(row[: row[MOST]])
    return sorted(out)
