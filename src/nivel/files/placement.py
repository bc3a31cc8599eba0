"""Placement of a part in an assembly: mirrored in the part's own axes, turned, moved.

x' = t + R P x for points of the part, P = diag(±1) the reflection (1 where nothing is mirrored), R the rotation.
Directions, velocities and forces follow R P; angular velocities, torques and axes that something turns about are
axial vectors and follow det(P) R P.

A body frame A becomes A' = R P A P, which is right-handed, so that coordinates in the body frame become s' = P s, those
of axial vectors det(P) P s, and inertia tensors P I P. An axis system C fixed in a body (a marker) becomes R P C F.
Where P mirrors, F turns one axis around (or all three), since the mere image R P C is left-handed:

    AXIAL_Z   x and y are images, z is the axial image: what turned about z by an angle still does
    POLAR_Z   x and z are images: what moved along z by a displacement still does
    AXIAL     all three are axial images
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from nivel.elements.beams.beam import Beam
from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.files.substitution import NotRepresentableError, rewritten, same, substituted
from nivel.lazy import Struct, field
from nivel.machine.bodies.body import Body
from nivel.machine.core import orientation as orientations
from nivel.machine.core.element import Marker
from nivel.machine.core.placement import marker_frame, placement
from nivel.machine.core.record import GROUND, Record
from nivel.machine.core.vectors import Array
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.units.formula import LinearFunction

Triple = tuple[float, float, float]

AXIAL_Z: Final = (1.0, 1.0, -1.0)
POLAR_Z: Final = (1.0, -1.0, 1.0)
AXIAL: Final = (-1.0, -1.0, -1.0)
_ROUND: Final = 1e-14  # quarter turns are exact


class Placement(Struct):
    """translation (3,) [m]; rotation (3, 3); reflection (3,) of ±1, in the part's axes."""

    translation: Array
    rotation: Array
    reflection: Array

    @classmethod
    def of(cls, position: Triple, orientation: orientations.Orientation | None, mirror: str) -> "Placement":
        """As an assembly gives it; `mirror` is x, y, z or none."""
        rotation = orientations.rotation_matrix(orientation)
        nearest = np.round(rotation)
        rotation = np.where(np.abs(rotation - nearest) < _ROUND, nearest + 0.0, rotation)
        reflection = np.array([-1.0 if axis == mirror else 1.0 for axis in "xyz"])
        return cls(np.array(position, dtype=float), rotation, reflection)

    @cached_property
    def mirrored(self) -> bool:
        """Whether the part is mirrored."""
        return bool(np.any(self.reflection < 0))

    @cached_property
    def turns(self) -> bool:
        """Whether directions change."""
        return self.mirrored or not np.array_equal(self.rotation, np.eye(3))

    @cached_property
    def changes(self) -> bool:
        """Whether anything changes."""
        return self.turns or bool(np.any(self.translation))

    @cached_property
    def handedness(self) -> float:
        """det P: -1 where mirrored."""
        return float(np.prod(self.reflection))

    @cached_property
    def polar(self) -> Array:
        """(3, 3) R P, for directions."""
        return self.rotation * self.reflection

    @cached_property
    def axial(self) -> Array:
        """(3, 3) det(P) R P, for what something turns about."""
        return self.handedness * self.polar

    def point(self, point: ArrayLike) -> Triple:
        """A global point of the part."""
        return triple(self.translation + self.polar @ np.asarray(point, dtype=float))

    def direction(self, direction: ArrayLike) -> Triple:
        """A direction, velocity or force in global axes."""
        return triple(self.polar @ np.asarray(direction, dtype=float))

    def turning(self, vector: ArrayLike) -> Triple:
        """An axis of turning, angular velocity or torque in global axes."""
        return triple(self.axial @ np.asarray(vector, dtype=float))

    def in_body(self, vector: ArrayLike) -> Triple:
        """A point or direction in the frame of a body that moves."""
        return triple(self.reflection * np.asarray(vector, dtype=float))

    def turning_in_body(self, vector: ArrayLike) -> Triple:
        """An angular velocity or torque in the frame of a body that moves."""
        return triple(self.handedness * self.reflection * np.asarray(vector, dtype=float))

    def body_frame(self, axes: Array) -> orientations.Orientation:
        """The frame of a body, from its axes (3, 3)."""
        return orientation_of(self.polar @ axes * self.reflection)

    def axes(self, axes: Array, kept: Triple = AXIAL_Z, *, on_ground: bool) -> orientations.Orientation:
        """Axes (3, 3), columns in the frame of their body, which for `ground` is global."""
        flip = np.array(kept) if self.mirrored else np.ones(3)
        image = (self.polar if on_ground else np.diag(self.reflection)) @ axes
        return orientation_of(image * flip)


def by_rules(record: Any, **rules: Callable[[Any], Any]) -> dict[str, Any]:
    """The fields of a record that are given, each by its rule."""
    return {name: rule(value) for name, rule in rules.items() if (value := getattr(record, name, None)) is not None}


def orientation_of(axes: Array) -> orientations.Orientation:
    """A rotation matrix (3, 3) as a record."""
    w, x, y, z = (float(each) for each in orientations.euler_parameters_from_matrix(axes))
    return orientations.Orientation(euler_parameters=(w, x, y, z))


def triple(vector: Sequence[float] | Array) -> Triple:
    """Three numbers as a record holds them, without negative zeros."""
    x, y, z = (float(each) + 0.0 for each in vector)
    return x, y, z


_QUANTITIES = {f"{kind}{axis}": (kind, at) for kind in ("", "v", "w") for at, axis in enumerate("xyz")}


class Scene(Struct, frozen=False):
    """A part before it is placed; `extra` markers are made on the way."""

    placement: Placement
    bodies: Mapping[str, Body]
    markers: Mapping[str, Marker]
    joints: Mapping[str, Joint]
    beams: Mapping[str, Beam]
    extra: dict[str, Marker] = field(default_factory=dict)

    @classmethod
    def of(cls, elements: Mapping[str, Sequence[Record]], placing: Placement) -> "Scene":
        """The part with these elements by section."""
        bodies = {each.name: each for each in elements["bodies"] if isinstance(each, Body)}
        markers = {str(each.name): each for each in elements["markers"] if isinstance(each, Marker)}
        joints = {each.name: each for each in elements["joints"] if isinstance(each, Joint)}
        beams = {each.name: each for each in elements["beams"] if isinstance(each, Beam)}
        return cls(placing, bodies, markers, joints, beams)

    def is_opposite(self, reference: str) -> bool:
        """Whether a joint coordinate counts the other way in the mirror image."""
        joint, _, coordinate = reference.partition(".")
        if not self.placement.mirrored or joint not in self.joints:
            return False
        opposite = JOINTS[self.joints[joint].type].opposite
        if not opposite:
            return False
        return not coordinate or coordinate.removesuffix("_rate") == opposite

    def signal(self, path: str) -> LinearFunction:
        """A signal of the part in terms of those of the placed part."""
        head, _, tail = path.partition(".")
        if head in self.joints and tail.removesuffix("_rate") in self.joints[head].coordinates:
            return LinearFunction(((-1.0, path),)) if self.is_opposite(path) else same(path)
        if tail not in _QUANTITIES or not (head in self.markers or head in self.bodies):
            return same(path)
        kind, at = _QUANTITIES[tail]
        back = (self.placement.axial if kind == "w" else self.placement.polar).T[at]
        terms = [(float(factor), f"{head}.{kind}{axis}") for factor, axis in zip(back, "xyz", strict=True) if factor]
        offset = float(-(back @ self.placement.translation)) + 0.0 if kind == "" else 0.0
        return LinearFunction(tuple(terms), offset)

    def varied(self, function: TimeFunction) -> TimeFunction:
        """A function of the part with the signals of the placed part.

        Raises NotRepresentableError.
        """
        return substituted(function, self.signal)

    def followed(self, record: Any) -> Any:
        """A record whose functions, and those of records in it, have the signals of the placed part.

        Raises NotRepresentableError.
        """
        given = {name: getattr(record, name) for name in record.model_fields_set - {"name"}}
        changes = {name: rewritten(value, self.varied, self.followed) for name, value in given.items()}
        changes = {name: value for name, value in changes.items() if value is not given[name]}
        return record.replace(**changes) if changes else record

    def marker(self, marker: Marker, kept: Triple = AXIAL_Z) -> Marker:
        """`marker` in the placed part. `kept`: which of its axes are images where the part is mirrored."""
        placing, on_ground = self.placement, marker.body == GROUND
        if not (on_ground and placing.changes) and not placing.mirrored:
            return marker
        position, axes = marker_frame(marker)
        place = placing.point(position) if on_ground else placing.in_body(position)
        if not placing.turns:
            return marker.replace(position=place)
        orientation = placing.axes(axes, kept, on_ground=on_ground)
        if marker.shape is not None and placing.mirrored:
            raise NotRepresentableError("a marker with a shape that touches cannot be mirrored; write it out")
        return Marker(name=marker.name, body=marker.body, position=place, orientation=orientation, shape=marker.shape)

    def end(self, end: str | Marker, kept: Triple = AXIAL_Z) -> str | Marker:
        """A marker of a joint or force. A name stays unless the marker by that name has other axes than are needed."""
        if isinstance(end, Marker):
            return self.marker(end, kept)
        if kept == AXIAL_Z or not self.placement.mirrored or end not in self.markers:
            return end
        return self.marker(self.markers[end], kept).replace(name=None)

    def variant(self, name: str, kept: Triple) -> str:
        """The name of a marker that is `name` with other axes kept; it is made if there is need."""
        if not self.placement.mirrored or kept == AXIAL_Z:
            return name
        return self._add(f"{name}_mirrored", self.marker(self.markers[name], kept))

    def ground_frame(self, kept: Triple) -> str:
        """The name of a marker on ground that has the part's origin and axes."""
        if not self.placement.changes:
            return GROUND
        return self._add("frame", self.marker(Marker(body=GROUND), kept))

    def point_on(self, body: str, point: Triple) -> Marker:
        """The marker on `body` at a global `point` of the part, with global axes there; not placed yet."""
        if body == GROUND:
            return Marker(body=GROUND, position=point)
        beam, _, station = body.partition(".")
        if station:
            position, axes = self.beams[beam].frame_at(station)
        else:
            position, parameters = placement(self.bodies[body])
            axes = orientations.matrix_from_euler_parameters(parameters)
        inside = triple(axes.T @ (np.array(point) - position))
        return Marker(body=body, position=inside, orientation=orientation_of(axes.T))

    def _add(self, wanted: str, marker: Marker) -> str:
        """The name under which `marker` is added, near `wanted`."""
        name, count = wanted, 2
        while name in self.markers or self.extra.get(name, marker).replace(name=None) != marker.replace(name=None):
            name, count = f"{wanted}_{count}", count + 1
        self.extra[name] = marker.replace(name=name)
        return name
