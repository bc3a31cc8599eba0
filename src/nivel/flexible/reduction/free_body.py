"""A finite-element model that nothing holds, ready to be solved: rigid motions known, elastic ones invertible."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from nivel.flexible.model.model import Array, FiniteElementModel
from nivel.flexible.model.sparse import Sparse
from nivel.flexible.reduction.factor import Factor, NoStiffnessError, Whole, determinate, lowest_modes


@dataclass(frozen=True)
class FreeBody:
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
