"""q = (R, φ), v = q̇ with three rotation coordinates φ a body: A = A(space) A(φ) A(body)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nivel.kernels.record.record import Rotations
from nivel.machine.core.orientation import conjugate, matrix_from_euler_parameters, product
from nivel.system.system import Array, StateMap, System
from nivel.system.tables import index_array


def arranged(
    system: System, y: Array, kind: int, start: Array, body: Array, phi: Array, rates: Array
) -> tuple[System, Array]:
    """The numbers of `system` (six velocities a body) and its state y in coordinates φ of this kind.

    start : (B, 4) Euler parameters of A(φ) at the start; body : (B, 4) those of the body axes in the axes that φ turns.
    phi, rates : (B, 3) φ [rad] and φ̇ at the start. The space axes follow from the orientations in y.
    """
    count = system.body_count
    q, v = y[: 7 * count].reshape(count, 7), y[7 * count : 13 * count].reshape(count, 6)
    space = product(product(q[:, 3:], conjugate(body)), conjugate(start))
    turned = np.array([matrix_from_euler_parameters(theta) for theta in conjugate(body)]).reshape(count, 3, 3)
    rotations = Rotations(
        kind=np.array([kind], dtype=np.uint32),
        space=np.ascontiguousarray(space),
        body=np.ascontiguousarray(body),
        turned_b=turned,
        theta=np.zeros((count, 4)),
        G=np.zeros((count, 3, 3)),
        bias=np.zeros((count, 3)),
        regularity=np.zeros(count),
    )
    n = 6 * count
    units = ["m", "m", "m", "1", "1", "1"] * count
    units += ["m/s", "m/s", "m/s", "1/s", "1/s", "1/s"] * count + [""] * (len(y) - 13 * count)
    plain = index_array([(i, n + i) for i in range(n)], 2)
    system = replace(
        system,
        record=system.record._replace(rotations=rotations),
        state_map=StateMap(plain, index_array([], 2), tuple(units)),
    )
    state = [np.hstack([q[:, :3], phi]).ravel(), np.hstack([v[:, :3], rates]).ravel(), y[13 * count :]]
    return system, np.concatenate(state)


def no_rotations() -> Rotations:
    """Those of states with Euler parameters: none."""
    four, nine, none = np.zeros((0, 4)), np.zeros((0, 3, 3)), np.zeros(0, dtype=np.uint32)
    return Rotations(none, four, four, nine, theta=four, G=nine, bias=np.zeros((0, 3)), regularity=np.zeros(0))
