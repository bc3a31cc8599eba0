"""End stops, motors and position servos on a joint coordinate."""

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.elements.contacts.impact import damping_of_restitution, impact
from nivel.elements.facts import Output, StateFact, add_outputs, is_angle, of_effort, of_value
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element
from nivel.kernels.algebra.analytic import maximum, real
from nivel.kernels.core.number import where
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function, evaluate_motion
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.core import coefficient
from nivel.machine.core.element import Acts, ForceElement, Inequalities
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.power_stiffness import PowerStiffness
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import CoordinateReference

ACTS = of_effort("effort on the coordinate")
VALUE = of_value("value", "coordinate")


class Stop(ForceElement):
    """A coordinate is pushed back where it passes `lower` or `upper`: effort stiffness · depth ** exponent, damped."""

    outputs: ClassVar[tuple[str, ...]] = (*ACTS, Output("depth", "m|rad", "overlap"))

    inequalities: ClassVar[Inequalities] = (
        Acts(
            ("is free of its lower end", "touches its lower end"),
            "coordinate",
            lambda own, of: own.lower - of.value(own.coordinate),
            lambda own, of: of.part("magnitude", 1.0),
            lambda own, of: -of.rate(own.coordinate),
            applies=lambda own: own.lower is not None,
        ),
        Acts(
            ("is free of its upper end", "touches its upper end"),
            "coordinate",
            lambda own, of: of.value(own.coordinate) - own.upper,
            lambda own, of: of.part("magnitude", -1.0),
            lambda own, of: of.rate(own.coordinate),
            applies=lambda own: own.upper is not None,
        ),
    )

    type: Literal["stop"] = "stop"
    coordinate: CoordinateReference
    lower: Maybe[coefficient.CoordinateValue] = Field("end of the way on the negative side", default=None)
    upper: Maybe[coefficient.CoordinateValue] = Field("end of the way on the positive side", default=None)
    exponent: coefficient.Exponent = Field("of the depth", default=1.0)
    stiffness: PowerStiffness
    restitution: coefficient.Restitution = Field("speed after the impact by the speed before it; 1 loses no energy")

    def problems(self) -> Iterator[Problem]:
        if self.lower is None and self.upper is None:
            yield Problem((), "`lower` or `upper` is missing: a stop needs one end of the way, or both")
        if self.lower is not None and self.upper is not None and self.lower >= self.upper:
            yield Problem(("upper",), f"`upper` {self.upper:g} must be greater than `lower` {self.lower:g}")


class Motor(ForceElement):
    """An effort on a joint coordinate, given or that of a controller that holds a speed; at most `limit`.

    It acts on the second body in the sense of the coordinate, and the counter-effort on the first.
    """

    outputs: ClassVar[tuple[str, ...]] = (*ACTS, *VALUE)

    type: Literal["motor"] = "motor"
    coordinate: CoordinateReference
    effort: Maybe[coefficient.CoordinateEffortFunction] = Field("force or torque", default=None)
    speed: Maybe[coefficient.CoordinateSpeed] = Field("held with the effort gain · (speed - rate)", default=None)
    gain: Maybe[coefficient.PositiveGain] = Field("effort per missing speed", default=None)
    limit: Maybe[coefficient.PositiveEffort] = Field("greatest magnitude of the effort", default=None)

    def problems(self) -> Iterator[Problem]:
        if self.effort is None and self.speed is None:
            yield Problem((), "a motor needs an `effort`, or a `speed` and a `gain`")
        if self.effort is not None and self.speed is not None:
            yield superfluous("speed", "stands in place of `effort`; give one of them")
        if self.speed is not None and self.gain is None:
            yield Problem((), "`gain` is missing: effort per missing speed")
        if self.speed is None and self.gain is not None:
            yield superfluous("gain", "belongs to a `speed`, and none is given")


class Servo(ForceElement):
    """Effort stiffness · error + damping · d(error)/dt + integral · ∫ error dt, at most `limit`, with error = target - coordinate.

    The rate of the target is known where it is a smooth function of time; else it counts as zero, and `damping` resists all motion.
    """

    outputs: ClassVar[tuple[str, ...]] = (*ACTS, *VALUE, Output("error", "m|rad", "target less coordinate"))

    type: Literal["servo"] = "servo"
    coordinate: CoordinateReference
    target: coefficient.CoordinatePosition = Field("length or angle that the coordinate shall have")
    stiffness: coefficient.CoordinateStiffness = Field("effort per error (proportional gain)")
    damping: coefficient.CoordinateDamping = Field("effort per rate of the error (derivative gain)", default=0.0)
    integral: coefficient.CoordinateIntegral = Field("effort per error and second (integral gain)", default=0.0)
    limit: Maybe[coefficient.PositiveEffort] = Field("greatest magnitude of the effort", default=None)


class StopRow(Row):
    """A stop on a COORDINATE; LOSS is x of `nivel.elements.contacts.impact`."""

    output: int
    coordinate: int
    lower: float
    upper: float
    stiffness: float
    exponent: float
    loss: float


class MotorRow(Row):
    """A motor on a COORDINATE; where the GAIN is zero, TARGET is the effort."""

    output: int
    coordinate: int
    target: int
    gain: float
    limit: float


class ServoRow(Row):
    """A servo on a COORDINATE. STATE is NONE where nothing is integrated. MOTION: whether the rate of the target is known."""

    output: int
    coordinate: int
    target: int
    state: int
    stiffness: float
    damping: float
    integral: float
    limit: float
    motion: float


@element
def stop(machine, k, index, n, t):
    """Compliant surfaces at LOWER and UPPER, see `nivel.elements.contacts.impact`."""
    record = record_at(machine)
    elements, coordinates, control, out = record.elements, record.coordinates, record.control, record.outputs.value
    memory, proposal, depth = elements.memory[k], elements.proposal[k], elements.depth[k]
    followed = record.watched.followed[0]
    q, first = index[StopRow.COORDINATE], index[StopRow.OUTPUT]
    c, rate = coordinates.value[q], coordinates.rate[q]
    depth[0], depth[1] = n[StopRow.LOWER] - c, c - n[StopRow.UPPER]
    if followed == 1:
        elements.depth_rate[k, 0], elements.depth_rate[k, 1] = -rate, rate
    stiffness, exponent, x = n[StopRow.STIFFNESS], n[StopRow.EXPONENT], n[StopRow.LOSS]
    up, stored, loss, proposal[0] = impact(depth[0], -rate, stiffness, exponent, x, memory[0], followed)
    control.stored[0] += stored
    control.power[1] += loss
    down, stored, loss, proposal[1] = impact(depth[1], rate, stiffness, exponent, x, memory[1], followed)
    control.stored[0] += stored
    control.power[1] += loss
    out[first], out[first + 1] = up - down, add_coordinate_force(machine, q, up - down)
    out[first + 2] = maximum(maximum(depth[0], depth[1]), 0.0)


@element
def drive(machine, index, n, t):
    """Effort command, or gain (command - rate), cut off at ± limit."""
    record = record_at(machine)
    coordinates, out = record.coordinates, record.outputs.value
    q, first, gain, limit = index[MotorRow.COORDINATE], index[MotorRow.OUTPUT], n[MotorRow.GAIN], n[MotorRow.LIMIT]
    effort = evaluate_function(machine, index[MotorRow.TARGET], t)
    if real(gain) > 0.0:
        effort = gain * (effort - coordinates.rate[q])
    # not min and max: these would hide an effort that is not a number
    effort = where(real(effort) > real(limit), limit, where(real(effort) < -real(limit), -limit, effort))
    power = add_coordinate_force(machine, q, effort)
    out[first], out[first + 1] = effort, power
    out[first + 2], out[first + 3] = coordinates.value[q], coordinates.rate[q]
    record.control.power[0] += power


@element
def servo(machine, index, n, t):
    """Effort of a servo. At the limit the error is integrated only where that leads back (conditional integration)."""
    record = record_at(machine)
    elements, coordinates, out = record.elements, record.coordinates, record.outputs.value
    q, x, first = index[ServoRow.COORDINATE], index[ServoRow.STATE], index[ServoRow.OUTPUT]
    rate = 0.0 * coordinates.rate[q]
    if real(n[ServoRow.MOTION]) > 0.0:
        target, rate, _ = evaluate_motion(machine, index[ServoRow.TARGET], t)
    else:
        target = evaluate_function(machine, index[ServoRow.TARGET], t)
    error = target - coordinates.value[q]
    effort = n[ServoRow.STIFFNESS] * error + n[ServoRow.DAMPING] * (rate - coordinates.rate[q])
    if x != NONE:
        effort = effort + n[ServoRow.INTEGRAL] * elements.state[x]
    wanted, limit = real(effort), real(n[ServoRow.LIMIT])
    most = n[ServoRow.LIMIT]
    effort = where(wanted > limit, most, where(wanted < -limit, -most, effort))
    if x != NONE:
        further = where(wanted > limit, real(error), where(wanted < -limit, -real(error), 0.0))
        elements.state_rate[x] += where(further > 0.0, 0.0 * error, error)
    power = add_coordinate_force(machine, q, effort)
    out[first], out[first + 1] = effort, power
    out[first + 2], out[first + 3], out[first + 4] = coordinates.value[q], coordinates.rate[q], error
    record.control.power[0] += power


def add_stop(builder: SystemBuilder, force: Stop) -> None:
    """Limit stops on a joint coordinate."""
    coordinate = builder.coordinate(force.coordinate)
    lower = -math.inf if force.lower is None else force.lower
    upper = math.inf if force.upper is None else force.upper
    output, loss = add_outputs(builder, force, is_angle(builder, coordinate)), damping_of_restitution(force.restitution)
    row = StopRow.of(force, output=output, coordinate=coordinate, lower=lower, upper=upper, loss=loss)
    builder.add(stop, row, 2, tuple(k for k, end in enumerate((lower, upper)) if math.isfinite(end)))


def add_motor(builder: SystemBuilder, force: Motor) -> None:
    """An effort on a joint coordinate."""
    coordinate = builder.coordinate(force.coordinate)
    command = force.effort if force.effort is not None else force.speed
    assert command is not None  # the record was checked
    row = MotorRow(
        output=add_outputs(builder, force, is_angle(builder, coordinate)),
        coordinate=coordinate,
        target=builder.function(command),
        gain=0.0 if force.speed is None else force.gain or 0.0,
        limit=math.inf if force.limit is None else force.limit,
    )
    builder.add(drive, row)


def add_servo(builder: SystemBuilder, force: Servo) -> None:
    """A position servo on a joint coordinate."""
    coordinate = builder.coordinate(force.coordinate)
    first, motion, state = add_outputs(builder, force, is_angle(builder, coordinate)), is_motion(force.target), NONE
    if force.integral:
        units = "rad" if is_angle(builder, coordinate) else "m"
        fact = StateFact(f"{force.name}.integral", f"{units} s", f"integrated error of {force.name}", 0.0, 0.01)
        state = builder.own_state(fact)
    limit = math.inf if force.limit is None else force.limit
    target = builder.function(force.target, motion=motion)
    ends = {"output": first, "coordinate": coordinate, "target": target, "state": state}
    row = ServoRow.of(force, **ends, limit=limit, motion=float(motion))
    builder.add(servo, row)


def is_motion(target: TimeFunction) -> bool:
    """Whether the rate of a target is known: a table of time, or a smooth expression of it."""
    if isinstance(target, Table):
        return not target.signals
    try:
        return isinstance(target, Expression) and target.derivative.derivative is not None
    except ExpressionError:
        return False


KINDS = (Kind(Stop, add_stop, (stop,)), Kind(Motor, add_motor, (drive,)), Kind(Servo, add_servo, (servo,)))
