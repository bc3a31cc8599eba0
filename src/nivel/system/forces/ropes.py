"""Ropes in numbers: distances from marker to marker, and the unstressed length, a state where there is a winch."""

from __future__ import annotations

import itertools

from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces.rope import apply
from nivel.kernels.record.record import NONE
from nivel.machine.forces import Rope
from nivel.system.builder import SystemBuilder
from nivel.system.forces.kind import ForceKind
from nivel.system.forces.outputs import force_outputs, magnitude_and_power
from nivel.system.signals.state_facts import StateFact


def add(builder: SystemBuilder, rope: Rope) -> None:
    """A rope."""
    markers = [builder.end(end) for end in rope.ends]
    distances = [
        builder.coordinates.use(builder.coordinates.add(DISTANCE, i, j)) for i, j in itertools.pairwise(markers)
    ]
    first = force_outputs(builder, rope.name, *magnitude_and_power("N", "tension"), ("stretch", "m", "stretch"))
    length = speed = NONE
    if rope.speed is not None:
        fact = StateFact(
            f"{rope.name}.length", "m", f"unstressed length of {rope.name}", rope.length, scale=rope.length
        )
        length, speed = builder.own_state(fact), builder.function(rope.speed)
    columns = [first, length, speed, len(distances), *distances]
    builder.elements.add(apply, columns, [rope.stiffness, rope.damping, rope.length], memory=1, surfaces=(0,))


KINDS = (ForceKind(Rope, add, (apply,)),)
