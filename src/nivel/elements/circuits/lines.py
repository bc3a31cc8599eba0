"""Flows of long lines between their segments, and of pipes with inertia: inertia of the fluid, and friction that depends on the frequency.

    l/A d(ṁ)/dt = p_a - p_b - Δp        Δp = g R ρ Q (1 + (Q/(g Q_c))⁶)^(1/8) + ζ ρ/(2 A²) Q |Q| + g U ρ Σ y_i

g is the growth of the viscosity with pressure and temperature (`nivel.elements.circuits.density`).
The first part is the loss of a round pipe, Hagen and Poiseuille's for Q ≪ Q_c and Blasius's, Δp ~ Q^(7/4), for Q ≫ Q_c; both meet at
Reynolds' number 1187, Q_c. The second one is that of bends. The third one is the difference of laminar
friction to that of a steady flow (Zielke 1968), with his weight as a sum of exponentials (Trikha 1975), those of Kagawa, Lee, Kitagawa
and Takenaka 1983:

    y_i = z_i + m_i Q        ż_i = -n_i g κ (z_i + m_i Q)        κ = 4 ν/d²        U = 16 ν l/(d² A)
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from math import pi
from typing import Any, ClassVar, Literal

import numpy as np

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.curves import LengthExpansion, hose_points
from nivel.elements.circuits.density import DENSITY, MODULUS, VISCOSITY, thickening
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.ledger import lose_between, transfer
from nivel.elements.circuits.nodes import NO_ACCUMULATOR, growth_of_walls, volume_node
from nivel.elements.circuits.phase import Phase, called, slopes_of
from nivel.elements.circuits.smooth import magnitude_within
from nivel.elements.circuits.symbol import pipe
from nivel.elements.circuits.tangent import add_by_pressure, add_flow_by_column
from nivel.elements.rows import element
from nivel.elements.states import StateFact
from nivel.kernels.record.record import record_at
from nivel.known import Node, Swept, SystemBuilder
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import NotNegativeNumber, Truth
from nivel.machine.core.record import Name, entry
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.units.quantity import Whole
from nivel.native.function import leaf

MOST_SEGMENTS, MOST_ITERATIONS = 100, 50
CRITICAL_REYNOLDS = (0.3164 / 64.0) ** (-4.0 / 3.0)  # where 64/Re is 0.3164 Re^(-1/4)


class Line(Component):
    """A long pipe or hose in segments, each a volume, with inertia and friction that depends on the frequency between them.

    `segments` volumes NAME.1 … lie between A and B; the first and the last flow pass half of one.
    """

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))
    nodes: ClassVar[tuple[str, ...]] = (".1",)
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B")

    type: Literal["line"] = "line"
    diameter: ranges.Bore = Field()
    diameter_B: Maybe[ranges.Bore] = Field(default=None, description="at B, where it changes evenly along the line")
    length: ranges.PipeLength = Field()
    segments: Whole = Field(default=10, description="number of its volumes, up to 100")
    unsteady_friction: Truth = Field(default=True, description="whether friction depends on the frequency (Zielke)")
    bends: NotNegativeNumber = Field(default=0.0, description="sum of the loss coefficients of bends and fittings")
    wall_modulus: Maybe[ranges.WallModulus] = Field(default=None, description="as of a volume")
    expansion: Maybe[OneRecord[LengthExpansion]] = Field(
        default=None, description="growth of a hose over the pressure, in place of `wall_modulus`"
    )
    start: Maybe[ranges.Level] = Field(
        default=None, description="pressure at the start; default: that of a steady circuit"
    )
    fluid: Name | None = Field(default=None, description="default: the only one")

    def diameter_at(self, share: float) -> float:
        """[m] at a share of the length from A."""
        return self.diameter + share * ((self.diameter_B or self.diameter) - self.diameter)

    @property
    def areas_of_segments(self) -> list[float]:
        """[m²] in the middle of each."""
        return [0.25 * pi * self.diameter_at((k + 0.5) / self.segments) ** 2 for k in range(self.segments)]

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        count = entry(data, "segments")
        return tuple(f".{k + 1}" for k in range(count if isinstance(count, int) else 10))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not 1 <= self.segments <= MOST_SEGMENTS:
            yield Problem(("segments",), f"1 to {MOST_SEGMENTS} segments were expected, got {self.segments}")
        if self.expansion is not None and self.wall_modulus is not None:
            yield superfluous("wall_modulus", "is of walls that grow evenly; `expansion` is a curve; give one of them")


# columns of `columns`; states: mass flow, then the z_i, one behind the other. Output: flow [m³/s]
OUTPUT, FROM, TO, STATE, FIRST_PART, PARTS = 0, 1, 2, 3, 4, 5
# columns of `number`: R over ρ, Q_c [m³/s], A/l [m], density of the kinetic energy [kg/m³], ζ/(2 A²) [1/m⁴], U, κ [1/s], flow within which
# |Q| is rounded [m³/s]
RESISTANCE, CRITICAL, SLENDER, KINETIC_DENSITY, BENDS, UNSTEADY, DECAY, SMALL = range(8)
# n_i and m_i
RATES = np.array((26.3744, 72.8033, 187.424, 536.626, 1570.60, 4618.13, 13601.1, 40082.5, 118153.0, 348316.0))
WEIGHTS = np.array((1.0, 1.16725, 2.20064, 3.92861, 6.78788, 11.6761, 20.0612, 34.4541, 59.1642, 101.590))


@leaf
def loss(n, g, density, flow):
    """Δp [Pa] of the volume flow; g is the growth of the viscosity."""
    ratio = flow / (n[CRITICAL] * g)
    square = ratio * ratio
    return n[RESISTANCE] * g * density * flow * np.sqrt(np.sqrt(np.sqrt(1.0 + square * square * square)))


@leaf
def slope_of_loss(n, g, flow):
    """∂Δp/∂Q over the density."""
    sixth = (flow / (n[CRITICAL] * g)) ** 6
    return n[RESISTANCE] * g * (1.0 + sixth) ** 0.125 * (1.0 + 0.75 * sixth / (1.0 + sixth))


@leaf
def flow_ratio(y):
    """The real x with x (1 + x⁶)^(1/8) = y, by Newton's method from above."""
    size = np.abs(y)
    x = size if size < 1.0 else size ** (4.0 / 7.0)
    for _ in range(MOST_ITERATIONS):
        sixth = x**6
        root = (1.0 + sixth) ** 0.125
        change = (x * root - size) / (root * (1.0 + 0.75 * sixth / (1.0 + sixth)))
        x -= change
        if np.abs(change) <= 1e-12 * x + 1e-300:
            break
    return x if y > 0.0 else -x


@leaf
def steady_loss(n, g, density, flow):
    """Δp [Pa] of a steady flow."""
    return loss(n, g, density, flow) + n[BENDS] * density * flow * magnitude_within(flow, n[SMALL])


@called(Phase.FLOWS, 9)
@element
def flow_in_lines(machine, index, n, t):
    """Rates of the flows of lines, and of what their friction remembers."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    a, b = index[FROM], index[TO]
    density, g = 0.5 * (circuit.density[a] + circuit.density[b]), thickening(circuit, a, b)
    mass_flow = elements.state[index[STATE]]
    flow = mass_flow / density
    total = 0.0 * flow
    for i in range(index[PARTS]):
        own = index[FIRST_PART] + i
        part = elements.state[own] + WEIGHTS[i] * flow
        total += part
        elements.state_rate[own] -= RATES[i] * n[DECAY] * g * part
    driving = circuit.pressure[a] - circuit.pressure[b] - steady_loss(n, g, density, flow)
    driving -= n[UNSTEADY] * g * density * total
    elements.state_rate[index[STATE]] += n[SLENDER] * driving
    stored = 0.5 * mass_flow * mass_flow / (n[SLENDER] * n[KINETIC_DENSITY])
    circuit.stored[0] += stored
    record.control.stored[0] += stored
    power = transfer(machine, a, b, mass_flow) - mass_flow * driving / n[KINETIC_DENSITY]
    lose_between(machine, a, b, mass_flow, power)
    record.outputs.value[index[OUTPUT]] = flow


@slopes_of(flow_in_lines)
@element
def add_slopes(machine, index, n, t):
    """Slopes of flows and of what their friction remembers."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    tangent = circuit.tangent
    a, b = index[FROM], index[TO]
    density, g = 0.5 * (circuit.density[a] + circuit.density[b]), thickening(circuit, a, b)
    flow = value[index[OUTPUT]]
    steady = slope_of_loss(n, g, flow)
    steady += 2.0 * n[BENDS] * magnitude_within(flow, n[SMALL])
    own = tangent.unknown[index[STATE]]
    row = tangent.slopes[own]
    add_by_pressure(circuit, row, a, n[SLENDER])
    add_by_pressure(circuit, row, b, -n[SLENDER])
    row[own] -= n[SLENDER] * steady
    for i in range(index[PARTS]):
        part = tangent.unknown[index[FIRST_PART] + i]
        row[part] -= n[SLENDER] * n[UNSTEADY] * g * density
        row[own] -= n[SLENDER] * n[UNSTEADY] * g * WEIGHTS[i]
        decay = RATES[i] * n[DECAY] * g
        tangent.slopes[part, part] -= decay
        tangent.slopes[part, own] -= decay * WEIGHTS[i] / density
    add_flow_by_column(circuit, a, b, own, 1.0)


def line_nodes(builder: SystemBuilder, component: Line, swept: Swept) -> Iterator[Node]:
    """The volumes of the segments of a line."""
    length = component.length / component.segments
    for k, area in enumerate(component.areas_of_segments):
        size = area * length
        curve = hose_points(component.expansion, length)
        room = (size, growth_of_walls(size, component.wall_modulus), *NO_ACCUMULATOR, *curve)
        yield volume_node(builder, component, f"{component.name}.{k + 1}", f"_{k + 1}", room, component.start, swept)


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
        builder.elements.add(flow_in_lines, columns, numbers)


def _friction_terms(component: Line, fluid: tuple[float, ...]) -> int:
    """How many exponentials are slower than the segments can vibrate, and the next one."""
    length, d = component.length / component.segments, component.diameter
    fastest = 2.0 * math.sqrt(fluid[MODULUS] / fluid[DENSITY]) / length
    slower = [rate for rate in RATES if rate * 4.0 * fluid[VISCOSITY] / d**2 < fastest]
    return min(len(slower) + 1, len(RATES))


KINDS = (ComponentKind(Line, add_line, (flow_in_lines,), symbol=pipe, nodes=line_nodes),)
