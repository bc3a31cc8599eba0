"""Stops, motors and servos on joint coordinates in numbers."""

from __future__ import annotations

import math

from nivel.kernels.forces.motor import apply as motor
from nivel.kernels.forces.servo import apply as servo
from nivel.kernels.forces.stop import apply as stop
from nivel.kernels.record.record import NONE
from nivel.machine.forces import Motor, Servo, Stop
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.units.expression import Expression
from nivel.machine.units.tree import ExpressionError
from nivel.system.builder import SystemBuilder
from nivel.system.forces.kind import ForceKind
from nivel.system.forces.outputs import effort_and_power, force_outputs, is_angle
from nivel.system.forces.restitution import damping_of_restitution
from nivel.system.signals.state_facts import StateFact


def add_stop(builder: SystemBuilder, force: Stop) -> None:
    """Limit stops on a joint coordinate."""
    coordinate = builder.coordinate(force.coordinate)
    angle = is_angle(builder, coordinate)
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort on the coordinate"),
        ("depth", "rad" if angle else "m", "overlap"),
    )
    lower = -math.inf if force.lower is None else force.lower
    upper = math.inf if force.upper is None else force.upper
    numbers = [lower, upper, force.stiffness, force.exponent, damping_of_restitution(force.restitution)]
    builder.elements.add(stop, [first, coordinate], numbers, 2, tuple(k for k in range(2) if math.isfinite(numbers[k])))


def add_motor(builder: SystemBuilder, force: Motor) -> None:
    """An effort on a joint coordinate."""
    coordinate = builder.coordinate(force.coordinate)
    angle = is_angle(builder, coordinate)
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort on the coordinate"),
        ("value", "rad" if angle else "m", "coordinate"),
        ("rate", "rad/s" if angle else "m/s", "rate of the coordinate"),
    )
    command = force.effort if force.effort is not None else force.speed
    assert command is not None  # the record was checked
    limit = math.inf if force.limit is None else force.limit
    numbers = [0.0 if force.speed is None else force.gain or 0.0, limit]
    builder.elements.add(motor, [first, coordinate, builder.function(command)], numbers)


def add_servo(builder: SystemBuilder, force: Servo) -> None:
    """A position servo on a joint coordinate."""
    coordinate = builder.coordinate(force.coordinate)
    angle = is_angle(builder, coordinate)
    units = "rad" if angle else "m"
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort on the coordinate"),
        ("value", units, "coordinate"),
        ("rate", f"{units}/s", "rate of the coordinate"),
        ("error", units, "target less coordinate"),
    )
    motion = is_motion(force.target)
    state = NONE
    if force.integral:
        fact = StateFact(f"{force.name}.integral", f"{units} s", f"integrated error of {force.name}", 0.0, 0.01)
        state = builder.own_state(fact)
    limit = math.inf if force.limit is None else force.limit
    numbers = [force.stiffness, force.damping, force.integral, limit, float(motion)]
    builder.elements.add(servo, [first, coordinate, builder.function(force.target, motion=motion), state], numbers)


def is_motion(target: TimeFunction) -> bool:
    """Whether the rate of a target is known: a table of time, or a smooth expression of it."""
    if isinstance(target, Table):
        return not target.signals
    try:
        return isinstance(target, Expression) and target.derivative.derivative is not None
    except ExpressionError:
        return False


KINDS = (
    ForceKind(Stop, add_stop, (stop,)),
    ForceKind(Motor, add_motor, (motor,)),
    ForceKind(Servo, add_servo, (servo,)),
)
