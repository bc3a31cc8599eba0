"""Soil that wheels press down and blades cut: its numbers in machine files, and its cells, heights on a grid over a plane of the ground.

Heights, shear and loads change between accepted steps only, at samples `period` apart (`nivel.elements.contacts.on_soil`). Within a step
forces see fixed cells, so that methods keep their order. All that changes stands in arrays of a unit (`nivel.system.signals.unit`): a run
begins with those of the file, and a saved state has all of them.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Any, ClassVar

import numpy as np

from nivel.elements.contacts.height_field import HeightField
from nivel.elements.facts import Output, StateFact, add_outputs
from nivel.elements.rows import Row, several
from nivel.errors import Fault, ModelError
from nivel.kernels.core.block import Handle
from nivel.kernels.elements.soil import SUMS, Cells, address_of
from nivel.kernels.record.record import NONE
from nivel.known import SystemBuilder
from nivel.machine.control.part import UnitFacts, UnitOutput
from nivel.machine.core.coefficient import NotNegativePressure, PositiveAngle, PositiveNumber
from nivel.machine.core.element import ForceElement, MarkerPlace
from nivel.machine.core.record import GROUND, Checked, Problem
from nivel.machine.core.vectors import Array
from nivel.machine.given import Field, OneNumber, OneRecord
from nivel.machine.units.formula import linear
from nivel.machine.units.quantity import Density, Duration, PositiveLength, Quantity
from nivel.machine.units.tree import TIME

Modulus = Annotated[OneNumber, Quantity("foundation modulus", positive=True)]


class Soil(Checked):
    """Soil of one kind: shear strength, pressure by sinkage (Bekker 1969), shear by displacement (Janosi, Hanamoto 1961)."""

    density: Density = Field(default=1700.0)
    cohesion: NotNegativePressure = Field(default=0.0)
    friction_angle: PositiveAngle = Field("inner one", default=math.radians(35.0))
    tool_friction: PositiveAngle = Field("angle of friction on a blade", default=math.radians(23.0))
    repose: PositiveAngle = Field("steepest slope that does not slide", default=math.radians(35.0))
    modulus: Modulus = Field("k of the pressure k z^n at the sinkage z, in metres", default=1.5e6)
    exponent: PositiveNumber = Field("n of the pressure k z^n", default=0.7)
    unloading: Modulus = Field("pressure by rise of unloaded soil", default=5e8)
    shear_length: PositiveLength = Field("sliding after which 63 % of the strength acts", default=0.025)
    period: Duration = Field("between two changes of the cells", default=1e-3)

    def problems(self) -> Iterator[Problem]:
        if self.friction_angle + self.tool_friction > math.radians(80.0):
            yield Problem(("friction_angle",), "`friction_angle` and `tool_friction` together must be below 80 deg")
        if self.repose > math.radians(69.0):
            yield Problem(("repose",), "an angle of less than 69 deg was expected")


class SoilRow(Row):
    """Numbers of a soil: the side of a CELL, GRAVITY along the axes of the plane [m/s²], ORIGIN: times the place of the first node."""

    cell: float
    density: float
    cohesion: float
    friction_angle: float
    tool_friction: float
    repose: float
    modulus: float
    exponent: float
    unloading: float
    shear_length: float
    period: float
    gravity: Sequence[float] = several(3)
    origin: float


class ForceRow(Row):
    """A force on soil: of a WHEEL, whose marker has z along the axle; of a blade, with markers of both ends of the edge, of the middle of
    the LOAD, of the NEAR and the FAR corner of what soil falls into, and two shares as states; or of a track, also on hard ground, with
    markers of the ends of its belt and of its SPROCKET, shares of what resists ahead (PUSH) and behind (BEARING), and two SHARES of each
    patch, as states.

    PLANE : a marker; CHANGED : the state that is the time of the last change; GRIP : a function; UNEVEN : whether hard ground has heights.
    WORK : of each patch its normal and its strength [N], and behind them the heights of hard ground."""

    output: int
    cells: int = NONE
    slot: int = 0
    plane: int
    changed: int = NONE
    wheel: int = NONE
    left: int = NONE
    right: int = NONE
    load: int = NONE
    near: int = NONE
    far: int = NONE
    push: int = NONE
    bearing: int = NONE
    front: int = NONE
    rear: int = NONE
    sprocket: int = NONE
    grip: int = NONE
    uneven: int = 0
    patches: int = 0
    shares: Sequence[int] = several(default=())
    rake: float = 0.0
    capacity: float = 0.0
    floor: float = 0.0
    cast_ahead: float = 0.0
    cast_left: float = 0.0
    radius: float = 0.0
    width: float = 0.0
    shear_length: float = 0.0
    stiffness: float = 0.0
    damping: float = 0.0
    work: Sequence[float] = several(default=())


MOVED_OUT = 6  # place of the first output that all forces on soil have, behind those of a blade or a wheel
ON_SOIL = (
    Output("moved", "m^3", "volume that was cut, dropped or pressed down so far"),
    Output("balance", "m^3", "volume of cells and loads less that at the start: zero, what was pressed down left out"),
    Output("spilt", "m^3", "volume that fell beyond the border of the heights"),
)


class OnSoil(ForceElement):
    """A force on soil, whose cells all forces with the same `plane`, `heights` and `soil` share."""

    turns: ClassVar[bool] = True

    plane: MarkerPlace = Field("marker on the ground: its point lies in it, its z axis points out of it")
    heights: OneRecord[HeightField] = Field("of the soil at the start, over the axes of the `plane`")
    soil: OneRecord[Soil] = Field("its numbers")


class SoilUnit:
    """The cells of one soil of a machine. name : of the soil. cell [m] : their sides. above : forces on it, as what they carry stands."""

    failure, arrays, law, name = "", (), address_of, ""
    above: Sequence[Any] = ()

    def __init__(self, soil: Soil, heights: HeightField, forces: int, gravity: Array, origin: float) -> None:
        """gravity (3,) [m/s²] : along the axes of the plane. origin [m²/s²] : gravity times the place of the first node."""
        h = np.array(heights.heights.T, order="C")
        self.cell = heights.size[0] / (h.shape[0] - 1)
        self.record = Cells(
            number=np.array(SoilRow.of(soil, cell=self.cell, gravity=gravity.tolist(), origin=origin).numbers),
            sum=np.zeros(SUMS),
            h=h,
            rest=h.copy(),
            shear=np.zeros((*h.shape, 2)),
            marked=np.zeros(h.size, dtype=np.int64),
            held=np.full(h.size, -1, dtype=np.int64),
            ring=np.zeros(h.size, dtype=np.int64),
            turn=np.zeros(3, dtype=np.int64),
            volume=np.zeros(forces),
            moved=np.zeros(forces),
            impulse=np.zeros((forces, 6)),
            edge=np.zeros((forces, 6)),
            mouth=np.zeros((forces, 7)),
            fallen=np.zeros(forces),
            body=np.zeros((forces, 13)),
        )
        self.handle = Handle(self.record)
        self._start = self.state()

    def move(self, **arrays: Array) -> None:
        """Let arrays of the record stand in other memory from now on."""
        for name, array in arrays.items():
            array[...] = getattr(self.record, name)
        self.record = self.record._replace(**arrays)
        self.handle.become(self.record)

    def begin(self) -> None:
        """As the machine file has it."""
        self.restore(self._start)

    def state(self) -> bytes:
        """All that changes in a run."""
        return b"".join(each.tobytes() for each in self.record[1:-1])  # the body without load stays

    def restore(self, content: bytes) -> None:
        """Go back to a state. Raises ModelError where it is of other cells."""
        if len(content) != len(self._start):
            raise ModelError("the state is of soil with other cells, or with other forces on it")
        place = 0
        for each in self.record[1:-1]:
            each.ravel()[:] = np.frombuffer(content, each.dtype, each.size, place)
            place += each.nbytes


def add_soil(builder: SystemBuilder, force: Any) -> dict[str, int]:
    """Columns of an element on soil: its first output, the function that says where the cells are, the number of the force among those on
    them, the marker of the plane, and the state that is the time of the last change.

    Raises ModelError for ground that cannot be soil.
    """
    own = force.plane, force.heights, force.soil
    others: list[Any] = [each for each in builder.machine.forces if getattr(each, "soil", None) is not None]
    same = [each for each in others if (each.plane, each.heights, each.soil) == own]
    name = f"soil of {same[0].name}"
    if name not in builder.functions.units:
        body, point, axes = builder.as_placed(force.plane)
        if body != GROUND:
            raise ModelError(Fault.at(f"forces.{force.name}.plane", "soil lies on the ground, not on a body"))
        rows, columns = force.heights.heights.shape
        along, across = force.heights.size[0] / (columns - 1), force.heights.size[1] / (rows - 1)
        if abs(along - across) > 1e-6 * across:
            message = (
                f"cells of soil are squares: here they are {along:.6g} m by {across:.6g} m; change `size` or the points"
            )
            raise ModelError(Fault.at(f"forces.{force.name}.heights", message))
        gravity, corner = np.array(builder.machine.gravity), point - 0.5 * axes[:, :2] @ np.array(force.heights.size)
        unit: Any = SoilUnit(force.soil, force.heights, len(same), gravity @ axes, float(gravity @ corner))
        unit.name, unit.above = name, same
        builder.functions.units[name] = unit
    text = f"time at which {force.name} changed its soil last"
    state = builder.own_state(StateFact(f"{force.name}.changed", "s", text, -force.soil.period, 1.0, sampled=True))
    builder.samples.append((state, linear((1.0, TIME)), force.soil.period, 0.0))
    return {
        "output": add_outputs(builder, force),
        "cells": builder.function(UnitOutput(UnitFacts(name, "", (), (), False, 0.0), 0, ())),
        "slot": [each.name for each in same].index(force.name),
        "plane": builder.end(force.plane),
        "changed": state,
    }
