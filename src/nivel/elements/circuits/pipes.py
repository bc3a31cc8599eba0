"""Pipes: their losses, and the inertia of the fluid in them where that is wanted."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.density import thickening
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.ledger import lose_between, transfer
from nivel.elements.circuits.line_friction import (
    CRITICAL,
    CRITICAL_REYNOLDS,
    RESISTANCE,
    flow_ratio,
    loss,
    slope_of_loss,
)
from nivel.elements.circuits.lines import flow_in_lines
from nivel.elements.circuits.orifices import flowing
from nivel.elements.circuits.phase import Phase, called, slopes_of
from nivel.elements.circuits.symbol import pipe
from nivel.elements.circuits.tangent import add_flow_by_pressure
from nivel.elements.rows import element
from nivel.elements.states import StateFact
from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.record import record_at
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import Truth
from nivel.machine.given import Field


class Pipe(Component):
    """The loss of a round pipe, laminar and turbulent (Blasius), and the inertia of the fluid in it where that is wanted.

    The volume of the fluid belongs to the nodes at its ends.
    """

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    late: ClassVar[tuple[str, ...]] = ("flow",)
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))

    type: Literal["pipe"] = "pipe"
    diameter: ranges.Bore = Field()
    length: ranges.PipeLength = Field()
    inertia: Truth = Field(default=False, description="whether the flow has inertia: a state")


# columns of `columns`. Output: flow [m³/s]
OUTPUT, FROM, TO = 0, 1, 2


@called(Phase.FLOWS, 10)
@element
def flow_in_pipes(machine, index, n, t):
    """Flows through pipes without inertia."""
    record = record_at(machine)
    circuit = record.circuit
    a, b = index[FROM], index[TO]
    density, g = 0.5 * (circuit.density[a] + circuit.density[b]), thickening(circuit, a, b)
    difference = circuit.pressure[a] - circuit.pressure[b]
    critical = real(n[CRITICAL]) * real(g)
    scale = real(n[RESISTANCE]) * real(g) * real(density) * critical
    found = flow_ratio(real(difference) / scale) * critical
    resistance = loss(n, g, density, found + 0.0 * difference)
    flow = found + (difference - resistance) / (real(density) * slope_of_loss(n, real(g), found))
    mass_flow = density * flow
    lose_between(machine, a, b, mass_flow, transfer(machine, a, b, mass_flow))
    record.outputs.value[index[OUTPUT]] = flow


@slopes_of(flow_in_pipes)
@element
def add_slopes(machine, index, n, t):
    """Slopes of flows through pipes, as secants."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    a, b = index[FROM], index[TO]
    g = thickening(circuit, a, b)
    sixth = (value[index[OUTPUT]] / (n[CRITICAL] * g)) ** 6
    secant = n[RESISTANCE] * g * (1.0 + sixth) ** 0.125
    add_flow_by_pressure(circuit, a, b, a, 1.0 / secant)
    add_flow_by_pressure(circuit, a, b, b, -1.0 / secant)


def add_pipe(builder: SystemBuilder, component: Pipe) -> None:
    """Losses of a pipe, and its inertia."""
    ends = component.ports["A"], component.ports["B"]
    fluid = builder.circuit.fluids[flowing(builder, ends).fluid]
    density, viscosity, d = fluid[4], fluid[5], component.diameter
    area = 0.25 * math.pi * d**2
    first = builder.outputs.add((f"hydraulics.{component.name}.flow", "m^3/s", f"flow of {component.name}"))
    critical = CRITICAL_REYNOLDS * viscosity * area / d
    resistance = 128.0 * viscosity * component.length / (math.pi * d**4)
    columns = [first, builder.node(ends[0]), builder.node(ends[1])]
    if not component.inertia:
        builder.elements.add(flow_in_pipes, columns, [resistance, critical])
        return
    fact = StateFact(f"{component.name}.mass_flow", "kg/s", f"mass flow of {component.name}", 0.0, density * critical)
    without_bends = [resistance, critical, area / component.length, density, 0.0, 0.0, 0.0, 1e-3 * critical]
    builder.elements.add(flow_in_lines, [*columns, builder.own_state(fact), 0, 0], without_bends)


KINDS = (ComponentKind(Pipe, add_pipe, (flow_in_pipes, flow_in_lines), symbol=pipe),)
