"""Extent of a machine during its motion, and the first viewpoint."""

from typing import Any, Final

import numpy as np

from nivel.lazy import Struct
from nivel.looks.solids import attached, held_points, reach_of, shapes_of
from nivel.looks.viewpoint import (
    Pose,
    body_poses,
    choose_view,
    in_space,
    is_planar,
    rotation,
    sliding_axes,
    turning_axes,
    upwards,
)
from nivel.machine.bodies.surface import surface_arrays
from nivel.machine.core.vectors import Array
from nivel.view.records import Triple, Viewpoint
from nivel.view.stage import Cast, triple

FAR_AWAY: Final = 1e3  # machine lengths from the global origin from which on positions are counted from the machine
LOOKED_AT: Final = 60  # frames that the box around a motion is found from
FLOWN: Final = 200.0  # lengths of the machine
BEYOND: Final = 1e15  # [m] a run that went further than machines may be long (system.build) is drawn up to there
NOTHING: Final = np.empty((0, 3))


class Extent(Struct):
    """Where a machine is during its motion: box from low to high, origin of the numbers sent, length for signs, first view."""

    origin: Triple
    low: Triple
    high: Triple
    size: float
    up: Triple
    viewpoint: Viewpoint


def extent(cast: Cast, position: Array, orientation: Array) -> Extent:
    """The extent over frames: position (n, B, 3) [m], orientation (n, B, 4)."""
    position, orientation = _looked_at(position, orientation)
    clouds = _clouds(cast.scene, position, orientation)
    size = float(np.linalg.norm(np.ptp(clouds[0], axis=0))) if len(clouds[0]) else 0.0
    if size > 0.0:  # a run that exploded is shown where it began
        near = np.all(np.linalg.norm(position - position[0], axis=-1) <= FLOWN * size, axis=1)
        clouds = [cloud for cloud, stays in zip(clouds, near, strict=True) if stays]
    cloud = np.concatenate(clouds)
    cloud = cloud if len(cloud) else np.zeros((1, 3))
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    size = size or float(np.linalg.norm(high - low)) or 1.0
    middle = 0.5 * (low + high)
    origin = middle if np.linalg.norm(middle) > FAR_AWAY * size else np.zeros(3)
    up = upwards(cast.record.get("gravity"))
    view = _first_view(cast.scene, position[0], orientation[0], up)
    return Extent(triple(origin), triple(low - origin), triple(high - origin), size, triple(up), view)


def _looked_at(position: Array, orientation: Array) -> tuple[Array, Array]:
    """Some of the frames, evenly taken of those that are finite and within bounds; a resting one where there is none."""
    fit = np.all(np.abs(position) < BEYOND, axis=(1, 2)) & np.all(np.isfinite(orientation), axis=(1, 2))
    chosen = np.flatnonzero(fit)
    if not len(chosen):
        bodies = position.shape[1]
        return np.zeros((1, bodies, 3)), np.tile([1.0, 0.0, 0.0, 0.0], (1, bodies, 1))
    chosen = chosen[np.unique(np.linspace(0, len(chosen) - 1, min(len(chosen), LOOKED_AT)).astype(int))]
    return position[chosen], orientation[chosen]


def _first_view(scene: dict[str, Any], position: Array, orientation: Array, up: Array) -> Viewpoint:
    poses = body_poses(scene, position, orientation)
    bones = _skeleton(scene, poses)
    bones = bones if len(bones) else np.zeros((1, 3))
    turning, sliding = turning_axes(scene, poses), sliding_axes(scene, poses)
    view = choose_view(bones, turning, sliding, up)
    return Viewpoint(triple(view.right), triple(view.up), triple(view.towards), is_planar(bones, turning, sliding))


def _clouds(scene: dict[str, Any], position: Array, orientation: Array) -> list[Array]:
    """(n, 3) points around the machine in each of the frames: what `_skeleton` has, and the corners around the shapes of bodies."""
    own = [np.vstack([_held(scene, body), _box(body)]) for body in scene["bodies"]]
    of_body = np.repeat(np.arange(len(own)), [len(points) for points in own])
    local = np.concatenate([NOTHING, *own])
    resting = np.concatenate([_on_ground(scene), NOTHING])
    moving = [
        r[of_body] + np.einsum("nij,nj->ni", rotation(theta)[of_body], local)
        for r, theta in zip(position, orientation, strict=True)
    ]
    return [np.concatenate([resting, points]) for points in moving]


def _box(body: dict[str, Any]) -> Array:
    """(8, 3) corners of the box around what a body looks like, undeformed; of one without a shape none."""
    if body.get("flexible"):
        return _corners(surface_arrays(body["flexible"]["surface"])[0])
    return _corners(reach_of(body)) if shapes_of(body) else NOTHING


def _corners(points: Array) -> Array:
    """(8, 3) corners of the box around points (n, 3)."""
    low, high = points.min(axis=0), points.max(axis=0)
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])


def _skeleton(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(n, 3) centres of mass, and points where joints and forces hold bodies and ground."""
    parts = [in_space(poses[body["name"]], _held(scene, body)) for body in scene["bodies"]]
    return np.concatenate([NOTHING, _on_ground(scene), *parts])


def _held(scene: dict[str, Any], body: dict[str, Any]) -> Array:
    """(n, 3) the centre of mass of a body and the points where it is held, in its frame."""
    return np.vstack([[body["centre_of_mass"]], held_points(scene, body)])


def _on_ground(scene: dict[str, Any]) -> Array:
    """(n, 3) points where joints and forces hold the ground."""
    points = [*scene.get("ground_points", []), *attached(scene, "ground")]
    return np.reshape(np.asarray(points, dtype=float), (-1, 3))
