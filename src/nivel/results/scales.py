"""The scales of a run that its errors are compared with: size, speed, energy. `verdicts.RULES` states them in words."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from nivel.results.verdicts import ENERGY_FLOOR, EXTENT_FLOOR, POINT_SIZE, REST

Array = NDArray[np.float64]
BLOCK = 16 * 1024  # frames read at once: a long run need not fit in memory


class Readable(Protocol):
    """What a measurement needs of a result: `Result` is one."""

    @property
    def attributes(self) -> Mapping[str, str | float | int]: ...
    @property
    def variables(self) -> Mapping[str, Any]: ...
    @property
    def coordinates(self) -> Mapping[str, tuple[str, ...]]: ...
    @property
    def time(self) -> Array: ...
    def array(self, name: str, frames: slice = ...) -> Array: ...


def machine_size(result: Readable) -> tuple[float, str]:
    """The length [m], never zero, that distances are compared with, and what it is: see `verdicts.RULES`."""
    extent = _extent(result, [slice(0, 1)])
    if extent > 0.0:
        return extent, "machine's size"
    path = _extent(result, blocks(result))
    return (path, "extent of its path") if path > 0.0 else (POINT_SIZE, "length taken for a single point at rest")


def _extent(result: Readable, parts: Iterable[slice]) -> float:
    """Diagonal of the box around all joint points, centres of mass and body origins in these frames [m]; 0 where all
    of them are one point.
    """
    least, largest = np.full(3, np.inf), np.full(3, -np.inf)
    ground = np.array(_scene(result).get("ground_points", []), dtype=float).reshape(-1, 3)
    for frames in parts:
        for points in [ground, *_points_in_space(result, frames)]:
            known = points.reshape(-1, 3)
            known = known[np.isfinite(known).all(axis=1)]
            least = np.minimum(least, known.min(axis=0, initial=np.inf))
            largest = np.maximum(largest, known.max(axis=0, initial=-np.inf))
    if not np.all(least <= largest):
        return 0.0
    extent = float(np.linalg.norm(largest - least))
    away = float(np.linalg.norm(np.maximum(np.abs(least), np.abs(largest))))
    return extent if np.isfinite(extent) and extent > EXTENT_FLOOR * away else 0.0


def speed_of_rest(result: Readable, size: float) -> float:
    """Largest speed [m/s] of a machine that counts as at rest during the run; one frame alone counts as a second."""
    time = result.time
    span = float(time[-1] - time[0]) if len(time) else 0.0
    return REST * size / (span if span > 0.0 else 1.0)


def largest_speed(result: Readable) -> float:
    """Upper bound |v| + |ω| r of the speed of every joint point, centre of mass and body origin, over the run [m/s]."""
    if "velocity" not in result.variables:
        return 0.0
    reach = np.array([_reach(body) for body in bodies(result)])
    largest = 0.0
    for frames in blocks(result):
        v = np.linalg.norm(result.array("velocity", frames), axis=-1)
        omega = np.linalg.norm(result.array("angular_velocity", frames), axis=-1)
        speed = v + omega * reach
        largest = max(largest, float(np.max(speed, initial=0.0, where=np.isfinite(speed))))
    return largest


def largest_energy(result: Readable, size: float) -> tuple[float, str]:
    """The energy [J] that the energy error is compared with, and what it is: see `verdicts.RULES`. It may be zero.

    size : of the machine [m]. A run without frames has no energy: 0 J of no kind.
    """
    if not len(result.time):
        return 0.0, ""
    at_rest = max(_largest(result, "potential_energy", lambda e: e), _largest_load(result, size))
    candidates = [
        ("largest kinetic energy", _largest(result, "kinetic_energy", lambda e: e)),
        ("largest change of potential energy", _largest(result, "potential_energy", lambda e: e - e[0])),
        ("largest work of external forces", _largest(result, "external_work", lambda e: e)),
        ("largest dissipated energy", _largest(result, "dissipated_energy", lambda e: e)),
        ("smallest energy that counts", ENERGY_FLOOR * at_rest),
    ]
    kind, value = max(candidates, key=lambda each: each[1])
    return value, kind


def blocks(result: Readable) -> Iterator[slice]:
    """The frames of the run in parts."""
    count = len(result.time)
    for start in range(0, count, BLOCK):
        yield slice(start, min(start + BLOCK, count))


def _largest_load(result: Readable, size: float) -> float:
    """Largest reaction or applied force times the size, or torque [J]."""
    largest = 0.0
    for name, variable in result.variables.items():
        if name not in ("joint_force", "joint_torque") and not (
            name.startswith("force.") and name.endswith(".magnitude")
        ):
            continue
        arm = size if variable.units == "N" else 1.0
        for frames in blocks(result):
            values = np.abs(result.array(name, frames))
            largest = max(largest, arm * float(np.max(values, initial=0.0, where=np.isfinite(values))))
    return largest


def _largest(result: Readable, name: str, change: Callable[[Array], Array]) -> float:
    if name not in result.variables or not len(result.time):
        return 0.0
    values = np.abs(change(result.array(name)))
    return float(np.max(values, initial=0.0, where=np.isfinite(values)))


def _scene(result: Readable) -> dict[str, Any]:
    return json.loads(str(result.attributes.get("scene", "{}")))


def bodies(result: Readable) -> list[dict[str, Any]]:
    """Bodies of the scene in the order of the result; a body that the scene does not know is a bare origin."""
    known = {body["name"]: body for body in _scene(result).get("bodies", [])}
    return [known.get(name, {}) for name in result.coordinates.get("body", ())]


def _body_points(body: dict[str, Any]) -> Array:
    """(n, 3) [m] origin, centre of mass and joint points in the body frame."""
    return np.array(
        [[0.0, 0.0, 0.0], body.get("centre_of_mass", [0.0, 0.0, 0.0]), *body.get("points", [])], dtype=float
    )


def _reach(body: dict[str, Any]) -> float:
    """Largest distance of a point of the body from its origin [m]."""
    return float(np.linalg.norm(_body_points(body), axis=1).max())


def _points_in_space(result: Readable, frames: slice) -> Iterator[Array]:
    """For each body its points (frames, n, 3) in global axes [m]."""
    if "position" not in result.variables:
        return
    position, orientation = result.array("position", frames), result.array("orientation", frames)
    for k, body in enumerate(bodies(result)):
        local = _body_points(body)
        yield position[:, k, None, :] + rotated(orientation[:, k, None, :], local)


def rotated(theta: Array, r: Array) -> Array:
    """A r for Euler parameters θ (…, 4), scalar first, and vectors r (…, 3) in the body frame."""
    e0, e = theta[..., :1], theta[..., 1:]
    t = 2.0 * np.cross(e, r)
    return r + e0 * t + np.cross(e, t)
