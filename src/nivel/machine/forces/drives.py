"""Electric drives on a joint coordinate: DC motor and servo motor, with gear, rotor, limits and losses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import (
    CoordinateDamping,
    CoordinateStiffness,
    NotNegative,
    OfCoordinate,
    Torques,
    TorsionalDamping,
)
from nivel.machine.core.element import OUTPUTS, ForceElement
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber, OneRecord
from nivel.machine.laws.coordinate_function import CoordinateEffortFunction
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import AngularVelocity, Quantity, listed
from nivel.machine.uses.coordinate_reference import CoordinateReference

Gear = Annotated[OneNumber, OfCoordinate(("turning per length", "number"), "positive")]
Resistance = Annotated[OneNumber, Quantity("resistance"), NotNegative]
Inductance = Annotated[OneNumber, Quantity("inductance"), NotNegative]
TorqueConstant = Annotated[OneNumber, Quantity("torque per current", positive=True)]
RotorInertia = Annotated[OneNumber, Quantity("inertia"), NotNegative]
NotNegativeTorque = Annotated[OneNumber, Quantity("torque"), NotNegative]
PositiveTorque = Annotated[OneNumber, Quantity("torque", positive=True)]
Voltage = Annotated[OneFunction, varying("voltage")]
PositiveVoltage = Annotated[OneNumber, Quantity("voltage", positive=True)]
PositiveCurrent = Annotated[OneNumber, Quantity("current", positive=True)]
PositiveTurning = Annotated[OneNumber, Quantity("angular velocity", positive=True)]
NotNegativeTime = Annotated[OneNumber, Quantity("time"), NotNegative]
Speeds = Annotated[ManyNumbers[AngularVelocity], BeforeValidator(listed)]


class TorqueSpeed(Checked):
    """The greatest torque of a motor over the magnitude of its speed; beyond the table its end values hold."""

    speeds: Speeds = Field(description="of the motor's shaft, from 0 on, increasing")
    torques: Torques = Field(description="greatest torque there, not negative")

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

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "speed", "torque", "current", "voltage", "electrical_power", "loss")

    coordinate: CoordinateReference
    gear: Gear = Field(default=1.0, description="turns of the motor per turn of an angle; of a length, rad/m")
    resistance: Resistance = Field(default=0.0, description="of the winding")
    friction_torque: NotNegativeTorque = Field(default=0.0, description="dry friction at the shaft")
    transition_speed: PositiveTurning = Field(
        default=1.0, description="of the shaft, over which the dry friction changes its sign"
    )
    viscous: TorsionalDamping = Field(default=0.0, description="friction per speed of the shaft")
    rotor_inertia: RotorInertia = Field(
        default=0.0, description="of what turns with the shaft; needs a `gear_stiffness`"
    )
    gear_stiffness: CoordinateStiffness = Field(default=0.0, description="of the gear, at the coordinate; 0: rigid")
    gear_damping: CoordinateDamping = Field(default=0.0, description="of the gear, at the coordinate")

    def problems(self) -> Iterator[Problem]:
        if (self.rotor_inertia > 0.0) != (self.gear_stiffness > 0.0):
            missing = "gear_stiffness" if self.rotor_inertia else "rotor_inertia"
            yield Problem((), f"`{missing}` is missing: a rotor with an inertia turns on an elastic gear")
        if self.gear_damping and not self.gear_stiffness:
            yield superfluous("gear_damping", "belongs to an elastic gear, one with `gear_stiffness`")


class DcMotor(Drive):
    """A winding at a voltage: L di/dt = u - R i - K ω, torque K i."""

    type: Literal["dc-motor"] = "dc-motor"
    voltage: Voltage = Field(description="at the winding")
    torque_constant: TorqueConstant = Field(description="K, N m/A, which is V s/rad too")
    inductance: Inductance = Field(default=0.0, description="L; zero: the current follows at once")
    voltage_limit: Maybe[PositiveVoltage] = Field(default=None, description="greatest magnitude of the voltage")
    current_limit: Maybe[PositiveCurrent] = Field(default=None, description="greatest magnitude of the current")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not self.resistance:
            yield Problem((), "`resistance` is missing: of the winding")


class ServoMotor(Drive):
    """A motor with its own current loop: its torque follows the command with a time constant, within its limits."""

    type: Literal["servo-motor"] = "servo-motor"
    effort: CoordinateEffortFunction = Field(description="command, as an effort on the coordinate, without losses")
    time_constant: NotNegativeTime = Field(default=1e-3, description="of the current loop; 0: at once")
    torque_constant: Maybe[TorqueConstant] = Field(default=None, description="N m/A, for the current and its losses")
    torque_limit: Maybe[PositiveTorque] = Field(
        default=None, description="greatest magnitude of the torque at the shaft"
    )
    torque_speed: Maybe[OneRecord[TorqueSpeed]] = Field(
        default=None, description="the same over the speed of the shaft"
    )

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.torque_limit is not None and self.torque_speed is not None:
            yield superfluous("torque_limit", "stands in `torque_speed`; give one of them")
        if self.resistance and self.torque_constant is None:
            yield Problem((), "`torque_constant` is missing: with which the resistance makes losses")
