"""Given loads: forces and torques on one body, with no counter-force, and forces between two points."""

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import add_outputs, of_force, of_value
from nivel.elements.forces.actuators import MotorRow, drive
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element
from nivel.kernels.algebra.vectors import opposite, turned
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces.wrench import add_marker_force, add_torque
from nivel.kernels.record.function import COORDINATE, RATE, evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.core.element import Between, ForceElement
from nivel.machine.core.record import GROUND, BodyName, Name, Problem, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import ForceComponent, SpringForce, ThreeFunctions, TorqueComponent
from nivel.machine.units.quantity import Position, listed

Axes = Annotated[Literal["global", "body"], Field("axes of the vector: global, or turning with the body")]


class PointForce(ForceElement):
    """A force on a point of a body: `body` and `position`, or a `marker`."""

    outputs: ClassVar[tuple[str, ...]] = of_force()
    stiff: ClassVar[bool] = False

    type: Literal["force"] = "force"
    body: BodyName | None = None
    position: Maybe[Position] = Field("of the point, in the body frame; default the origin", default=None)
    marker: Name | None = Field("the point, in place of `body` and `position`", default=None)
    vector: Annotated[ThreeFunctions[ForceComponent], BeforeValidator(listed)]
    axes: Axes = "global"

    def problems(self) -> Iterator[Problem]:
        if self.marker is None and self.body is None:
            yield Problem((), "a force needs a `body` (and `position`) or a `marker`")
        for name in ("body", "position"):
            if self.marker is not None and getattr(self, name) is not None:
                yield superfluous(name, "must not be given with `marker`, which says where the force acts")
        if self.body == GROUND:
            yield Problem(("body",), f"a force on `{GROUND}` moves nothing")


class Torque(ForceElement):
    """A pure torque on a body."""

    outputs: ClassVar[tuple[str, ...]] = of_force(units="N m")
    turns: ClassVar[bool] = True
    stiff: ClassVar[bool] = False

    type: Literal["torque"] = "torque"
    body: BodyName
    vector: Annotated[ThreeFunctions[TorqueComponent], BeforeValidator(listed)]
    axes: Axes = "global"

    def problems(self) -> Iterator[Problem]:
        if self.body == GROUND:
            yield Problem(("body",), f"a torque on `{GROUND}` moves nothing")


PairVector = Annotated[ThreeFunctions[ForceComponent], BeforeValidator(listed)]


class PairForce(Between):
    """A force on the second point and the opposite one on the first: a `magnitude` along the line between, or a
    `vector`.
    """

    outputs: ClassVar[tuple[str, ...]] = (*of_force(), *of_value("length"))

    type: Literal["pair-force"] = "pair-force"
    magnitude: Maybe[SpringForce] = Field("along the line, pushing apart; may use `length` and `rate`", default=None)
    vector: Maybe[PairVector] = Field("on the second point, opposite on the first", default=None)
    axes: Literal["global", "first"] = Field(
        "axes of the vector: global, or those of the first marker", default="global"
    )

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.magnitude is None and self.vector is None:
            yield Problem((), "a pair-force needs a `magnitude` along the line, or a `vector`")
        if self.magnitude is not None:
            if self.vector is not None:
                yield superfluous("vector", "stands in place of `magnitude`; give one of them")
            elif self.axes != "global":
                yield superfluous("axes", "belongs to a `vector`, and none is given")
            yield from self.problems_of_line()


FORCE, TORQUE = 0, 1


class LoadRow(Row):
    """A vector of three functions in global axes (AXES = NONE) or in those of marker AXES, on the body of MARKER. KIND : FORCE or TORQUE.
    COUNTER : marker that gets the opposite force, or NONE. LENGTH : coordinate that is reported with it."""

    output: int
    kind: int
    marker: int
    axes: int
    x: int
    y: int
    z: int
    counter: int = NONE
    length: int = NONE


@element
def push(machine, index, n, t):
    """A force or torque, its counter-force and power."""
    record = record_at(machine)
    bodies, markers, out, first = record.bodies, record.markers, record.outputs.value, index[LoadRow.OUTPUT]
    x = evaluate_function(machine, index[LoadRow.X], t)
    y = evaluate_function(machine, index[LoadRow.Y], t)
    z = evaluate_function(machine, index[LoadRow.Z], t)
    out[first] = np.sqrt(x * x + y * y + z * z)
    if index[LoadRow.AXES] != NONE:
        x, y, z = turned(markers.A[index[LoadRow.AXES]], (x, y, z))
    m, load, pushes = index[LoadRow.MARKER], (x, y, z), index[LoadRow.KIND] == FORCE
    power = add_marker_force(bodies, markers, m, load) if pushes else add_torque(bodies, markers.body[m], load)
    if index[LoadRow.COUNTER] != NONE:
        power += add_marker_force(bodies, markers, index[LoadRow.COUNTER], opposite(load))
        out[first + 2] = record.coordinates.value[index[LoadRow.LENGTH]]
        out[first + 3] = record.coordinates.rate[index[LoadRow.LENGTH]]
    out[first + 1] = power
    record.control.power[0] += power


def add_load(builder: SystemBuilder, force: PointForce | Torque) -> None:
    """A force or torque on one body."""
    first = add_outputs(builder, force)
    point, body = np.zeros(3), force.body
    if isinstance(force, PointForce):
        point = np.array(force.position or (0.0, 0.0, 0.0), dtype=float)
        if force.marker is not None:
            body, point, _ = builder.place_of(force.marker)
    assert body is not None  # the record was checked
    marker = builder.place((body, point, np.eye(3)))
    x, y, z = (builder.function(component) for component in force.vector)
    kind = FORCE if isinstance(force, PointForce) else TORQUE
    axes = marker if force.axes == "body" else NONE
    builder.add(push, LoadRow(output=first, kind=kind, marker=marker, axes=axes, x=x, y=y, z=z))


def add_pair(builder: SystemBuilder, force: PairForce) -> None:
    """A force between two points, along their line or as a vector."""
    i, j = builder.ends(force.ends)
    coordinate = builder.coordinates.use(builder.coordinates.add(DISTANCE, i, j))
    first = add_outputs(builder, force)
    if force.vector is None:
        assert force.magnitude is not None  # the record was checked
        law = builder.function(force.magnitude, {"length": (COORDINATE, coordinate, 0), "rate": (RATE, coordinate, 0)})
        builder.add(drive, MotorRow(output=first, coordinate=coordinate, target=law, gain=0.0, limit=math.inf))
        return
    x, y, z = (builder.function(component) for component in force.vector)
    axes = i if force.axes == "first" else NONE
    row = LoadRow(output=first, kind=FORCE, marker=j, axes=axes, x=x, y=y, z=z, counter=i, length=coordinate)
    builder.add(push, row)


KINDS = (Kind(PointForce, add_load, (push,)), Kind(Torque, add_load, (push,)), Kind(PairForce, add_pair, (push, drive)))
