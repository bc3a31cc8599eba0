"""Volumes, tanks and accumulators in numbers."""

from __future__ import annotations

import math

from nivel.elements.states import Coupled, StateFact
from nivel.kernels.hydraulics import accumulator, reservoir, restriction
from nivel.kernels.hydraulics.volume import THETA
from nivel.machine.hydraulics import Accumulator, Reservoir, Tank, Volume
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import accumulator_nodes, first_charge, reservoir_nodes, tank_nodes, volume_nodes
from nivel.system.hydraulics.restrictions import TRANSITION, add_flow

CREEP = 1e-3  # share of the rated flow by which a piston that sticks moves at the limit of its friction


def add_inlet(builder: SystemBuilder, component: Accumulator) -> None:
    """The inlet of an accumulator."""
    conductance = component.flow / math.sqrt(component.pressure_drop)
    ends = component.ports["A"], component.name
    if component.piston_friction:
        name = f"hydraulics.{component.name}.flow"
        first = builder.outputs.add((name, "m^3/s", f"flow of {component.name}"))
        columns = [first, builder.node(ends[0]), builder.node(ends[1])]
        friction = component.piston_friction
        builder.elements.add(
            accumulator.rub, columns, [conductance, TRANSITION, friction, CREEP * component.flow / friction]
        )
    else:
        add_flow(builder, component.name, "flow", ends, [conductance, TRANSITION, 0.0])
    if component.thermal_time is not None:
        _add_gas(builder, component, component.thermal_time)


def _add_gas(builder: SystemBuilder, component: Accumulator, time: float) -> None:
    """The temperature of the gas of an accumulator."""
    real = component.gas == "nitrogen"
    if real:
        words = f"temperature of the gas in {component.name} on its adiabat at the density of its precharge"
        theta = builder.circuit.nodes[component.name].room[THETA]
        state = builder.own_state(
            StateFact(f"{component.name}.gas_temperature", "K", words, theta, component.temperature)
        )
    else:
        words = f"P of the gas in {component.name}, as of a precharge"
        state = builder.own_state(
            StateFact(f"{component.name}.charge", "Pa", words, first_charge(component), component.precharge)
        )
    first = builder.outputs.add(
        (f"hydraulics.{component.name}.temperature", "K", f"temperature of the gas in {component.name}")
    )
    columns = [first, builder.node(component.name), state]
    builder.elements.add(accumulator.charge_nitrogen if real else accumulator.charge, columns)
    numbers = [component.precharge, time, component.temperature]
    builder.elements.add(accumulator.warm_nitrogen if real else accumulator.exchange_heat, columns, numbers)


def add_reservoir(builder: SystemBuilder, component: Reservoir) -> None:
    """Level and volume of a reservoir, which are known with the pressures."""
    name, node = component.name, builder.circuit.nodes[component.name]
    first = builder.outputs.add(
        (f"hydraulics.{name}.level", "m", f"level of {name}"),
        (f"hydraulics.{name}.oil", "m^3", f"volume of the liquid in {name}"),
    )
    columns = [first, builder.circuit.index(name), node.state, node.output + 1]
    builder.elements.add(reservoir.apply, columns, [component.area])
    known = builder.circuit.depends.setdefault(name, Coupled(frozenset(), node.states))
    for k, quantity in enumerate(("level", "oil")):
        builder.circuit.signals[f"{name}.{quantity}"] = (first + k, known)
    builder.circuit.signals[f"{name}.temperature"] = (node.output + 1, known)


OF_ACCUMULATORS = (
    restriction.apply,
    accumulator.charge,
    accumulator.exchange_heat,
    accumulator.charge_nitrogen,
    accumulator.warm_nitrogen,
    accumulator.rub,
)
KINDS = (
    ComponentKind(Reservoir, None, (reservoir.apply,), None, reservoir_nodes, present=add_reservoir),
    ComponentKind(Volume, None, (), nodes=volume_nodes),
    ComponentKind(Tank, None, (), symbols.source, tank_nodes),
    ComponentKind(Accumulator, add_inlet, OF_ACCUMULATORS, symbols.accumulator, accumulator_nodes),
)
