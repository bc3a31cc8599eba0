"""Flows through restrictions: orifices, edges of valves, leaks.

    Q = K x Δp (Δp² + c²)^(-1/4) + G Δp        ṁ = ½ (ρ_a + ρ_b) Q

x is an opening from 0 to 1. Edges of spools open as R(z)/R(z at a full stroke), z = factor u + shift, R a ramp: exactly closed within
their overlap.
"""

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component, Rating, problem_of_share
from nivel.elements.circuits.density import thickness
from nivel.elements.circuits.gases import GAS_CONSTANT, RATIO, REFERENCE, SURROUNDINGS, heat_capacity
from nivel.elements.circuits.kind import ComponentKind, Phase, called, slopes_of
from nivel.elements.circuits.ledger import lose, lose_between, transfer
from nivel.elements.circuits.poppets import FIRST_FACTOR, FIRST_NODE, NODES, slope_of_poppet
from nivel.elements.circuits.smooth import clipped, magnitude_within, ramp, root_flow, slope_of_step, step
from nivel.elements.circuits.symbol import Symbol, path
from nivel.elements.circuits.tangent import add_flow_by_column, add_flow_by_pressure
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.known import Node, SystemBuilder
from nivel.machine.core.coefficient import Leakage, Share
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import PositiveLength
from nivel.native.function import leaf, stage

# columns of `columns`; POSITION: output of the valve, or a function. Output: flow [m³/s]
OUTPUT, FROM, TO, KIND, POSITION = 0, 1, 2, 3, 4
# kinds of openings: one; a function; the position of a valve; that of an edge; of an edge that is open about the middle; of a cushion; of
# an edge that closes again
FIXED, GIVEN, DIRECT, EDGE, MIDDLE, CUSHION, BAND = 0, 1, 2, 3, 4, 5, 6
# columns of `number`: K [m³/s/√Pa], corner c [Pa], leak G [m³/s/Pa]; of edges the factor and shift of z, the width of the ramp, 1 over its
# greatest value, and the z from which one closes again; of cushions the place of the end, 1 or -1 where the piston comes from below or
# above, their length, the least opening
FLOW, CORNER, LEAK, FACTOR, SHIFT, WIDTH, SCALE, LEAST = 0, 1, 2, 3, 4, 5, 6, 7
CLOSES = 7


@stage
def opening_of(machine, index, n, t):
    """The opening of a restriction."""
    value = record_at(machine).outputs.value
    kind = index[KIND]
    if kind == GIVEN:
        return clipped(evaluate_function(machine, index[POSITION], t), 0.0)
    if kind == DIRECT:
        return clipped(value[index[POSITION]], 0.0)
    if kind == EDGE:
        u = clipped(value[index[POSITION]], -1.0)
        return ramp(n[FACTOR] * u + n[SHIFT], n[WIDTH]) * n[SCALE]
    if kind == MIDDLE:
        u = clipped(value[index[POSITION]], -1.0)
        return 1.0 - step(magnitude_within(u, 1e-6) / n[WIDTH])
    if kind == CUSHION:
        away = (value[index[POSITION]] - n[SHIFT]) * n[FACTOR]
        return n[LEAST] + (1.0 - n[LEAST]) * step(away / n[WIDTH])
    if kind == BAND:
        z = n[FACTOR] * clipped(value[index[POSITION]], -1.0) + n[SHIFT]
        return ramp(z, n[WIDTH]) * n[SCALE] * (1.0 - step((z - n[CLOSES]) / n[WIDTH]))
    return 0.0 * value[index[OUTPUT]] + 1.0


@called(Phase.FLOWS, 2)
@element
def restrict(machine, index, n, t):
    """Flows of all restrictions."""
    record = record_at(machine)
    circuit = record.circuit
    secant = circuit.secant[0]
    a, b = index[FROM], index[TO]
    difference = circuit.pressure[a] - circuit.pressure[b]
    opening = opening_of(machine, index, n, t)
    flow = (
        n[FLOW] * opening * root_flow(difference, n[CORNER], secant) + n[LEAK] / thickness(circuit, a, b) * difference
    )
    mass_flow = 0.5 * (circuit.density[a] + circuit.density[b]) * flow
    lose_between(machine, a, b, mass_flow, transfer(machine, a, b, mass_flow))
    record.outputs.value[index[OUTPUT]] = flow


@leaf
def slope_of_opening(index, n, u):
    """Slope of the opening of a restriction with the position u of its valve."""
    kind = index[KIND]
    if kind == DIRECT:
        return 1.0 if 0.0 <= u <= 1.0 else 0.0
    if not -1.0 <= u <= 1.0:
        return 0.0
    z = n[FACTOR] * u + n[SHIFT]
    if kind == EDGE:
        return n[FACTOR] * step(z / n[WIDTH]) * n[SCALE]
    if kind == BAND:
        beyond = (z - n[CLOSES]) / n[WIDTH]
        opens = step(z / n[WIDTH]) * (1.0 - step(beyond))
        return n[FACTOR] * n[SCALE] * (opens - ramp(z, n[WIDTH]) * slope_of_step(beyond) / n[WIDTH])
    size = magnitude_within(u, 1e-6)
    return -slope_of_step(size / n[WIDTH]) / n[WIDTH] * u / size


@slopes_of(restrict)
@element
def add_slopes(machine, index, n, t):
    """Slopes of all flows, those with pressures as secants."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    a, b, kind = index[FROM], index[TO], index[KIND]
    difference = circuit.pressure[a] - circuit.pressure[b]
    density = 0.5 * (circuit.density[a] + circuit.density[b])
    through = n[FLOW] / np.sqrt(np.sqrt(difference * difference + n[CORNER] * n[CORNER]))
    conductance = density * (through * opening_of(machine, index, n, t) + n[LEAK] / thickness(circuit, a, b))
    if conductance != 0.0:
        add_flow_by_pressure(circuit, a, b, a, conductance)
        add_flow_by_pressure(circuit, a, b, b, -conductance)
    if kind in (FIXED, GIVEN, CUSHION):
        return
    slope = density * through * difference * slope_of_opening(index, n, value[index[POSITION]])
    if slope == 0.0:
        return
    state, poppet = circuit.tangent.source[index[POSITION], 0], circuit.tangent.source[index[POSITION], 1]
    if state != NONE:
        add_flow_by_column(circuit, a, b, state, slope)
    elif poppet != NONE:
        valve, factors = elements.columns[poppet], elements.number[poppet]
        slope *= slope_of_poppet(machine, valve, factors, t)
        for i in range(NODES):
            if slope != 0.0 and valve[FIRST_NODE + i] != NONE:
                add_flow_by_pressure(circuit, a, b, valve[FIRST_NODE + i], slope * factors[FIRST_FACTOR + i])


# The columns are those of `nivel.elements.circuits.restrictions`; in `number` C [m³/s/Pa] and b stand first. Output: flow at the reference
# of ISO 8778, 1 bar and 20 °C [m³/s]
SONIC, CRITICAL, LEAK_OF_GAS = 0, 1, 2
ROUNDED = 1e-3
WHOLE = np.sqrt(np.sqrt(1.0 + ROUNDED * ROUNDED))
REFERENCE_ROOT = np.sqrt(293.15)  # √T_N [√K]


@leaf
def reduced_flow(n, high, low, secant):
    """p₁ ψ [Pa] for the pressures upstream and downstream.

    secant : on dual numbers, the derivative below choking is that of a line through the origin: see `root_flow`.
    """
    x = (high - low) / (high * (1.0 - n[CRITICAL]))
    if real(x) >= 1.0:
        return high + 0.0 * x
    if secant == 1:
        shown = real(x)
        slope = WHOLE * np.sqrt((2.0 - shown) / np.sqrt(shown * shown + ROUNDED * ROUNDED))
        return (high - low) / (1.0 - n[CRITICAL]) * slope
    return high * x * WHOLE * np.sqrt(2.0 - x) / np.sqrt(np.sqrt(x * x + ROUNDED * ROUNDED))


@stage
def carry_heat(machine, a, b, flow):
    """Energies that a mass flow [kg/s] from a to b takes along. Returns the available energy [W] of its heat in the gas that it meets."""
    record = record_at(machine)
    circuit, rate = record.circuit, record.elements.state_rate
    up, down = (a, b) if real(flow) >= 0.0 else (b, a)
    f = circuit.fluid[circuit.node[up, 0]]
    warm, own = circuit.temperature[up], circuit.temperature[down]
    carried = flow * heat_capacity(f) * warm
    if circuit.node[a, 2] != NONE:
        rate[circuit.node[a, 2]] -= carried
    if circuit.node[b, 2] != NONE:
        rate[circuit.node[b, 2]] += carried
    size = flow if up == a else -flow
    return size * (1.0 - f[SURROUNDINGS] / own) * heat_capacity(f) * (warm - own)


@called(Phase.FLOWS, 0)
@element
def restrict_gas(machine, index, n, t):
    """Flows of gas through all restrictions."""
    record = record_at(machine)
    circuit = record.circuit
    a, b = index[FROM], index[TO]
    f = circuit.fluid[circuit.node[a, 0]]
    backward = real(circuit.pressure[b]) > real(circuit.pressure[a])
    up, down = (b, a) if backward else (a, b)
    reduced = reduced_flow(n, circuit.pressure[up], circuit.pressure[down], circuit.secant[0])
    flow = n[SONIC] * opening_of(machine, index, n, t) * f[REFERENCE] * reduced
    flow = flow / np.sqrt(circuit.temperature[up])
    flow += n[LEAK_OF_GAS] * circuit.density[up] * (circuit.pressure[up] - circuit.pressure[down])
    if backward:
        flow = -flow
    lose(machine, transfer(machine, a, b, flow) - carry_heat(machine, a, b, flow))
    record.outputs.value[index[OUTPUT]] = flow * REFERENCE_ROOT / f[REFERENCE]


TRANSITION = 0.5e5  # Pa, of restrictions that do not say
CRITICAL_RATIO = 0.3  # of pneumatic valves that do not say


def add_flow(
    builder: SystemBuilder,
    component: Component,
    quantity: str,
    ends: tuple[str, str],
    numbers: list[float],
    opening: tuple[int, int] = (FIXED, 0),
) -> None:
    """A restriction between two ports, or `.M` within a component, of the family of their fluid.

    opening : its kind, and the output or function that it follows.
    """
    name, nodes = component.name, [component.node(place) for place in ends]
    first = builder.outputs.add((f"hydraulics.{name}.{quantity}", "m^3/s", f"{quantity.replace('_', ' ')} of {name}"))
    family = restrict_gas if builder.circuit.nodes[nodes[0]].gas else restrict
    builder.elements.add(family, [first, *map(builder.node, nodes), *opening], numbers)


def rated(component: Rating, leakage: float) -> list[float]:
    """FLOW, CORNER, LEAK of a component from a catalogue, or SONIC, CRITICAL, LEAK of one for gases."""
    if component.sonic_conductance is not None:
        return [component.sonic_conductance, component.critical_ratio or CRITICAL_RATIO, leakage]
    return [component.conductance, getattr(component, "transition", TRANSITION), leakage]


Opening = Annotated[OneFunction, varying("number")]


class Orifice(Rating, Component):
    """A restriction between two nodes: by its diameter, by a flow at a difference of pressure, or a leak alone."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("opening",)
    late: ClassVar[tuple[str, ...]] = ("flow",)
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))

    type: Literal["orifice"] = "orifice"
    diameter: Maybe[PositiveLength] = Field(default=None, usual=ranges.ORIFICE)
    discharge_coefficient: Share = Field(default=0.65)
    leakage: Leakage = Field("flow over the difference of pressure, laminar", default=0.0)
    opening: Opening = Field("from 0, closed, to 1", default=1.0)
    transition: ranges.Drop = Field("difference of pressure below which the root is rounded", default=0.5e5)

    def problems(self) -> Iterator[Problem]:
        yield from Component.problems(self)
        yield from problem_of_share("opening", self.opening, 0.0)
        given = [name for name in ("flow", "pressure_drop", "sonic_conductance") if getattr(self, name) is not None]
        if given:
            yield from self.problems_of_rating()
        if self.diameter is not None and given:
            yield superfluous(given[0], "stands in place of `diameter`; give one of them")
        if self.diameter is None and not given and not self.leakage:
            yield Problem(
                (),
                "`diameter`, `flow` and `pressure_drop`, of gases `sonic_conductance`, or `leakage` is needed: what lets the fluid through",
            )


def add_orifice(builder: SystemBuilder, component: Orifice) -> None:
    """A restriction, fixed or with an opening that varies."""
    numbers, node = rated(component, component.leakage), flowing(builder, component)
    if component.diameter is not None:
        area = 0.25 * math.pi * component.diameter**2 * component.discharge_coefficient
        fluid = builder.circuit.fluids[node.fluid]
        of_liquid = (area * math.sqrt(2.0 / fluid[4]), component.transition)
        numbers[:2] = _nozzle(area, fluid) if node.gas else of_liquid
    opening = (FIXED, 0) if component.opening == 1.0 else (GIVEN, builder.function(component.opening))
    add_flow(builder, component, "flow", ("A", "B"), numbers, opening)


def _nozzle(area: float, gas: tuple[float, ...]) -> tuple[float, float]:
    """(C [m³/s/Pa], b) of a gas that expands without loss into an area [m²]: the sonic flow (Saint-Venant and Wantzel 1839)."""
    ratio = gas[RATIO]
    critical = (2.0 / (ratio + 1.0)) ** (ratio / (ratio - 1.0))
    sonic = math.sqrt(ratio / gas[GAS_CONSTANT]) * (2.0 / (ratio + 1.0)) ** (0.5 * (ratio + 1.0) / (ratio - 1.0))
    return area * sonic / gas[REFERENCE], critical


def flowing(builder: SystemBuilder, component: Component) -> Node:
    """The node at port A of a component."""
    return builder.circuit.nodes[component.ports["A"]]


BODY = path("M0 -16 V16 M-8 -8 Q-1 0 -8 8 M8 -8 Q1 0 8 8")
ORIFICE = Symbol(BODY, 13.0, 16.0, {"B": 0.0}, {"A": 0.0}, key="opening", arrow=(-13, 12, 13, -12))


KINDS = (ComponentKind(Orifice, add_orifice, (restrict,), symbol=ORIFICE),)
