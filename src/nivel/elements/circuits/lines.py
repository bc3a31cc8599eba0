"""Pipes, and long lines of segments: inertia of the fluid, and friction that depends on the frequency.

    l/A d(ṁ)/dt = p_a - p_b - Δp        Δp = g R ρ Q (1 + (Q/(g Q_c))⁶)^(1/8) + ζ ρ/(2 A²) Q |Q| + g U ρ Σ y_i

Its terms stand in `nivel.elements.circuits.line_friction`.
"""

import math
from collections.abc import Iterator
from math import pi
from typing import Any, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.curves import LengthExpansion, hose_points
from nivel.elements.circuits.delay_lines import add_delay, pass_waves
from nivel.elements.circuits.density import DENSITY, MODULUS, VISCOSITY, thickening
from nivel.elements.circuits.kind import ComponentKind, Phase, called, slopes_of
from nivel.elements.circuits.ledger import lose_between, transfer
from nivel.elements.circuits.line_friction import (
    BENDS,
    CRITICAL,
    CRITICAL_REYNOLDS,
    DECAY,
    KINETIC_DENSITY,
    RATES,
    RESISTANCE,
    SLENDER,
    SMALL,
    UNSTEADY,
    WEIGHTS,
    flow_ratio,
    loss,
    slope_of_loss,
    steady_loss,
)
from nivel.elements.circuits.nodes import NO_ACCUMULATOR, growth_of_walls, volume_node
from nivel.elements.circuits.restrictions import flowing
from nivel.elements.circuits.smooth import magnitude_within
from nivel.elements.circuits.symbol import pipe
from nivel.elements.circuits.tangent import add_by_pressure, add_flow_by_column, add_flow_by_pressure
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.record import record_at
from nivel.known import Node, Swept, SystemBuilder
from nivel.machine.core.coefficient import NotNegativeNumber, Truth
from nivel.machine.core.record import Name, Problem, entry, superfluous
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.units.quantity import Duration, Whole

MOST_SEGMENTS = 100


class Line(Component):
    """A long pipe or hose, with friction that depends on the frequency.

    segments : `segments` volumes NAME.1 … lie between A and B, with inertia between them; the first and the last flow pass half of one.
    delay : waves take their time from one end to the other (`nivel.elements.circuits.delay_lines`).
    """

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))
    nodes: ClassVar[tuple[str, ...]] = (".1",)
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B", "wave_A", "wave_B")

    type: Literal["line"] = "line"
    model: Literal["segments", "delay"] = Field("volumes, or waves that arrive later", default="segments")
    diameter: ranges.Bore = Field()
    diameter_B: Maybe[ranges.Bore] = Field("at B, where it changes evenly along the line", default=None)
    length: ranges.PipeLength = Field()
    segments: Whole = Field("number of its volumes, up to 100", default=10)
    sample_time: Duration = Field("of delay: between two samples of its waves", default=1e-3)
    mean_pressure: ranges.Level = Field(
        "of delay, absolute: at which its speed of sound and its density hold", default=1e7
    )
    unsteady_friction: Truth = Field("whether friction depends on the frequency (Zielke)", default=True)
    bends: NotNegativeNumber = Field("sum of the loss coefficients of bends and fittings", default=0.0)
    wall_modulus: Maybe[ranges.WallModulus] = Field("as of a volume", default=None)
    expansion: Maybe[OneRecord[LengthExpansion]] = Field(
        "growth of a hose over the pressure, in place of `wall_modulus`", default=None
    )
    start: Maybe[ranges.Level] = Field("pressure at the start; default: that of a steady circuit", default=None)
    fluid: Name | None = Field("default: the only one", default=None)

    def diameter_at(self, share: float) -> float:
        """[m] at a share of the length from A."""
        return self.diameter + share * ((self.diameter_B or self.diameter) - self.diameter)

    @property
    def areas_of_segments(self) -> list[float]:
        """[m²] in the middle of each."""
        return [0.25 * pi * self.diameter_at((k + 0.5) / self.segments) ** 2 for k in range(self.segments)]

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        if entry(data, "model") == "delay":
            return ()
        count = entry(data, "segments")
        return tuple(f".{k + 1}" for k in range(count if isinstance(count, int) else 10))

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        return cls.late if entry(data, "model") == "delay" else ("flow_A", "flow_B")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.model == "delay" and self.diameter_B is not None:
            yield superfluous("diameter_B", "belongs to `model: segments`; waves keep their size in one diameter")
        if self.model == "segments":
            for key in ("sample_time", "mean_pressure"):
                if getattr(self, key) != type(self).model_fields[key].default:
                    yield superfluous(key, "belongs to `model: delay`")
        if not 1 <= self.segments <= MOST_SEGMENTS:
            yield Problem(("segments",), f"1 to {MOST_SEGMENTS} segments were expected, got {self.segments}")
        if self.expansion is not None and self.wall_modulus is not None:
            yield superfluous("wall_modulus", "is of walls that grow evenly; `expansion` is a curve; give one of them")


# columns of `columns`; states: mass flow, then the z_i, one behind the other. Output: flow [m³/s]
OUTPUT, FROM, TO, STATE, FIRST_PART, PARTS = 0, 1, 2, 3, 4, 5


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
    for k, area in enumerate(component.areas_of_segments if component.model == "segments" else ()):
        size = area * length
        curve = hose_points(component.expansion, length)
        room = (size, growth_of_walls(size, component.wall_modulus), *NO_ACCUMULATOR, *curve)
        yield volume_node(builder, component, f"{component.name}.{k + 1}", f"_{k + 1}", room, component.start, swept)


def add_line(builder: SystemBuilder, component: Line) -> None:
    """The flows between A, the segments and B, or the waves between A and B."""
    if component.model == "delay":
        return add_delay(builder, component)
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
    return None


def _friction_terms(component: Line, fluid: tuple[float, ...]) -> int:
    """How many exponentials are slower than the segments can vibrate, and the next one."""
    length, d = component.length / component.segments, component.diameter
    fastest = 2.0 * math.sqrt(fluid[MODULUS] / fluid[DENSITY]) / length
    slower = [rate for rate in RATES if rate * 4.0 * fluid[VISCOSITY] / d**2 < fastest]
    return min(len(slower) + 1, len(RATES))


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
    inertia: Truth = Field("whether the flow has inertia: a state", default=False)


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
def add_slopes_of_pipes(machine, index, n, t):
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
    fluid = builder.circuit.fluids[flowing(builder, component).fluid]
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


KINDS = (
    ComponentKind(Line, add_line, (flow_in_lines, pass_waves), symbol=pipe, nodes=line_nodes),
    ComponentKind(Pipe, add_pipe, (flow_in_pipes, flow_in_lines), symbol=pipe),
)
