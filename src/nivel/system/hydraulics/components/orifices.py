"""Orifices and pipes in numbers."""

from __future__ import annotations

import math

from nivel.elements.states import StateFact
from nivel.kernels.hydraulics import gas_line, line, pipe, restriction
from nivel.kernels.hydraulics.fluid import DENSITY, MODULUS, VISCOSITY
from nivel.kernels.hydraulics.gas import GAS_CONSTANT, RATIO, REFERENCE
from nivel.machine.hydraulics import Line, Orifice, Pipe, Tube
from nivel.machine.hydraulics.restrictions import AIR_VISCOSITY
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.circuit import Node
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import line_nodes, tube_nodes
from nivel.system.hydraulics.restrictions import add_flow, rated

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
    resistance = 128.0 * viscosity * component.length / (math.pi * d**4)
    columns = [first, builder.node(ends[0]), builder.node(ends[1])]
    if not component.inertia:
        builder.elements.add(pipe.apply, columns, [resistance, critical])
        return
    fact = StateFact(f"{component.name}.mass_flow", "kg/s", f"mass flow of {component.name}", 0.0, density * critical)
    without_bends = [resistance, critical, area / component.length, density, 0.0, 0.0, 0.0, 1e-3 * critical]
    builder.elements.add(line.apply, [*columns, builder.own_state(fact), 0, 0], without_bends)


def add_line(builder: SystemBuilder, component: Line) -> None:
    """The flows between A, the segments and B."""
    name, count = component.name, component.segments
    nodes = [component.ports["A"], *(f"{name}.{k + 1}" for k in range(count)), component.ports["B"]]
    fluid = builder.circuit.fluids[builder.circuit.nodes[nodes[1]].fluid]
    density, viscosity = fluid[DENSITY], fluid[VISCOSITY]
    terms = _friction_terms(component, fluid) if component.unsteady_friction else 0
    for k in range(count + 1):
        begin, end = max(0.0, (k - 0.5) / count), min(1.0, (k + 0.5) / count)
        d, length = component.diameter_at(0.5 * (begin + end)), (end - begin) * component.length
        ending = {0: "A", count: "B"}.get(k, str(k))
        first = builder.outputs.add((f"hydraulics.{name}.flow_{ending}", "m^3/s", f"flow at {ending} of {name}"))
        area = 0.25 * math.pi * d**2
        critical = CRITICAL_REYNOLDS * viscosity * area / d
        words = f"mass flow at {ending} of {name}"
        state = builder.own_state(StateFact(f"{name}.mass_flow_{ending}", "kg/s", words, 0.0, density * critical))
        words = f"friction at {ending} of {name}"
        parts = [
            builder.own_state(StateFact(f"{name}.friction_{ending}_{i + 1}", "m^3/s", words, 0.0, critical))
            for i in range(terms)
        ]
        numbers = [128.0 * viscosity * length / (math.pi * d**4), critical, area / length, density]
        numbers += [0.5 * component.bends * (end - begin) / area**2, 16.0 * viscosity * length / (d**2 * area)]
        numbers += [4.0 * viscosity / d**2, 1e-3 * critical]
        columns = [first, builder.node(nodes[k]), builder.node(nodes[k + 1]), state, parts[0] if parts else 0, terms]
        builder.elements.add(line.apply, columns, numbers)


def _friction_terms(component: Line, fluid: tuple[float, ...]) -> int:
    """How many exponentials are slower than the segments can vibrate, and the next one."""
    length, d = component.length / component.segments, component.diameter
    fastest = 2.0 * math.sqrt(fluid[MODULUS] / fluid[DENSITY]) / length
    slower = [rate for rate in line.RATES if rate * 4.0 * fluid[VISCOSITY] / d**2 < fastest]
    return min(len(slower) + 1, len(line.RATES))


def add_tube(builder: SystemBuilder, component: Tube) -> None:
    """The flows between A, the segments and B."""
    name, count, d = component.name, component.segments, component.diameter
    nodes = [component.ports["A"], *(f"{name}.{k + 1}" for k in range(count)), component.ports["B"]]
    density, area = builder.circuit.fluids[builder.circuit.nodes[nodes[1]].fluid][DENSITY], 0.25 * math.pi * d**2
    critical = CRITICAL_REYNOLDS * AIR_VISCOSITY * area / d
    for k in range(count + 1):
        share = (0.5 if k in (0, count) else 1.0) / count
        length, ending = share * component.length, {0: "A", count: "B"}.get(k, str(k))
        first = builder.outputs.add((f"hydraulics.{name}.flow_{ending}", "m^3/s", f"flow at {ending} of {name}"))
        words = f"mass flow at {ending} of {name}"
        state = builder.own_state(StateFact(f"{name}.mass_flow_{ending}", "kg/s", words, 0.0, 10.0 * critical))
        resistance = 128.0 * AIR_VISCOSITY * length / (math.pi * d**4)
        numbers = [resistance, critical, area / length, density, 0.5 * component.bends * share / area**2]
        columns = [first, builder.node(nodes[k]), builder.node(nodes[k + 1]), state]
        builder.elements.add(gas_line.apply, columns, numbers)


KINDS = (
    ComponentKind(Tube, add_tube, (gas_line.apply,), symbols.pipe, tube_nodes),
    ComponentKind(Line, add_line, (line.apply,), symbols.pipe, line_nodes),
    ComponentKind(Orifice, add_orifice, (restriction.apply,), symbols.orifice),
    ComponentKind(Pipe, add_pipe, (pipe.apply, line.apply), symbols.pipe),
)
