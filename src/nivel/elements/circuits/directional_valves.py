"""Directional valves, whose spool follows a command: their ways, and the symbol of these, a box for each position."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from math import hypot
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal

from pydantic import AfterValidator

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, problem_of_share
from nivel.elements.circuits.kind import ComponentKind, Phase, called, slopes_of
from nivel.elements.circuits.poppets import COMMAND, OUTPUT, SPEED, STATE
from nivel.elements.circuits.restrictions import EDGE, MIDDLE, add_flow, rated, restrict
from nivel.elements.circuits.smooth import clipped
from nivel.elements.circuits.spools import Switching, add_switch, switch
from nivel.elements.circuits.symbol import Symbol, path
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import tanh
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.lazy import replace
from nivel.machine.core.coefficient import Leakage, PositiveNumber, Share
from nivel.machine.core.record import Problem, entry, superfluous
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


Ways = Literal["2/2", "3/2", "4/2", "4/3", "5/2", "5/3"]
Centre = Literal["closed", "tandem", "open", "float"]


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
    ways: Ways = Field("ports and positions: 2/2, 3/2, 4/2, 4/3, 5/2 or 5/3")
    command: Annotated[OneFunction, varying("number")] = Field("position asked for")
    overlap: Annotated[OneNumber, Quantity("number"), AfterValidator(_overlap)] = Field(
        "share of the stroke before an edge opens; negative: edges are open at the centre", default=0.0
    )
    rounding: Share = Field("share of the stroke over which an edge begins to open", default=0.02)
    centre: Centre = Field("what is joined at the centre of a 4/3 or 5/3 valve", default="closed")
    frequency: Maybe[ranges.SpoolFrequency] = Field("natural frequency of the spool; default: no lag", default=None)
    damping_ratio: PositiveNumber = Field("of the spool", default=0.8)
    rate_limit: Maybe[Rate] = Field("greatest speed of the spool, full strokes per second", default=None)
    leakage: Leakage = Field("of each edge", default=0.0)
    switching: Maybe[OneRecord[Switching]] = Field(
        "whether it is on or off alone, with its delays; `command` then counts above one half", default=None
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
        add_flow(builder, component, quantity, (pair[0], pair[1]), numbers, (MIDDLE, position))


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
    add_flow(builder, component, f"flow_{pair}", (pair[0], pair[1]), numbers, (EDGE, position))


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


PORTS: Final[dict[str, tuple[str, ...]]] = {
    "2/2": ("P", "A"),
    "3/2": ("P", "T", "A"),
    "4/2": ("P", "T", "A", "B"),
    "4/3": ("P", "T", "A", "B"),
    "5/2": ("P", "A", "B", "R", "S"),
    "5/3": ("P", "A", "B", "R", "S"),
}
# valves with a centre, whose positions go from -1 to 1
CENTRED: Final = ("4/3", "5/3")
# edges that open with a position from 0 to 1 (of centred valves), with one from 0 to -1 (of others: that close towards 1)
EDGES: Final[dict[str, tuple[tuple[str, ...], tuple[str, ...]]]] = {
    "2/2": (("PA",), ()),
    "3/2": (("PA",), ("AT",)),
    "4/2": (("PA", "BT"), ("PB", "AT")),
    "4/3": (("PA", "BT"), ("PB", "AT")),
    "5/2": (("PA", "BS"), ("PB", "AR")),
    "5/3": (("PA", "BS"), ("PB", "AR")),
}
CENTRES: Final[dict[str, tuple[str, ...]]] = {
    "closed": (),
    "tandem": ("PT",),
    "open": ("PT", "AT", "BT"),
    "float": ("AT", "BT"),
}
OF_FIVE: Final = {"AT": "AR", "BT": "BS"}  # outlets of A and B in valves with five ports


def centre_pairs(ways: str, centre: str) -> tuple[str, ...]:
    """Pairs of ports that are joined at the centre."""
    pairs = CENTRES.get(centre, ())
    return tuple(OF_FIVE.get(pair, pair) for pair in pairs) if ways == "5/3" else pairs


BOX, STUB = 30.0, 6.0  # side of a box; a line that ends in it
# x of ports from the middle of a box: those above it and those below
TOP: Final = {"2/2": {"A": 0.0}, "3/2": {"A": -8.0}}
BOTTOM: Final = {"2/2": {"P": 0.0}, "5/2": {"R": -11.0, "P": 0.0, "S": 11.0}}
USUAL_TOP: Final = {"A": -8.0, "B": 8.0}
USUAL_BOTTOM: Final = {"P": -8.0, "T": 8.0}


def directional_valve(data: Mapping[str, Any]) -> Symbol:
    """A valve, whose lines meet the box of its rest."""
    ways, centred = str(data["ways"]), data["ways"] in CENTRED
    forward, back = EDGES[ways]
    groups = [forward, centre_pairs(ways, str(data.get("centre") or "closed")), back] if centred else [forward, back]
    top, bottom = TOP.get(ways, USUAL_TOP), BOTTOM.get(ways.replace("5/3", "5/2"), USUAL_BOTTOM)
    drawn = boxes(groups, top, bottom, BOX)
    if not centred:
        return replace(drawn, wide=drawn.wide - 12.0)
    end, high = drawn.wide - 26.0, 0.5 * BOX + 3.0
    proportional = path(f"M{-end:g} {-high:g} H{end:g} M{-end:g} {high:g} H{end:g}")
    return replace(drawn, body=drawn.body + proportional) if data.get("frequency") is not None else drawn


def spool(groups: Sequence[Sequence[tuple[str, str]]], top: Sequence[str], bottom: Sequence[str]) -> Symbol:
    """A spool with any ports. groups : pairs that it joins in each box."""
    wide = max(BOX, 16.0 * max(len(top), len(bottom), 2))

    def spread(side: Sequence[str]) -> dict[str, float]:
        step = wide / max(len(side), 1) if len(side) > 2 else 16.0
        return {port: step * (k - 0.5 * (len(side) - 1)) for k, port in enumerate(side)}

    return boxes(groups, spread(top), spread(bottom), wide)


def boxes(
    groups: Sequence[Sequence[str | tuple[str, str]]],
    top: Mapping[str, float],
    bottom: Mapping[str, float],
    wide: float,
) -> Symbol:
    """A box for each group of joined pairs, the second at rest. top, bottom : x of ports from the middle of a box of this width.

    With three boxes solenoids act on both sides, and springs centre it.
    """
    first, high = -0.5 * wide * (len(groups) - 1), 0.5 * BOX
    rest, end = first + wide, 0.5 * wide * len(groups)
    body = "".join(line for k, pairs in enumerate(groups) for line in _box(first + k * wide, wide, pairs, top, bottom))
    body += "".join(path(f"M{rest + x:g} {-high:g} v-6") for x in top.values())
    body += "".join(path(f"M{rest + x:g} {high:g} v6") for x in bottom.values())
    body += _solenoid(-end, -1.0)
    if len(groups) > 2:
        body += _solenoid(end, 1.0) + _centring(-end, -1.0) + _centring(end, 1.0)
    else:
        body += path(f"M{end:g} 0 l2 -5 l3 10 l3 -10 l3 10 l2 -5")
    above, below = ({port: rest + x for port, x in side.items()} for side in (top, bottom))
    return Symbol(body, end + 26.0, high + 6.0, above, below, "valve")


def _box(
    x: float, wide: float, pairs: Sequence[str | tuple[str, str]], top: Mapping[str, float], bottom: Mapping[str, float]
) -> Iterator[str]:
    """A box with arrows of what it joins and stubs of what it closes."""
    high = 0.5 * BOX
    yield path(f"M{x - 0.5 * wide:g} {-high:g} h{wide:g} v{BOX:g} h{-wide:g} z")
    place = {port: (x + at, -high) for port, at in top.items()} | {port: (x + at, high) for port, at in bottom.items()}
    for a, b in pairs:
        yield _way(place[a], place[b])
    joined = {port for pair in pairs for port in pair}
    for port, (px, py) in place.items():
        if port not in joined:
            yield path(f"M{px:g} {py:g} v{STUB if py < 0.0 else -STUB:g} m-3 0 h6")


def _way(start: tuple[float, float], end: tuple[float, float]) -> str:
    """An arrow between two ports; where both are below, a line through the box."""
    (x0, y0), (x1, y1) = start, end
    if y0 == y1:
        return path(f"M{x0:g} {y0:g} V0 H{x1:g} V{y1:g}")
    length = hypot(x1 - x0, y1 - y0)
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    bx, by = x1 - 6.0 * ux, y1 - 6.0 * uy
    tip = f"M{x1:g} {y1:g} L{bx - 2.6 * uy:.1f} {by + 2.6 * ux:.1f} L{bx + 2.6 * uy:.1f} {by - 2.6 * ux:.1f} z"
    return path(f"M{x0:g} {y0:g} L{bx:.1f} {by:.1f}") + path(tip, "full")


def _solenoid(x: float, side: float) -> str:
    return path(f"M{x:g} -6 h{12 * side:g} v12 h{-12 * side:g} M{x + 3 * side:g} 6 l{6 * side:g} -12")


def _centring(x: float, side: float) -> str:
    """A spring beside a solenoid."""
    at = x + 12 * side
    return path(f"M{at:g} 0 l{2 * side:g} -5 l{3 * side:g} 10 l{3 * side:g} -10 l{3 * side:g} 10 l{side:g} -5")


KINDS = (ComponentKind(DirectionalValve, add_directional, OF_SPOOLS, symbol=directional),)
