"""Arrows: what joints carry, what forces, motors and drivers apply. For each a point, and its vector at every frame.

Constraint violations as vectors, so that the page can exaggerate them: a gap and a turn for each joint.
Rows are named `joint.basic.axes` (NOTATION.md): `s.x` is a gap along global x; `d2.y` one along y of the first marker; `distance` one
along the line between the two points; `d1.xz` says that x of the first is not perpendicular to z of the second marker: with a small
turn φ of the second, a·(φ × b) = φ·(b × a); `across.y` that a slider is off the line of a beam along y of its section.
"""

from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

from nivel.lazy import Struct
from nivel.looks.viewpoint import rotation
from nivel.machine.core.vectors import Array
from nivel.view.records import Arrow, Force, Joint, Triple
from nivel.view.stage import Cast, coordinate_place

Read = Callable[[str], Array | None]  # a variable of the result by name (n, …), None where it has none

# coordinates of joints along or about the z axis of the first marker
ALONG_Z: Final = {"angle": "torque", "displacement": "force"}
DRIVES: Final = ("motor", "servo", "dc-motor", "servo-motor")
ON_COORDINATES: Final = (*DRIVES, "joint-spring-damper", "stop", "friction", "brake", "clutch", "freewheel")
LARGEST: Final = 1e30  # [N or N m] beyond it nothing is drawn
BETWEEN: Final = ("spring-damper", "pair-force")


class Traced(Struct):
    """An arrow and its vectors (n, 3), global axes [N or N m]; places (n, 3) [m] where it stands, where that is no point of the body."""

    owner: str
    source: Any
    kind: Any
    body: int
    point: Triple
    vectors: Array
    places: Array | None = None


class Moments(Struct):
    """Poses at the frames: position (n, B, 3), rotation matrices A (n, B, 3, 3), time (n,)."""

    position: Array
    A: Array

    @classmethod
    def of(cls, position: Array, orientation: Array) -> "Moments":
        """position (n, B, 3), orientation (n, B, 4)."""
        return cls(position, rotation(orientation))

    def turned(self, body: int, vector: Any) -> Array:
        """(n, 3) a vector of the body frame in global axes."""
        vector = np.asarray(vector, dtype=float)
        return np.tile(vector, (len(self.position), 1)) if body < 0 else self.A[:, body] @ vector

    def point(self, body: int, point: Any) -> Array:
        """(n, 3) a point of the body frame in space."""
        return self.turned(body, point) + (0.0 if body < 0 else self.position[:, body])


def arrows(cast: Cast, moments: Moments, read: Read) -> list[Traced]:
    """All arrows that the result knows."""
    return [*_reactions(cast, read), *_forces(cast, moments, read), *_drivers(cast, moments, read)]


def _reactions(cast: Cast, read: Read) -> Iterator[Traced]:
    for kind in ("force", "torque"):
        values = read(f"joint_{kind}")
        if values is None:
            continue
        for k, joint in enumerate(cast.joints):
            # shown on the second body where the first is the ground: what the ground does to the machine
            on_first = joint.bodies[0] >= 0
            body, point = (joint.bodies[0], joint.points[0]) if on_first else (joint.bodies[1], joint.points[1])
            vectors = values[:, k] if on_first else -values[:, k]
            yield Traced(joint.name, "reaction", kind, body, point, vectors)


def _forces(cast: Cast, moments: Moments, read: Read) -> Iterator[Traced]:
    records = {force["name"]: force for force in cast.record.get("forces", [])}
    for force in cast.forces:
        record = records.get(force.name, {})
        magnitude, power = read(f"force.{force.name}.magnitude"), read(f"force.{force.name}.power")
        if magnitude is None or power is None:
            continue
        if force.kind in ("force", "torque"):
            yield from _load(cast, moments, record, magnitude, power, read)
        elif force.kind in BETWEEN and len(force.points) == 2:
            apart = moments.point(force.bodies[1], force.points[1]) - moments.point(force.bodies[0], force.points[0])
            rate = read(f"force.{force.name}.rate")
            if rate is None:
                continue
            # on the first body, positive where it pulls
            pulls = -_signed(magnitude, power, rate)[:, None] * _unit(apart)
            for k, sign in ((0, 1.0), (1, -1.0)):
                if force.bodies[k] >= 0:
                    yield Traced(force.name, "applied", "force", force.bodies[k], force.points[k], sign * pulls)
        elif force.kind == "contact":
            yield from _contact(force, moments, read)
        elif force.kind in ON_COORDINATES:
            yield from _on_coordinate(cast, moments, record, magnitude, power, read)


def _contact(force: Force, moments: Moments, read: Read) -> Iterator[Traced]:
    """What the bodies of a contact exert on each other, where they touch at each moment."""
    found = [_vector(f"force.{force.name}.{name}", read) for name in ("normal_{}", "friction_{}", "{}")]
    normal_force = read(f"force.{force.name}.normal_force")
    if normal_force is None or any(each is None for each in found):
        return
    normal, friction, place = (np.asarray(each) for each in found)
    push = normal_force[:, None] * normal + friction
    if not (normal_force > 0.0).any():
        return
    for body, sign in zip(force.bodies, (1.0, -1.0), strict=True):
        if body >= 0:
            mean = _mean_point(moments, body, place, normal_force)
            yield Traced(force.name, "applied", "force", body, mean, sign * push, place)


def _vector(name: str, read: Read) -> Array | None:
    """(n, 3) a variable of three components."""
    parts = [part for axis in "xyz" if (part := read(name.format(axis))) is not None]
    return np.stack(parts, axis=1) if len(parts) == 3 else None


def _mean_point(moments: Moments, body: int, place: Array, weight: Array) -> Triple:
    """The mean of points in space, seen from a body."""
    apart = place - moments.position[:, body]
    seen = np.einsum("nji,nj->ni", moments.A[:, body], apart)
    held = np.isfinite(weight) & (np.abs(weight) < LARGEST)
    x, y, z = np.average(seen[held], axis=0, weights=np.maximum(weight[held], 0.0))
    return float(x), float(y), float(z)


def _drivers(cast: Cast, moments: Moments, read: Read) -> Iterator[Traced]:
    for driver in cast.record.get("drivers", []):
        effort, power = read(f"driver.{driver['name']}.effort"), read(f"driver.{driver['name']}.power")
        if effort is not None and power is not None:
            yield from _on_coordinate(cast, moments, driver, effort, power, read)


def _on_coordinate(
    cast: Cast, moments: Moments, record: dict[str, Any], effort: Array, power: Array, read: Read
) -> Iterator[Traced]:
    """An effort on a joint coordinate along or about the joint's axis, shown on the second body."""
    place = coordinate_place(record.get("coordinate"), cast.joints)
    rate = read(f"{place.name}.rate") if place else None
    if place is None or rate is None or place.word not in ALONG_Z:
        return
    joint = place.joint
    vectors = _signed(effort, power, rate)[:, None] * moments.turned(joint.bodies[0], joint.axes[0])
    second = int(joint.bodies[1] >= 0)
    vectors = vectors if second else -vectors
    yield Traced(record["name"], "applied", ALONG_Z[place.word], joint.bodies[second], joint.points[second], vectors)


def _load(
    cast: Cast, moments: Moments, record: dict[str, Any], magnitude: Array, power: Array, read: Read
) -> Iterator[Traced]:
    """A force or torque on one body. Its direction is known where it is constant, or has one component only."""
    place = cast.place_of(record)
    if place is None:
        return
    body, point = place
    kind = record["type"]
    components = list(record.get("vector", []))
    constant = [isinstance(each, int | float) for each in components]
    frame = body if record.get("axes") == "body" else -1
    if all(constant):
        yield Traced(record["name"], "applied", kind, body, point, moments.turned(frame, components))
        return
    if sum(not (known and value == 0.0) for known, value in zip(constant, components, strict=True)) != 1:
        return
    along = moments.turned(frame, [0.0 if known else 1.0 for known in constant])
    velocity, turning = read("velocity"), read("angular_velocity")
    if velocity is None or turning is None:
        return
    arm = moments.turned(body, point)
    moving = turning[:, body] if kind == "torque" else velocity[:, body] + np.cross(turning[:, body], arm)
    vectors = _signed(magnitude, power, np.sum(moving * along, 1))[:, None] * along
    yield Traced(record["name"], "applied", kind, body, point, vectors)


def _signed(magnitude: Array, power: Array, rate: Array) -> Array:
    """Size of `magnitude` with the sign of power/rate; where nothing moves, that of the moment before, or its own."""
    sign = np.sign(power) * np.sign(rate)
    known = np.flatnonzero(np.isfinite(sign) & (sign != 0.0))
    if not len(known):
        return magnitude
    place = np.clip(np.searchsorted(known, np.arange(len(sign)), side="right") - 1, 0, None)
    return np.abs(magnitude) * sign[known[place]]


def _unit(vectors: Array) -> Array:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0.0)


def described(traced: list[Traced], first: int) -> list[Arrow]:
    """Records of arrows whose vectors stand from place `first` on, and behind them those of `places_of`."""
    out, at = [], first + len(traced)
    for k, each in enumerate(traced):
        place = -1 if each.places is None else at
        at += each.places is not None
        sizes = _sizes(each.vectors)
        out.append(Arrow(each.owner, each.source, each.kind, each.body, each.point, first + k, *sizes, place))
    return out


def places_of(traced: list[Traced]) -> list[Array]:
    """(n, 3) [m] the places of those arrows that stand at no point of their bodies."""
    return [each.places for each in traced if each.places is not None]


def _sizes(vectors: Array) -> tuple[float, float]:
    """Greatest length, and the root of the mean square; of what is finite, also when squared."""
    lengths = np.linalg.norm(vectors, axis=-1)
    lengths = lengths[lengths < LARGEST]
    return float(lengths.max(initial=0.0)), float(np.sqrt(np.mean(lengths**2))) if len(lengths) else 0.0


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
    return axes[0], axes[1], _unit(points[1] - points[0])


def _across(z: Array) -> Array:
    """(n, 3) some unit vectors perpendicular to z (n, 3)."""
    other = np.where(np.abs(z[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    x = np.cross(z, other)
    return x / np.linalg.norm(x, axis=-1, keepdims=True)
