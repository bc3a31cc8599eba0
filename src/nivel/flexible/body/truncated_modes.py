"""Truncated modes of a reduced body: the next modes of a finer basis, and how the body's motion loads them.

Along with the modes Φ that are kept, the body could also move by Z q. The equations of Z, with kept modes alone in motion, are

    q̈ + ω² q = Zᵀ F - Zᵀ M ẍ - Zᵀ K Φ p,     ẍ of the moving frame and Φ p̈,

the residual of the finer basis; F are the loads at the interfaces. Fixed-interface modes do not move the interfaces, so these load them
by inertia alone (Craig, Bampton 1968).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.invariants import Invariants

Array = NDArray[np.float64]
Whole = NDArray[np.int64]


@dataclass(frozen=True)
class LeftOut:
    """k modes Z of unit modal mass that are not among the n of the body.

    eigenvalues : (k,) [1/s²]. phi : (i, 6, k) displacement and turn of the interfaces. mass : (k, n) Zᵀ M Φ, stiffness : (k, n) [1/s²]
    Zᵀ K Φ. I3 (3, k), I4 (3, k), I8 (k, 3, 3) : inertia invariants of Z.
    """

    eigenvalues: Array
    phi: Array
    mass: Array
    stiffness: Array
    I3: Array
    I4: Array
    I8: Array

    def beside(self, kept: Whole) -> LeftOut:
        """The same modes for a body with these of its modes only."""
        return LeftOut(
            self.eigenvalues, self.phi, self.mass[:, kept], self.stiffness[:, kept], self.I3, self.I4, self.I8
        )

    def __add__(self, other: LeftOut) -> LeftOut:
        """All modes of both, for the same body."""
        return LeftOut(
            np.concatenate([self.eigenvalues, other.eigenvalues]),
            np.concatenate([self.phi, other.phi], axis=2),
            np.vstack([self.mass, other.mass]),
            np.vstack([self.stiffness, other.stiffness]),
            np.hstack([self.I3, other.I3]),
            np.hstack([self.I4, other.I4]),
            np.concatenate([self.I8, other.I8]),
        )


def own_modes(left: Whole, kept: Whole, eigenvalues: Array, phi: Array, its: Invariants) -> LeftOut:
    """Modes `left` of a body as seen from those `kept`; phi (i, 6, n) of its interfaces, `its` invariants of all modes."""
    none = np.zeros((len(left), len(kept)))
    return LeftOut(eigenvalues[left], phi[:, :, left], none, none, its.I3[:, left], its.I4[:, left], its.I8[left])
