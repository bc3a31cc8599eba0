"""Bases of reduced bodies: the displacements that span its reduced model, each method a function.

Every basis also spans the rigid motions or is combined with them by the reduction, which takes them out.
"""

from collections.abc import Callable
from typing import Final

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from nivel.errors import ModelError
from nivel.flexible.model.model import Array, Sparse
from nivel.flexible.reduction.factor import NoStiffnessError, Whole, lowest_modes, pivots
from nivel.flexible.reduction.free_body import FreeBody
from nivel.lazy import Struct


def stiffening(body: FreeBody, modes: Array, support: Whole, loaded: dict[str, Whole]) -> dict[str, Array]:
    """Geometric stiffness projected on `modes` (N, n), by the name of its cause.

    support : independent freedoms that are held, at least six that stop rigid motion.
    loaded : independent freedoms of other interfaces by name; `interface.NAME` is (k, n, n) for unit forces [1/N] and
    torques on them.
    returns `acceleration` (3, n, n) per m/s², `angular_acceleration` (3, n, n) per rad/s², `centrifugal` (6, n, n) per
    rad²/s² for x², y², z², xy, yz, zx; all symmetric, K_g on the side of the stiffness: force -K_g q.
    """
    elements = body.model.elements
    assert elements is not None
    loads = {**inertia_loads(body), **{f"interface.{name}": _units(body, rows) for name, rows in loaded.items()}}
    expansion, full = body.model.expansion, body.model.expansion @ modes
    return {
        name: elements.geometric_stiffness(expansion @ body.held_solution(support, load), full)
        for name, load in loads.items()
    }


def _units(body: FreeBody, rows: Whole) -> Array:
    loads = np.zeros((body.model.count, len(rows)))
    loads[rows, np.arange(len(rows))] = 1.0
    return loads


PAIRS: Final = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))  # ω_i ω_j of the centrifugal terms


def inertia_loads(body: FreeBody) -> dict[str, Array]:
    """(N, k) nodal forces -M a of unit accelerations of the undeformed body, by name."""
    model = body.model
    R = model.rigid_modes()
    fields = []
    for i, j in PAIRS:
        e = np.eye(3)
        # ω × (ω × x) for ω_i ω_j: the symmetric part, twice it for i ≠ j, since the product stands once in the sum
        turned = [np.cross(e[a], np.cross(e[b], model.position)) for a, b in {(i, j), (j, i)}]
        fields.append(_nodal(body, np.sum(turned, axis=0)))
    return {
        "acceleration": -(body.M @ R[:, :3]),
        "angular_acceleration": -(body.M @ R[:, 3:]),
        "centrifugal": -(body.M @ np.stack(fields, axis=1)),
    }


def _nodal(body: FreeBody, field: Array) -> Array:
    """(N,) the field (n, 3), linear in x, as displacements of the nodes and turns by half its curl."""
    model = body.model
    full = np.zeros(model.expansion.shape[0])
    values = np.hstack([field, np.zeros_like(field)])
    x = model.position - model.position.mean(axis=0)
    gradient = np.linalg.lstsq(np.hstack([x, np.ones((len(x), 1))]), field, rcond=None)[0][:3]  # [b, a] ∂f_a/∂x_b
    values[:, 3] = 0.5 * (gradient[1, 2] - gradient[2, 1])
    values[:, 4] = 0.5 * (gradient[2, 0] - gradient[0, 2])
    values[:, 5] = 0.5 * (gradient[0, 1] - gradient[1, 0])
    has = model.freedoms >= 0
    full[model.freedoms[has]] = values[has]
    return full[model.independent]


LIMIT_START = 16  # modes that are computed first where a frequency is the limit
MOST_MODES = 1000
NEXT = 6  # modes beyond those that are kept, by which a run tells whether it lacks them
MOST_BOUNDARY = 1200  # interface freedoms: each makes a correction mode


class ModeCount(Struct):
    """How many normal modes: `count` of them, or all `up_to` a frequency [Hz], or both (whatever is less)."""

    count: int | None = None
    up_to: float | None = None


class Basis(Struct):
    """`vectors` (N, k): `extra` ones that may depend on the others, interface modes, and `normal` modes at the end with their
    `frequencies` [Hz], of the body as it was held. left : (N, c) the next normal modes, which are not taken; `held` : whether they leave
    the interfaces where they are.
    """

    vectors: Array
    normal: int
    frequencies: Array
    left: Array
    held: bool = False
    extra: int = 0


def craig_bampton(body: FreeBody, boundary: Whole, modes: ModeCount) -> Basis:
    """Correction modes of the `boundary` freedoms and fixed-interface normal modes. Rantalainen 2007, eqs (3.28)–(3.31).

    Where the boundary does not stop every rigid motion, the rest of them are zero-frequency normal modes of the body
    held there. They are not computed: the reduction knows the rigid motions. The boundary is then held with some more
    freedoms for the correction modes, which changes these by rigid motions only.
    """
    if len(boundary) > MOST_BOUNDARY:
        raise ModelError(
            f"the interfaces have {len(boundary)} degrees of freedom, and each makes a mode; "
            f"{MOST_BOUNDARY} are allowed. Tie surfaces to reference nodes"
        )
    held = _with_pins(body, boundary)
    inner = np.setdiff1d(np.arange(body.model.count), boundary)
    corrections = _correction_modes(body, boundary, held)
    factor, free = body.factor(held), body.all_but(held)
    if len(held) == len(boundary):
        found = _chosen(modes, lambda n: lowest_modes(*_within(body, inner), n, factor.solve))  # K has the factor
    else:
        rigid = _rigid_within(body, boundary, inner)
        K, M = _within(body, inner)
        position = np.searchsorted(inner, free)

        def solve(load: Array) -> Array:
            balanced = load - M @ (rigid @ (rigid.T @ load))
            moved = np.zeros_like(load)
            moved[position] = factor.solve(balanced[position])
            return moved - rigid @ (rigid.T @ (M @ moved))

        try:
            found = _chosen(modes, lambda n: lowest_modes(K, M, n, solve, rigid))
        except NoStiffnessError as error:
            motion = np.zeros(body.model.count)
            motion[inner] = error.motion
            raise NoStiffnessError(motion) from None
    values, inside, next_inside = found
    normal, left = (np.zeros((body.model.count, each.shape[1])) for each in (inside, next_inside))
    normal[inner], left[inner] = inside, next_inside
    frequencies = np.sqrt(values) / (2.0 * np.pi)
    return Basis(np.hstack([corrections, normal]), len(values), frequencies, left, held=len(boundary) > 0)


def inertia_modes(body: FreeBody, boundary: Whole) -> Array:
    """(N, 12) static displacement under the inertia forces of unit accelerations and spins, with the boundary held.

    With these in the basis, the reduced body answers exactly to its own inertia while it moves steadily.
    """
    return body.held_solution(_with_pins(body, boundary), np.hstack(list(inertia_loads(body).values())))


def free_interface(body: FreeBody, boundary: Whole, modes: ModeCount) -> Basis:
    """Free–free normal modes and attachment modes of the residual flexibility for unit loads on the `boundary` freedoms.

    Rubin 1975 (AIAA J. 13): with the mass of the residual modes, which MacNeal 1971 neglects.
    """
    values, normal, left = _chosen(modes, body.elastic_modes)
    flexible, loads = attachments(body, boundary)
    residual = flexible - normal @ ((normal.T @ loads) / values[:, None])
    return Basis(np.hstack([residual, normal]), len(values), np.sqrt(values) / (2.0 * np.pi), left)


def normal_only(body: FreeBody, boundary: Whole, modes: ModeCount) -> Basis:
    """Free–free normal modes alone. Left out is also the static answer to loads on the `boundary` freedoms."""
    values, normal, left = _chosen(modes, body.elastic_modes)
    left = np.hstack([left, attachments(body, boundary)[0]])
    return Basis(normal, len(values), np.sqrt(values) / (2.0 * np.pi), left)


def attachments(body: FreeBody, boundary: Whole) -> tuple[Array, Array]:
    """(N, b) displacements under unit loads on the `boundary` freedoms, balanced by inertia; and these loads."""
    loads = _units(body, boundary)
    return body.elastic_solution(loads), loads


def _chosen(modes: ModeCount, compute: Callable[[int], tuple[Array, Array]]) -> tuple[Array, Array, Array]:
    """Eigenvalues and vectors of as many modes as are wanted, and the vectors of some that come next."""
    if modes.up_to is None:
        wanted = modes.count or 0
        values, vectors = compute(wanted + NEXT)
        return values[:wanted], vectors[:, :wanted], vectors[:, wanted:]
    limit = (2.0 * np.pi * modes.up_to) ** 2
    most = np.inf if modes.count is None else modes.count
    count = int(min(LIMIT_START, most + NEXT))
    while True:
        values, vectors = compute(count)
        if len(values) < count or count >= most + NEXT or (len(values) and values[-1] > limit):
            keep = int(min(np.count_nonzero(values <= limit), most))
            return values[:keep], vectors[:, :keep], vectors[:, keep : keep + NEXT]
        if count >= MOST_MODES:
            raise ModelError(
                f"more than {MOST_MODES} normal modes lie below {modes.up_to:g} Hz; lower `reduction.modes.up_to`, or limit the `count`"
            )
        count = int(min(2 * count, most + NEXT))


def _with_pins(body: FreeBody, boundary: Whole) -> Whole:
    """The boundary freedoms and, where these leave rigid motions, the fewest others that stop them."""
    R = body.model.rigid_modes(body.model.position.mean(axis=0))
    R = R / np.abs(R).max(axis=0)
    left = la.null_space(R[boundary], rcond=1e-9) if len(boundary) else np.eye(6)
    if left.shape[1] == 0:
        return boundary
    return np.concatenate([boundary, pivots((R @ left).T)[: left.shape[1]]])


def _rigid_within(body: FreeBody, boundary: Whole, inner: Whole) -> Array:
    """(I, k) M-orthonormal rigid motions that do not move the boundary."""
    R = body.rigid
    left = la.null_space(R[boundary], rcond=1e-9) if len(boundary) else np.eye(6)
    motions = (R @ left)[inner]
    gram = motions.T @ (body.M[inner][:, inner] @ motions)
    return la.solve_triangular(la.cholesky(gram, lower=True), motions.T, lower=True).T


def _within(body: FreeBody, inner: Whole) -> tuple[Sparse, sp.csc_array]:
    return sp.csc_array(body.K[inner][:, inner]), sp.csc_array(body.M[inner][:, inner])


def _correction_modes(body: FreeBody, boundary: Whole, held: Whole) -> Array:
    """(N, b) static displacement for unit motion of each boundary freedom."""
    if not len(boundary):
        return np.zeros((body.model.count, 0))
    out = body.held_solution(held, -(body.K[:, boundary].toarray()))
    out[boundary, np.arange(len(boundary))] = 1.0
    return out
