"""Electric drives in numbers."""

from __future__ import annotations

import math

from nivel.elements.kind import Kind
from nivel.elements.states import StateFact
from nivel.kernels.forces.drive import apply as drive
from nivel.kernels.record.function import NUMBER
from nivel.kernels.record.record import NONE
from nivel.machine.forces.drives import DcMotor, Drive, ServoMotor
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.units.linear_function import linear
from nivel.machine.uses.coordinate_reference import resolve
from nivel.system.builder import SystemBuilder
from nivel.system.forces.outputs import effort_and_power, force_outputs, is_angle
from nivel.system.laws.functions import Signal

WINDING, CURRENT_LOOP = 0.0, 1.0  # kinds


def add_dc_motor(builder: SystemBuilder, force: DcMotor) -> None:
    """A winding at a voltage."""
    limit = math.inf if force.current_limit is None else force.current_limit
    voltage = math.inf if force.voltage_limit is None else force.voltage_limit
    state = NONE
    if force.inductance:
        scale = force.current_limit or (force.voltage_limit or 1.0) / force.resistance
        state = builder.own_state(StateFact(f"{force.name}.winding", "A", f"current of {force.name}", 0.0, scale))
    _add(builder, force, force.voltage, WINDING, state, NONE, force.torque_constant, [force.inductance, limit, voltage])


def add_servo_motor(builder: SystemBuilder, force: ServoMotor) -> None:
    """A motor with its own current loop."""
    limit, curve, state = force.torque_limit or math.inf, NONE, NONE
    if force.torque_speed is not None:
        limit = max(force.torque_speed.torques)
        table = Table(force.torque_speed.speeds, force.torque_speed.torques, of="shaft.speed")
        curve = builder.functions.add(table, _number)
    if force.time_constant:
        scale = limit if math.isfinite(limit) else 1.0
        state = builder.own_state(StateFact(f"{force.name}.loop", "N m", f"torque of {force.name}", 0.0, scale))
    constant = 1.0 if force.torque_constant is None else force.torque_constant
    _add(builder, force, force.effort, CURRENT_LOOP, state, curve, constant, [force.time_constant, limit, math.inf])


def _number(_: str) -> Signal:
    """The argument of a table that is looked up by hand."""
    return NUMBER, 0, 0


def _add(
    builder: SystemBuilder,
    force: Drive,
    command: TimeFunction,
    kind: float,
    state: int,
    curve: int,
    constant: float,
    limits: list[float],
) -> None:
    coordinate = builder.coordinate(force.coordinate)
    angle = is_angle(builder, coordinate)
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort on the coordinate"),
        ("speed", "rad/s", "speed of the shaft"),
        ("torque", "N m", "torque of the motor"),
        ("current", "A", "current"),
        ("voltage", "V", "voltage"),
        ("electrical_power", "W", "electrical power taken"),
        ("loss", "W", "power lost"),
    )
    twist, speed = _rotor(builder, force, angle) if force.gear_stiffness else (NONE, NONE)
    numbers = [kind, force.gear, force.resistance, constant, *limits, force.friction_torque, force.transition_speed]
    numbers += [force.viscous, force.rotor_inertia, force.gear_stiffness, force.gear_damping]
    builder.elements.add(drive, [first, coordinate, builder.function(command), state, twist, speed, curve], numbers)


def _rotor(builder: SystemBuilder, force: Drive, angle: bool) -> tuple[int, int]:
    """States of an elastic gear: its twist, and the speed of the shaft, which begins with that of the coordinate."""
    units = "rad" if angle else "m"
    twist = builder.own_state(StateFact(f"{force.name}.twist", units, f"twist of the gear of {force.name}", 0.0, 1e-3))
    speed = builder.own_state(
        StateFact(f"{force.name}.rotor", "rad/s", f"speed of the shaft of {force.name}", 0.0, 1.0)
    )
    rate = ".".join(resolve(force.coordinate, builder.machine.joints)) + "_rate"
    builder.begins.append((speed, linear((force.gear, rate))))
    return twist, speed


KINDS = (
    Kind(DcMotor, add_dc_motor, (drive,)),
    Kind(ServoMotor, add_servo_motor, (drive,)),
)
