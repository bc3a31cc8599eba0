"""Finite elements of a beam: shape functions, reference strains and shares of mass, from where its nodes are unstressed.

Along an element the line is interpolated by Lagrange's polynomials, and so are rotation vectors of the sections relative to one of its
nodes (Crisfield, Jelenić 1999): rigid motions of any size cause no strain. Stiffness is integrated at as many Gauss points as the order,
which keeps it free of locking; mass exactly.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import dataclass, scipy
from nivel.machine.beams.beam import Beam

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Elements:
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


@dataclass(frozen=True)
class Masses:
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
