"""Pressures in place of the masses of fluid as states of linear equations.

Circuits are computed with the mass of fluid in each volume, of gas with its inner energy beside it. With the changes δp of the pressures,
which are linear in all states, x' = T x:  A' = T A T⁻¹,  B' = T B,  C' = C T⁻¹. Eigenvalues are the same; participation factors then say
which pressures take part.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from nivel.analysis.linearise.eigenvalues import Eigen
from nivel.analysis.linearise.reduction import StateSpace
from nivel.elements.states import StateFact
from nivel.lazy import dataclass
from nivel.system.system import Array

# a state of a volume makes its pressure if it makes this share of it at least, for its size
MAKES = 1e-9
# of the sum of the magnitudes of its terms, what is known of a number
ROUND_OFF = 1e-13


@dataclass(frozen=True)
class PressureStates:
    """The states of volumes and the outputs of their pressures: (number of the state, name of the output)."""

    pairs: tuple[tuple[int, str], ...]

    @property
    def outputs(self) -> list[str]:
        """Names of the pressures."""
        return [name for _, name in self.pairs]


def pressure_states(facts: Sequence[StateFact], outputs: Collection[str]) -> PressureStates:
    """Those of a machine: the state of each volume is its mass, of gas its inner energy."""
    names = {fact.name: k for k, fact in enumerate(facts)}
    pairs = []
    for name, k in names.items():
        owner, _, quantity = name.rpartition(".")
        if not quantity.startswith("mass"):
            continue
        pressure = f"hydraulics.{owner}.{quantity.replace('mass', 'pressure', 1)}"
        if pressure in outputs:
            pairs.append((names.get(f"{owner}.{quantity.replace('mass', 'energy', 1)}", k), pressure))
    return PressureStates(tuple(pairs))


def transformation(rows: Array, places: Sequence[int], scale: Array) -> tuple[Array, set[int]]:
    """T (n, n): one but for the rows of these places, which are `rows` (k, n), and the places that were replaced. A row whose own state
    does not make the pressure stays."""
    T, replaced = np.eye(len(scale)), set[int]()
    for row, place in zip(rows, places, strict=True):
        if abs(row[place]) * scale[place] > MAKES * np.max(np.abs(row) * scale, initial=0.0):
            T[place] = row
            replaced.add(place)
    return T, replaced


def transformed(space: StateSpace, T: Array) -> StateSpace:
    """The same equations for T x, without what is left of terms that cancel."""
    back: Array = np.asarray(np.linalg.inv(T), dtype=np.float64)

    def product(*factors: Array) -> Array:
        whole, size = factors[0], np.abs(factors[0])
        for each in factors[1:]:
            whole, size = whole @ each, size @ np.abs(each)
        return np.where(np.abs(whole) > ROUND_OFF * size, whole, 0.0)

    return StateSpace(product(T, space.A, back), product(T, space.B), product(space.C, back), space.D)


def seen(found: Eigen, T: Array) -> Eigen:
    """Eigenvectors of the equations for T x."""
    back: Array = np.asarray(np.linalg.inv(T), dtype=np.float64)
    return Eigen(found.values, found.zero, T @ found.right, back.T @ found.left, found.zeros, found.known)
