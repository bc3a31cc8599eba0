"""Rows of drivers: one of a joint coordinate or of a motion of a marker, up to six of a marker's whole pose."""

from __future__ import annotations

import numpy as np

from nivel.errors import located
from nivel.kernels.bodies.coordinate import ROTATION, TRANSLATION
from nivel.kernels.bodies.driven_turn import TURN_X, TURN_Y, TURN_Z
from nivel.machine.joints.driver import Driver
from nivel.machine.laws.time_function import TimeFunction
from nivel.system.builder import SystemBuilder
from nivel.system.joints.composition import AXES
from nivel.system.joints.interfaces import marker_place
from nivel.system.joints.rows import RowTable, units_of
from nivel.system.laws.integrated import integrated
from nivel.system.tables import Target

# of the three coordinates of a turn, in the order of the axes
TURNS = (TURN_X, TURN_Y, TURN_Z)


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
    units = units_of(builder, coordinate)
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
    end = builder.machine.simulation.duration
    if driver.value is not None:
        with located(f"drivers.{driver.name}.value"):
            return builder.function(driver.value, motion=True)
    if driver.speed is not None:
        with located(f"drivers.{driver.name}.speed"):
            return builder.functions.add_way(*integrated(driver.speed, 1, end))
    assert driver.acceleration is not None  # the record was checked
    with located(f"drivers.{driver.name}.acceleration"):
        return builder.functions.add_way(*integrated(driver.acceleration, 2, end, driver.start_speed))


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
        body, point, axes = marker_place(builder.machine, builder.machine.marker_named[name])
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
        nothing = _function(builder, place, 0.0)
        for axis, kind in zip("xyz", TURNS, strict=True):
            coordinate = builder.coordinates.on_target(kind, reference, marker, Target(first, axes))
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
