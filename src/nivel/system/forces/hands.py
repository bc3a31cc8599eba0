"""Hands in numbers."""

from __future__ import annotations

import math

from nivel.elements.kind import Kind
from nivel.elements.states import Coupled
from nivel.kernels.forces.hand import apply
from nivel.machine.forces.hand import Hand
from nivel.system.builder import SystemBuilder
from nivel.system.forces.outputs import force_outputs, magnitude_and_power


def add(builder: SystemBuilder, hand: Hand) -> None:
    """A hand, which may hold any body."""
    first = force_outputs(builder, hand.name, *magnitude_and_power("N"))
    functions = [builder.function(each) for each in (hand.pull, hand.body_number, *hand.point, *hand.towards)]
    omega = 2.0 * math.pi * hand.frequency
    builder.note(Coupled(frozenset(range(len(builder.machine.bodies)))))
    builder.elements.add(apply, [first, *functions], [omega**2, 2.0 * hand.damping_ratio * omega])


KINDS = (Kind(Hand, add, (apply,)),)
