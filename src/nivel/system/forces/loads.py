"""Point forces, torques and forces between two points in numbers."""

from __future__ import annotations

import math

import numpy as np

from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces import load
from nivel.kernels.forces.motor import apply as motor
from nivel.kernels.record.function import COORDINATE, RATE
from nivel.kernels.record.record import NONE
from nivel.machine.forces import PairForce, PointForce, Torque
from nivel.system.builder import SystemBuilder
from nivel.system.forces.kind import ForceKind
from nivel.system.forces.outputs import force_outputs, magnitude_and_power
from nivel.system.interfaces import marker_place


def add_load(draft: SystemBuilder, force: PointForce | Torque) -> None:
    """A force or torque on one body."""
    units = "N" if isinstance(force, PointForce) else "N m"
    first = force_outputs(draft, force.name, *magnitude_and_power(units))
    point, body = np.zeros(3), force.body
    if isinstance(force, PointForce):
        point = np.array(force.position or (0.0, 0.0, 0.0), dtype=float)
        if force.marker is not None:
            body, point, _ = marker_place(draft.machine, draft.machine.marker_named[force.marker])
    assert body is not None  # the record was checked
    marker = draft.place((body, point, np.eye(3)))
    functions = [draft.function(component) for component in force.vector]
    kind = load.FORCE if isinstance(force, PointForce) else load.TORQUE
    axes = marker if force.axes == "body" else NONE
    draft.elements.add(load.apply, [first, kind, marker, axes, *functions, NONE, NONE])


def add_pair(draft: SystemBuilder, force: PairForce) -> None:
    """A force between two points, along their line or as a vector."""
    i, j = draft.ends(force.ends)
    coordinate = draft.coordinates.use(draft.coordinates.add(DISTANCE, i, j))
    entries = (*magnitude_and_power("N"), ("length", "m", "length"), ("rate", "m/s", "rate of the length"))
    first = force_outputs(draft, force.name, *entries)
    if force.vector is None:
        assert force.magnitude is not None  # the record was checked
        law = draft.function(force.magnitude, {"length": (COORDINATE, coordinate, 0), "rate": (RATE, coordinate, 0)})
        draft.elements.add(motor, [first, coordinate, law], [0.0, math.inf])
        return
    functions = [draft.function(component) for component in force.vector]
    axes = i if force.axes == "first" else NONE
    draft.elements.add(load.apply, [first, load.FORCE, j, axes, *functions, i, coordinate])


KINDS = (
    ForceKind(PointForce, add_load, (load.apply,)),
    ForceKind(Torque, add_load, (load.apply,)),
    ForceKind(PairForce, add_pair, (load.apply, motor)),
)
