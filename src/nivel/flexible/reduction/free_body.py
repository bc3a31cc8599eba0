"""A finite-element model that nothing holds, ready to be solved: rigid motions known, elastic ones invertible."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from nivel.flexible.model.model import Array, FiniteElementModel
from nivel.flexible.model.sparse import Sparse
from nivel.flexible.reduction.factor import Factor, Whole, determinate, lowest_modes


@dataclass(frozen=True)
class FreeBody:
    """`model` with its matrices K, M (N, N).

    The elastic inverse is that of a body held at six freedoms, between two projections: the load is first balanced by
    inertia forces of a rigid motion, the answer freed of rigid motion. It does not depend on the six freedoms.
    """

    model: FiniteElementModel
    K: Sparse
    M: Sparse

    @classmethod
    def of(cls, model: FiniteElementModel) -> FreeBody:
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

    @cached_property
    def free(self) -> Whole:
        """(N - 6,) the others."""
        return np.setdiff1d(np.arange(self.model.count), self.pins)

    @cached_property
    def factor(self) -> Factor:
        """Of K without the pins.

        Raises NoStiffnessError.
        """
        return Factor(sp.csc_array(self.K[self.free][:, self.free]))

    def pinned_solution(self, load: Array) -> Array:
        """(N,) or (N, k) displacement under loads of the body held at its pins."""
        out = np.zeros_like(load, dtype=float)
        out[self.free] = self.factor.solve(load[self.free])
        return out

    def elastic_solution(self, load: Array) -> Array:
        """(N,) or (N, k) displacement under loads and the inertia forces that balance them; without rigid motion."""
        R = self.rigid
        balanced = load - self.M @ (R @ (R.T @ load))
        moved = self.pinned_solution(balanced)
        return moved - R @ (R.T @ (self.M @ moved))

    def elastic_modes(self, count: int) -> tuple[Array, Array]:
        """The lowest eigenvalues [1/s²] and M-orthonormal modes (N, count) of the free body, rigid motions left out."""
        return lowest_modes(self.K, self.M, count, self.elastic_solution, self.rigid)
