"""A finite-element model that nothing holds, ready to be solved: rigid motions known, elastic ones invertible."""

from functools import cached_property
from typing import Final

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from nivel.flexible.model.model import Array, FiniteElementModel, Sparse
from nivel.flexible.reduction.factor import Factor, NoStiffnessError, Whole, determinate, lowest_modes
from nivel.lazy import Struct, field


class FreeBody(Struct):
    """`model` with its matrices K, M (N, N).

    Factors of K take most of the memory of a reduction, so there is one at a time, the last that was asked for.

    The elastic inverse is that of a body held at six freedoms, between two projections: the load is first balanced by
    inertia forces of a rigid motion, the answer freed of rigid motion. It does not depend on the six freedoms.
    """

    model: FiniteElementModel
    K: Sparse
    M: Sparse
    _factors: dict[bytes, Factor] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def of(cls, model: FiniteElementModel) -> "FreeBody":
        """The body of `model`."""
        return cls(model, model.stiffness, model.mass.matrix)

    @cached_property
    def rigid(self) -> Array:
        """(N, 6) rigid modes about the middle of the nodes, M-orthonormal."""
        R = self.model.rigid_modes(self.model.position.mean(axis=0))
        gram = R.T @ (self.M @ R)
        return la.solve_triangular(la.cholesky(gram, lower=True), R.T, lower=True).T

    @cached_property
    def pins(self) -> Whole:
        """(6,) freedoms that stop every rigid motion when they are held."""
        return determinate(self.model.rigid_modes(self.model.position.mean(axis=0)))

    def held_solution(self, held: Whole, load: Array) -> Array:
        """(N,) or (N, k) displacement under loads of the body with the freedoms `held`.

        Raises NoStiffnessError where these leave a motion that costs no energy.
        """
        free = self.all_but(held)
        out = np.zeros_like(load, dtype=float)
        out[free] = self.factor(held).solve(load[free])
        return out

    def factor(self, held: Whole) -> Factor:
        """Of K without the rows and columns of `held`. Raises NoStiffnessError, with the motion (N,) of the whole body."""
        key = np.sort(held).tobytes()
        if key not in self._factors:
            self._factors.clear()
            free = self.all_but(held)
            try:
                self._factors[key] = Factor(sp.csc_array(self.K[free][:, free]))
            except NoStiffnessError as error:
                motion = np.zeros(self.model.count)
                motion[free] = error.motion
                raise NoStiffnessError(motion) from None
        return self._factors[key]

    def forget_factor(self) -> None:
        """Gives the memory of the last factor back."""
        self._factors.clear()

    def all_but(self, held: Whole) -> Whole:
        """The freedoms that are not `held`, ascending."""
        return np.setdiff1d(np.arange(self.model.count), held)

    def elastic_solution(self, load: Array) -> Array:
        """(N,) or (N, k) displacement under loads and the inertia forces that balance them; without rigid motion."""
        R = self.rigid
        balanced = load - self.M @ (R @ (R.T @ load))
        moved = self.held_solution(self.pins, balanced)
        return moved - R @ (R.T @ (self.M @ moved))

    def elastic_modes(self, count: int) -> tuple[Array, Array]:
        """The lowest eigenvalues [1/s²] and M-orthonormal modes (N, count) of the free body, rigid motions left out."""
        return lowest_modes(self.K, self.M, count, self.elastic_solution, self.rigid)


DEPENDENT: Final = 1e-12  # share of the largest: directions of the scaled mass matrix below it are none
NOTHING: Final = 1e-22  # share of a vector's mass: what round-off leaves of a rigid motion that was taken out
RIGID: Final = 1e-6  # a mode whose mass is that of a rigid motion but for this share is one


class Orthonormal(Struct):
    """Modes (N, n) with Φᵀ M Φ = 1, Φᵀ K Φ = diag(`eigenvalues`) [1/s²].

    rigid_frequencies : [Hz] the six that the reduced model had for rigid motions, zero except for round-off; empty where the
    basis did not span them. condition : of the mass matrix of the basis, each vector scaled to unit mass.
    dependent : vectors of the basis that the others span.
    """

    modes: Array
    eigenvalues: Array
    rigid_frequencies: Array
    condition: float
    dependent: int


def orthonormal(body: FreeBody, basis: Array, extra: int = 0) -> Orthonormal:
    """The modes of the reduced model, without rigid motions: those of a mean-axis frame. Eqs (3.32)–(3.36).

    The rigid motions are known from the nodes, so they are taken out of the basis itself; the reduced eigenproblem would
    give them frequencies of round-off, which are told for comparison. The basis then has up to six vectors too many.
    The first `extra` vectors may depend on the others; they do not count for the condition.
    """
    rigid_frequencies, condition = _as_given(body, basis[:, extra:])
    R = body.rigid
    weight = np.einsum("ij,ij->j", basis, body.M @ basis)
    basis = basis[:, weight > 0.0] / np.sqrt(weight[weight > 0.0])
    elastic = basis - R @ (R.T @ (body.M @ basis))
    mass = elastic.T @ (body.M @ elastic)
    values, vectors = la.eigh(0.5 * (mass + mass.T))
    keep = values > max(DEPENDENT * values.max(initial=0.0), NOTHING)
    spanned = elastic @ (vectors[:, keep] / np.sqrt(values[keep]))
    stiffness = spanned.T @ (body.K @ spanned)
    eigenvalues, turned = (
        la.eigh(0.5 * (stiffness + stiffness.T)) if spanned.shape[1] else (np.zeros(0), np.zeros((0, 0)))
    )
    missing = int(np.count_nonzero(~keep)) - len(rigid_frequencies) - extra
    return Orthonormal(spanned @ turned, eigenvalues, rigid_frequencies, condition, max(missing, 0))


def _as_given(body: FreeBody, basis: Array) -> tuple[Array, float]:
    """Frequencies [Hz] of the rigid motions in the reduced model as it is, and the condition of its scaled mass matrix.

    A mode of the reduced model is a rigid motion where its mass is that of its share of the rigid modes.
    """
    if basis.shape[1] == 0:
        return np.zeros(0), 1.0
    M, K = basis.T @ (body.M @ basis), basis.T @ (body.K @ basis)
    scale = np.sqrt(np.maximum(np.diag(M), 1e-300))
    M, K = M / np.outer(scale, scale), K / np.outer(scale, scale)
    values, vectors = la.eigh(0.5 * (M + M.T))
    condition = float(values[-1] / max(values[0], 1e-300))
    keep = values > DEPENDENT * values[-1]
    T = vectors[:, keep] / np.sqrt(values[keep])
    reduced = T.T @ K @ T
    eigenvalues, turned = la.eigh(0.5 * (reduced + reduced.T))
    shares = (body.rigid.T @ (body.M @ ((basis / scale) @ (T @ turned)))) ** 2
    rigid = eigenvalues[shares.sum(axis=0) > 1.0 - RIGID]
    return np.sqrt(np.abs(rigid)) / (2.0 * np.pi), condition


def held_at(body: FreeBody, modes: Array, held: Array) -> tuple[Array, Array]:
    """The modes (N, n) and eigenvalues where the frame of the body moves with six freedoms instead of the mean axes.

    held : (6, N) rows that give the displacements which are to be zero. The same displacements but for rigid motions,
    again orthonormal; the frequencies are those of the body clamped at these freedoms.
    """
    R = body.model.rigid_modes(body.model.position.mean(axis=0))
    moved = modes - R @ la.solve(held @ R, held @ modes)
    mass = moved.T @ (body.M @ moved)
    stiffness = moved.T @ (body.K @ moved)
    eigenvalues, turned = la.eigh(0.5 * (stiffness + stiffness.T), 0.5 * (mass + mass.T))
    return moved @ turned, eigenvalues
