"""Drivers: prescribed motions of a joint coordinate, of the place or angle of a marker, or of its whole pose; one row for each."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Final, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import is_angle
from nivel.elements.joints.kind import AXES
from nivel.errors import located
from nivel.kernels.bodies.coordinate import ROTATION, TRANSLATION
from nivel.known import RowTable, SystemBuilder
from nivel.lazy import nivel
from nivel.machine.core import coefficient
from nivel.machine.core.orientation import AxisSequence
from nivel.machine.core.record import GROUND, Checked, Name, Problem, superfluous
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import (
    FourFunctions,
    OneFunction,
    ThreeFunctions,
    TimeFunction,
    signals_of,
    varying,
)
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.units.quantity import Direction, fault, listed
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import CoordinateReference, Kind, kind_of

AngleMotion = Annotated[OneFunction, varying("angle", smooth=True)]
ShareMotion = Annotated[OneFunction, varying("number", smooth=True)]
FORMS: Final = ("euler", "axis", "euler_parameters")
# Euler parameters between the points of a table are made of unit length; shorter than this they are of points too far apart.
SHORTEST: Final = 0.9
# times at which the length of Euler parameters is looked at
LOOKS: Final = 400


def _columns(value: Any) -> Any:
    """Four functions; of a table with four values a row its columns, with signs of rows (q and -q are one turn) that follow smoothly."""
    if not isinstance(value, Mapping) or "values" not in value:
        return listed(value)
    try:
        table = np.array([listed(row) for row in value["values"]], dtype=float)
    except (TypeError, ValueError):
        table = np.zeros(0)
    if table.ndim != 2 or len(table[0]) != 4:
        raise fault("`values` has four numbers a row, scalar first: `values: [[1, 0, 0, 0], [0.8, 0.6, 0, 0], …]`")
    flips = np.cumprod([1.0, *np.where(np.einsum("ki,ki->k", table[1:], table[:-1]) < 0.0, -1.0, 1.0)])
    rest = {"interpolation": "cubic", **{key: each for key, each in value.items() if key != "values"}}
    return tuple({**rest, "values": column.tolist()} for column in (table * flips[:, None]).T)


class DrivenOrientation(Checked):
    """One of: `euler` with `sequence`, `axis` with `angle`, `euler_parameters`; all functions of time."""

    euler: Annotated[Maybe[ThreeFunctions[AngleMotion]], BeforeValidator(listed)] = Field(
        "three angles, each about an axis of the frame as turned so far", default=None
    )
    sequence: AxisSequence | None = Field("axes of the three turns, e.g. zyx", default=None)
    axis: Maybe[Direction] = Field("axis of the turn, of any length", default=None)
    angle: Maybe[AngleMotion] = Field("turn about `axis`, right-handed", default=None)
    euler_parameters: Annotated[Maybe[FourFunctions[ShareMotion]], BeforeValidator(_columns)] = Field(
        "four functions, scalar first, or one table whose `values` have four numbers a row; made of unit length",
        default=None,
    )

    @property
    def turns(self) -> tuple[str, tuple[TimeFunction, ...]]:
        """Axes of the turns in order, each of the frame as turned so far, and their angles [rad]; no axes for Euler parameters, of which
        there are four."""
        if self.euler is not None and self.sequence is not None:
            return self.sequence, self.euler
        if self.axis is not None and self.angle is not None:
            x, y, z = self.axis
            first, second = float(np.arctan2(y, x)), float(np.arctan2(np.hypot(x, y), z))
            # z is turned into the axis, and back behind the turn
            return "zyzyz", (first, second, self.angle, -second, -first)
        assert self.euler_parameters is not None  # the record was checked
        return "", self.euler_parameters

    def problems(self) -> Iterator[Problem]:
        given = [name for name in FORMS if getattr(self, name) is not None]
        if len(given) != 1:
            got = " and ".join(given) or "none of them"
            yield Problem((), f"one of {', '.join(FORMS)} was expected, got {got}")
        if (self.euler is None) != (self.sequence is None):
            yield Problem((), "`euler` and `sequence` belong together, e.g. `{euler: [time, 0, 0], sequence: zyx}`")
        if (self.axis is None) != (self.angle is None):
            yield Problem((), "`axis` and `angle` belong together, e.g. `{axis: [0, 0, 1], angle: 2*time}`")
        if self.axis is not None and not np.any(self.axis):
            yield Problem(("axis",), "the axis has no direction: it is zero")
        if self.euler_parameters is not None:
            yield from _problems_of_length(self.euler_parameters)


def _problems_of_length(parameters: tuple[TimeFunction, ...]) -> Iterator[Problem]:
    """Tables whose Euler parameters are far from unit length between their points: these are too far apart, or no unit quaternions."""
    tables = [each for each in parameters if isinstance(each, Table)]
    if not tables and any(not isinstance(each, float | int) for each in parameters):
        return  # functions of any length
    spans = [np.linspace(each.times[0], each.times[-1], LOOKS) for each in tables]
    times = np.unique(np.concatenate([[0.0], *spans]))
    for time in times:
        try:
            length = float(np.linalg.norm([_value(each, float(time)) for each in parameters]))
        except (ExpressionError, TypeError):
            return
        if not SHORTEST <= length <= 1.0 / SHORTEST:
            yield Problem(
                ("euler_parameters",),
                f"their length at {time:.6g} s is {length:.4g}, not 1: give unit quaternions, scalar first, "
                f"of a table at times less than a quarter turn apart",
            )
            return


def _value(function: TimeFunction, time: float) -> float:
    return function(time) if isinstance(function, Table | Expression) else float(function)  # type: ignore[arg-type]


LengthMotion = Annotated[OneFunction, varying("length", smooth=True)]
# keys of a driver of one motion, which a whole pose has no use for
RATES: Final = ("speed", "acceleration")
MOTIONS: Final = ("value", *RATES)
OF_ONE_MOTION: Final = ("coordinate", "along", "about", "value", "speed", "acceleration")


class Driver(Checked):
    """A joint coordinate, the place or angle of a marker, or a marker's whole pose, that follows functions of time."""

    collection: ClassVar[str] = "drivers"

    name: Name
    coordinate: CoordinateReference | None = Field("joint coordinate that is driven", default=None)
    marker: Name | None = Field("marker that is driven, in place of `coordinate`", default=None)
    along: Literal["x", "y", "z"] | None = Field(
        "axis of `relative_to` along which the marker's point is driven", default=None
    )
    about: Literal["x", "y", "z"] | None = Field(
        "axis of `relative_to` about which the marker is turned, measured between the axes that follow it", default=None
    )
    relative_to: Name | None = Field("marker from which it is measured; default `ground`", default=None)
    value: Maybe[coefficient.CoordinateMotion] = Field("length or angle, a function of time", default=None)
    speed: Maybe[coefficient.CoordinateSpeed] = Field(
        "in place of `value`: rate, a function of time; the coordinate begins where it is placed", default=None
    )
    acceleration: Maybe[coefficient.CoordinateAcceleration] = Field(
        "in place of `value`: a function of time; the coordinate begins where it is placed", default=None
    )
    start_speed: coefficient.CoordinateRate = Field("with `acceleration`: rate at t = 0", default=0.0)
    position: Annotated[Maybe[ThreeFunctions[LengthMotion]], BeforeValidator(listed)] = Field(
        "of the marker's point from that of `relative_to`, along its axes: three functions of time", default=None
    )
    orientation: Maybe[OneRecord[DrivenOrientation]] = Field(
        "of the marker's axes in those of `relative_to`, functions of time", default=None
    )
    from_start: coefficient.Truth = Field(
        "the coordinate moves from where it is placed by what `value` changes from its value at t = 0", default=False
    )

    @property
    def kind(self) -> Kind | None:
        """Whether a length or an angle is driven, where that is known without the machine."""
        if self.marker is not None:
            return "length" if self.along is not None else "angle"
        return kind_of(self.coordinate)

    @property
    def is_pose(self) -> bool:
        """Whether a position or an orientation is driven as a whole."""
        return self.position is not None or self.orientation is not None

    @property
    def row_count(self) -> int:
        """Motions that it prescribes."""
        return 3 * (self.position is not None) + 3 * (self.orientation is not None) if self.is_pose else 1

    @property
    def reference(self) -> str | None:
        """The marker from which a marker is measured; None for the ground."""
        return None if self.relative_to == GROUND else self.relative_to

    def problems(self) -> Iterator[Problem]:
        if self.is_pose:
            yield from self._problems_of_pose()
            return
        given = [name for name in MOTIONS if getattr(self, name) is not None]
        if not given and (self.coordinate, self.along, self.about) != (None, None, None):
            yield Problem(
                (),
                "`value` is missing: the driven length or angle, a function of time; or a `speed`, or an `acceleration`",
            )
        for name in given[1:]:
            yield superfluous(name, f"stands in place of `{given[0]}`; give one of them")
        yield from self._problems_of_rates()
        if self.coordinate is not None:
            for name in ("marker", "along", "about", "relative_to"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "must not be given with `coordinate`")
            return
        if self.marker is None:
            yield Problem((), "a driver needs a `coordinate`, or a `marker` and `along` or `about`")
            return
        if self.along is None and self.about is None:
            yield Problem(
                (),
                "`along` or `about` is missing: the axis of the driven motion; or a whole `position` or `orientation`",
            )
        if self.along is not None and self.about is not None:
            yield superfluous("about", "stands in place of `along`; give one of them")
        if self.marker is not None and self.relative_to == self.marker:
            yield Problem(("relative_to",), "a marker does not move relative to itself")

    def _problems_of_rates(self) -> Iterator[Problem]:
        for name in RATES:
            function = getattr(self, name)
            if function is not None and signals_of(function):
                symbol = signals_of(function)[0]
                message = f"`{symbol}` is only known while the machine moves; a driver depends on `time` alone"
                yield Problem((name,), message)
            if isinstance(function, PythonLaw):
                yield Problem((name,), "a function in Python drives by its `value`, rate and acceleration")
            if function is not None and self.from_start:
                yield superfluous(
                    "from_start", f"goes with `value`; with `{name}` the coordinate begins where it is placed"
                )
        if self.start_speed and self.acceleration is None:
            yield superfluous("start_speed", "belongs to an `acceleration`, and none is given")

    def _problems_of_pose(self) -> Iterator[Problem]:
        for name in OF_ONE_MOTION:
            if getattr(self, name) is not None:
                yield superfluous(name, "must not be given with `position` or `orientation`, which drive a marker")
        if self.from_start:
            yield superfluous(
                "from_start", "goes with `value`; a `position` and an `orientation` are those of the marker"
            )
        if self.marker is None:
            yield Problem((), "`marker` is missing: the marker whose pose is driven")
        if self.marker is not None and self.relative_to == self.marker:
            yield Problem(("relative_to",), "a marker does not move relative to itself")


def add_drivers(builder: SystemBuilder, rows: RowTable) -> None:
    """Rows of all drivers."""
    for driver in builder.machine.drivers:
        if driver.is_pose:
            _add_pose(builder, rows, driver)
        else:
            _add_driver(builder, rows, driver)


def _add_driver(builder: SystemBuilder, rows: RowTable, driver: Driver) -> None:
    """The row of a driver of one motion."""
    coordinate = _driven(builder, driver)
    units = "rad" if is_angle(builder, coordinate) else "m"
    row = rows.row(driver.name, "driver", units)
    effort = "N m" if units == "rad" else "N"
    output = builder.outputs.add(
        (f"driver.{driver.name}.effort", effort, f"effort of {driver.name} on its coordinate"),
        (f"driver.{driver.name}.power", "W", f"power of {driver.name} into the machine"),
    )
    function = _motion(builder, driver)
    offset = 0.0 if driver.value is not None and not driver.from_start else None
    rows.combine(builder, row, [(coordinate, 1.0)], offset=offset, function=function, report=(output, 1))


def _motion(builder: SystemBuilder, driver: Driver) -> int:
    """The function that the coordinate follows, or its change since t = 0."""
    if driver.value is not None:
        with located(f"drivers.{driver.name}.value"):
            return builder.function(driver.value, motion=True)
    if driver.speed is not None:
        with located(f"drivers.{driver.name}.speed"):
            return builder.way(driver.speed, 1)
    assert driver.acceleration is not None  # the record was checked
    with located(f"drivers.{driver.name}.acceleration"):
        return builder.way(driver.acceleration, 2, driver.start_speed)


def _driven(builder: SystemBuilder, driver: Driver) -> int:
    if driver.coordinate is not None:
        return builder.coordinate(driver.coordinate)
    assert driver.marker is not None  # the record was checked
    if driver.about in ("x", "y"):
        ends = (_with_axis(builder, name, driver.about) for name in (driver.reference, driver.marker))
        return builder.coordinates.add(ROTATION, *ends)
    marker, reference = builder.marker(driver.marker), builder.marker_or_ground(driver.relative_to)
    if driver.along is not None:
        return builder.coordinates.add(TRANSLATION, reference, marker, AXES[driver.along])
    return builder.coordinates.add(ROTATION, reference, marker)


def _with_axis(builder: SystemBuilder, name: str | None, axis: str) -> int:
    """A marker like that called `name`, or the global frame, with this axis in the place of z and the next one in that of x."""
    body, point, axes = ("ground", np.zeros(3), np.eye(3))
    if name is not None:
        body, point, axes = builder.place_of(name)
    k = AXES[axis]
    return builder.place((body, point, axes[:, [(k + 1) % 3, (k + 2) % 3, k]]))


def _add_pose(builder: SystemBuilder, rows: RowTable, driver: Driver) -> None:
    """Rows `x`, `y`, `z` of a driven position, `about_x`, `about_y`, `about_z` of a driven orientation."""
    assert driver.marker is not None  # the record was checked
    reference, marker = builder.marker_or_ground(driver.reference), builder.marker(driver.marker)
    if driver.position is not None:
        for axis, value in zip("xyz", driver.position, strict=True):
            coordinate = builder.coordinates.add(TRANSLATION, reference, marker, AXES[axis])
            function = _function(builder, f"drivers.{driver.name}.position.{AXES[axis]}", value)
            _add_row(
                builder, rows, driver, (axis, f"along {axis} of {driver.relative_to or 'ground'}"), coordinate, function
            )
    if driver.orientation is not None:
        axes, functions = driver.orientation.turns
        place = f"drivers.{driver.name}.orientation"
        first, *_ = [_function(builder, place, each) for each in functions]
        nothing, turn = _function(builder, place, 0.0), nivel.kernels.bodies.driven_turn
        for axis, kind in zip("xyz", (turn.TURN_X, turn.TURN_Y, turn.TURN_Z), strict=True):
            coordinate = builder.coordinates.on_target(kind, reference, marker, (first, axes))
            _add_row(builder, rows, driver, (f"about_{axis}", f"about {axis} of {driver.marker}"), coordinate, nothing)


def _function(builder: SystemBuilder, place: str, value: TimeFunction) -> int:
    with located(place):
        return builder.function(value, motion=True)


def _add_row(
    builder: SystemBuilder, rows: RowTable, driver: Driver, motion: tuple[str, str], coordinate: int, function: int
) -> None:
    """One of the rows of a pose. motion : its name, and what it is in words."""
    name, words = motion
    turns = name.startswith("about")
    row = rows.row(driver.name, name, "1" if turns else "m")
    output = builder.outputs.add(
        (f"driver.{driver.name}.{name}.effort", "N m" if turns else "N", f"effort of {driver.name} {words}"),
        (f"driver.{driver.name}.{name}.power", "W", f"power of {driver.name} {words} into the machine"),
    )
    rows.combine(builder, row, [(coordinate, 1.0)], offset=0.0, function=function, report=(output, 1))
