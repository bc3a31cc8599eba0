"""Constraint violations as vectors, so that the page can exaggerate them: a gap and a turn for each joint.

Rows are named `joint.basic.axes` (NOTATION.md): `s.x` is a gap along global x; `d2.y` one along y of the first marker; `distance` one
along the line between the two points; `d1.xz` says that x of the first is not perpendicular to z of the second marker: with a small
turn φ of the second, a·(φ × b) = φ·(b × a); `across.y` that a slider is off the line of a beam along y of its section.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.view.arrows import Moments
from nivel.view.records import Joint

Array = NDArray[np.float64]


def violation_vectors(joints: list[Joint], rows: tuple[str, ...], violation: Array, moments: Moments) -> Array:
    """(n, 2 J, 3) gap [m] and turn [rad] of each joint in global axes; violation (n, rows)."""
    out = np.zeros((len(violation), 2 * len(joints), 3))
    place = {joint.name: k for k, joint in enumerate(joints)}
    frames: dict[int, Any] = {}
    for row, name in enumerate(rows):
        owner, _, rest = name.partition(".")
        basic, _, axes = rest.partition(".")
        k = place.get(owner)
        if k is None:
            continue
        if k not in frames:
            frames[k] = _frames(joints[k], moments)
        first, second, apart = frames[k]
        values = violation[:, row, None]
        if basic == "s" and axes in ("x", "y", "z"):
            out[:, 2 * k, "xyz".index(axes)] += values[:, 0]
        elif basic == "d2" and axes in ("x", "y", "z"):
            out[:, 2 * k] += values * first[..., "xyz".index(axes)]
        elif basic == "d1" and len(axes) == 2 and set(axes) <= set("xyz"):
            a, b = first[..., "xyz".index(axes[0])], second[..., "xyz".index(axes[1])]
            out[:, 2 * k + 1] += values * np.cross(b, a)
        elif basic == "across" and axes in ("y", "z"):  # of the section, which are x and y of the second marker
            out[:, 2 * k] -= values * second[..., "yz".index(axes)]
        elif basic == "distance":
            out[:, 2 * k] += values * apart
    return out


def _frames(joint: Joint, moments: Moments) -> tuple[Array, Array, Array]:
    """Axes of both markers (n, 3, 3) in their columns, and the direction from the first to the second point (n, 3)."""
    axes = []
    for side in (0, 1):
        z = moments.turned(joint.bodies[side], joint.axes[side])
        x = moments.turned(joint.bodies[side], joint.x_axes[side]) if joint.x_axes else _across(z)
        axes.append(np.stack([x, np.cross(z, x), z], axis=-1))
    points = [moments.point(joint.bodies[side], joint.points[side]) for side in (0, 1)]
    apart = points[1] - points[0]
    length = np.linalg.norm(apart, axis=-1, keepdims=True)
    return axes[0], axes[1], np.divide(apart, length, out=np.zeros_like(apart), where=length > 0.0)


def _across(z: Array) -> Array:
    """(n, 3) some unit vectors perpendicular to z (n, 3)."""
    other = np.where(np.abs(z[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    x = np.cross(z, other)
    return x / np.linalg.norm(x, axis=-1, keepdims=True)
