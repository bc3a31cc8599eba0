"""A section drawn along a line through the frames of bodies in a row, as of a beam (`sweeps` of a scene, `system.scene`).

Between two frames the line is a cubic (Hermite) that leaves and arrives along their axes with a slope as long as the bodies are apart;
the section turns evenly from one frame to the next and is tilted so that it stands square to the line. Without `smooth` it is straight.
"""

from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.looks.solids import Face, ears
from nivel.looks.viewpoint import Pose, in_space
from nivel.machine.core.vectors import Array

MOST_RINGS: Final = 60  # of one sweep
FINEST: Final = 8  # rings from one frame to the next


def swept_bodies(scene: dict[str, Any]) -> set[str]:
    """Names of the bodies that are drawn as parts of a sweep, and by nothing else of their own."""
    return {body for each in scene.get("sweeps", []) for body in each["bodies"]}


def rings(sweep: dict[str, Any], poses: dict[str, Pose], corners: Any) -> Array:
    """(rings, corners, 3) [m] where the corners (y, z) of a section are in space, from the first body to the last."""
    count = len(sweep["bodies"])
    points = sweep.get("points") or [(0.0, 0.0, 0.0)] * count
    axes, across = sweep.get("axes") or [(1.0, 0.0, 0.0)] * count, sweep.get("across") or [(0.0, 1.0, 0.0)] * count
    at = [in_space(poses[body], point)[0] for body, point in zip(sweep["bodies"], points, strict=True)]
    turned = [
        poses[body][1] @ _section_axes(axis, side)
        for body, axis, side in zip(sweep["bodies"], axes, across, strict=True)
    ]
    smooth = bool(sweep.get("smooth", True))
    steps = min(max(MOST_RINGS // max(count - 1, 1), 1), FINEST) if smooth else 1
    section = np.reshape(np.asarray(corners, dtype=float), (-1, 2))
    out = []
    for k in range(count - 1):
        for step in range(steps):
            place, axes_there = _between(step / steps, at[k], at[k + 1], turned[k], turned[k + 1], smooth=smooth)
            out.append(place + section @ axes_there[:, 1:].T)
    out.append(at[-1] + section @ turned[-1][:, 1:].T)
    return np.array(out)


def sweep_faces(sweep: dict[str, Any], poses: dict[str, Pose]) -> list[Face]:
    """The outside of a sweep in global axes; its ends are closed, as long as they are seen from afar."""
    section = np.asarray(sweep["section"], dtype=float)
    y, z = section.T
    if np.sum(y * np.roll(z, -1) - np.roll(y, -1) * z) < 0.0:
        section = section[::-1]
    shape = rings(sweep, poses, section)
    n, faces = len(section), []
    for before, after in pairwise(shape):
        for k in range(n):
            side = [k, (k + 1) % n]
            corners = np.concatenate([before[side], after[side[::-1]]])
            faces.append(_face(corners, np.zeros(4, dtype=bool)))
    for triangle in ears(section):
        rim = np.array([(j - i) % n == 1 for i, j in zip(triangle, np.roll(triangle, -1), strict=True)])
        faces.append(_face(shape[-1][list(triangle)], rim))
        faces.append(_face(shape[0][list(triangle)][::-1], rim[[1, 0, 2]]))
    return faces


def _face(corners: Array, outlined: NDArray[np.bool_]) -> Face:
    a, b, c = corners[:3]
    one, two = (c - a, corners[3] - b) if len(corners) == 4 else (b - a, c - a)  # diagonals, or sides
    normal = np.cross(one, two)
    return Face(corners, normal / max(float(np.linalg.norm(normal)), 1e-300), outlined)


def _between(s: float, a: Array, b: Array, first: Array, second: Array, *, smooth: bool) -> tuple[Array, Array]:
    """Place and section axes (3, 3) at the share s of the way from one frame to the next."""
    if not smooth or s == 0.0:
        return a + s * (b - a), first
    length = float(np.linalg.norm(b - a))
    u, v = length * first[:, 0], length * second[:, 0]
    place = (2 * s**3 - 3 * s**2 + 1) * a + (3 * s**2 - 2 * s**3) * b + (s**3 - 2 * s**2 + s) * u + (s**3 - s**2) * v
    along = 6 * (s - s**2) * (b - a) + (3 * s**2 - 4 * s + 1) * u + (3 * s**2 - 2 * s) * v
    turned = _turned_by(s, first.T @ second)
    axes = first @ turned
    return place, _tilted(axes, along)


def _turned_by(share: float, R: Array) -> Array:
    """(3, 3) a share of the turn R about its axis (Rodrigues)."""
    axial = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    sine = float(np.linalg.norm(axial))
    angle = share * float(np.arctan2(sine, 0.5 * (np.trace(R) - 1.0)))
    if sine < 1e-12:
        return np.eye(3)
    return _about(axial / sine, np.sin(angle), np.cos(angle))


def _tilted(axes: Array, along: Array) -> Array:
    """Section axes turned the shortest way so that x lies along a direction."""
    length = float(np.linalg.norm(along))
    if length == 0.0:
        return axes
    turn = np.cross(axes[:, 0], along / length)
    sine = float(np.linalg.norm(turn))
    return _about(turn / sine, sine, float(axes[:, 0] @ along) / length) @ axes if sine > 1e-12 else axes


def _about(axis: Array, sine: float, cosine: float) -> Array:
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + sine * cross + (1.0 - cosine) * cross @ cross


def _section_axes(axis: Any, across: Any) -> Array:
    """(3, 3) axes of the section in a body's frame: the line's direction, `across` made square to it, and what completes them."""
    x = np.asarray(axis, dtype=float)
    x = x / max(float(np.linalg.norm(x)), 1e-300)
    y = np.asarray(across, dtype=float)
    y = y - (y @ x) * x
    y = y / max(float(np.linalg.norm(y)), 1e-300)
    return np.stack([x, y, np.cross(x, y)], axis=-1)
