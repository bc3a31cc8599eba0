"""Orifices, pipes, inlets and cushions in numbers."""

from __future__ import annotations

import math

from nivel.kernels.hydraulics import gas_flow, pipe, restriction, spool
from nivel.kernels.hydraulics.gas import GAS_CONSTANT, RATIO, REFERENCE
from nivel.kernels.record.record import NONE
from nivel.machine.hydraulics import Accumulator, HydraulicCylinder, Orifice, Pipe
from nivel.machine.hydraulics.component import Rating
from nivel.machine.laws.time_function import TimeFunction
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics.circuit import Node
from nivel.system.hydraulics.nodes import chamber_node
from nivel.system.signals.state_facts import StateFact

TRANSITION = 0.5e5  # Pa, of restrictions that do not say
CRITICAL_RATIO = 0.3  # of pneumatic valves that do not say
CRITICAL_REYNOLDS = (0.3164 / 64.0) ** (-4.0 / 3.0)  # where 64/Re is 0.3164 Re^(-1/4)


def add_flow(
    builder: SystemBuilder,
    component: str,
    quantity: str,
    ends: tuple[str, str],
    numbers: list[float],
    opening: tuple[int, int] = (restriction.FIXED, 0),
) -> None:
    """A restriction between two nodes, of the family of their fluid. opening : its kind, and the output or function that it follows."""
    first = builder.outputs.add(
        (f"hydraulics.{component}.{quantity}", "m^3/s", f"{quantity.replace('_', ' ')} of {component}")
    )
    family = gas_flow.apply if builder.circuit.nodes[ends[0]].gas else restriction.apply
    builder.elements.add(family, [first, builder.node(ends[0]), builder.node(ends[1]), *opening], numbers)


def rated(component: Rating, leakage: float) -> list[float]:
    """FLOW, CORNER, LEAK of a component from a catalogue, or SONIC, CRITICAL, LEAK of one for gases."""
    if component.sonic_conductance is not None:
        return [component.sonic_conductance, component.critical_ratio or CRITICAL_RATIO, leakage]
    return [component.conductance, getattr(component, "transition", TRANSITION), leakage]


def add_orifice(builder: SystemBuilder, component: Orifice) -> None:
    """A restriction, fixed or with an opening that varies."""
    ends = component.ports["A"], component.ports["B"]
    numbers = rated(component, component.leakage)
    if component.diameter is not None:
        area = 0.25 * math.pi * component.diameter**2 * component.discharge_coefficient
        fluid = builder.circuit.fluids[_flowing(builder, ends).fluid]
        numbers[:2] = (
            _nozzle(area, fluid)
            if _flowing(builder, ends).gas
            else (area * math.sqrt(2.0 / fluid[4]), component.transition)
        )
    opening = (restriction.FIXED, 0)
    if component.opening != 1.0:
        opening = (restriction.GIVEN, builder.function(component.opening))
    add_flow(builder, component.name, "flow", ends, numbers, opening)


def _nozzle(area: float, gas: tuple[float, ...]) -> tuple[float, float]:
    """(C [m³/s/Pa], b) of a gas that expands without loss into an area [m²]: the sonic flow (Saint-Venant and Wantzel 1839)."""
    ratio = gas[RATIO]
    critical = (2.0 / (ratio + 1.0)) ** (ratio / (ratio - 1.0))
    sonic = math.sqrt(ratio / gas[GAS_CONSTANT]) * (2.0 / (ratio + 1.0)) ** (0.5 * (ratio + 1.0) / (ratio - 1.0))
    return area * sonic / gas[REFERENCE], critical


def _flowing(builder: SystemBuilder, ends: tuple[str, str]) -> Node:
    return builder.circuit.nodes[ends[0]]


def add_inlet(builder: SystemBuilder, component: Accumulator) -> None:
    """The inlet of an accumulator."""
    conductance = component.flow / math.sqrt(component.pressure_drop)
    add_flow(builder, component.name, "flow", (component.ports["A"], component.name), [conductance, TRANSITION, 0.0])


def add_pipe(builder: SystemBuilder, component: Pipe) -> None:
    """Losses of a pipe, and its inertia."""
    ends = component.ports["A"], component.ports["B"]
    fluid = builder.circuit.fluids[_flowing(builder, ends).fluid]
    density, viscosity, d = fluid[4], fluid[5], component.diameter
    area = 0.25 * math.pi * d**2
    first = builder.outputs.add((f"hydraulics.{component.name}.flow", "m^3/s", f"flow of {component.name}"))
    critical = CRITICAL_REYNOLDS * viscosity * area / d
    state = NONE
    if component.inertia:
        name = f"{component.name}.mass_flow"
        state = builder.own_state(StateFact(name, "kg/s", f"mass flow of {component.name}", 0.0, density * critical))
    resistance = 128.0 * viscosity * component.length / (math.pi * d**4)
    columns = [first, builder.node(ends[0]), builder.node(ends[1]), state]
    builder.elements.add(pipe.apply, columns, [resistance, critical, area / component.length, density])


def add_cushions(builder: SystemBuilder, component: HydraulicCylinder) -> None:
    """The throttled outlets of a cylinder, each with a check valve beside it."""
    for chamber in component.chambers:
        cushion = getattr(component, f"cushion_{chamber}")
        if cushion is None:
            continue
        inner, port = chamber_node(component, chamber), f"{component.name}.{chamber}"
        head = rated(cushion, 0.0)
        end, sign = (0.0, 1.0) if chamber == "A" else (component.stroke, -1.0)
        position, coupled = builder.circuit.signals[f"{component.name}.position"]
        builder.note(coupled)
        numbers = [*head, sign, end, cushion.length, 1.0, cushion.least_opening]
        add_flow(
            builder, component.name, f"cushion_flow_{chamber}", (inner, port), numbers, (restriction.CUSHION, position)
        )
        opening = add_poppet(
            builder, component.name, f"check_{chamber}", {port: 1.0, inner: -1.0}, (3e5, 0.0, -1.0, 0.0), 0.5e5
        )
        add_flow(builder, component.name, f"check_flow_{chamber}", (port, inner), head, opening)


def add_poppet(
    builder: SystemBuilder,
    component: str,
    quantity: str,
    factors: dict[str, float],
    numbers: tuple[float, float, float, float],
    setting: TimeFunction,
) -> tuple[int, int]:
    """A valve that pressures open, and its opening as restrictions read it.

    factors : of the pressures of nodes. numbers : range, time constant (0: none), factor of the setting, constant.
    """
    output = builder.outputs.add(
        (f"hydraulics.{component}.{quantity}", "1", f"{quantity.replace('_', ' ')} of {component}, 0 closed")
    )
    state = NONE
    if numbers[1] > 0.0:
        state = builder.own_state(StateFact(f"{component}.{quantity}", "1", f"{quantity} of {component}", 0.0, 1.0))
    nodes = [builder.node(name) for name in factors]
    columns = [output, state, NONE, builder.function(setting), *nodes, *[NONE] * (spool.NODES - len(nodes))]
    builder.elements.add(spool.lift, columns, [*numbers, *factors.values()])
    return restriction.DIRECT, output
