"""Volumes, tanks and accumulators in numbers."""

from __future__ import annotations

import math

from nivel.kernels.hydraulics import accumulator, reservoir, restriction
from nivel.kernels.hydraulics.tangent import RESTRICT
from nivel.machine.hydraulics import Accumulator, Reservoir, Tank, Volume
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import accumulator_nodes, first_charge, reservoir_nodes, tank_nodes, volume_nodes
from nivel.system.hydraulics.restrictions import TRANSITION, add_flow
from nivel.system.signals.state_facts import Coupled, StateFact


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


def add_reservoir(builder: SystemBuilder, component: Reservoir) -> None:
    """Level and volume of a reservoir, which are known with the pressures."""
    name, node = component.name, builder.circuit.nodes[component.name]
    first = builder.outputs.add(
        (f"hydraulics.{name}.level", "m", f"level of {name}"), (f"hydraulics.{name}.oil", "m^3", f"volume of the liquid in {name}")
    )
    columns = [first, builder.circuit.index(name), node.state, node.output + 1]
    builder.elements.add(reservoir.apply, columns, [component.area])
    known = builder.circuit.depends.setdefault(name, Coupled(frozenset(), node.states))
    for k, quantity in enumerate(("level", "oil")):
        builder.circuit.signals[f"{name}.{quantity}"] = (first + k, known)
    builder.circuit.signals[f"{name}.temperature"] = (node.output + 1, known)


KINDS = (
    ComponentKind(
        Reservoir, None, (reservoir.apply,), symbols.reservoir, {}, reservoir_nodes, present=add_reservoir
    ),
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
