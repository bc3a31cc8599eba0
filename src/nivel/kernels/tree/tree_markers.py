"""Markers, coordinates and forces of an evaluation in relative coordinates, once all bodies of the tree are placed."""

from __future__ import annotations

from nivel.kernels.bodies.constraint import constraint_rows
from nivel.kernels.bodies.marker import move_marker, place_point, turn_axes
from nivel.kernels.record.hook import measure_active
from nivel.kernels.record.record import record_at
from nivel.native.function import stage


@stage
def read_markers(machine, t):
    """The markers in use, the rows that are left and the coordinates that something needs. Returns a status."""
    record = record_at(machine)
    bodies, markers = record.bodies, record.markers
    for n in range(record.tree.marker.shape[0]):
        k = record.tree.marker[n]
        place_point(bodies, markers, k)
        if record.tree.turning[n] != 0:
            turn_axes(bodies, markers, k)
        move_marker(bodies, markers, k)
    constraint_rows(bodies, markers, record.constraints)
    return measure_active(machine, t)
