"""Rigid motions of a whole machine that nothing ties to the ground: they have no stiffness, and make no mechanism of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.statics.equations import Rest, StaticEquations, Tangent
from nivel.analysis.statics.linear import NO_STIFFNESS, PivotError, lowest, symmetric
from nivel.machine.core.vectors import cross
from nivel.system.system import Array

WHOLE = 6  # velocities of a body that nothing holds
# of what constraints make of a motion of unit size: round-off
RESISTED = 1e-9
# of a direction of unit size: what is not a motion of the whole
OTHER = 1e-6


@dataclass(frozen=True)
class Whole:
    """How many rigid motions of the whole machine nothing resists, of how many; inner (f,) : a motion without stiffness beside them, of
    parts against each other, or None."""

    motions: int
    of: int
    inner: Array | None

    @property
    def alone(self) -> bool:
        """Whether nothing at all ties the machine to the ground, and its parts are not free against each other."""
        return 0 < self.motions == self.of and self.inner is None


def of_whole(equations: StaticEquations, state: Rest, tangent: Tangent) -> Whole:
    """What of the motions without stiffness of an equilibrium is a motion of the whole machine."""
    every = _rigid_motions(equations, state)
    rigid = _unresisted(every, tangent)
    count, most = rigid.shape[1], every.shape[1]
    try:
        values, found = lowest(tangent, min(count + 1, tangent.K.shape[0]), tangent.M, nearest=True)
    except PivotError:
        return Whole(count, most, None if count else np.zeros(tangent.K.shape[0]))
    largest = float(np.abs(tangent.K).max()) if tangent.K.nnz else 0.0
    inner, largest_rest = None, OTHER
    for k in range(len(values)):
        direction = found[:, k] / np.linalg.norm(found[:, k])
        if abs(float(direction @ (tangent.K @ direction))) > NO_STIFFNESS * largest:
            continue
        rest = direction - rigid @ (rigid.T @ direction)
        if np.linalg.norm(rest) > largest_rest:
            inner, largest_rest = rest, float(np.linalg.norm(rest))
    return Whole(count, most, inner)


def _rigid_motions(equations: StaticEquations, state: Rest) -> Array:
    """(f, 6) without units, orthonormal: translations and rotations of all bodies together, fewer of points on a line. None, (f, 0), of a
    machine of which a joint of the tree holds a part to the ground."""
    equations.evaluate(state)
    system, record = equations.system, equations.record
    nodes, count = record.tree.node, system.body_count
    if len(nodes):
        on_ground = [node for node in nodes.tolist() if node[1] == count and node[0] < count]
        if any(last - first != WHOLE for *_, first, last in on_ground):
            return np.zeros((len(equations.free), 0))
        spans = [(node[0], node[4]) for node in on_ground]
    else:
        spans = [(b, WHOLE * b) for b in range(count)]
    out = np.zeros((equations.n, WHOLE))
    for body, first in spans:
        place, axes = record.bodies.R[body], record.bodies.A[body]
        for k, axis in enumerate(np.eye(3)):
            out[first : first + 3, k] = axis
            out[first : first + 3, 3 + k] = cross(axis, place)
            out[first + 3 : first + 6, 3 + k] = axes.T @ axis
    U, size, _ = np.linalg.svd(out[equations.free] / equations.length[equations.free, None], full_matrices=False)
    return U[:, size > RESISTED * size[0]]


def _unresisted(basis: Array, tangent: Tangent) -> Array:
    """(f, k) an orthonormal basis of those motions that neither stiffness nor constraints resist."""
    if not basis.shape[1]:
        return basis
    # constraints first; of what they allow, forces that are not balanced make no stiffness along the motion
    _, size, combined = np.linalg.svd(tangent.C @ basis, full_matrices=True)
    size = np.append(size, np.zeros(len(combined) - len(size)))
    basis = basis @ combined[size <= RESISTED * (float(np.abs(tangent.C).max()) if tangent.C.nnz else 0.0)].T
    largest = float(np.abs(tangent.K).max()) if tangent.K.nnz else 0.0
    values, vectors = np.linalg.eigh(symmetric(basis.T @ (tangent.K @ basis)))
    return basis @ vectors[:, np.abs(values) <= NO_STIFFNESS * largest]
