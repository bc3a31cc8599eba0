"""Orifices and pipes in numbers."""

from __future__ import annotations

import math

from nivel.kernels.hydraulics import pipe, restriction
from nivel.kernels.hydraulics.gas import GAS_CONSTANT, RATIO, REFERENCE
from nivel.kernels.hydraulics.tangent import PIPE, RESTRICT
from nivel.kernels.record.record import NONE
from nivel.machine.hydraulics import Orifice, Pipe
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.circuit import Node
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.restrictions import add_flow, rated
from nivel.system.signals.state_facts import StateFact

CRITICAL_REYNOLDS = (0.3164 / 64.0) ** (-4.0 / 3.0)  # where 64/Re is 0.3164 Re^(-1/4)


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


KINDS = (
    ComponentKind(Orifice, add_orifice, (restriction.apply,), symbols.orifice, {restriction.apply: RESTRICT}),
    ComponentKind(Pipe, add_pipe, (pipe.apply,), symbols.pipe, {pipe.apply: PIPE}),
)
