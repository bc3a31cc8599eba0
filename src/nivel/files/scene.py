"""Scene of a part while it is placed: what its elements have to know of each other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from nivel.files.placement import AXIAL_Z, Placement, Triple, orientation_of, triple
from nivel.files.substitution import Linear, same, substituted
from nivel.machine.beams.beam import Beam
from nivel.machine.bodies.body import Body
from nivel.machine.core.marker import Marker
from nivel.machine.core.orientation import matrix_from_euler_parameters
from nivel.machine.core.placement import marker_frame, placement
from nivel.machine.core.record import GROUND, Record
from nivel.machine.joints.joint import JOINT_WORDS, Joint
from nivel.machine.laws.time_function import Expression, PythonLaw, Table, TimeFunction

_QUANTITIES = {f"{kind}{axis}": (kind, at) for kind in ("", "v", "w") for at, axis in enumerate("xyz")}


@dataclass
class Scene:
    """A part before it is placed; `extra` markers are made on the way."""

    placement: Placement
    bodies: Mapping[str, Body]
    markers: Mapping[str, Marker]
    joints: Mapping[str, Joint]
    beams: Mapping[str, Beam]
    extra: dict[str, Marker] = field(default_factory=dict)

    @classmethod
    def of(cls, elements: Mapping[str, Sequence[Record]], placing: Placement) -> Scene:
        """The part with these elements by section."""
        bodies = {each.name: each for each in elements["bodies"] if isinstance(each, Body)}
        markers = {str(each.name): each for each in elements["markers"] if isinstance(each, Marker)}
        joints = {each.name: each for each in elements["joints"] if isinstance(each, Joint)}
        beams = {each.name: each for each in elements["beams"] if isinstance(each, Beam)}
        return cls(placing, bodies, markers, joints, beams)

    def is_opposite(self, reference: str, kind: str = "length") -> bool:
        """Whether a joint coordinate counts the other way in the mirror image. `kind`: of a joint without coordinate."""
        joint, _, coordinate = reference.partition(".")
        if not self.placement.mirrored or joint not in self.joints:
            return False
        opposite = JOINT_WORDS[self.joints[joint].type].opposite
        if not opposite:
            return False
        return coordinate.removesuffix("_rate") == opposite if coordinate else kind == "length"

    def signal(self, path: str) -> Linear:
        """A signal of the part in terms of those of the placed part."""
        head, _, tail = path.partition(".")
        if head in self.joints and tail.removesuffix("_rate") in self.joints[head].coordinates:
            return Linear(((-1.0, path),)) if self.is_opposite(path) else same(path)
        if tail not in _QUANTITIES or not (head in self.markers or head in self.bodies):
            return same(path)
        kind, at = _QUANTITIES[tail]
        back = (self.placement.axial if kind == "w" else self.placement.polar).T[at]
        terms = [(float(factor), f"{head}.{kind}{axis}") for factor, axis in zip(back, "xyz", strict=True) if factor]
        offset = float(-(back @ self.placement.translation)) + 0.0 if kind == "" else 0.0
        return Linear(tuple(terms), offset)

    def varied(self, function: TimeFunction) -> TimeFunction:
        """A function of the part with the signals of the placed part.

        Raises NotRepresentableError.
        """
        return substituted(function, self.signal)

    def followed(self, record: Any) -> Any:
        """A record whose functions, and those of records in it, have the signals of the placed part.

        Raises NotRepresentableError.
        """
        changes = {name: self._followed(getattr(record, name)) for name in record.model_fields_set - {"name"}}
        changes = {name: value for name, value in changes.items() if value is not getattr(record, name)}
        return record.replace(**changes) if changes else record

    def _followed(self, value: Any) -> Any:
        match value:
            case Expression() | Table() | PythonLaw():
                return self.varied(value)
            case Record():
                return self.followed(value)
            case tuple() if any(isinstance(each, Expression | Table | PythonLaw | Record) for each in value):
                return tuple(self._followed(each) for each in value)
        return value

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
        return Marker(name=marker.name, body=marker.body, position=place, orientation=orientation)

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
            axes = matrix_from_euler_parameters(parameters)
        inside = triple(axes.T @ (np.array(point) - position))
        return Marker(body=body, position=inside, orientation=orientation_of(axes.T))

    def _add(self, wanted: str, marker: Marker) -> str:
        """The name under which `marker` is added, near `wanted`."""
        name, count = wanted, 2
        while name in self.markers or self.extra.get(name, marker).replace(name=None) != marker.replace(name=None):
            name, count = f"{wanted}_{count}", count + 1
        self.extra[name] = marker.replace(name=name)
        return name
