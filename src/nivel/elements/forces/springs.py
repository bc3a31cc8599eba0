"""Springs and dampers: between points, between markers, on joint coordinates, and along the global axes."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import Output, add_outputs, is_angle, of_effort, of_force, of_value
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.vectors import opposite
from nivel.kernels.bodies.coordinate import DISTANCE, ROTATION
from nivel.kernels.forces.wrench import add_coordinate_force, add_marker_force
from nivel.kernels.record import function
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.core import coefficient as of
from nivel.machine.core.coefficient import CoordinateLaw
from nivel.machine.core.element import Between, BetweenMarkers, ForceElement
from nivel.machine.core.record import Checked, Problem, superfluous
from nivel.machine.given import Field, ManyNumbers, Maybe, OneRecord, ThreeNumbers
from nivel.machine.laws.time_function import SpringForce, SpringTorque
from nivel.machine.units.quantity import Angle, Position, listed
from nivel.machine.uses.coordinate_reference import CoordinateReference

ThreeStiffnesses = Annotated[ThreeNumbers[of.Stiffness], BeforeValidator(listed)]
ThreeDampings = Annotated[ThreeNumbers[of.Damping], BeforeValidator(listed)]
ThreeForces = Annotated[ThreeNumbers[of.ForceValue], BeforeValidator(listed)]
RESISTS = of_effort("effort that resists the coordinate")
_check_columns = of.columns_of_coordinate({"deflections": of.COORDINATE, "efforts": of.COORDINATE_EFFORT})


class Characteristic(Checked):
    """Points of a spring's characteristic; `deflections` increase, beyond the ends the end slopes go on."""

    column: ClassVar[str]  # the field that holds the efforts

    deflections: ManyNumbers[Any]

    @property
    def points(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Deflections [m or rad] and efforts [N or N m]."""
        return self.deflections, getattr(self, self.column)

    def problems(self) -> Iterator[Problem]:
        deflections, efforts = self.points
        if len(deflections) != len(efforts):
            counts = f"{len(efforts)} and {len(deflections)}"
            yield Problem((self.column,), f"a table needs as many {self.column} as deflections; got {counts}")
        if len(deflections) < 2:
            yield Problem(("deflections",), f"two or more deflections were expected, got {len(deflections)}")
        for at in range(1, len(deflections)):
            if deflections[at] <= deflections[at - 1]:
                before, here = f"{deflections[at - 1]:g}", f"{deflections[at]:g}"
                yield Problem(("deflections", at), f"deflections increase; {here} does not come after {before}")
                return


class ForceTable(Characteristic):
    """Force [N], tension positive, over the deflection `length - free_length` [m]."""

    column = "forces"

    deflections: of.Lengths = Field("length - free_length, increasing")
    forces: of.Forces = Field("of the spring, tension positive")


class TorqueTable(Characteristic):
    """Torque [N m] over the deflection `angle - free_angle` [rad]."""

    column = "torques"

    deflections: of.Angles = Field("angle - free_angle, increasing")
    torques: of.Torques = Field("with which the spring resists")


class EffortTable(Characteristic):
    """Effort [N or N m] over the deflection `coordinate - free_value` [m or rad]."""

    column = "efforts"

    deflections: Annotated[ManyNumbers[of.CoordinateValue], BeforeValidator(listed)] = Field(
        "coordinate - free_value, increasing"
    )
    efforts: Annotated[ManyNumbers[of.CoordinateEffort], BeforeValidator(listed)] = Field(
        "with which the spring resists"
    )


class SpringDamper(Between):
    """Tension stiffness · (length - free_length) + damping · rate + preload, in N, between two points.

    A `table` stands in place of the stiffness, a `law` in place of all of it.
    """

    outputs: ClassVar[tuple[str, ...]] = (*RESISTS, *of_value("length"))

    type: Literal["spring-damper"] = "spring-damper"
    stiffness: Maybe[of.Stiffness] = Field(default=None)
    damping: of.Damping = Field(default=0.0)
    free_length: Maybe[of.NotNegativeLength] = Field("at which the spring has no force", default=None)
    preload: of.ForceValue = Field("added to the tension", default=0.0)
    table: Maybe[OneRecord[ForceTable]] = Field("of the spring, in place of `stiffness`", default=None)
    law: Maybe[SpringForce] = Field("the tension; may use `length` and `rate`", default=None)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from self.problems_of_line()
        yield from problems_of_spring(self, "free_length")
        springs = self.law is None and (self.stiffness is not None or self.table is not None)
        if springs and self.free_length is None:
            yield Problem((), "`free_length` is missing: the length at which the spring has no force")


class TorsionalSpringDamper(BetweenMarkers):
    """Torque stiffness · (angle - free_angle) + damping · rate + preload, in N m, that resists the angle.

    The angle is that of the second marker about the z axis of the first. A `table` stands in place of the stiffness, a
    `law` in place of all of it.
    """

    outputs: ClassVar[tuple[str, ...]] = (*RESISTS, *of_value("angle"))
    turns: ClassVar[bool] = True

    type: Literal["torsional-spring-damper"] = "torsional-spring-damper"
    stiffness: Maybe[of.TorsionalStiffness] = Field(default=None)
    damping: of.TorsionalDamping = Field(default=0.0)
    free_angle: Angle = Field("at which the spring has no torque", default=0.0)
    preload: of.TorqueValue = Field("added to the torque that resists", default=0.0)
    table: Maybe[OneRecord[TorqueTable]] = Field("of the spring, in place of `stiffness`", default=None)
    law: Maybe[SpringTorque] = Field("the torque that resists; may use `angle` and `rate`", default=None)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problems_of_spring(self, "free_angle")


class JointSpringDamper(ForceElement):
    """Effort stiffness · (coordinate - free_value) + damping · rate + preload, in N or N m, that resists.

    A `table` stands in place of the stiffness, a `law` in place of all of it.
    """

    outputs: ClassVar[tuple[str, ...]] = (*RESISTS, *of_value("value"))

    type: Literal["joint-spring-damper"] = "joint-spring-damper"
    coordinate: CoordinateReference
    stiffness: Maybe[of.CoordinateStiffness] = Field(default=None)
    damping: of.CoordinateDamping = Field(default=0.0)
    free_value: of.CoordinateValue = Field("of the coordinate where the spring has no effort", default=0.0)
    preload: of.CoordinateEffort = Field("added to the effort that resists", default=0.0)
    table: Annotated[Maybe[OneRecord[EffortTable]], BeforeValidator(_check_columns)] = Field(
        "of the spring, in place of `stiffness`", default=None
    )
    law: Maybe[CoordinateLaw] = Field("the effort that resists; may use `value` and `rate`", default=None)

    def problems(self) -> Iterator[Problem]:
        yield from problems_of_spring(self, "free_value")


class ThreeAxisSpring(Between):
    """Along each global axis, a force stiffness · (displacement - free_displacement) + damping · rate + preload, in N, draws two points
    together. The displacement is that of the second point from the first.
    """

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force(),
        *(Output(f"force_{axis}", "N", f"force on the second body along global {axis}") for axis in "xyz"),
    )

    type: Literal["three-axis-spring"] = "three-axis-spring"
    stiffness: ThreeStiffnesses = Field("along global x, y, z", default=(0.0, 0.0, 0.0))
    damping: ThreeDampings = Field("along global x, y, z", default=(0.0, 0.0, 0.0))
    free_displacement: Position = Field(
        "of the second point from the first, at which the springs have no force", default=(0.0, 0.0, 0.0)
    )
    preload: ThreeForces = Field("added to the forces that draw the points together", default=(0.0, 0.0, 0.0))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not any((*self.stiffness, *self.damping, *self.preload)):
            yield Problem((), "a three-axis-spring needs a `stiffness`, a `damping` or a `preload` along some axis")


Spring = SpringDamper | TorsionalSpringDamper | JointSpringDamper


def problems_of_spring(spring: Spring, free: str) -> Iterator[Problem]:
    """What clashes in a spring; `free` is the name of its field for where the spring has no force."""
    if spring.law is not None:
        for name in ("stiffness", "table", "damping", free, "preload"):
            if getattr(spring, name):
                yield superfluous(name, "must not be given with a `law`, which is all that the element does")
        return
    if spring.stiffness is not None and spring.table is not None:
        yield superfluous("table", "stands in place of `stiffness`; give one of them")
    if spring.stiffness is None and spring.table is None:
        if getattr(spring, free):
            yield superfluous(free, "belongs to a `stiffness` or a `table`, and none is given")
        if not spring.damping and not spring.preload:
            message = f"a {spring.type} needs a `stiffness`, a `table`, a `damping`, a `preload` or a `law`"
            yield Problem((), message)


class SpringRow(Row):
    """A spring on a coordinate; without LAW, TABLE and its integral ENERGY where these are NONE."""

    output: int
    at: int
    table: int
    energy: int
    law: int
    stiffness: float
    damping: float
    free: float
    preload: float


class AxesRow(Row):
    """Springs along the global axes between the markers I and J."""

    output: int
    i: int
    j: int
    stiffness: Sequence[float] = several(3)
    damping: Sequence[float] = several(3)
    free: Sequence[float] = several(3)
    preload: Sequence[float] = several(3)


@element
def resist(machine, index, n, t):
    """Tension k (c - c0) + preload + d ċ, with a table in place of k (c - c0), or a law in place of all of it.

    Spring and preload store energy (the table's integral is table ENERGY), the damper dissipates, a law works from outside.
    """
    record = record_at(machine)
    coordinates, control, out = record.coordinates, record.control, record.outputs.value
    q, first = index[SpringRow.AT], index[SpringRow.OUTPUT]
    c, rate = coordinates.value[q], coordinates.rate[q]
    if index[SpringRow.LAW] != NONE:
        tension = evaluate_function(machine, index[SpringRow.LAW], t)
        control.power[0] -= tension * rate
    else:
        stretch = c - n[SpringRow.FREE]
        damping = n[SpringRow.DAMPING] * rate
        tension = n[SpringRow.STIFFNESS] * stretch + n[SpringRow.PRELOAD] + damping
        control.stored[0] += (0.5 * n[SpringRow.STIFFNESS] * stretch + n[SpringRow.PRELOAD]) * stretch
        control.power[1] += damping * rate
        if index[SpringRow.TABLE] != NONE:
            force, _, _ = table_value(record.functions, index[SpringRow.TABLE], stretch)
            energy, _, _ = table_value(record.functions, index[SpringRow.ENERGY], stretch)
            tension += force
            control.stored[0] += energy
    out[first], out[first + 1] = tension, add_coordinate_force(machine, q, -tension)
    out[first + 2], out[first + 3] = c, rate


@element
def draw(machine, index, n, t):
    """Forces along the global axes, their energy and losses."""
    record = record_at(machine)
    bodies, markers, control, out = record.bodies, record.markers, record.control, record.outputs.value
    i, j, first = index[AxesRow.I], index[AxesRow.J], index[AxesRow.OUTPUT]
    force = out[first + 2 : first + 5]
    for a in range(3):
        stretch = markers.r[j, a] - markers.r[i, a] - n[AxesRow.FREE + a]
        rate = markers.rdot[j, a] - markers.rdot[i, a]
        damping = n[AxesRow.DAMPING + a] * rate
        force[a] = -(n[AxesRow.STIFFNESS + a] * stretch + n[AxesRow.PRELOAD + a] + damping)
        control.stored[0] += (0.5 * n[AxesRow.STIFFNESS + a] * stretch + n[AxesRow.PRELOAD + a]) * stretch
        control.power[1] += damping * rate
    power = add_marker_force(bodies, markers, j, force) + add_marker_force(bodies, markers, i, opposite(force))
    out[first], out[first + 1] = np.sqrt(dot(force, force)), power


def add_spring_damper(builder: SystemBuilder, force: SpringDamper) -> None:
    """A spring and damper between two points."""
    _add_spring(
        builder, force, builder.coordinates.add(DISTANCE, *builder.ends(force.ends)), "length", force.free_length or 0.0
    )


def add_torsional_spring_damper(builder: SystemBuilder, force: TorsionalSpringDamper) -> None:
    """A torsional spring and damper between two markers."""
    _add_spring(builder, force, builder.coordinates.add(ROTATION, *builder.ends(force.ends)), "angle", force.free_angle)


def add_joint_spring_damper(builder: SystemBuilder, force: JointSpringDamper) -> None:
    """A spring and damper on a joint coordinate."""
    _add_spring(builder, force, builder.coordinate(force.coordinate), "value", force.free_value)


def _add_spring(builder: SystemBuilder, force: Spring, coordinate: int, symbol: str, free: float) -> None:
    coordinate = builder.coordinates.use(coordinate)
    first, law = add_outputs(builder, force, is_angle(builder, coordinate)), NONE
    table, energy = (NONE, NONE) if force.table is None else _characteristic(builder, force.table)
    if force.law is not None:
        symbols = {symbol: (function.COORDINATE, coordinate, 0), "rate": (function.RATE, coordinate, 0)}
        law = builder.function(force.law, symbols)
    ends = {"output": first, "at": coordinate, "table": table, "energy": energy, "law": law}
    row = SpringRow.of(force, **ends, stiffness=force.stiffness or 0.0, free=free)
    builder.add(resist, row)


def _characteristic(builder: SystemBuilder, table: Characteristic) -> tuple[int, int]:
    """Tables of the effort over the deflection, and of the energy stored since zero deflection."""
    x, effort = (np.array(column, dtype=float) for column in table.points)
    slope = np.diff(effort) / np.diff(x)
    slope = np.append(slope, slope[-1])
    nothing = np.zeros(len(x))
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (effort[1:] + effort[:-1]) * np.diff(x))])
    # the piece that holds zero, or the end piece that goes on to it
    at = int(np.clip(np.searchsorted(x, 0.0, side="right") - 1, 0, len(x) - 1))
    energy -= energy[at] - effort[at] * x[at] + 0.5 * slope[at] * x[at] ** 2
    force = builder.functions.add_table(x.tolist(), np.column_stack([effort, slope, nothing, nothing]))
    stored = builder.functions.add_table(x.tolist(), np.column_stack([energy, effort, 0.5 * slope, nothing]))
    return force, stored


def add_three_axis_spring(builder: SystemBuilder, force: ThreeAxisSpring) -> None:
    """Springs and dampers along the global axes."""
    first, (i, j), free = add_outputs(builder, force), builder.ends(force.ends), force.free_displacement
    row = AxesRow.of(force, output=first, i=i, j=j, free=free)
    builder.add(draw, row)


KINDS = (
    Kind(SpringDamper, add_spring_damper, (resist,)),
    Kind(TorsionalSpringDamper, add_torsional_spring_damper, (resist,)),
    Kind(JointSpringDamper, add_joint_spring_damper, (resist,)),
    Kind(ThreeAxisSpring, add_three_axis_spring, (draw,)),
)
