"""Slopes of the flows and forces of components, for `nivel.kernels.hydraulics.tangent`."""

from __future__ import annotations

from nivel.kernels.record.record import NONE
from nivel.native.function import leaf


@leaf
def add_by_pressure(circuit, row, node, slope):
    """Add to a row of slopes `slope` times that of the pressure of a node: it follows from a mass and from pistons, or is a state."""
    tangent, state = circuit.tangent, circuit.node[node, 1]
    if state != NONE:
        row[tangent.unknown[state]] += slope * tangent.by_mass[node]
        first = tangent.state.shape[0]
        for c in range(tangent.coordinate.shape[0]):
            row[first + c] += slope * tangent.by_stroke[node, c]
    elif tangent.signal[node] != NONE:
        row[tangent.signal[node]] += slope


@leaf
def add_flow_by_pressure(circuit, a, b, node, slope):
    """The mass flow from node a to node b grows by `slope` [kg/s/Pa] with the pressure of a node."""
    tangent = circuit.tangent
    if circuit.node[a, 1] != NONE:
        add_by_pressure(circuit, tangent.slopes[tangent.unknown[circuit.node[a, 1]]], node, -slope)
    if circuit.node[b, 1] != NONE:
        add_by_pressure(circuit, tangent.slopes[tangent.unknown[circuit.node[b, 1]]], node, slope)


@leaf
def add_flow_by_column(circuit, a, b, column, slope):
    """The mass flow from node a to node b grows by `slope` with what a column of slopes stands for."""
    tangent = circuit.tangent
    if circuit.node[a, 1] != NONE:
        tangent.slopes[tangent.unknown[circuit.node[a, 1]], column] -= slope
    if circuit.node[b, 1] != NONE:
        tangent.slopes[tangent.unknown[circuit.node[b, 1]], column] += slope
