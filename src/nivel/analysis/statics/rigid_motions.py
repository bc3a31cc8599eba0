"""Rigid motions of a whole machine that nothing ties to the ground: they have no stiffness, and make no mechanism of it.

Loads that balance each other do no work in them, so any place of the machine will do. Newton's iteration keeps the one that it has: in its
matrix one body is tied to the ground along those motions. K x + S x = -r with S = κ W Wᵀ, W the rows of that body of a basis B of the
motions. Where K B = 0 and Bᵀ r = 0 it follows that Wᵀ x = 0: the tie bears nothing, and x is an exact step of Newton's method.
"""

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix

from nivel.analysis.statics.equations import Rest, Sparse, StaticEquations, Tangent
from nivel.analysis.statics.linear import NO_STIFFNESS, PivotError, lowest, symmetric
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import cross
from nivel.system.system import Array

WHOLE = 6  # velocities of a body that nothing holds
# of what constraints make of a motion of unit size: round-off
RESISTED = 1e-9
# of a direction of unit size: what is not a motion of the whole
OTHER = 1e-6
# of the sizes of all forces: what round-off leaves of their sum
BALANCED = 1e-9
# of the largest stiffness: what round-off makes of that of a translation
RIGID = 1e-12


class Whole(Struct):
    """How many rigid motions of the whole machine nothing resists; inner (f,) : a motion without stiffness beside them, of parts against
    each other, or None. tied : something ties the machine to the ground."""

    motions: int
    inner: Array | None
    tied: bool

    @property
    def alone(self) -> bool:
        """Whether nothing at all ties the machine to the ground, and its parts are not free against each other."""
        return not self.tied and self.motions > 0 and self.inner is None


def of_whole(equations: StaticEquations, state: Rest, tangent: Tangent) -> Whole:
    """What of the motions without stiffness of an equilibrium is a motion of the whole machine."""
    equations.evaluate(state)
    rigid = _unresisted(rigid_motions(equations), tangent)
    count, tied = rigid.shape[1], is_tied(equations, tangent)
    try:
        values, found = lowest(tangent, min(count + 1, tangent.K.shape[0]), tangent.M, nearest=True)
    except PivotError:
        return Whole(count, None if count else np.zeros(tangent.K.shape[0]), tied)
    largest = float(np.abs(tangent.K).max()) if tangent.K.nnz else 0.0
    inner, largest_rest = None, OTHER
    for k in range(len(values)):
        direction = found[:, k] / np.linalg.norm(found[:, k])
        if abs(float(direction @ (tangent.K @ direction))) > NO_STIFFNESS * largest:
            continue
        rest = direction - rigid @ (rigid.T @ direction)
        if np.linalg.norm(rest) > largest_rest:
            inner, largest_rest = rest, float(np.linalg.norm(rest))
    return Whole(count, inner, tied)


def is_tied(equations: StaticEquations, tangent: Tangent) -> bool:
    """Whether constraints, or forces that change with the place, keep the machine from moving as a whole."""
    along = translations(equations)
    if not along.shape[1]:
        return True
    stiff, held = _size(tangent.K @ along), _size(tangent.C @ along)
    return held > RESISTED * _largest(tangent.C) or stiff > RIGID * _largest(tangent.K)


def with_tie(equations: StaticEquations, state: Rest, tangent: Tangent, r: Array) -> Tangent:
    """The same with one body tied to the ground, along the motions of the whole in which the forces r (f,) of this state balance each
    other; of a machine that nothing else ties to the ground."""
    if is_tied(equations, tangent):
        return tangent
    equations.evaluate(state)
    basis = rigid_motions(equations)
    basis = basis[:, np.abs(tangent.C @ basis).max(axis=0, initial=0.0) <= RESISTED * (_largest(tangent.C) or 1.0)]
    left = basis.T @ r
    if np.linalg.norm(left) > BALANCED * equations.loads(state) / equations.energy:
        basis = basis @ np.linalg.svd(left[None])[2][1:].T
    return replace(tangent, tie=_at_one_body(equations, basis, _largest(tangent.K) or 1.0))


def resultant(equations: StaticEquations, state: Rest) -> tuple[Array, Array]:
    """((3,) force [N], (3,) moment about the origin [N m]): sums of the loads on all bodies, in global axes."""
    r, bodies = equations.evaluate(state)[0], equations.record.bodies
    load = np.zeros(equations.n)
    load[equations.free] = -r * equations.energy / equations.length[equations.free]
    force, moment = np.zeros(3), np.zeros(3)
    for body, first in _spans(equations):
        own, turning = load[first : first + 3], load[first + 3 : first + WHOLE]
        force += own
        moment += cross(bodies.R[body], own) + bodies.A[body] @ turning
    return force, moment


def translations(equations: StaticEquations) -> Array:
    """(f, 3) without units, of unit size; (f, 0) of a machine of which a joint of the tree holds a part to the ground."""
    spans = _spans(equations)
    out = np.zeros((equations.n, 3 if spans else 0))
    for _, first in spans:
        out[first : first + 3] = np.eye(3)
    out = out[equations.free] / equations.length[equations.free, None]
    return out / np.linalg.norm(out, axis=0)


def rigid_motions(equations: StaticEquations) -> Array:
    """(f, 6) without units, orthonormal, in the state last evaluated: translations and rotations of all bodies together, fewer of points on
    a line. None, (f, 0), of a machine of which a joint of the tree holds a part to the ground."""
    spans, record = _spans(equations), equations.record
    if not spans:
        return np.zeros((len(equations.free), 0))
    out = np.zeros((equations.n, WHOLE))
    for body, first in spans:
        place, axes = record.bodies.R[body], record.bodies.A[body]
        for k, axis in enumerate(np.eye(3)):
            out[first : first + 3, k] = axis
            out[first : first + 3, 3 + k] = cross(axis, place)
            out[first + 3 : first + 6, 3 + k] = axes.T @ axis
    U, size, _ = np.linalg.svd(out[equations.free] / equations.length[equations.free, None], full_matrices=False)
    return U[:, size > RESISTED * size[0]]


def _spans(equations: StaticEquations) -> list[tuple[int, int]]:
    """(body, first of its six unknowns) of bodies that move apart from all others; none where a joint of the tree holds one to the
    ground."""
    nodes, count = equations.record.tree.node, equations.system.body_count
    if not len(nodes):
        return [(b, WHOLE * b) for b in range(count)]
    on_ground = [node for node in nodes.tolist() if node[1] == count and node[0] < count]
    if any(last - first != WHOLE for *_, first, last in on_ground):
        return []
    return [(node[0], node[4]) for node in on_ground]


def _at_one_body(equations: StaticEquations, basis: Array, stiffness: float) -> Sparse:
    """(f, f) S = κ W Wᵀ at as few bodies as know all motions of the basis."""
    place = np.full(equations.n, -1)
    place[equations.free] = np.arange(len(equations.free))
    rows: list[int] = []
    for _, first in _spans(equations):
        rows += [int(row) for row in place[first : first + WHOLE] if row >= 0]
        if np.linalg.matrix_rank(basis[rows]) == basis.shape[1]:
            break
    W = basis[rows]
    block = stiffness * (W @ W.T) / max(float(np.abs(W @ W.T).max(initial=0.0)), np.finfo(float).tiny)
    i, j = np.meshgrid(rows, rows, indexing="ij")
    size = len(equations.free)
    return csc_matrix(coo_matrix((block.ravel(), (i.ravel(), j.ravel())), shape=(size, size)))


def _unresisted(basis: Array, tangent: Tangent) -> Array:
    """(f, k) an orthonormal basis of those motions that neither stiffness nor constraints resist."""
    if not basis.shape[1]:
        return basis
    # constraints first; of what they allow, forces that are not balanced make no stiffness along the motion
    _, size, combined = np.linalg.svd(tangent.C @ basis, full_matrices=True)
    size = np.append(size, np.zeros(len(combined) - len(size)))
    basis = basis @ combined[size <= RESISTED * _largest(tangent.C)].T
    values, vectors = np.linalg.eigh(symmetric(basis.T @ (tangent.K @ basis)))
    return basis @ vectors[:, np.abs(values) <= NO_STIFFNESS * _largest(tangent.K)]


def _largest(matrix: Sparse) -> float:
    return float(np.abs(matrix).max()) if matrix.nnz else 0.0


def _size(matrix: Array) -> float:
    return float(np.abs(matrix).max(initial=0.0))
