"""Wheels on soil: rigid ones that press it down, its numbers in machine files, and its cells, heights on a grid over a plane of the ground.

Heights and shear change between accepted steps only, at samples `period` apart (`nivel.elements.contacts.on_soil`). Within a step forces
see fixed cells, so that methods keep their order. All that changes stands in arrays of a unit (`nivel.system.signals.unit`): a run begins
with those of the file, and a saved state has all of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

import numpy as np

from nivel.elements.contacts.height_field import HeightField
from nivel.elements.contacts.on_soil import SoilRow, WheelRow, apply
from nivel.elements.facts import Output, StateFact, add_outputs, of_force
from nivel.elements.kind import Kind
from nivel.errors import Fault, ModelError
from nivel.kernels.core.block import Handle
from nivel.kernels.elements.soil import Cells, address_of
from nivel.known import SystemBuilder
from nivel.machine.control.part import UnitFacts, UnitOutput
from nivel.machine.core.coefficient import NotNegativePressure, PositiveNumber
from nivel.machine.core.element import ForceElement
from nivel.machine.core.marker import MarkerPlace
from nivel.machine.core.record import GROUND, Checked, Problem
from nivel.machine.given import Field, OneNumber, OneRecord
from nivel.machine.units.formula import linear
from nivel.machine.units.quantity import Duration, PositiveLength, Quantity
from nivel.machine.units.tree import TIME

Modulus = Annotated[OneNumber, Quantity("foundation modulus", positive=True)]
FrictionAngle = Annotated[OneNumber, Quantity("angle", positive=True)]


class Soil(Checked):
    """Soil of one kind: shear strength, pressure by sinkage (Bekker 1969), shear by displacement (Janosi, Hanamoto 1961)."""

    cohesion: NotNegativePressure = Field(default=0.0)
    friction_angle: FrictionAngle = Field(default=math.radians(35.0), description="inner one")
    modulus: Modulus = Field(default=1.5e6, description="k of the pressure k z^n at the sinkage z, in metres")
    exponent: PositiveNumber = Field(default=0.7, description="n of the pressure k z^n")
    unloading: Modulus = Field(default=5e8, description="pressure by rise of unloaded soil")
    shear_length: PositiveLength = Field(default=0.025, description="sliding after which 63 % of the strength acts")
    period: Duration = Field(default=1e-3, description="between two changes of the cells")

    def problems(self) -> Iterator[Problem]:
        if self.friction_angle > math.radians(60.0):
            yield Problem(("friction_angle",), "an angle of less than 60 deg was expected")


class SoilWheel(ForceElement):
    """A rigid wheel, or a tyre that is hard beside the soil: pressure by sinkage, and shear, cell by cell. All with the same `plane`,
    `heights` and `soil` share the cells."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("load across the plane"),
        Output("longitudinal", "N", "force on the wheel in the direction in which it points"),
        Output("lateral", "N", "force on the wheel to the side to which its marker's z axis points"),
        Output("moment", "N m", "moment on the wheel about its axle"),
        Output("sinkage", "m", "greatest, below the soil as it was laid"),
    )
    turns: ClassVar[bool] = True

    type: Literal["soil-wheel"] = "soil-wheel"
    wheel: MarkerPlace = Field(description="marker on the wheel: its point is the centre, its z axis the axle")
    radius: PositiveLength
    width: PositiveLength
    plane: MarkerPlace = Field(description="marker on the ground: its point lies in it, its z axis points out of it")
    heights: OneRecord[HeightField] = Field(description="of the soil at the start, over the axes of the `plane`")
    soil: OneRecord[Soil] = Field(description="its numbers")


class SoilUnit:
    """The cells of one soil of a machine."""

    failure, arrays, law = "", (), address_of

    def __init__(self, soil: Soil, heights: HeightField) -> None:
        h = np.array(heights.heights.T, order="C")
        number = SoilRow.of(soil, cell=heights.size[0] / (h.shape[0] - 1)).numbers
        self.record = Cells(number=np.array(number), h=h, rest=h.copy(), shear=np.zeros((*h.shape, 2)))
        self._start = self.state()
        self.handle = Handle(self.record)

    def begin(self) -> None:
        """As the machine file has it."""
        self.restore(self._start)

    def state(self) -> bytes:
        """All that changes in a run."""
        return np.concatenate([each.ravel() for each in self.record[1:]]).tobytes()

    def restore(self, content: bytes) -> None:
        """Go back to a state. Raises ModelError where it is of other cells."""
        numbers, size = np.frombuffer(content), self.record.h.size
        if len(numbers) != 4 * size:
            raise ModelError("the state is of soil with other cells")
        for own, kept in zip(self.record[1:], np.split(numbers, (size, 2 * size)), strict=True):
            own.ravel()[:] = kept


def add_wheel(builder: SystemBuilder, force: SoilWheel) -> None:
    """A wheel, with the time of the last change of its soil as a state. Raises ModelError for ground that cannot be soil."""
    soil = force.plane, force.heights, force.soil
    wheels = [each for each in builder.machine.forces if isinstance(each, SoilWheel)]
    name = f"soil of {next(each.name for each in wheels if (each.plane, each.heights, each.soil) == soil)}"
    if name not in builder.functions.units:
        if builder.as_placed(force.plane)[0] != GROUND:
            raise ModelError(Fault.at(f"forces.{force.name}.plane", "soil lies on the ground, not on a body"))
        rows, columns = force.heights.heights.shape
        along, across = force.heights.size[0] / (columns - 1), force.heights.size[1] / (rows - 1)
        if abs(along - across) > 1e-6 * across:
            message = (
                f"cells of soil are squares: here they are {along:.6g} m by {across:.6g} m; change `size` or the points"
            )
            raise ModelError(Fault.at(f"forces.{force.name}.heights", message))
        unit: Any = SoilUnit(force.soil, force.heights)
        builder.functions.units[name] = unit
    text, first = f"time at which {force.name} changed its soil last", add_outputs(builder, force)
    state = builder.own_state(StateFact(f"{force.name}.changed", "s", text, -force.soil.period, 1.0, sampled=True))
    builder.samples.append((state, linear((1.0, TIME)), force.soil.period, 0.0))
    cells = builder.function(UnitOutput(UnitFacts(name, "", (), (), False, 0.0), 0, ()))
    wheel, plane = builder.ends((force.wheel, force.plane))
    builder.add(apply, WheelRow.of(force, output=first, cells=cells, changed=state, wheel=wheel, plane=plane))


KINDS = (Kind(SoilWheel, add_wheel, (apply, address_of)),)
