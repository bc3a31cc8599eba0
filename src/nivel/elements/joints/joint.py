"""A joint in words: which two bodies, where, and what motion stays free.

What a joint of each type is placed by, and its coordinates, are facts of its kind.
"""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import ClassVar, Final, Literal

from nivel.elements.joints import JOINTS, JointType
from nivel.elements.joints.kind import JointKind
from nivel.machine.core.element import TwoMarkers
from nivel.machine.core.placement import Triple, angle_between, bad_axis_pair, no_direction, parallel
from nivel.machine.core.record import BodyName, Checked, Name, Problem, Record, superfluous, unknown_word
from nivel.machine.given import ANGULAR_SPEED, SLIDING_SPEED, Field, Given, Maybe, OneRecord, TwoNames, TwoPlaces, Usual
from nivel.machine.units.quantity import Angle, AngularVelocity, Direction, Length, Position, PositiveLength, Velocity

Motion = Literal["x", "y", "z", "rx", "ry", "rz"]
# of a generic joint: the coordinate of each motion that has one
COORDINATE_OF: Final[dict[str, str]] = {"x": "x", "y": "y", "z": "displacement", "rz": "angle"}

PERPENDICULAR: Final = 1e-3  # [rad] by which the two axes of a universal joint may miss the right angle


_PLACE: Final = ("point", "interface", "points", "axis", "axes", "x_axis")
_SIZE: Final = ("pitch", "distance", "locked", "radius", "rim_radius")
_INSTEAD: Final = {"point": "points", "points": "point", "axis": "axes", "axes": "axis"}
_WANTED: Final = {
    "point": "one",
    "points": "two, one on each body",
    "axis": "one, e.g. [0, 0, 1]",
    "axes": "two, e.g. [[0, 1, 0], [0, 0, 1]]",
    "radius": "one: from the axle to the outermost points of the rim",
    "pitch": "one: the advance per turn, e.g. 5 mm",
    "locked": "a list of the motions that it does not allow, e.g. [x, y, rx, ry]",
}


class CoordinateValues(Record):
    """Values of joint coordinates by name."""

    angle: Maybe[Angle] = Field(default=None)
    angle_1: Maybe[Angle] = Field(default=None)
    angle_2: Maybe[Angle] = Field(default=None)
    displacement: Maybe[Length] = Field(default=None)
    x: Maybe[Length] = Field(default=None)
    y: Maybe[Length] = Field(default=None)
    distance: Maybe[Length] = Field(default=None)

    @property
    def given(self) -> dict[str, float]:
        """The coordinates that have a value [m, rad]."""
        return {name: value for name in type(self).model_fields if (value := getattr(self, name)) is not None}


class CoordinateRates(Record):
    """Rates of joint coordinates by name. usual : what they are between in results, by their units."""

    usual: ClassVar[Mapping[str, Usual]] = {"rad/s": ANGULAR_SPEED, "m/s": SLIDING_SPEED}

    angle: Maybe[AngularVelocity] = Field(default=None, usual=ANGULAR_SPEED)
    angle_1: Maybe[AngularVelocity] = Field(default=None, usual=ANGULAR_SPEED)
    angle_2: Maybe[AngularVelocity] = Field(default=None, usual=ANGULAR_SPEED)
    displacement: Maybe[Velocity] = Field(default=None, usual=SLIDING_SPEED)
    x: Maybe[Velocity] = Field(default=None, usual=SLIDING_SPEED)
    y: Maybe[Velocity] = Field(default=None, usual=SLIDING_SPEED)
    distance: Maybe[Velocity] = Field(default=None, usual=SLIDING_SPEED)

    @property
    def given(self) -> dict[str, float]:
        """The coordinates that have a rate [m/s, rad/s]."""
        return {name: value for name in type(self).model_fields if (value := getattr(self, name)) is not None}


class Joint(Checked):
    """Two bodies that can move against each other only in the way of the `type`.

    Placed by `bodies` and a global `point` (or `points`, with `axis` or `axes`) at the bodies' given positions, or by
    two `markers`, whose z axes are the joint's axis. The first body comes first in both.
    """

    collection: ClassVar[str] = "joints"

    name: Name
    type: JointType
    bodies: Maybe[TwoNames[BodyName]] = Field("first and second body; one may be `ground`", default=None)
    markers: Maybe[TwoMarkers] = Field("on the first and second body: names or markers", default=None)
    point: Maybe[Position] = Field("of the joint, global", default=None)
    interface: Name | None = Field(
        "of a flexible body among the two, by name, instead of `point`: where it is as placed", default=None
    )
    points: Maybe[TwoPlaces[Position]] = Field(
        "of a joint between two points: on the first body, on the second; global", default=None
    )
    axis: Maybe[Direction] = Field("of the joint; global, of any length", default=None)
    axes: Maybe[TwoPlaces[Direction]] = Field(
        "of a joint with two axes: on the first body, on the second; global; perpendicular in a universal one",
        default=None,
    )
    x_axis: Maybe[Direction] = Field(
        "where the joint's x axis points, made perpendicular to `axis`; global", default=None
    )
    pitch: Maybe[Length] = Field("of a screw, advance per turn; negative: left-handed", default=None)
    distance: Maybe[PositiveLength] = Field("held between the points; default as placed", default=None)
    radius: Maybe[PositiveLength] = Field("of a wheel that rolls, at its outermost points", default=None)
    rim_radius: Maybe[Length] = Field(
        "of its rim where it touches, in a section through the axle; default 0, a sharp edge; as large as `radius`: a ball",
        default=None,
    )
    locked: Maybe[Given[tuple[Motion, ...], tuple[Motion, ...], Sequence[Motion]]] = Field(
        "of a generic joint: motions that it does not allow, x y z along and rx ry rz about the axes of its first marker",
        default=None,
    )
    start: Maybe[OneRecord[CoordinateValues]] = Field("of joint coordinates, held by the assembly", default=None)
    start_rates: Maybe[OneRecord[CoordinateRates]] = Field("of joint coordinates at the start", default=None)

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the joint coordinates."""
        return JOINTS[self.type].coordinates

    @property
    def held(self) -> tuple[str, ...]:
        """Those of them that the joint itself holds."""
        return (*JOINTS[self.type].held, *held_by(self.locked or ()))

    @property
    def x_direction(self) -> Triple | None:
        """Where the joint's x axis points, global: as given, or to the second of two points; None: as for any axis."""
        if self.x_axis is not None or self.points is None or self.type == "rolling":
            return self.x_axis
        return _line(self.points)

    def problems(self) -> Iterator[Problem]:
        kind = JOINTS[self.type]
        if kind.rail and self.markers is not None:
            yield superfluous(
                "markers", f"do not place a {self.type} joint: give `bodies`, the second a beam, and a `point`"
            )
        yield from self._problems_by_markers() if self.markers is not None else self._problems_by_points(kind)
        for key in _SIZE:
            if key not in (*kind.size, *kind.may_size) and self._gives(key):
                yield superfluous(key, f"does not belong to a {self.type} joint")
        for key in kind.size:
            if not self._gives(key):
                yield self._missing(key)
        if self.pitch == 0:
            yield Problem(("pitch",), "`pitch` is zero: a joint that only turns is revolute")
        if self.locked is not None:
            yield from self._problems_of_locked(self.locked)
        yield from self._problems_of_rim()
        if self.type == "rolling":
            yield from self._problems_of_plane()
        yield from self._problems_of_start(kind)

    def _problems_of_rim(self) -> Iterator[Problem]:
        radius, rim = self.radius, self.rim_radius
        if rim is not None and rim < 0.0:
            yield Problem(("rim_radius",), f"`rim_radius` is {rim:.6g} m, less than zero; zero is a sharp edge")
        if rim is not None and radius is not None and rim > radius:
            message = f"`rim_radius` is {rim:.6g} m, more than the `radius` of the wheel, {radius:.6g} m"
            yield Problem(("rim_radius",), message)

    def _problems_of_plane(self) -> Iterator[Problem]:
        if self.x_axis is None or self.axes is None or not any(self.axes[0]):
            return
        zero = list(no_direction("x_axis", self.x_axis))
        yield from zero
        if not zero and parallel(self.axes[0], self.x_axis):
            yield Problem(
                ("x_axis",), "`x_axis` is parallel to the plane's normal, the first of `axes`; it must point elsewhere"
            )

    def _problems_of_locked(self, locked: tuple[str, ...]) -> Iterator[Problem]:
        twice = [name for name, count in Counter(locked).items() if count > 1]
        if twice:
            yield Problem(("locked",), f"`{twice[0]}` stands here more than once")
        if not locked:
            yield Problem(("locked",), "nothing is locked: bodies without a joint are free; leave the joint out")

    def _gives(self, key: str) -> bool:
        return getattr(self, key) is not None

    def _missing(self, key: str) -> Problem:
        return Problem((), f"`{key}` is missing: a {self.type} joint needs {_WANTED[key]}")

    def _problems_by_markers(self) -> Iterator[Problem]:
        for key in ("bodies", *_PLACE):
            if self._gives(key):
                yield superfluous(key, "must not be given with `markers`, which say where the joint is")

    def _problems_by_points(self, kind: JointKind) -> Iterator[Problem]:
        where = kind.place[0]
        by_interface = where == "point" and self.interface is not None and not kind.rail
        if by_interface and self.point is not None:
            yield Problem(("interface",), "give `point` or `interface`, not both", at_key=True)
        if self.bodies is None or not (self._gives(where) or by_interface):
            what = "a `point`" if where == "point" else "`points`"
            line = "point: [0, 0, 0]" if where == "point" else "points: [[0, 0, 0], [1, 0, 0]]"
            what += "; the second body is a beam" if kind.rail else ", or two `markers`"
            yield Problem((), f"a {self.type} joint needs `bodies` and {what}; write `bodies: [FIRST, SECOND], {line}`")
        if self.bodies is not None and self.bodies[0] == self.bodies[1]:
            yield Problem(("bodies",), f"`bodies`: a joint needs two different bodies, got `{self.bodies[0]}` twice")
        for key in kind.place[1:]:
            if not self._gives(key):
                yield self._missing(key)
        allowed = (*kind.place, *kind.may, *(("interface",) if where == "point" and not kind.rail else ()))
        for key in _PLACE:
            if self._gives(key) and key not in allowed:
                instead = _INSTEAD.get(key, "")
                hint = f"; write `{instead}`" if instead in allowed else ""
                yield Problem((key,), f"a {self.type} joint has no `{key}`{hint}", at_key=True)
        if "axis" in allowed:
            yield from bad_axis_pair(self.axis, self.x_axis) if self.axis is not None else ()
        if "axes" in allowed:
            yield from self._problems_of_axes(kind)
        needs_line = "points" in allowed and "axes" not in allowed and self.distance is None
        if needs_line and self.points is not None and self.points[0] == self.points[1]:
            yield Problem(("points",), "the two `points` are the same; the line between them has no direction")
        if self.points is not None:
            yield from self._problems_of_one_line(self.points)

    def _problems_of_one_line(self, points: tuple[Triple, Triple]) -> Iterator[Problem]:
        """A link that lies along the axis that it should turn about."""
        same = points[0] == points[1]
        if self.axis is not None and any(self.axis) and not same and _along(self.axis, points):
            yield Problem(("points",), "the second of the `points` lies on the `axis`: nothing turns about it")
        if self.axes is None or not all(map(any, self.axes)) or not parallel(*self.axes):
            return
        if self.type == "rolling":
            if self.rim_radius != self.radius:
                yield Problem(
                    ("axes",), "the two `axes`, the plane's normal and the axle, are parallel: the wheel lies flat"
                )
        elif _along(self.axes[0], points):
            yield Problem(("axes",), "the two `axes` are one line: that is a cylindrical joint, without a link")

    def _problems_of_axes(self, kind: JointKind) -> Iterator[Problem]:
        if self.axes is None:
            return
        zero = [problem for axis in self.axes for problem in no_direction("axes", axis)]
        yield from zero[:1]
        if zero:
            return
        angle = angle_between(*self.axes)
        if kind.axes == "perpendicular" and abs(angle - math.pi / 2) > PERPENDICULAR:
            apart = f"{math.degrees(angle):.4g} deg apart"
            yield Problem(("axes",), f"`axes` of a {self.type} joint are perpendicular; these are {apart}")
        if self.axis is not None and any(self.axis):
            off = abs(angle_between(self.axis, self.axes[0]) - math.pi / 2)
            if off > PERPENDICULAR:
                message = f"the first of the `axes` is perpendicular to `axis`; it is {math.degrees(off):.4g} deg off"
                yield Problem(("axes",), message)
        if kind.axes == "not parallel" and parallel(*self.axes):
            yield Problem(("axes",), f"`axes` of a {self.type} joint are not parallel; these are")

    def _problems_of_start(self, kind: JointKind) -> Iterator[Problem]:
        free = [name for name in kind.coordinates if name not in self.held]
        for key in ("start", "start_rates"):
            values: CoordinateValues | CoordinateRates | None = getattr(self, key)
            for name in values.given if values is not None else ():
                if name not in free:
                    message = f"for a {self.type} joint {unknown_word(name, free, 'coordinate')}"
                    yield Problem((key, name), message, at_key=True)


def held_by(locked: Iterable[object]) -> tuple[str, ...]:
    """The joint coordinates that stay constant in a generic joint with these motions locked: without turns about x and y
    alone there is no angle about z.
    """
    locked = tuple(locked)
    held = [COORDINATE_OF[each] for each in locked if isinstance(each, str) and each in COORDINATE_OF]
    return (*held, *(() if not locked or {"rx", "ry"} <= set(locked) or "angle" in held else ("angle",)))


def _along(axis: Triple, points: tuple[Triple, Triple]) -> bool:
    """Whether the line through two points lies along `axis`, as it does where they are one point."""
    line = _line(points)
    return not any(line) or parallel(axis, line)


def _line(points: tuple[Triple, Triple]) -> Triple:
    """From the first point to the second."""
    first, second = points
    return second[0] - first[0], second[1] - first[1], second[2] - first[2]
