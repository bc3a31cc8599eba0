"""Forces of inertia on a model that moves as a rigid body, and the geometric stiffness that their stress gives."""

from __future__ import annotations

from typing import Final

import numpy as np

from nivel.flexible.model.model import Array
from nivel.flexible.reduction.factor import Whole
from nivel.flexible.reduction.free_body import FreeBody


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
    out = {}
    full = body.model.expansion @ modes
    for name, load in loads.items():
        moved = body.held_solution(support, load)
        out[name] = elements.geometric_stiffness(body.model.expansion @ moved, full)
    return out


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
