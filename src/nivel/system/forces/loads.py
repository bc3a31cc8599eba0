"""Point forces, torques and forces between two points in numbers."""

from __future__ import annotations

import math

import numpy as np

from nivel.elements.forces.actuators import MotorRow, drive
from nivel.elements.kind import Kind
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces import load
from nivel.kernels.record.function import COORDINATE, RATE
from nivel.kernels.record.record import NONE
from nivel.machine.forces.load import PointForce, Torque
from nivel.machine.forces.pair_force import PairForce
from nivel.system.builder import SystemBuilder
from nivel.system.forces.outputs import force_outputs, magnitude_and_power
from nivel.system.joints.interfaces import marker_place


def add_load(builder: SystemBuilder, force: PointForce | Torque) -> None:
    """A force or torque on one body."""
    units = "N" if isinstance(force, PointForce) else "N m"
    first = force_outputs(builder, force.name, *magnitude_and_power(units))
    point, body = np.zeros(3), force.body
    if isinstance(force, PointForce):
        point = np.array(force.position or (0.0, 0.0, 0.0), dtype=float)
        if force.marker is not None:
            body, point, _ = marker_place(builder.machine, builder.machine.marker_named[force.marker])
    assert body is not None  # the record was checked
    marker = builder.place((body, point, np.eye(3)))
    functions = [builder.function(component) for component in force.vector]
    kind = load.FORCE if isinstance(force, PointForce) else load.TORQUE
    axes = marker if force.axes == "body" else NONE
    builder.elements.add(load.apply, [first, kind, marker, axes, *functions, NONE, NONE])


def add_pair(builder: SystemBuilder, force: PairForce) -> None:
    """A force between two points, along their line or as a vector."""
    i, j = builder.ends(force.ends)
    coordinate = builder.coordinates.use(builder.coordinates.add(DISTANCE, i, j))
    entries = (*magnitude_and_power("N"), ("length", "m", "length"), ("rate", "m/s", "rate of the length"))
    first = force_outputs(builder, force.name, *entries)
    if force.vector is None:
        assert force.magnitude is not None  # the record was checked
        law = builder.function(force.magnitude, {"length": (COORDINATE, coordinate, 0), "rate": (RATE, coordinate, 0)})
        builder.add(drive, MotorRow(output=first, coordinate=coordinate, target=law, gain=0.0, limit=math.inf))
        return
    functions = [builder.function(component) for component in force.vector]
    axes = i if force.axes == "first" else NONE
    builder.elements.add(load.apply, [first, load.FORCE, j, axes, *functions, i, coordinate])


KINDS = (
    Kind(PointForce, add_load, (load.apply,)),
    Kind(Torque, add_load, (load.apply,)),
    Kind(PairForce, add_pair, (load.apply, drive)),
)
