"""Volumes, tanks and accumulators in numbers."""

from __future__ import annotations

import math

from nivel.kernels.hydraulics import accumulator, restriction
from nivel.kernels.hydraulics.tangent import RESTRICT
from nivel.machine.hydraulics import Accumulator, Tank, Volume
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import accumulator_nodes, first_charge, tank_nodes, volume_nodes
from nivel.system.hydraulics.restrictions import TRANSITION, add_flow
from nivel.system.signals.state_facts import StateFact


def add_inlet(builder: SystemBuilder, component: Accumulator) -> None:
    """The inlet of an accumulator."""
    conductance = component.flow / math.sqrt(component.pressure_drop)
    add_flow(builder, component.name, "flow", (component.ports["A"], component.name), [conductance, TRANSITION, 0.0])
    if component.thermal_time is None:
        return
    words = f"P of the gas in {component.name}, as of a precharge"
    state = builder.own_state(
        StateFact(f"{component.name}.charge", "Pa", words, first_charge(component), component.precharge)
    )
    first = builder.outputs.add(
        (f"hydraulics.{component.name}.temperature", "K", f"temperature of the gas in {component.name}")
    )
    columns = [first, builder.node(component.name), state]
    builder.elements.add(accumulator.charge, columns)
    numbers = [component.precharge, component.thermal_time, component.temperature]
    builder.elements.add(accumulator.exchange_heat, columns, numbers)


KINDS = (
    ComponentKind(Volume, None, (), slopes={}, nodes=volume_nodes),
    ComponentKind(Tank, None, (), symbols.source, {}, tank_nodes),
    ComponentKind(
        Accumulator,
        add_inlet,
        (restriction.apply, accumulator.charge, accumulator.exchange_heat),
        symbols.accumulator,
        {restriction.apply: RESTRICT},  # heat is slow beside steps
        accumulator_nodes,
    ),
)
