"""Brakes and clutches: dry friction whose greatest effort is a function, as of a pressure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import NotNegativeRate, PositiveNumber
from nivel.machine.core.element import OUTPUTS, ForceElement, Holds, Inequalities
from nivel.machine.forces.drive_line import DriveLine
from nivel.machine.given import Field
from nivel.machine.laws.coordinate_function import CoordinateEffortFunction
from nivel.machine.uses.coordinate_reference import CoordinateReference

CAPACITY = "force or torque with which it slips, a function; below zero it is open"
STATIC_RATIO = "of the effort that it holds at rest to that with which it slips"
STRIBECK_RATE = "slip at which the one has mostly become the other; 0: as soon as it slips"

LOCKS: Inequalities = (
    Holds(
        "slip",
        lambda own, of: of["magnitude"],
        lambda own, of: own.static_ratio * of["capacity"],
        lambda own, of: of["capacity"],
        lambda own, of: of["slip"],
    ),
)


class Brake(ForceElement):
    """Friction between the bodies of a joint, which really holds where less than its capacity is wanted."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "capacity", "slip")
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = LOCKS

    type: Literal["brake"] = "brake"
    coordinate: CoordinateReference
    capacity: CoordinateEffortFunction = Field(description=CAPACITY)
    static_ratio: PositiveNumber = Field(default=1.0, description=STATIC_RATIO)
    stribeck_rate: NotNegativeRate = Field(default=0.0, description=STRIBECK_RATE)

    def problems(self) -> Iterator[Problem]:
        yield from problems_of_capacity(self.capacity)
        yield from problems_of_ratio(self.static_ratio)


class Clutch(DriveLine):
    """Friction between two joint coordinates, which really locks where less than its capacity is wanted."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "capacity", "slip")
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = LOCKS

    type: Literal["clutch"] = "clutch"
    capacity: CoordinateEffortFunction = Field(description=CAPACITY)
    static_ratio: PositiveNumber = Field(default=1.0, description=STATIC_RATIO)
    stribeck_rate: NotNegativeRate = Field(default=0.0, description=STRIBECK_RATE)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problems_of_capacity(self.capacity)
        yield from problems_of_ratio(self.static_ratio)


def problems_of_capacity(capacity: object) -> Iterator[Problem]:
    """What is wrong with a capacity that never changes."""
    if isinstance(capacity, int | float) and capacity < 0.0:
        yield Problem(
            ("capacity",), f"`capacity` {capacity:g} is below zero, so it never holds; zero or more was expected"
        )


def problems_of_ratio(static_ratio: float) -> Iterator[Problem]:
    """What is wrong with the ratio of static to kinetic friction."""
    if static_ratio < 1.0:
        message = (
            f"`static_ratio` {static_ratio:g} is smaller than one; static friction is at least as strong as kinetic"
        )
        yield Problem(("static_ratio",), message)
