"""Spool valves from catalogues in words: every edge has curves of its own, and the spool a solenoid, springs and the force of the flow."""

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, BeforeValidator

from nivel.elements.circuits import ranges, spools
from nivel.elements.circuits.component import Component, problem_of_share
from nivel.elements.circuits.curves import Curve, held_curve
from nivel.elements.circuits.directional_valves import spool
from nivel.elements.circuits.edges import MOST_EDGES, Edge, meter, push
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.symbol import Symbol
from nivel.kernels.record.record import NONE
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import NotNegativeNumber, PositiveNumber
from nivel.machine.core.record import Problem, entry, superfluous
from nivel.machine.given import Field, Given, Maybe, OneNumber, OneRecord
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.laws.varying_value import Table
from nivel.machine.units.quantity import PositiveLength, Quantity, fault
from nivel.machine.uses.coordinate_reference import CoordinateReference

PORTS = ("P", "T", "A", "B", "C", "R", "S", "LS")


def _edges(value: Any) -> Any:
    if not isinstance(value, Mapping) or not value:
        raise fault("a mapping of pairs of ports such as {PA: {…}, AT: {…}} was expected")
    if len(value) > MOST_EDGES:
        raise fault(f"at most {MOST_EDGES} edges were expected, got {len(value)}")
    return value


def _pair(value: str) -> str:
    if ends_of(value) is None:
        known = ", ".join(PORTS)
        raise fault(f"two of the ports {known} were expected, such as `PA` or `ALS`, got `{value}`")
    return value


def ends_of(pair: str) -> tuple[str, str] | None:
    """The two ports that an edge joins; None where they are none."""
    for at in (1, 2):
        if pair[:at] in PORTS and pair[at:] in PORTS and pair[:at] != pair[at:]:
            return pair[:at], pair[at:]
    return None


Edges = Annotated[
    Given[dict[Annotated[str, AfterValidator(_pair)], Edge], dict[str, Edge], Mapping[str, Edge | Mapping[str, Any]]],
    BeforeValidator(_edges),
]


class SpoolValve(Component):
    """A spool whose edges have the curves of a catalogue, each its own. Its position goes from -1 to 1.

    It follows a `command`, the `current` of a solenoid against springs, the `coordinate` of a spool that is a body, or it is `switching`.
    """

    functions: ClassVar[tuple[str, ...]] = ("command", "current")
    may: ClassVar[tuple[str, ...]] = PORTS
    late: ClassVar[tuple[str, ...]] = ("position",)
    sensing: ClassVar[tuple[str, ...]] = ()
    loads: ClassVar[bool] = True

    type: Literal["spool-valve"] = "spool-valve"
    edges: Edges = Field("by pairs of ports: PA is from P to A")
    command: Maybe[Annotated[OneFunction, varying("number")]] = Field("position asked for", default=None)
    current: Maybe[Annotated[OneFunction, varying("current")]] = Field(
        "of its `solenoid`, in place of `command`; negative: of the second one", default=None, usual=ranges.CURRENT
    )
    coordinate: CoordinateReference | None = Field(
        "displacement of a joint whose body is the spool; flows act on it", default=None
    )
    solenoid: Maybe[OneRecord[spools.Solenoid]] = Field("with the springs of the spool", default=None)
    switching: Maybe[OneRecord[spools.Switching]] = Field("whether it is on or off alone", default=None)
    stroke: Maybe[PositiveLength] = Field(
        "from the middle to the full stroke, of notches and springs", default=None, usual=ranges.SPOOL_STROKE
    )
    frequency: Maybe[ranges.SpoolFrequency] = Field("natural frequency of the spool; default: no lag", default=None)
    damping_ratio: PositiveNumber = Field("of the spool", default=0.8)
    dead_band: Annotated[OneNumber, Quantity("number")] = Field("share of the command that does nothing", default=0.0)
    hysteresis: NotNegativeNumber = Field("share of the full command between the curves up and down", default=0.0)
    dither: Maybe[OneRecord[spools.Dither]] = Field(default=None)
    transition: ranges.Drop = Field("difference of pressure below which the root is rounded", default=0.5e5)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        edges = entry(data, "edges")
        return ("position", *(f"flow_{pair}" for pair in (edges if isinstance(edges, Mapping) else ())))

    @property
    def two_sided(self) -> bool:
        """Whether an edge is open at negative positions."""
        curves = (each for edge in self.edges.values() for each in self.curves_of(edge))
        return any(point < 0.0 for curve in curves for point in curve.points)

    def curves_of(self, edge: Edge) -> tuple[Curve, ...]:
        """Flows [m³/s], one curve for each difference of pressure, or an area [m²]."""
        if edge.flows:
            return edge.flows
        return (edge.flow,) if edge.flow is not None else (edge.area_curve(self.stroke or 1.0),)

    def problems(self) -> Iterator[Problem]:
        joined = {port for pair in self.edges for port in ends_of(pair) or ()}
        yield from self.problems_of_ports(tuple(port for port in PORTS if port in joined))
        given = [key for key in ("command", "current", "coordinate") if getattr(self, key) is not None]
        if len(given) != 1:
            got = " and ".join(f"`{key}`" for key in given) or "none"
            what = "a `command`, the `current` of a `solenoid`, or the `coordinate` of a spool that is a body"
            yield Problem((), f"{what} was expected; got {got}")
        elif (self.current is None) != (self.solenoid is None):
            lacking = "`solenoid` is" if self.solenoid is None else "`current` is"
            yield Problem((), f"{lacking} missing: a solenoid has a `current` and a `force` over it")
        yield from problem_of_share("command", self.command, -1.0)
        if self.coordinate is not None:
            for key in ("solenoid", "switching", "frequency", "dither", "dead_band", "hysteresis"):
                if getattr(self, key):
                    yield superfluous(key, "belongs to a spool that is not a body")
        needs_stroke = (
            self.solenoid is not None
            or self.coordinate is not None
            or any(edge.notches for edge in self.edges.values())
        )
        if needs_stroke and self.stroke is None:
            yield Problem((), "`stroke` is missing: notches, springs and bodies need the way of the spool")
        if self.solenoid is not None and self.frequency is None:
            yield Problem((), "`frequency` is missing: that of the spool on its spring, √(stiffness/mass)/2π")
        if self.switching is not None:
            for key in ("solenoid", "frequency", "dither"):
                if getattr(self, key) is not None:
                    yield superfluous(key, "belongs to a proportional valve; `switching` states how this one moves")
        for key in ("dead_band", "hysteresis"):
            value = getattr(self, key)
            if not 0.0 <= value < 1.0:
                yield Problem((key,), f"a share of the command from 0 to 1 was expected, got {value:g}")
            elif value and self.switching is not None:
                yield superfluous(key, "belongs to a proportional valve")


def add_spool_valve(builder: SystemBuilder, component: SpoolValve) -> None:
    """The spool, and its edges, whose flows act on it where solenoids hold it."""
    position, speed = _add_position(builder, component)
    for pair, edge in component.edges.items():
        _add_edge(builder, component, pair, edge, position, speed)


def _add_position(builder: SystemBuilder, component: SpoolValve) -> tuple[int, int]:
    """(the output that is the position, the state on which forces of flows act, or NONE)."""
    name = component.name
    position = builder.outputs.add((f"hydraulics.{name}.position", "1", f"position of {name}"))
    if component.coordinate is not None:
        assert component.stroke is not None  # the record was checked
        along = builder.coordinate(component.coordinate, "length")
        builder.elements.add(spools.ride, [position, along], [1.0 / component.stroke])
        return position, NONE
    if component.switching is not None:
        assert component.command is not None  # the record was checked
        spools.add_switch(builder, name, position, component.command, component.switching, component.two_sided)
        return position, NONE
    speed = spools.add_drive(builder, component, position)
    return position, speed if component.solenoid is not None and component.solenoid.flow_force else NONE


def _add_edge(builder: SystemBuilder, component: SpoolValve, pair: str, edge: Edge, position: int, speed: int) -> None:
    """An edge with its curves; speed : state of the spool on which its flow acts, or NONE."""
    ports = ends_of(pair)
    assert ports is not None  # the record was checked
    a, b = (builder.node(component.ports[port]) for port in ports)
    output = builder.outputs.add(
        (f"hydraulics.{component.name}.flow_{pair}", "m^3/s", f"flow {pair} of {component.name}")
    )
    density = builder.circuit.fluids[builder.circuit.nodes[component.ports[ports[0]]].fluid][4]
    drops, curves = conductances(component, edge, density)
    tables = [held_curve(builder, curve) for curve in curves]
    opens = -1.0 if opens_backwards(curves[0]) else 1.0
    jet, force = -opens * math.sqrt(2.0 * density) * math.cos(edge.jet_angle), 0.0
    if speed != NONE:
        builder.touch_state(speed)
        force = jet / spools.full_force(component) * (2.0 * math.pi * (component.frequency or 0.0)) ** 2
    numbers = [component.transition, edge.leakage, force, *drops]
    builder.elements.add(meter, [output, a, b, position, speed, *tables], numbers)
    if component.coordinate is not None and component.stroke is not None:
        along = builder.coordinate(component.coordinate, "length")
        numbers = [component.transition, 1.0 / component.stroke, jet, *drops]
        builder.elements.add(push, [output, a, b, position, along, *tables], numbers)


def conductances(component: SpoolValve, edge: Edge, density: float) -> tuple[list[float], list[Table]]:
    """(differences of pressure [Pa], K [m³/s/√Pa] over the position at each) of an edge."""
    curves = component.curves_of(edge)
    drops = list(edge.pressure_drops) if edge.flows else [edge.pressure_drop or 0.0]
    out = []
    for curve, drop in zip(curves, drops, strict=True):
        root = drop * (drop * drop + component.transition**2) ** -0.25
        factor = 1.0 / root if drop else edge.discharge_coefficient * math.sqrt(2.0 / density)
        values = tuple(factor * value for value in curve.values)
        out.append(Table(curve.points, values, curve.table.interpolation, "position"))
    return drops, out


def opens_backwards(curve: Table) -> bool:
    """Whether an edge is more open at its least position than at its greatest one."""
    return curve.values[0] > curve.values[-1]


def closed_until(component: SpoolValve) -> float:
    """Share of the stroke within which P is joined with neither A nor B."""
    ends = []
    for pair, edge in component.edges.items():
        if pair in ("PA", "PB", "CA", "CB"):
            curve = component.curves_of(edge)[-1]
            shut = [abs(x) for x, y in zip(curve.points, curve.values, strict=True) if y == 0.0]
            ends.append(min(max(shut, default=0.0), 0.9))
    return min(ends, default=0.0)


OF_VALVES = (spools.drive, spools.ride, spools.switch, meter, push)


def spool_valve(data: Mapping[str, Any]) -> Symbol:
    """A spool with a box for each side to which its edges open."""
    forward, middle, back = [], [], []
    for pair, edge in (data.get("edges") or {}).items():
        ends = ends_of(pair)
        if ends is not None:
            for group, sign in ((forward, 1.0), (middle, 0.0), (back, -1.0)):
                if _is_open(edge, sign):
                    group.append(ends)
    ports = sorted({port for pair in data.get("edges") or {} for port in ends_of(pair) or ()}, key=_place)
    top = [port for port in ports if port in ("A", "B", "C")]
    bottom = [port for port in ports if port not in top]
    return spool([forward, middle, back] if back else [forward, middle], top, bottom)


def _place(port: str) -> int:
    return "ABCPTRSLS".find(port) if port != "LS" else 99


def _is_open(edge: Mapping[str, Any], at: float) -> bool:
    """Whether an edge is open at a position, by its record as JSON."""
    curve = edge.get("flow") or edge.get("area") or next(iter(edge.get("flows") or ()), None)
    if curve is None:
        starts = [each.get("begins", 0.0) for each in edge.get("notches") or ()]
        return any(at > x >= 0.0 or at < x < 0.0 for x in starts)
    points, values = curve["points"], curve["values"]
    k = min(range(len(points)), key=lambda j: abs(points[j] - at))
    return abs(points[k] - at) < 0.5 and values[k] > 0.0


KINDS = (ComponentKind(SpoolValve, add_spool_valve, OF_VALVES, symbol=spool_valve),)
