"""Springs that meet without mass between them, in numbers: in series, and in a node."""

from __future__ import annotations

import numpy as np

from nivel.elements.kind import Kind
from nivel.elements.states import StateFact
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces.spring_node import apply as spring_node
from nivel.kernels.forces.spring_series import apply as spring_series
from nivel.kernels.record.record import NONE
from nivel.machine.forces.spring_node import SpringNode
from nivel.machine.forces.spring_series import SpringSeries
from nivel.system.builder import SystemBuilder
from nivel.system.forces.outputs import force_outputs, magnitude_and_power


def add_spring_series(builder: SystemBuilder, force: SpringSeries) -> None:
    """Parts along a distance; those with dampers have their lengths as states, but the last one where all have dampers."""
    coordinate = builder.coordinates.use(builder.coordinates.add(DISTANCE, *builder.ends(force.ends)))
    parts = list(zip(force.stiffness, force.dampings, force.free_length, strict=True))
    lengths = [(f"length_{k + 1}", "m", f"length of part {k + 1}") for k in range(len(parts))]
    first = force_outputs(
        builder,
        force.name,
        *magnitude_and_power("N", "tension"),
        ("length", "m", "length"),
        ("rate", "m/s", "rate of the length"),
        *lengths,
    )
    followed = [k for k, damping in enumerate(force.dampings) if damping]
    if len(followed) == len(parts):
        followed.pop()
    scale, states = max(*force.free_length, 1e-3), []
    for k in range(len(parts)):
        fact = StateFact(
            f"{force.name}.length_{k + 1}", "m", f"length of part {k + 1} of {force.name}", parts[k][2], scale
        )
        states.append(builder.own_state(fact) if k in followed else NONE)
    numbers = [float(force.only_pulls), *(each for part in parts for each in part)]
    builder.elements.add(spring_series, [first, coordinate, len(parts), *states], numbers)


def add_spring_node(builder: SystemBuilder, force: SpringNode) -> None:
    """Springs from markers to a node that is kept from state to state."""
    markers = [builder.end(end) for end in force.ends]
    tensions = [(f"tension_{k + 1}", "N", f"tension of spring {k + 1}") for k in range(len(markers))]
    first = force_outputs(
        builder,
        force.name,
        *magnitude_and_power("N", "tension of the first spring"),
        *((axis, "m", f"global {axis} of the node") for axis in "xyz"),
        *tensions,
    )
    springs = np.column_stack([force.stiffness, force.free_length])
    size = max(*force.free_length, 1e-6)
    numbers = [float(force.only_pulls), *force.node, size, float(np.sum(force.stiffness)), *springs.ravel().tolist()]
    builder.elements.add(spring_node, [first, len(markers), *markers], numbers, memory=3)


KINDS = (
    Kind(SpringSeries, add_spring_series, (spring_series,)),
    Kind(SpringNode, add_spring_node, (spring_node,)),
)
