"""Flows between the segments of tubes of gas: inertia of the gas and the friction of its pipe, steady at every instant.

    l/A d(ṁ)/dt = p_a - p_b - Δp        Δp = 128 μ l/(π d⁴) ṁ/ρ (1 + (ṁ/ṁ_c)⁶)^(1/8) + ζ/(2 A²) ṁ |ṁ|/ρ

laminar below ṁ_c and turbulent above it (Blasius), as `nivel.elements.circuits.lines`. With the volumes of the segments, in which
the gas is compressed without heat, waves run with √(κ R T).
"""

import math
from collections.abc import Iterator
from typing import Any, ClassVar, Literal

import numpy as np

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.density import DENSITY
from nivel.elements.circuits.gases import REFERENCE
from nivel.elements.circuits.kind import ComponentKind, Phase, called
from nivel.elements.circuits.ledger import lose, transfer
from nivel.elements.circuits.line_friction import CRITICAL_REYNOLDS
from nivel.elements.circuits.lines import MOST_SEGMENTS
from nivel.elements.circuits.nodes import NO_ACCUMULATOR, volume_node
from nivel.elements.circuits.restrictions import REFERENCE_ROOT, carry_heat
from nivel.elements.circuits.smooth import magnitude_within
from nivel.elements.circuits.symbol import pipe
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.kernels.record.record import record_at
from nivel.known import Node, Swept, SystemBuilder
from nivel.machine.core.coefficient import NotNegativeNumber
from nivel.machine.core.record import Name, Problem, entry
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import Whole

AIR_VISCOSITY = 18.2e-6  # Pa s, at 20 °C


class Tube(Component):
    """A tube of gas in segments, with the inertia and friction of the gas between them: pressure waves run through it with √(κ R T)."""

    gases: ClassVar[bool] = True
    liquids: ClassVar[bool] = False
    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))
    nodes: ClassVar[tuple[str, ...]] = (".1",)
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B")

    type: Literal["tube"] = "tube"
    diameter: ranges.Bore = Field("inside")
    length: ranges.PipeLength = Field()
    segments: Whole = Field("number of its volumes, up to 100", default=10)
    bends: NotNegativeNumber = Field("sum of the loss coefficients of bends and fittings", default=0.0)
    heat_transfer: ranges.WallTransfer = Field(
        "heat over the area of its walls and the difference of temperature", default=0.0
    )
    start: Maybe[ranges.Level] = Field("pressure at the start; default: that of a steady circuit", default=None)
    fluid: Name | None = Field("default: the only one", default=None)

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        count = entry(data, "segments")
        return tuple(f".{k + 1}" for k in range(count if isinstance(count, int) else 10))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not 1 <= self.segments <= MOST_SEGMENTS:
            yield Problem(("segments",), f"1 to {MOST_SEGMENTS} segments were expected, got {self.segments}")


# columns of `columns`; output: flow at the reference of ISO 8778 [m³/s]
OUTPUT, FROM, TO, STATE = 0, 1, 2, 3
# columns of `number`: 128 μ l/(π d⁴), ṁ_c [kg/s], A/l [m], density of the kinetic energy [kg/m³], ζ/(2 A²) [1/m⁴]
RESISTANCE, CRITICAL, SLENDER, KINETIC_DENSITY, BENDS = range(5)
ROUNDED = 1e-3  # of ṁ_c, within which |ṁ| is rounded


@called(Phase.FLOWS, 8)
@element
def flow_in_tubes(machine, index, n, t):
    """Rates of the flows of tubes."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    a, b = index[FROM], index[TO]
    specific = 2.0 / (circuit.density[a] + circuit.density[b])
    mass_flow = elements.state[index[STATE]]
    ratio = mass_flow * (1.0 / n[CRITICAL])
    square = ratio * ratio
    turbulent = np.sqrt(np.sqrt(np.sqrt(1.0 + square * square * square)))
    loss = n[RESISTANCE] * mass_flow * specific * turbulent
    loss += n[BENDS] * mass_flow * specific * magnitude_within(mass_flow, ROUNDED * n[CRITICAL])
    driving = circuit.pressure[a] - circuit.pressure[b] - loss
    elements.state_rate[index[STATE]] += n[SLENDER] * driving
    stored = 0.5 * mass_flow * mass_flow / (n[SLENDER] * n[KINETIC_DENSITY])
    circuit.stored[0] += stored
    record.control.stored[0] += stored
    given = transfer(machine, a, b, mass_flow) - carry_heat(machine, a, b, mass_flow)
    lose(machine, given - mass_flow * driving / n[KINETIC_DENSITY])
    f = circuit.fluid[circuit.node[a, 0]]
    record.outputs.value[index[OUTPUT]] = mass_flow * REFERENCE_ROOT / f[REFERENCE]


def tube_nodes(builder: SystemBuilder, component: Tube, swept: Swept) -> Iterator[Node]:
    """The volumes of the segments of a tube of gas."""
    length = component.length / component.segments
    room = (0.25 * math.pi * component.diameter**2 * length, 0.0, *NO_ACCUMULATOR)
    walls = component.heat_transfer * math.pi * component.diameter * length
    for k in range(component.segments):
        name = f"{component.name}.{k + 1}"
        yield volume_node(builder, component, name, f"_{k + 1}", room, component.start, swept, (walls, 0.0))


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
        builder.elements.add(flow_in_tubes, columns, numbers)


KINDS = (ComponentKind(Tube, add_tube, (flow_in_tubes,), symbol=pipe, nodes=tube_nodes),)
