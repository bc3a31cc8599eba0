"""Volumes, tanks and accumulators in numbers."""

from __future__ import annotations

import math

from nivel.kernels.hydraulics import restriction
from nivel.kernels.hydraulics.tangent import RESTRICT
from nivel.machine.hydraulics import Accumulator, Tank, Volume
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import accumulator_nodes, tank_nodes, volume_nodes
from nivel.system.hydraulics.restrictions import TRANSITION, add_flow


def add_inlet(builder: SystemBuilder, component: Accumulator) -> None:
    """The inlet of an accumulator."""
    conductance = component.flow / math.sqrt(component.pressure_drop)
    add_flow(builder, component.name, "flow", (component.ports["A"], component.name), [conductance, TRANSITION, 0.0])


KINDS = (
    ComponentKind(Volume, None, (), slopes={}, nodes=volume_nodes),
    ComponentKind(Tank, None, (), symbols.source, {}, tank_nodes),
    ComponentKind(
        Accumulator,
        add_inlet,
        (restriction.apply,),
        symbols.accumulator,
        {restriction.apply: RESTRICT},
        accumulator_nodes,
    ),
)
