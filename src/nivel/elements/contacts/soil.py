"""Soil that wheels press down and blades cut: its numbers in machine files, and its cells, heights on a grid over a plane of the ground.

Heights, shear and loads change between accepted steps only, at samples `period` apart (`nivel.elements.contacts.soil_samples`). Within a
step forces see fixed cells, so that methods keep their order. All that changes stands in arrays of a unit (`nivel.system.signals.units`):
a second run has its own, and a saved state has all of it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np

from nivel.elements.contacts.height_field import HeightField
from nivel.elements.output import Output
from nivel.elements.states import StateFact
from nivel.errors import Fault, ModelError
from nivel.kernels.core.arrays import F1, F2, F3, I1
from nivel.kernels.core.block import Handle
from nivel.kernels.core.handle import reader
from nivel.kernels.record.function import OUTPUT
from nivel.kernels.record.hook import law
from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import NotNegativePressure, PositiveNumber
from nivel.machine.core.element import ForceElement
from nivel.machine.core.marker import MarkerPlace
from nivel.machine.core.record import GROUND
from nivel.machine.given import Field, OneNumber, OneRecord
from nivel.machine.units.expression import Expression
from nivel.machine.units.quantity import Density, Duration, PositiveLength, Quantity

if TYPE_CHECKING:
    from nivel.kernels.record.hook import Family
    from nivel.system.builder import SystemBuilder
    from nivel.system.tables import Array

PositiveAngle = Annotated[OneNumber, Quantity("angle", positive=True)]
Modulus = Annotated[OneNumber, Quantity("foundation modulus", positive=True)]

# Entries of Cells.number; then those of Cells.sum: volume added [m³], its moments along x, y, z [m⁴], volume that fell beyond the border,
# volume pressed together, work of the sample on loads [J], energy that goes to the account of losses until TIME + PERIOD
CELL, WEIGHT, COHESION, FRICTION, TOOL, REPOSE, MODULUS, EXPONENT, UNLOAD, SHEAR, PERIOD, DENSITY = range(12)
GRAVITY, ORIGIN, NUMBERS = (
    12,
    15,
    16,
)  # gravity along the axes of the plane [m/s²]; gravity times place of the first node [m²/s²]
ADDED, MOMENT_X, MOMENT_Y, MOMENT_Z, BEYOND, PRESSED, JUMP, PENDING, TIME, SUMS = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
FIRST, COUNT, STAMP = 0, 1, 2  # entries of Cells.turn: first of the ring, how many are on it, number of the sample
# Columns of Cells.load: volume carried [m³], angle of failure [rad], impulse [N s] and angular impulse [N m s] that take along what was
# taken in at the last sample, the ends of the edge then, whether they are known, volume moved so far [m³], samples at which something
# changed, whether the last one was
VOLUME, FAILURE, IMPULSE, TURN, EDGE, KNOWN, MOVED, CHANGES, CHANGED, LOADS = 0, 1, 2, 5, 8, 14, 15, 16, 17, 18
# Columns of Cells.empty: mass, centre, inertia about it of the body without load, and whether they are known
MASS, CENTRE, INERTIA, NOTED, EMPTY = 0, 1, 4, 13, 14


class Soil(Checked):
    """Soil of one kind: shear strength, pressure by sinkage (Bekker 1969), shear by displacement (Janosi, Hanamoto 1961)."""

    density: Density = Field(default=1700.0)
    cohesion: NotNegativePressure = Field(default=0.0)
    friction_angle: PositiveAngle = Field(default=math.radians(35.0), description="inner one")
    tool_friction: PositiveAngle = Field(default=math.radians(23.0), description="angle of friction on a blade")
    repose: PositiveAngle = Field(default=math.radians(35.0), description="steepest slope that does not slide")
    modulus: Modulus = Field(default=1.5e6, description="k of the pressure k z^n at the sinkage z, in metres")
    exponent: PositiveNumber = Field(default=0.7, description="n of the pressure k z^n")
    unloading: Modulus = Field(default=5e8, description="pressure by rise of soil that is let go")
    shear_length: PositiveLength = Field(default=0.025, description="sliding after which 63 % of the strength acts")
    period: Duration = Field(default=1e-3, description="between two changes of the cells")

    def problems(self) -> Iterator[Problem]:
        if self.friction_angle + self.tool_friction > 1.4:
            yield Problem(("friction_angle",), "`friction_angle` and `tool_friction` together must be below 80 deg")
        if self.repose > 1.2:
            yield Problem(("repose",), "an angle of less than 69 deg was expected")


# outputs that all forces on soil have, behind six of their own
MOVED_OUT, CHANGES_OUT, BALANCE_OUT, SPILT_OUT = 6, 7, 8, 9
ON_SOIL = (
    Output("moved", "m^3", "volume that was cut, dropped or pressed down so far"),
    Output("changes", "1", "samples at which it changed the soil"),
    Output(
        "balance", "m^3", "volume of all cells and loads less that at the start and what was pressed together: zero"
    ),
    Output("spilt", "m^3", "volume that fell beyond the border of the heights"),
)


class OnSoil(ForceElement):
    """A force on soil, whose cells all forces with the same `plane`, `heights` and `soil` share."""

    plane: MarkerPlace = Field(
        description="marker on the ground: its point lies in the plane, its z axis points out of it"
    )
    heights: OneRecord[HeightField] = Field(
        description="of the soil at the start, over the x and y axes of the `plane`"
    )
    soil: OneRecord[Soil] = Field(description="its numbers")

    @property
    def ground(self) -> tuple[object, HeightField, Soil]:
        """What forces on the same cells have in common."""
        return self.plane, self.heights, self.soil


class Cells(NamedTuple):
    """Soil in numbers. Node (i, j) stands at (i, j) CELL from the corner of least x and y of the plane."""

    number: F1
    sum: F1
    h: F2  # (n, m) [m] heights
    rest: F2  # (n, m) [m] heights from which soil was pressed down: undisturbed, or cut or poured last
    shear: F3  # (n, m, 2) share of the shear strength that acts along x and y
    marked: I1  # (n m,) whether a node is on the ring of those that may slide
    held: I1  # (n m,) sample at which a blade held a node
    ring: I1  # (n m,)
    turn: I1
    load: F2  # (forces, LOADS)
    empty: F2  # (forces, EMPTY)


cells_at = reader(Cells)


@law
def address_of(row):
    """The address of cells, its only argument."""
    return row[0]


class SoilUnit:
    """The cells of one soil of a machine."""

    failure = ""

    def __init__(self, soil: Soil, heights: HeightField, forces: int, gravity: Array, origin: float) -> None:
        """gravity (3,) [m/s²] : along the axes of the plane. origin [m²/s²] : gravity times the place of the first node."""
        self._start = np.ascontiguousarray(heights.heights.T)
        size = self._start.size
        number = np.zeros(NUMBERS)
        number[CELL] = heights.size[0] / (self._start.shape[0] - 1)
        number[[WEIGHT, COHESION, FRICTION]] = -soil.density * gravity[2], soil.cohesion, soil.friction_angle
        number[[TOOL, REPOSE, MODULUS]] = soil.tool_friction, soil.repose, soil.modulus
        number[[EXPONENT, UNLOAD, SHEAR]] = soil.exponent, soil.unloading, soil.shear_length
        number[[PERIOD, DENSITY, ORIGIN]] = soil.period, soil.density, origin
        number[GRAVITY:ORIGIN] = gravity
        self.record = Cells(
            number=number,
            sum=np.zeros(SUMS),
            h=self._start.copy(),
            rest=self._start.copy(),
            shear=np.zeros((*self._start.shape, 2)),
            marked=np.zeros(size, dtype=np.int64),
            held=np.full(size, -1, dtype=np.int64),
            ring=np.zeros(size, dtype=np.int64),
            turn=np.zeros(3, dtype=np.int64),
            load=np.zeros((forces, LOADS)),
            empty=np.zeros((forces, EMPTY)),
        )
        self.handle = Handle(self.record)

    @property
    def law(self) -> Family:
        """What says where the cells are."""
        return address_of

    @property
    def arrays(self) -> list[Any]:
        """All that changes."""
        return list(self.record[1:])

    def begin(self) -> None:
        """As the machine file has it."""
        own = self.record
        for array in (own.sum, own.shear, own.marked, own.ring, own.turn, own.load):
            array[...] = 0
        own.held[:] = -1
        own.h[:], own.rest[:] = self._start, self._start

    def end(self) -> None:
        """Nothing is held."""

    def state(self) -> bytes:
        """Nothing besides the arrays."""
        return b""

    def restore(self, content: bytes) -> None:
        """Nothing besides the arrays."""


def add_soil(builder: SystemBuilder, force: OnSoil, changes: int) -> dict[str, int]:
    """Columns of an element on soil: the function that says where the cells are, the number of the force among those on them, the marker
    of the plane, and the state that counts the samples at which it changed them, which the output `changes` says.

    Raises ModelError for ground that cannot be soil.
    """
    same = [each for each in builder.machine.forces if isinstance(each, OnSoil) and each.ground == force.ground]
    name = f"soil of {same[0].name}"
    unit = builder.functions.units.get(name)
    if unit is None:
        body, point, axes = builder.as_placed(force.plane)
        if body != GROUND:
            raise ModelError(
                Fault.at(f"forces.{force.name}.plane", "soil lies on the ground, not on a body that moves")
            )
        rows, columns = force.heights.heights.shape
        along, across = force.heights.size[0] / (columns - 1), force.heights.size[1] / (rows - 1)
        if abs(along - across) > 1e-6 * along:
            message = f"cells of soil are squares: here they are {along:.6g} m by {across:.6g} m; change `size` or the number of heights"
            raise ModelError(Fault.at(f"forces.{force.name}.heights", message))
        gravity = np.array(builder.machine.gravity)
        corner = point - 0.5 * axes[:, :2] @ np.array(force.heights.size)
        unit = SoilUnit(force.soil, force.heights, len(same), gravity @ axes, float(gravity @ corner))
    text = f"samples at which {force.name} changed the soil"
    state = builder.own_state(StateFact(f"{force.name}.changes", "1", text, 0.0, 1.0, sampled=True))
    function = builder.function(Expression("value"), {"value": (OUTPUT, changes, 0)}, sampled=True)
    builder.sampled.append((state, function, force.soil.period))
    return {
        "cells": builder.functions.add_unit(name, unit),
        "slot": [each.name for each in same].index(force.name),
        "plane": builder.end(force.plane),
        "changes": state,
    }
