"""Where a machine is during its motion, how large it is, and from where it is seen at first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.looks.joints import sliding_axes, turning_axes
from nivel.looks.links import attached, held_points
from nivel.looks.poses import Pose, body_poses, in_space, upwards
from nivel.looks.solids import reach
from nivel.looks.viewpoint import choose_view, is_planar
from nivel.view.records import Triple, Viewpoint
from nivel.view.stage import Cast, triple

Array = NDArray[np.float64]
FAR_AWAY: Final = 1e3  # machine lengths from the global origin from which on positions are counted from the machine
LOOKED_AT: Final = 60  # frames that the box around a motion is found from
FLOWN: Final = 200.0  # lengths of the machine
BEYOND: Final = 1e15  # [m] a run that went further than machines may be long (system.build) is drawn up to there
NOTHING: Final = np.empty((0, 3))


@dataclass(frozen=True)
class Extent:
    """Where a machine is during its motion: box from low to high, origin of the numbers sent, length for signs, first view."""

    origin: Triple
    low: Triple
    high: Triple
    size: float
    up: Triple
    viewpoint: Viewpoint


def extent(cast: Cast, position: Array, orientation: Array) -> Extent:
    """The extent over frames: position (n, B, 3) [m], orientation (n, B, 4); frames that are not finite, or beyond all bounds, are left out."""
    scene, up = cast.scene, upwards(cast.record.get("gravity"))
    fit = np.all(np.abs(position) < BEYOND, axis=(1, 2)) & np.all(np.isfinite(orientation), axis=(1, 2))
    chosen = np.flatnonzero(fit)
    chosen = (
        chosen[np.unique(np.linspace(0, len(chosen) - 1, min(len(chosen), LOOKED_AT)).astype(int))]
        if len(chosen)
        else chosen
    )
    position, orientation = position[chosen], orientation[chosen]
    near = _stays_near(scene, position, orientation)
    position, orientation = position[near], orientation[near]
    if not len(position):
        position, orientation = np.zeros((1, len(cast.bodies), 3)), np.tile([1.0, 0, 0, 0], (1, len(cast.bodies), 1))
    skeletons = [_points(scene, p, q) for p, q in zip(position, orientation, strict=True)]
    start, cloud = skeletons[0], np.concatenate([*skeletons, NOTHING])
    if not len(cloud):
        start = cloud = np.zeros((1, 3))
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    size = float(np.linalg.norm(np.ptp(start, axis=0))) or float(np.linalg.norm(high - low)) or 1.0
    middle = 0.5 * (low + high)
    origin = middle if np.linalg.norm(middle) > FAR_AWAY * size else np.zeros(3)
    poses = body_poses(scene, position[0], orientation[0]) if cast.bodies else {"ground": (np.zeros(3), np.eye(3))}
    bones = _skeleton(scene, poses)
    turning, sliding = turning_axes(scene, poses), sliding_axes(scene, poses)
    view = choose_view(bones if len(bones) else cloud, turning, sliding, up)
    flat = is_planar(bones if len(bones) else cloud, turning, sliding)
    point = Viewpoint(triple(view.right), triple(view.up), triple(view.towards), flat)
    return Extent(triple(origin), triple(low - origin), triple(high - origin), size, triple(up), point)


def _stays_near(scene: dict[str, Any], position: Array, orientation: Array) -> NDArray[np.bool_]:
    """(n,) frames in which no body is further away than FLOWN lengths of the machine: a run that exploded is shown where it began."""
    if not len(position) or not scene.get("bodies"):
        return np.ones(len(position), dtype=bool)
    size = float(np.linalg.norm(np.ptp(_points(scene, position[0], orientation[0]), axis=0))) or np.inf
    return np.all(np.linalg.norm(position - position[0], axis=-1) <= FLOWN * size, axis=1)


def _points(scene: dict[str, Any], position: Array, orientation: Array) -> Array:
    """(n, 3) points around the machine in one frame."""
    if not scene.get("bodies"):
        return NOTHING
    poses = body_poses(scene, position, orientation)
    shapes = [in_space(poses[b["name"]], _corners(b["shape"])) for b in scene["bodies"] if b.get("shape")]
    return np.concatenate([_skeleton(scene, poses), *shapes])


def _corners(shape: dict[str, Any]) -> Array:
    """(8, 3) corners of the box around a shape."""
    points = reach(shape)
    low, high = points.min(axis=0), points.max(axis=0)
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])


def _skeleton(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(n, 3) centres of mass, and points where joints and forces hold bodies and ground."""
    parts = [np.reshape(np.asarray(scene.get("ground_points", []), dtype=float), (-1, 3))]
    parts += [
        in_space(poses[b["name"]], np.vstack([[b["centre_of_mass"]], held_points(scene, b)]))
        for b in scene.get("bodies", [])
    ]
    parts += [in_space(poses["ground"], point) for point in attached(scene, "ground")]
    return np.concatenate([NOTHING, *parts])
