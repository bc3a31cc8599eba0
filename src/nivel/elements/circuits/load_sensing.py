"""The highest load of several directional valves, as a pressure that follows it: τ ṗ = p_max - p.

The load of a valve is the pressure at A or B, whichever it feeds, and that of its tank while it is closed.
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.directional_valves import DirectionalValve
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import ComponentKind, Phase, called, slopes_of
from nivel.elements.circuits.nodes import RIGID, TYPICAL, Node, pressure_output
from nivel.elements.circuits.sections import Section
from nivel.elements.circuits.smooth import clipped, maximum_within, ramp, step
from nivel.elements.circuits.spool_valves import SpoolValve, closed_until
from nivel.elements.circuits.symbol import Symbol, circle, path
from nivel.elements.circuits.tangent import add_by_pressure
from nivel.elements.circuits.volumes import SIGNAL
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.kernels.record.record import NONE, record_at
from nivel.known import Swept, SystemBuilder
from nivel.machine.core.coefficient import Share
from nivel.machine.core.record import Name, Problem
from nivel.machine.given import Field, ManyNames
from nivel.machine.units.quantity import Duration, listed
from nivel.native.function import stage


class LoadSensing(Component):
    """A pressure signal: the highest load of several directional valves, of those that are open, with a lag."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure",)

    type: Literal["load-sensing"] = "load-sensing"
    valves: Annotated[ManyNames[Name], BeforeValidator(listed)] = Field("directional valves of 4/3 ways")
    lag: Duration = Field("time constant", default=0.01, usual=ranges.LAG)
    opens_within: Share = Field("opening of a valve at which its load is wholly sensed", default=0.05)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not self.valves:
            yield Problem(("valves",), "names of directional valves are needed, got none")


# columns of `columns`: STATE, then for each of MOST valves the output that is its position, and nodes A, B, T
STATE, FIRST = 0, 1
POSITION, NODE_A, NODE_B, NODE_T, WIDE = 0, 1, 2, 3, 4
MOST = 8
# columns of `number`: time constant [s], opening at which a load is wholly felt, then overlap and width of the ramp of each valve
LAG, OPENS_WITHIN, FIRST_VALVE = 0, 1, 2
# pressure [Pa] within which the highest load passes from one valve to the next
ROUNDED = 1e4


@stage
def feeds(machine, position, n, i):
    """Shares by which valve i, with the output `position`, feels A and B."""
    u = clipped(record_at(machine).outputs.value[position], -1.0)
    overlap, width = n[FIRST_VALVE + 2 * i], n[FIRST_VALVE + 2 * i + 1]
    to_a, to_b = step(ramp(u - overlap, width) / n[OPENS_WITHIN]), step(ramp(-u - overlap, width) / n[OPENS_WITHIN])
    return to_a, to_b


@called(Phase.FLOWS, 4)
@element
def sense_loads(machine, index, n, t):
    """Rates of the signals."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    highest = 0.0 * n[LAG]
    for i in range(MOST):
        first = FIRST + WIDE * i
        if index[first] == NONE:
            break
        to_a, to_b = feeds(machine, index[first + POSITION], n, i)
        tank = circuit.pressure[index[first + NODE_T]]
        load = tank + to_a * (circuit.pressure[index[first + NODE_A]] - tank)
        load += to_b * (circuit.pressure[index[first + NODE_B]] - tank)
        highest = maximum_within(highest, load, ROUNDED)
    own = index[STATE]
    elements.state_rate[own] += (highest - elements.state[own]) / n[LAG]


@slopes_of(sense_loads)
@element
def add_slopes(machine, index, n, t):
    """Slopes of the signals with pressures; what positions of valves change in them is left out."""
    record = record_at(machine)
    circuit = record.circuit
    tangent = circuit.tangent
    own, highest = tangent.unknown[index[STATE]], 0.0
    row = tangent.slopes[own]
    for i in range(MOST):
        first = FIRST + WIDE * i
        if index[first] == NONE:
            break
        to_a, to_b = feeds(machine, index[first + POSITION], n, i)
        a, b, drain = index[first + NODE_A], index[first + NODE_B], index[first + NODE_T]
        tank = circuit.pressure[drain]
        load = tank + to_a * (circuit.pressure[a] - tank) + to_b * (circuit.pressure[b] - tank)
        lead = (load - highest) / np.sqrt((load - highest) ** 2 + ROUNDED * ROUNDED)
        for j in range(row.shape[0]):
            row[j] *= 0.5 * (1.0 - lead)
        share = 0.5 * (1.0 + lead) / n[LAG]
        add_by_pressure(circuit, row, a, share * to_a)
        add_by_pressure(circuit, row, b, share * to_b)
        add_by_pressure(circuit, row, drain, share * (1.0 - to_a - to_b))
        highest = maximum_within(highest, load, ROUNDED)
    row[own] -= 1.0 / n[LAG]


def signal_nodes(builder: SystemBuilder, component: LoadSensing, _: Swept) -> Iterator[Node]:
    """A node whose pressure is a signal."""
    name = component.name
    output = pressure_output(builder, name, "pressure")
    state = builder.own_state(StateFact(f"{name}.pressure", "Pa", f"load signal of {name}", ATMOSPHERE, TYPICAL))
    yield Node(name, SIGNAL, 0, state, RIGID, 0.0, None, name, output)


FELT_WITHIN = 0.02  # share of the stroke over which a load is first felt


def add_load_signal(builder: SystemBuilder, component: LoadSensing) -> None:
    """The signal, and the valves that it is made of."""
    node = builder.circuit.nodes[component.name]
    columns, numbers = [node.state], [component.lag, component.opens_within]
    valves = {
        each.name: each
        for each in builder.machine.hydraulics
        if isinstance(each, DirectionalValve | Section | SpoolValve)
    }
    for name in component.valves:
        valve = valves[name]
        output, coupled = builder.circuit.signals[f"{name}.position"]
        with builder.noting():  # the loads of valves do not depend on each other
            builder.touch_state(node.state)
            builder.note(coupled)
            columns += [output, *(builder.node(valve.ports[port]) for port in "ABT")]
        shut = (closed_until(valve), FELT_WITHIN) if isinstance(valve, SpoolValve) else (valve.overlap, valve.rounding)
        numbers += shut
    width = 1 + WIDE * MOST
    builder.elements.add(sense_loads, columns + [NONE] * (width - len(columns)), numbers)


BODY = path("M-18 -8 H18 V8 H-18 Z M-10 -4 L-5 0 L-10 4 M10 -4 L5 0 L10 4") + circle(4.0) + path("M0 -16 V-8", "dashed")
SHUTTLE = Symbol(BODY, 18.0, 16.0, {"LS": 0.0}, {}, "supply")

KINDS = (ComponentKind(LoadSensing, add_load_signal, (sense_loads,), symbol=SHUTTLE, nodes=signal_nodes, last=True),)
