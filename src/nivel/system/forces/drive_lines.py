"""Brakes, clutches, freewheels, shafts, belts and losses of transmissions in numbers."""

from __future__ import annotations

import math

from nivel.elements.kind import Kind
from nivel.errors import Fault, ModelError
from nivel.kernels.elements import friction
from nivel.kernels.forces.belt_drive import AT_HIGH, AT_LOW, KEPT, PULLS, PULLS_BACK
from nivel.kernels.forces.belt_drive import apply as belt_drive
from nivel.kernels.forces.shaft import apply as shaft
from nivel.kernels.record.record import NONE
from nivel.machine.forces.belt_drive import BeltDrive
from nivel.machine.forces.clutch import Brake, Clutch
from nivel.machine.forces.freewheel import Freewheel
from nivel.machine.forces.shaft import Shaft
from nivel.machine.forces.transmission_loss import TransmissionLoss
from nivel.system.builder import SystemBuilder
from nivel.system.forces.outputs import effort_and_power, force_outputs, is_angle


def _difference(builder: SystemBuilder, force: Clutch | Freewheel | Shaft) -> tuple[int, bool]:
    """The coordinate on which the element acts, and whether its first part is an angle."""
    first = builder.coordinate(force.coordinate)
    angle = is_angle(builder, first)
    if force.against is None:
        return first, angle
    second = builder.coordinate(str(force.against))
    return builder.coordinates.combined(((first, 1.0), (second, -force.ratio))), angle


def _units(angle: bool) -> str:
    return "rad" if angle else "m"


def add_brake(builder: SystemBuilder, force: Brake | Clutch) -> None:
    """Friction with a load that is a function."""
    if isinstance(force, Clutch):
        coordinate, angle = _difference(builder, force)
    else:
        coordinate = builder.coordinate(force.coordinate)
        angle = is_angle(builder, coordinate)
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort on the coordinate"),
        ("capacity", "N m" if angle else "N", "effort with which it slips"),
        ("slip", f"{_units(angle)}/s", "rate of slip"),
    )
    capacity = builder.function(force.capacity)
    index = [coordinate, friction.STICTION, NONE, int(angle), NONE, first, NONE, NONE, NONE, NONE, capacity, NONE, NONE]
    numbers = [1.0, force.static_ratio, force.stribeck_rate, 1.0, *[0.0] * 3, 1.0]
    builder.add_friction(force.name, index, numbers)


def add_freewheel(builder: SystemBuilder, force: Freewheel) -> None:
    """Friction one way without a limit, or a spring that is not strained the other way."""
    coordinate, angle = _difference(builder, force)
    capacity = friction.UNLIMITED if force.capacity is None else force.capacity
    rate = ("slip", f"{_units(angle)}/s", "rate at which it runs ahead")
    efforts = effort_and_power(angle, "effort on the coordinate")
    if force.stiffness is None:
        first = force_outputs(builder, force.name, *efforts, rate)
        index = [coordinate, friction.STICTION, NONE, int(angle), NONE, first, *[NONE] * 6, friction.ONE_WAY]
        builder.add_friction(force.name, index, [1.0, 1.0, 0.0, 1.0, *[0.0] * 3, 1.0, *[0.0] * 3, capacity])
        return
    way = ("run", _units(angle), "way that it ran ahead")
    first = force_outputs(builder, force.name, *efforts, rate, way)
    low = -math.inf if force.capacity is None else -force.capacity / force.stiffness
    watched = (AT_HIGH,) if force.capacity is None else (AT_HIGH, AT_LOW)
    numbers = [force.stiffness, force.damping, 0.0, low, 0.0]
    builder.elements.add(belt_drive, [first, coordinate, 0], numbers, KEPT, watched)


def add_shaft(builder: SystemBuilder, force: Shaft) -> None:
    """A spring and damper, with two flanks where there is play."""
    coordinate, angle = _difference(builder, force)
    units = _units(angle)
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort that resists"),
        ("twist", units, "twist"),
        ("rate", f"{units}/s", "rate of the twist"),
    )
    numbers = [force.stiffness, force.damping, force.free_value, 0.5 * force.backlash]
    flanks = (2, (0, 1)) if force.backlash else (0, ())
    builder.elements.add(shaft, [first, coordinate], numbers, *flanks)


def add_belt_drive(builder: SystemBuilder, force: BeltDrive) -> None:
    """Two strands, and a slip where the pulleys are not toothed."""
    ends = [builder.coordinate(reference, "angle") for reference in (force.coordinate, force.against)]
    one, two = force.radii
    coordinate = builder.coordinates.combined(((ends[0], one), (ends[1], two if force.crossed else -two)))
    first = force_outputs(
        builder,
        force.name,
        ("magnitude", "N", "pull on the rims"),
        ("power", "W", "power into the machine"),
        ("slip_rate", "m/s", "speed of the slip"),
        ("slip", "m", "slip"),
        ("first_tension", "N", "tension of the strand that the first pulley pulls as it turns up"),
        ("second_tension", "N", "tension of the other strand"),
    )
    end, watched = math.inf, (PULLS, PULLS_BACK)
    if force.friction is not None:
        m = math.exp(force.friction * force.wrap)
        end = force.pretension * (m - 1.0) / (m + 1.0) / force.stiffness
        watched = AT_HIGH, AT_LOW
    pretension = force.pretension - force.stiffness * force.slack
    numbers = [force.stiffness, force.damping, pretension, -end, end]
    builder.elements.add(belt_drive, [first, coordinate, 1], numbers, KEPT, watched)


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
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort on the coordinate"),
        ("transmitted", "N m" if angle else "N", "effort that the coordinate gives to the rest"),
    )
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


KINDS = (
    Kind(Brake, add_brake, ()),
    Kind(Clutch, add_brake, ()),
    Kind(Freewheel, add_freewheel, (belt_drive,)),
    Kind(Shaft, add_shaft, (shaft,)),
    Kind(BeltDrive, add_belt_drive, (belt_drive,)),
    Kind(TransmissionLoss, add_transmission_loss, ()),
)
