"""Electric drives on a joint coordinate: windings or current loops, shafts with friction, gears that are rigid or elastic.

Energy: electrical power u i goes in; R i², friction and the damping of the gear are lost; ½ L i², ½ J ω² and ½ k δ² are stored.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import Output, StateFact, add_outputs, is_angle, of_effort
from nivel.elements.forces.shafts import with_play
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element
from nivel.kernels.algebra.analytic import absolute, real, tanh
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import NUMBER, evaluate_function, table_value
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.core import coefficient
from nivel.machine.core.element import ForceElement
from nivel.machine.core.record import Checked, Problem, superfluous
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber, OneRecord
from nivel.machine.laws.time_function import OneFunction, TimeFunction, varying
from nivel.machine.laws.varying_value import Table
from nivel.machine.units.formula import linear
from nivel.machine.units.quantity import AngularVelocity, Quantity, listed
from nivel.machine.uses.coordinate_reference import CoordinateReference, resolve
from nivel.native.function import stage

Gear = Annotated[OneNumber, coefficient.OfCoordinate(("turning per length", "number"), "positive")]
Resistance = Annotated[OneNumber, Quantity("resistance"), coefficient.NotNegative]
Inductance = Annotated[OneNumber, Quantity("inductance"), coefficient.NotNegative]
TorqueConstant = Annotated[OneNumber, Quantity("torque per current", positive=True)]
RotorInertia = Annotated[OneNumber, Quantity("inertia"), coefficient.NotNegative]
NotNegativeTorque = Annotated[OneNumber, Quantity("torque"), coefficient.NotNegative]
PositiveTorque = Annotated[OneNumber, Quantity("torque", positive=True)]
Voltage = Annotated[OneFunction, varying("voltage")]
PositiveVoltage = Annotated[OneNumber, Quantity("voltage", positive=True)]
PositiveCurrent = Annotated[OneNumber, Quantity("current", positive=True)]
PositiveTurning = Annotated[OneNumber, Quantity("angular velocity", positive=True)]
NotNegativeTime = Annotated[OneNumber, Quantity("time"), coefficient.NotNegative]
Speeds = Annotated[ManyNumbers[AngularVelocity], BeforeValidator(listed)]


class TorqueSpeed(Checked):
    """The greatest torque of a motor over the magnitude of its speed; beyond the table its end values hold."""

    speeds: Speeds = Field("of the motor's shaft, from 0 on, increasing")
    torques: coefficient.Torques = Field("greatest torque there, not negative")

    def problems(self) -> Iterator[Problem]:
        if len(self.speeds) != len(self.torques) or len(self.speeds) < 2:
            counts = f"got {len(self.speeds)} and {len(self.torques)}"
            yield Problem(("torques",), f"a limit needs as many torques as speeds, two or more; {counts}")
            return
        if self.speeds[0] != 0.0 or any(b <= a for a, b in zip(self.speeds, self.speeds[1:], strict=False)):
            yield Problem(("speeds",), "speeds begin with 0 and increase")
        if min(self.torques) < 0.0:
            yield Problem(("torques",), f"a torque of zero or more was expected, got {min(self.torques):g}")


class Drive(ForceElement):
    """A motor that turns `gear` times as fast as its coordinate, whose losses are friction at its shaft."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_effort("effort on the coordinate"),
        Output("speed", "rad/s", "speed of the shaft"),
        Output("torque", "N m", "torque of the motor"),
        Output("current", "A"),
        Output("voltage", "V"),
        Output("electrical_power", "W", "electrical power taken"),
        Output("loss", "W", "power lost"),
    )

    coordinate: CoordinateReference
    gear: Gear = Field("turns of the motor per turn of an angle; of a length, rad/m", default=1.0)
    resistance: Resistance = Field("of the winding", default=0.0)
    friction_torque: NotNegativeTorque = Field("dry friction at the shaft", default=0.0)
    transition_speed: PositiveTurning = Field("of the shaft, over which the dry friction changes its sign", default=1.0)
    viscous: coefficient.TorsionalDamping = Field("friction per speed of the shaft", default=0.0)
    rotor_inertia: RotorInertia = Field("of what turns with the shaft; needs a `gear_stiffness`", default=0.0)
    gear_stiffness: coefficient.CoordinateStiffness = Field("of the gear, at the coordinate; 0: rigid", default=0.0)
    gear_damping: coefficient.CoordinateDamping = Field("of the gear, at the coordinate", default=0.0)
    backlash: coefficient.NotNegativeValue = Field(
        "play of an elastic gear, at the coordinate, from flank to flank", default=0.0
    )

    def problems(self) -> Iterator[Problem]:
        if (self.rotor_inertia > 0.0) != (self.gear_stiffness > 0.0):
            missing = "gear_stiffness" if self.rotor_inertia else "rotor_inertia"
            yield Problem((), f"`{missing}` is missing: a rotor with an inertia turns on an elastic gear")
        for key in ("gear_damping", "backlash"):
            if getattr(self, key) and not self.gear_stiffness:
                yield superfluous(key, "belongs to an elastic gear, one with `gear_stiffness`")


class DcMotor(Drive):
    """A winding at a voltage: L di/dt = u - R i - K ω, torque K i."""

    type: Literal["dc-motor"] = "dc-motor"
    voltage: Voltage = Field("at the winding")
    torque_constant: TorqueConstant = Field("K, N m/A, which is V s/rad too")
    inductance: Inductance = Field("L; zero: the current follows at once", default=0.0)
    voltage_limit: Maybe[PositiveVoltage] = Field("greatest magnitude of the voltage", default=None)
    current_limit: Maybe[PositiveCurrent] = Field("greatest magnitude of the current", default=None)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not self.resistance:
            yield Problem((), "`resistance` is missing: of the winding")


class ServoMotor(Drive):
    """A motor with its own current loop: its torque follows the command with a time constant, within its limits."""

    type: Literal["servo-motor"] = "servo-motor"
    effort: coefficient.CoordinateEffortFunction = Field("command, as an effort on the coordinate, without losses")
    time_constant: NotNegativeTime = Field("of the current loop; 0: at once", default=1e-3)
    torque_constant: Maybe[TorqueConstant] = Field("N m/A, for the current and its losses", default=None)
    torque_limit: Maybe[PositiveTorque] = Field("greatest magnitude of the torque at the shaft", default=None)
    torque_speed: Maybe[OneRecord[TorqueSpeed]] = Field("the same over the speed of the shaft", default=None)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.torque_limit is not None and self.torque_speed is not None:
            yield superfluous("torque_limit", "stands in `torque_speed`; give one of them")
        if self.resistance and self.torque_constant is None:
            yield Problem((), "`torque_constant` is missing: with which the resistance makes losses")


WINDING, CURRENT_LOOP = 0.0, 1.0


class DriveRow(Row):
    """A drive. STATE : of the current or the torque, TWIST and SPEED : of an elastic gear, CURVE : the greatest torque over the speed, each
    NONE where there is none. KIND : WINDING or CURRENT_LOOP. LAG : L or the time constant. PLAY : half the backlash."""

    output: int
    coordinate: int
    command: int
    state: int
    twist: int
    speed: int
    curve: int
    kind: float
    gear: float
    resistance: float
    constant: float
    lag: float
    limit: float
    voltage_limit: float
    friction_torque: float
    transition_speed: float
    viscous: float
    rotor_inertia: float
    gear_stiffness: float
    gear_damping: float
    play: float


@stage
def clipped(x, limit):
    """x between ± limit; what is no number stays none."""
    if real(x) > real(limit):
        return limit + 0.0 * x
    if real(x) < -real(limit):
        return -limit + 0.0 * x
    return x


@stage
def winding(machine, index, n, command, omega):
    """(current, voltage, power of the magnetic field) of a winding at a voltage."""
    elements = record_at(machine).elements
    u, limit = clipped(command, n[DriveRow.VOLTAGE_LIMIT]), n[DriveRow.LIMIT]
    if index[DriveRow.STATE] == NONE:
        i = clipped((u - n[DriveRow.CONSTANT] * omega) / n[DriveRow.RESISTANCE], limit)
        return i, n[DriveRow.RESISTANCE] * i + n[DriveRow.CONSTANT] * omega
    # a step may leave the state beyond the limit, at which the current stays until the state comes back
    x = elements.state[index[DriveRow.STATE]]
    i = clipped(x, limit)
    rate = (u - n[DriveRow.RESISTANCE] * i - n[DriveRow.CONSTANT] * omega) / n[DriveRow.LAG]
    if (real(x) >= real(limit) and real(rate) > 0.0) or (real(x) <= -real(limit) and real(rate) < 0.0):
        rate = 0.0 * rate
    elements.state_rate[index[DriveRow.STATE]] += rate
    record_at(machine).control.stored[0] += 0.5 * n[DriveRow.LAG] * i * i
    if np.abs(real(x)) > real(limit):
        rate = 0.0 * rate
    return i, n[DriveRow.RESISTANCE] * i + n[DriveRow.CONSTANT] * omega + n[DriveRow.LAG] * rate


@stage
def current_loop(machine, index, n, command, omega):
    """(current, voltage) of a motor whose torque follows command / gear within its limits; without a torque constant, as if that were 1."""
    record = record_at(machine)
    elements, limit = record.elements, n[DriveRow.LIMIT]
    if index[DriveRow.CURVE] != NONE:
        limit, _, _ = table_value(record.functions, index[DriveRow.CURVE], absolute(omega))
    torque = clipped(command / n[DriveRow.GEAR], limit)
    if index[DriveRow.STATE] != NONE:
        wanted, torque = torque, elements.state[index[DriveRow.STATE]]
        elements.state_rate[index[DriveRow.STATE]] += (wanted - torque) / n[DriveRow.LAG]
    i = torque / n[DriveRow.CONSTANT]
    return i, n[DriveRow.RESISTANCE] * i + n[DriveRow.CONSTANT] * omega


@stage
def shaft_speed(machine, index, n):
    """Speed of the shaft: that of its rotor, or of the coordinate through the gear."""
    record = record_at(machine)
    if index[DriveRow.SPEED] != NONE:
        return record.elements.state[index[DriveRow.SPEED]]
    return n[DriveRow.GEAR] * record.coordinates.rate[index[DriveRow.COORDINATE]]


@stage
def transmit(machine, k, torque, omega):
    """(effort on the coordinate, loss in the gear) of what the shaft gives to the gear."""
    record = record_at(machine)
    elements, followed = record.elements, record.watched.followed[0]
    n, index = elements.number[k], elements.columns[k]
    if index[DriveRow.TWIST] == NONE:
        return n[DriveRow.GEAR] * torque, 0.0 * torque
    twist = elements.state[index[DriveRow.TWIST]]
    rate = omega / n[DriveRow.GEAR] - record.coordinates.rate[index[DriveRow.COORDINATE]]
    stiffness, damping, play = n[DriveRow.GEAR_STIFFNESS], n[DriveRow.GEAR_DAMPING], n[DriveRow.PLAY]
    effort, elastic, stored = with_play(elements, k, twist, rate, stiffness, damping, play, followed)
    elements.state_rate[index[DriveRow.TWIST]] += rate
    elements.state_rate[index[DriveRow.SPEED]] += (torque - effort / n[DriveRow.GEAR]) / n[DriveRow.ROTOR_INERTIA]
    record.control.stored[0] += 0.5 * n[DriveRow.ROTOR_INERTIA] * omega * omega + stored
    return effort, (effort - elastic) * rate


@element
def drive(machine, k, index, n, t):
    """Current, torque and effort of a drive."""
    record = record_at(machine)
    control, out, first = record.control, record.outputs.value, np.int64(index[DriveRow.OUTPUT])
    omega, command = shaft_speed(machine, index, n), evaluate_function(machine, index[DriveRow.COMMAND], t)
    if real(n[DriveRow.KIND]) == WINDING:
        i, u = winding(machine, index, n, command, omega)
    else:
        i, u = current_loop(machine, index, n, command, omega)
    torque = n[DriveRow.CONSTANT] * i
    rubbing = n[DriveRow.FRICTION_TORQUE] * tanh(omega / n[DriveRow.TRANSITION_SPEED]) + n[DriveRow.VISCOUS] * omega
    effort, lost = transmit(machine, k, torque - rubbing, omega)
    loss = n[DriveRow.RESISTANCE] * i * i + rubbing * omega + lost
    control.power[0] += u * i
    control.power[1] += loss
    out[first], out[first + 1] = effort, add_coordinate_force(machine, index[DriveRow.COORDINATE], effort)
    out[first + 2], out[first + 3], out[first + 4], out[first + 5] = omega, torque, i, u
    out[first + 6], out[first + 7] = u * i, loss


def add_dc_motor(builder: SystemBuilder, force: DcMotor) -> None:
    """A winding at a voltage."""
    limit = math.inf if force.current_limit is None else force.current_limit
    voltage = math.inf if force.voltage_limit is None else force.voltage_limit
    state = NONE
    if force.inductance:
        scale = force.current_limit or (force.voltage_limit or 1.0) / force.resistance
        state = builder.own_state(StateFact(f"{force.name}.winding", "A", f"current of {force.name}", 0.0, scale))
    lags = {"state": state, "curve": NONE, "lag": force.inductance, "limit": limit, "voltage_limit": voltage}
    add_row(builder, force, force.voltage, drive, kind=WINDING, constant=force.torque_constant, **lags)


def add_servo_motor(builder: SystemBuilder, force: ServoMotor) -> None:
    """A motor with its own current loop."""
    limit, curve, state = force.torque_limit or math.inf, NONE, NONE
    if force.torque_speed is not None:
        limit = max(force.torque_speed.torques)
        table = Table(force.torque_speed.speeds, force.torque_speed.torques, of="shaft.speed")
        curve = builder.functions.add(table, no_argument)
    if force.time_constant:
        scale = limit if math.isfinite(limit) else 1.0
        state = builder.own_state(StateFact(f"{force.name}.loop", "N m", f"torque of {force.name}", 0.0, scale))
    constant = 1.0 if force.torque_constant is None else force.torque_constant
    lags = {"state": state, "curve": curve, "lag": force.time_constant, "limit": limit, "voltage_limit": math.inf}
    add_row(builder, force, force.effort, drive, kind=CURRENT_LOOP, constant=constant, **lags)


def no_argument(_: str) -> tuple[int, int, int]:
    """The argument of a table that is looked up by hand."""
    return NUMBER, 0, 0


def add_row(
    builder: SystemBuilder,
    force: Drive,
    command: TimeFunction,
    kernel: Family,
    more: tuple[Sequence[int], Sequence[float]] = ((), ()),
    **own: Any,
) -> None:
    """The row of a drive for its kernel; own : what its kind says; more : columns and numbers that only this kernel reads."""
    coordinate = builder.coordinate(force.coordinate)
    angle = is_angle(builder, coordinate)
    first = add_outputs(builder, force, angle)
    twist, speed = _rotor(builder, force, angle) if force.gear_stiffness else (NONE, NONE)
    ends = {"output": first, "coordinate": coordinate, "command": builder.function(command)}
    row = DriveRow.of(force, **ends, twist=twist, speed=speed, play=0.5 * force.backlash, **own)
    row.columns.extend(more[0])
    row.numbers.extend(more[1])
    builder.add(kernel, row, *((2, (0, 1)) if force.backlash else (0, ())))


def _rotor(builder: SystemBuilder, force: Drive, angle: bool) -> tuple[int, int]:
    """States of an elastic gear: its twist, and the speed of the shaft, which begins with that of the coordinate."""
    units = "rad" if angle else "m"
    twist = builder.own_state(StateFact(f"{force.name}.twist", units, f"twist of the gear of {force.name}", 0.0, 1e-3))
    speed = builder.own_state(
        StateFact(f"{force.name}.rotor", "rad/s", f"speed of the shaft of {force.name}", 0.0, 1.0)
    )
    rate = ".".join(resolve(force.coordinate, builder.machine.joints)) + "_rate"
    builder.samples.append((speed, linear((force.gear, rate)), None, 0.0))
    return twist, speed


KINDS = (Kind(DcMotor, add_dc_motor, (drive,)), Kind(ServoMotor, add_servo_motor, (drive,)))
