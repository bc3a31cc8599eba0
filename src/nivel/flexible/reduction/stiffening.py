"""Geometric stiffness: how the stress of a moving body stiffens or softens it.

A body in motion is stressed by its own inertia forces -ρ (a + α̃ x + ω̃ ω̃ x), a = Aᵀ (R̈ - g), and by what acts on its
interfaces. Each unit load case gives a static stress, and this a geometric stiffness matrix K_g that is projected on the
modes: K_g(t) = Σ a_i K_i + Σ α_i K_i + Σ ω_i ω_j K_ij + Σ F_k K_k (Wallrapp & Schwertassek 1991, Int. J. Numer. Meth. Eng. 32).

One load case alone is not in equilibrium, so all are solved with the body held at the same place, the interface
`support` or six freedoms; in the sum the reactions there vanish, whatever the place. Loads on the support itself cause
no stress, so a pendulum held at its hinge needs no interface loads.
"""

from __future__ import annotations

import numpy as np

from nivel.flexible.model.model import Array
from nivel.flexible.reduction.factor import Whole
from nivel.flexible.reduction.free_body import FreeBody
from nivel.flexible.reduction.inertia_loads import inertia_loads


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
