"""Directional valves, whose spool follows a command."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, problem_of_share
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.phase import Phase, called, slopes_of
from nivel.elements.circuits.poppets import COMMAND, OUTPUT, SPEED, STATE
from nivel.elements.circuits.restrictions import EDGE, MIDDLE, add_flow, rated, restrict
from nivel.elements.circuits.smooth import clipped
from nivel.elements.circuits.spools import Switching, add_switch, switch
from nivel.elements.circuits.symbol import Symbol
from nivel.elements.circuits.ways import CENTRED, EDGES, PORTS, Centre, Ways, centre_pairs, directional_valve
from nivel.elements.rows import element
from nivel.elements.states import StateFact
from nivel.kernels.algebra.analytic import tanh
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.lazy import replace
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Leakage, PositiveNumber, Share
from nivel.machine.core.record import entry
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Quantity, Rate, fault

if TYPE_CHECKING:
    from nivel.elements.circuits.sections import Section
    from nivel.system.builder import SystemBuilder


def _overlap(value: float) -> float:
    if not -0.5 < value < 0.9:
        raise fault(f"a share of the stroke from -0.5 (underlap) to 0.9 (overlap) was expected, got {value:g}")
    return value


class DirectionalValve(Rated):
    """A spool that joins P and T with A and B; with five ways R is the outlet of A, S that of B. `command` is its position: -1 to 1 of
    valves with a centre, 4/3 and 5/3, 0 to 1 of others.

    `flow` at `pressure_drop` is that of one edge at a full stroke; a sheet that states a drop over the whole valve means two edges.
    """

    functions: ClassVar[tuple[str, ...]] = ("command",)
    gases: ClassVar[bool] = True
    loads: ClassVar[bool] = True
    early: ClassVar[tuple[str, ...]] = ()
    late: ClassVar[tuple[str, ...]] = ("position", "flow_PA", "flow_PB", "flow_AT", "flow_BT", "flow_AR", "flow_BS")

    type: Literal["directional-valve"] = "directional-valve"
    ways: Ways = Field(description="ports and positions: 2/2, 3/2, 4/2, 4/3, 5/2 or 5/3")
    command: Annotated[OneFunction, varying("number")] = Field(description="position asked for")
    overlap: Annotated[OneNumber, Quantity("number"), AfterValidator(_overlap)] = Field(
        default=0.0, description="share of the stroke before an edge opens; negative: edges are open at the centre"
    )
    rounding: Share = Field(default=0.02, description="share of the stroke over which an edge begins to open")
    centre: Centre = Field(default="closed", description="what is joined at the centre of a 4/3 or 5/3 valve")
    frequency: Maybe[ranges.SpoolFrequency] = Field(
        default=None, description="natural frequency of the spool; default: no lag"
    )
    damping_ratio: PositiveNumber = Field(default=0.8, description="of the spool")
    rate_limit: Maybe[Rate] = Field(default=None, description="greatest speed of the spool, full strokes per second")
    leakage: Leakage = Field(default=0.0, description="of each edge")
    switching: Maybe[OneRecord[Switching]] = Field(
        default=None, description="whether it is on or off alone, with its delays; `command` then counts above one half"
    )

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        ways, centre = str(entry(data, "ways")), str(entry(data, "centre") or "closed")
        pairs = [edge for edges in EDGES.get(ways, ()) for edge in edges]
        pairs += [edge for edge in centre_pairs(ways, centre) if edge not in pairs]
        return ("position", *(f"flow_{pair}" for pair in pairs))

    @property
    def edges(self) -> tuple[str, ...]:
        """All edges, as pairs of ports."""
        return (*EDGES[self.ways][0], *EDGES[self.ways][1])

    def problems(self) -> Iterator[Problem]:
        yield from self.problems_of_ports(PORTS[self.ways])
        yield from self.problems_of_rating()
        yield from problem_of_share("command", self.command, -1.0 if self.ways in CENTRED else 0.0)
        if self.centre != "closed" and self.ways not in CENTRED:
            yield superfluous("centre", f"belongs to a 4/3 or 5/3 valve, not to {self.ways}")
        if self.ways == "5/3" and self.centre in ("tandem", "open"):
            yield Problem(("centre",), f"a 5/3 valve has the centre `closed` or `float`, got `{self.centre}`")
        if self.overlap + self.rounding > 1.0:
            yield Problem(
                ("rounding",), "an edge would not open within the stroke: overlap and rounding are more than 1"
            )
        if self.switching is not None and self.frequency is not None:
            yield superfluous("frequency", "belongs to a proportional valve; `switching` states how this one moves")
        if self.rate_limit is not None and self.frequency is None:
            yield Problem((), "`frequency` is missing: a spool with a `rate_limit` follows its command with it")


# spools: columns of `number`: least position, natural frequency [rad/s], damping ratio, greatest speed [1/s] (0: second order)
LEAST, FREQUENCY, DAMPING, RATE = 0, 1, 2, 3


@called(Phase.POSITIONS, 1)
@element
def move(machine, index, n, t):
    """Spools: at the command itself, or ü = ω² (u_c - u) - 2 ζ ω u̇, or with a greatest speed r, u̇ = r tanh(ω (u_c - u)/r)."""
    record = record_at(machine)
    elements = record.elements
    command = clipped(evaluate_function(machine, index[COMMAND], t), n[LEAST])
    if index[STATE] == NONE:
        record.outputs.value[index[OUTPUT]] = command
        return
    own, omega, rate = index[STATE], n[FREQUENCY], elements.state_rate
    u = elements.state[own]
    if index[SPEED] == NONE:
        rate[own] += n[RATE] * tanh(omega * (command - u) / n[RATE])
    else:
        speed = elements.state[index[SPEED]]
        rate[own] += speed
        rate[index[SPEED]] += omega * omega * (command - u) - 2.0 * n[DAMPING] * omega * speed
    record.outputs.value[index[OUTPUT]] = u


@slopes_of(move)
@element
def add_slopes_of_spools(machine, index, n, t):
    """Slopes of the positions and speeds of spools, for commands that do not depend on the state."""
    record = record_at(machine)
    elements, tangent = record.elements, record.circuit.tangent
    if index[STATE] == NONE:
        return
    own, omega = tangent.unknown[index[STATE]], n[FREQUENCY]
    if index[SPEED] == NONE:
        share = elements.state_rate[index[STATE]] / n[RATE]
        tangent.slopes[own, own] -= omega * (1.0 - share * share)
    else:
        speed = tangent.unknown[index[SPEED]]
        tangent.slopes[own, speed] += 1.0
        tangent.slopes[speed, own] -= omega * omega
        tangent.slopes[speed, speed] -= 2.0 * n[DAMPING] * omega


def add_directional(builder: SystemBuilder, component: DirectionalValve) -> None:
    """The spool, and its edges."""
    position = _add_spool(builder, component)
    forward, back = EDGES[component.ways]
    for pairs, sign in ((forward, 1.0), (back, -1.0)):
        for pair in pairs:
            _add_edge(builder, component, pair, position, _slope(component.ways, sign, component.overlap))
    for pair in centre_pairs(component.ways, component.centre):
        quantity = f"flow_{pair}" if pair not in component.edges else f"centre_flow_{pair}"
        width = max(component.overlap, component.rounding)
        numbers = [*rated(component, 0.0), 0.0, 0.0, width]
        add_flow(builder, component.name, quantity, _ends(component, pair), numbers, (MIDDLE, position))


def _slope(ways: str, sign: float, overlap: float) -> tuple[float, float]:
    """(factor, shift) of z = factor u + shift, which opens an edge where it is positive."""
    if ways in (*CENTRED, "2/2"):
        return sign, -overlap
    return 2.0 * sign, -sign - overlap


def _add_edge(
    builder: SystemBuilder, component: DirectionalValve, pair: str, position: int, slope: tuple[float, float]
) -> None:
    full = 1.0 - component.overlap - 0.5 * component.rounding  # ramp of a full stroke
    numbers = [*rated(component, component.leakage), *slope, component.rounding, 1.0 / full]
    add_flow(builder, component.name, f"flow_{pair}", _ends(component, pair), numbers, (EDGE, position))


def _ends(component: DirectionalValve, pair: str) -> tuple[str, str]:
    return component.ports[pair[0]], component.ports[pair[1]]


def _add_spool(builder: SystemBuilder, component: DirectionalValve) -> int:
    """The output that is the position of the spool."""
    name = component.name
    output = builder.outputs.add((f"hydraulics.{name}.position", "1", f"position of {name}"))
    if component.switching is not None:
        add_switch(builder, name, output, component.command, component.switching, component.ways in CENTRED)
        return output
    add_spool(builder, component, output, -1.0 if component.ways in CENTRED else 0.0, component.rate_limit)
    return output


def add_spool(
    builder: SystemBuilder,
    component: DirectionalValve | Section,
    output: int,
    least: float,
    rate_limit: float | None = None,
) -> None:
    """A spool whose position is this output, from `least` on."""
    name, state, speed = component.name, NONE, NONE
    if component.frequency is not None:
        state = builder.own_state(StateFact(f"{name}.spool", "1", f"position of {name}", 0.0, 1.0))
        if rate_limit is None:
            words = f"speed of {name}"
            speed = builder.own_state(StateFact(f"{name}.spool_speed", "1/s", words, 0.0, frequency(component)))
    columns = [output, state, speed, builder.function(component.command)]
    builder.elements.add(move, columns, [least, frequency(component), component.damping_ratio, rate_limit or 0.0])


def frequency(component: DirectionalValve | Section) -> float:
    """[rad/s] natural frequency of the spool; 0 without one."""
    return 2.0 * math.pi * (component.frequency or 0.0)


OF_SPOOLS = (move, switch, restrict)


def directional(data: Mapping[str, Any]) -> Symbol:
    """A directional valve."""
    return replace(directional_valve(data), settings=(str(data["ways"]),))


KINDS = (ComponentKind(DirectionalValve, add_directional, OF_SPOOLS, symbol=directional),)
