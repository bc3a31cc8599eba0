"""Friction in drive lines: brakes, clutches, freewheels, and the losses of transmissions."""

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from nivel.elements.facts import Output, add_outputs, is_angle, of_effort
from nivel.elements.forces.shafts import AT_HIGH, AT_LOW, KEPT, BeltRow, DriveLine, difference, pull_belt
from nivel.elements.kind import Kind
from nivel.errors import Fault, ModelError
from nivel.kernels.elements import friction
from nivel.kernels.record.record import NONE
from nivel.known import SystemBuilder
from nivel.machine.core import coefficient
from nivel.machine.core.element import Acts, ForceElement, Holds, Inequalities
from nivel.machine.core.record import Name, Problem, superfluous
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.units.quantity import Quantity
from nivel.machine.uses.coordinate_reference import CoordinateReference

CAPACITY = "force or torque with which it slips, a function; below zero it is open"
STATIC_RATIO = "of the effort that it holds at rest to that with which it slips"
STRIBECK_RATE = "slip at which the one has mostly become the other; 0: as soon as it slips"

LOCK_OUTPUTS = (
    *of_effort("effort on the coordinate"),
    Output("capacity", "N|N m", "effort with which it slips"),
    Output("slip", "m/s|rad/s", "rate of slip"),
)
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

    locks: ClassVar[bool] = True
    outputs: ClassVar[tuple[str, ...]] = LOCK_OUTPUTS
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = LOCKS

    type: Literal["brake"] = "brake"
    coordinate: CoordinateReference
    capacity: coefficient.CoordinateEffortFunction = Field(CAPACITY)
    static_ratio: coefficient.PositiveNumber = Field(STATIC_RATIO, default=1.0)
    stribeck_rate: coefficient.NotNegativeRate = Field(STRIBECK_RATE, default=0.0)

    def problems(self) -> Iterator[Problem]:
        yield from problems_of_capacity(self.capacity)
        yield from problems_of_ratio(self.static_ratio)


class Clutch(DriveLine):
    """Friction between two joint coordinates, which really locks where less than its capacity is wanted."""

    locks: ClassVar[bool] = True
    outputs: ClassVar[tuple[str, ...]] = LOCK_OUTPUTS
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = LOCKS

    type: Literal["clutch"] = "clutch"
    capacity: coefficient.CoordinateEffortFunction = Field(CAPACITY)
    static_ratio: coefficient.PositiveNumber = Field(STATIC_RATIO, default=1.0)
    stribeck_rate: coefficient.NotNegativeRate = Field(STRIBECK_RATE, default=0.0)

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


class Freewheel(DriveLine):
    """The coordinate may run faster than ratio · against, not slower: then it is taken along, rigidly or by a spring."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_effort("effort on the coordinate"),
        Output("slip", "m/s|rad/s", "rate at which it runs ahead"),
        Output("run", "m|rad", "way that it ran ahead"),  # with a stiffness
    )
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = (
        Holds(
            "slip",
            lambda own, of: of["magnitude"],
            lambda own, of: of.all(own.capacity),
            lambda own, of: of.all(own.capacity),
            lambda own, of: of["slip"],
            one_way=True,
            applies=lambda own: own.is_rigid,
        ),
        Acts(
            ("runs ahead", "takes along"),
            "run",
            lambda own, of: of["run"] - of.difference(own),
            lambda own, of: of["magnitude"],
            applies=lambda own: not own.is_rigid,
        ),
    )

    type: Literal["freewheel"] = "freewheel"
    against: Maybe[CoordinateReference] = Field(  # type: ignore[assignment]
        "coordinate that takes the first one along; without it: a backstop, it never goes backwards", default=None
    )
    capacity: Maybe[coefficient.PositiveEffort] = Field("effort beyond which it slips", default=None, absent="none")
    stiffness: Maybe[coefficient.PositiveCoordinateStiffness] = Field(
        "of what takes the coordinate along", default=None, absent="rigid"
    )
    damping: coefficient.CoordinateDamping = Field("beside the stiffness", default=0.0)

    @property
    def is_rigid(self) -> bool:
        """Whether what it takes along is held without any spring."""
        return self.stiffness is None

    @property
    def sticks(self) -> bool:
        """Whether it holds the coordinates together."""
        return self.is_rigid

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.damping and self.stiffness is None:
            yield superfluous("damping", "belongs to a `stiffness`, and none is given")


Efficiency = Annotated[OneNumber, Quantity("number")]


class TransmissionLoss(ForceElement):
    """Dry friction at the coordinate that drives a coupling or a screw joint, loaded by the effort that it gives to the rest of it."""

    locks: ClassVar[bool] = True
    outputs: ClassVar[tuple[str, ...]] = (
        *of_effort("effort on the coordinate"),
        Output("transmitted", "N|N m", "effort that the coordinate gives to the rest"),
    )
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = (
        Holds(
            "coordinate",
            lambda own, of: of["magnitude"],
            lambda own, of: max(own.shares) * abs(of["transmitted"]),
            lambda own, of: min(own.shares) * abs(of["transmitted"]),
            lambda own, of: of.rate(own.coordinate),
        ),
    )

    type: Literal["transmission-loss"] = "transmission-loss"
    coupling: Name = Field("coupling, or joint of type screw")
    coordinate: CoordinateReference = Field("that drives, one of the coupling's or the joint's")
    efficiency: coefficient.Share = Field("power out by power in, where the coordinate drives")
    backward_efficiency: Maybe[Efficiency] = Field(
        "the same where the coordinate is driven; zero or less: self-locking", default=None, absent="2 - 1/efficiency"
    )

    @property
    def shares(self) -> tuple[float, float]:
        """Effort that is lost by the effort that is transmitted, where the coordinate drives and where it is driven."""
        forward = 1.0 / self.efficiency - 1.0
        return forward, forward if self.backward_efficiency is None else 1.0 - self.backward_efficiency

    def problems(self) -> Iterator[Problem]:
        if self.backward_efficiency is not None and self.backward_efficiency > 1.0:
            yield Problem(
                ("backward_efficiency",), f"a number of 1 or less was expected, got {self.backward_efficiency:g}"
            )


def add_brake(builder: SystemBuilder, force: Brake | Clutch) -> None:
    """Friction with a load that is a function."""
    if isinstance(force, Clutch):
        coordinate, angle = difference(builder, force)
    else:
        coordinate = builder.coordinate(force.coordinate)
        angle = is_angle(builder, coordinate)
    first = add_outputs(builder, force, angle)
    capacity = builder.function(force.capacity)
    index = [coordinate, friction.STICTION, NONE, int(angle), NONE, first, NONE, NONE, NONE, NONE, capacity, NONE, NONE]
    numbers = [1.0, force.static_ratio, force.stribeck_rate, 1.0, *[0.0] * 3, 1.0]
    builder.add_friction(force.name, index, numbers)


def add_freewheel(builder: SystemBuilder, force: Freewheel) -> None:
    """Friction one way without a limit, or a spring that is not strained the other way."""
    coordinate, angle = difference(builder, force)
    capacity = friction.UNLIMITED if force.capacity is None else force.capacity
    if force.stiffness is None:
        first = add_outputs(builder, force, angle, without=("run",))
        index = [coordinate, friction.STICTION, NONE, int(angle), NONE, first, *[NONE] * 6, friction.ONE_WAY]
        builder.add_friction(force.name, index, [1.0, 1.0, 0.0, 1.0, *[0.0] * 3, 1.0, *[0.0] * 3, capacity])
        return
    low = -math.inf if force.capacity is None else -force.capacity / force.stiffness
    watched = (AT_HIGH,) if force.capacity is None else (AT_HIGH, AT_LOW)
    first = add_outputs(builder, force, angle)
    row = BeltRow.of(force, output=first, coordinate=coordinate, tensions=0, pretension=0.0, low=low, high=0.0)
    builder.add(pull_belt, row, KEPT, watched)


def add_transmission_loss(builder: SystemBuilder, force: TransmissionLoss) -> None:
    """Friction with the effort of a row of constraints as its load."""
    coordinate = builder.coordinate(force.coordinate)
    if force.coupling not in builder.transmissions:
        known = ", ".join(builder.transmissions) or "none"
        message = f"there is no coupling or screw joint `{force.coupling}`; there are {known}"
        raise ModelError(Fault("", 0, 0, f"forces.{force.name}.coupling", message))
    _refuse_another_loss(builder, force)
    row, factors = builder.transmissions[force.coupling]
    if coordinate not in factors:
        names = [name for name, index in builder.joint_coordinates.items() if index in factors]
        message = f"`{force.coordinate}` is not a linear part of `{force.coupling}`; write one of {', '.join(names)}"
        raise ModelError(Fault("", 0, 0, f"forces.{force.name}.coordinate", message))
    angle = is_angle(builder, coordinate)
    first = add_outputs(builder, force, angle)
    forward, backward = force.shares
    index = [coordinate, friction.STICTION, NONE, int(angle), NONE, first, *[NONE] * 5, row, NONE]
    numbers = [forward, forward, 0.0, 1.0, *[0.0] * 3, 1.0, *[0.0] * 5, backward, factors[coordinate]]
    builder.add_friction(force.name, index, numbers)


def _refuse_another_loss(builder: SystemBuilder, force: TransmissionLoss) -> None:
    """The effort of a coupling loads one loss: of two, each would be loaded by what the other takes away."""
    losses = [each for each in builder.machine.forces if isinstance(each, TransmissionLoss)]
    first = next(each for each in losses if each.coupling == force.coupling)
    if first is not force:
        message = (
            f"`{first.name}` is the loss of `{force.coupling}` already; leave this one out, and give `{first.name}` the efficiency of "
            f"both: `efficiency: {first.efficiency * force.efficiency:g}`"
        )
        raise ModelError(Fault("", 0, 0, f"forces.{force.name}.coupling", message))


def holds_by_capacity(force: ForceElement) -> bool:
    """Whether it is an element of a drive train that can hold coordinates at rest: a brake, a clutch, a rigid freewheel, a loss."""
    return force.locks or (isinstance(force, Freewheel) and force.is_rigid)


KINDS = (
    Kind(Brake, add_brake, ()),
    Kind(Clutch, add_brake, ()),
    Kind(Freewheel, add_freewheel, (pull_belt,)),
    Kind(TransmissionLoss, add_transmission_loss, ()),
)
