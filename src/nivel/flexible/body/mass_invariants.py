"""Inertia invariants of a finite-element model, from its mass. They need SciPy, which what only reads invariants does not load."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.invariants import Invariants, of_points, tilde
from nivel.flexible.model.mass import Mass, MatrixMass, PointMass, at_nodes, scalar_part
from nivel.flexible.model.rigid_modes import rigid_modes

Array = NDArray[np.float64]


def invariants(mass: Mass, modes: Array) -> Invariants:
    """The invariants of `modes`, (N, n) in the freedoms of the model."""
    if isinstance(mass, PointMass):
        return of_points(mass.position, (mass.shape @ modes).reshape(len(mass.position), 3, -1), mass.weight)
    return _of_matrix(mass, modes)


def _of_matrix(mass: MatrixMass, modes: Array) -> Invariants:
    """I1 … I4, I6, I7 and the antisymmetric part of I8 from the whole matrix by its rigid motions (exact for any matrix);
    I5, I9 and the symmetric part of I8, which turn the deformation with the body, from the mean translational mass.

    The antisymmetric part of I8 follows from I8_j - I8_jᵀ = -(I4_j)~, without which no energy would be kept.
    """
    full = modes if mass.transformation is None else mass.transformation @ modes
    points = of_points(
        mass.position,
        (at_nodes(mass.freedoms, mass.full.shape[0]) @ full).reshape(len(mass.position), 3, -1),
        scalar_part(mass),
    )
    R = rigid_modes(mass.position, mass.freedoms, mass.full.shape[0])
    rigid, coupling = R.T @ (mass.full @ R), R.T @ (mass.full @ full)
    first = rigid[:3, 3:]  # of a body: -(I2)~
    symmetric = 0.5 * (points.I8 + points.I8.transpose(0, 2, 1))
    return Invariants(
        I1=float(np.trace(rigid[:3, :3])) / 3.0,
        I2=0.5 * np.array([first[1, 2] - first[2, 1], first[2, 0] - first[0, 2], first[0, 1] - first[1, 0]]),
        I3=coupling[:3],
        I4=coupling[3:],
        I5=points.I5,
        I6=full.T @ (mass.full @ full),
        I7=rigid[3:, 3:],
        I8=symmetric - 0.5 * tilde(coupling[3:].T),
        I9=points.I9,
    )
