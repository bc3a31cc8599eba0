"""Spool valves from catalogues in words: every edge has curves of its own, and the spool a solenoid, springs and the force of the flow."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, BeforeValidator

from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import (
    Frequency,
    Leakage,
    NotNegativeForce,
    NotNegativeNumber,
    PositiveNumber,
    Pressure,
    Share,
    Truth,
)
from nivel.machine.core.record import entry
from nivel.machine.given import Field, Given, ManyNumbers, ManyRecords, Maybe, OneNumber, OneRecord
from nivel.machine.hydraulics.component import Component, problem_of_share
from nivel.machine.hydraulics.curve import Curve, CurveOf, SomeCurve
from nivel.machine.hydraulics.switching import Switching
from nivel.machine.hydraulics.usual import CURRENT, DIFFERENCE, SPOOL_FREQUENCY, SPOOL_STROKE
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Angle, PositiveLength, Quantity, Whole, fault, listed

POSITION, CURRENT_SYMBOL = "position", "current"
PORTS = ("P", "T", "A", "B", "C", "R", "S", "LS")
MOST_CURVES, MOST_EDGES = 8, 6
JET_ANGLE = math.radians(69.0)  # of the jet behind a sharp edge (von Mises 1917)
NOTCH_POINTS = 33


class Notch(Checked):
    """A notch in the land of a spool, open from `begins` on.

    Areas over the way s beyond that: a rectangle `width` s, a triangle tan(angle/2) s², a bore of a `diameter` the segment of its circle.
    """

    shape: Literal["rectangle", "triangle", "bore"]
    begins: Annotated[OneNumber, Quantity("number")] = Field(
        default=0.0, description="share of the stroke at which it begins to open; the sign is that of the edge"
    )
    width: Maybe[PositiveLength] = Field(default=None, description="of a rectangle; of a whole edge its circumference")
    angle: Maybe[Angle] = Field(default=None, description="between the sides of a triangle")
    diameter: Maybe[PositiveLength] = Field(default=None, description="of a bore")
    length: Maybe[PositiveLength] = Field(default=None, description="over which it opens; default: to the full stroke")
    number: Whole = Field(default=1, description="of equal notches")

    NEEDS: ClassVar[Mapping[str, str]] = {"rectangle": "width", "triangle": "angle", "bore": "diameter"}

    def area(self, s: float) -> float:
        """[m²] of all of them at the way s [m] beyond where they begin."""
        s = max(0.0, s if self.length is None else min(s, self.length))
        if self.shape == "rectangle":
            return self.number * (self.width or 0.0) * s
        if self.shape == "triangle":
            return self.number * math.tan(0.5 * (self.angle or 0.0)) * s * s
        radius = 0.5 * (self.diameter or 0.0)
        s = min(s, 2.0 * radius)
        segment = radius**2 * math.acos(1.0 - s / radius) - (radius - s) * math.sqrt(s * (2.0 * radius - s))
        return self.number * segment

    def problems(self) -> Iterator[Problem]:
        needed = self.NEEDS[self.shape]
        for key in self.NEEDS.values():
            given = getattr(self, key) is not None
            if key == needed and not given:
                yield Problem((), f"`{key}` is missing: a {self.shape} has one")
            elif key != needed and given:
                yield superfluous(key, f"is of another shape; a {self.shape} has `{needed}`")
        if not -1.0 < self.begins < 1.0:
            yield Problem(("begins",), f"a share of the stroke from -1 to 1 was expected, got {self.begins:g}")


class Edge(Checked):
    """How much flows between two ports: by curves of a catalogue, by an area, or by notches.

    `flow` over `position` at `pressure_drop`; `flows`, one curve for each of `pressure_drops`; `area` over `position`; or `notches`.
    """

    flow: Maybe[Annotated[SomeCurve, CurveOf("volume flow", POSITION)]] = Field(
        default=None, description="over the position, at `pressure_drop`"
    )
    pressure_drop: Maybe[Pressure] = Field(default=None, description="at which `flow` is measured", usual=DIFFERENCE)
    flows: Annotated[
        Given[
            tuple[Annotated[Curve, CurveOf("volume flow", POSITION)], ...],
            tuple[Curve, ...],
            Sequence[Curve | Mapping[str, Any]],
        ],
        BeforeValidator(listed),
    ] = Field(default=(), description="curves over the position, one for each of `pressure_drops`")
    pressure_drops: Annotated[
        ManyNumbers[Annotated[OneNumber, Quantity("pressure", positive=True)]], BeforeValidator(listed)
    ] = Field(default=(), description="increasing; outside, the nearest curve holds", usual=DIFFERENCE)
    area: Maybe[Annotated[SomeCurve, CurveOf("area", POSITION)]] = Field(default=None, description="over the position")
    notches: ManyRecords[Notch] = Field(default=(), description="in place of `area`")
    discharge_coefficient: Share = Field(default=0.65, description="of an area")
    jet_angle: Angle = Field(default=JET_ANGLE, description="between jet and spool, of the force of the flow")
    leakage: Leakage = Field(default=0.0)

    def problems(self) -> Iterator[Problem]:
        given = [name for name in ("flow", "flows", "area", "notches") if getattr(self, name)]
        if len(given) != 1:
            got = " and ".join(f"`{name}`" for name in given) or "none"
            yield Problem((), f"one of `flow`, `flows`, `area` and `notches` was expected, got {got}")
        for curve, drop in (("flow", "pressure_drop"), ("flows", "pressure_drops")):
            if getattr(self, curve) and not getattr(self, drop):
                yield Problem((), f"`{drop}` is missing: a catalogue states a flow at a difference of pressure")
            if getattr(self, drop) and not getattr(self, curve):
                yield superfluous(drop, f"belongs to `{curve}`")
        if self.flows and self.pressure_drops and len(self.flows) != len(self.pressure_drops):
            counts = f"got {len(self.flows)} and {len(self.pressure_drops)}"
            yield Problem(("flows",), f"as many curves as `pressure_drops` were expected, {counts}")
        if len(self.flows) > MOST_CURVES:
            yield Problem(("flows",), f"at most {MOST_CURVES} curves were expected, got {len(self.flows)}")
        if any(b <= a for a, b in pairwise(self.pressure_drops)):
            yield Problem(("pressure_drops",), "differences of pressure that increase were expected")

    def area_curve(self, stroke: float) -> Curve:
        """[m²] over the position; stroke : [m] of the spool, which notches need."""
        if self.area is not None:
            return self.area
        points = [k / (NOTCH_POINTS - 1) for k in range(NOTCH_POINTS)]
        back = any(each.begins < 0.0 for each in self.notches)
        values = [sum(each.area((x - abs(each.begins)) * stroke) for each in self.notches) for x in points]
        if back:
            points, values = [-x for x in reversed(points)], values[::-1]
        return Curve(Table(tuple(points), tuple(values), "linear", POSITION))


class Solenoid(Checked):
    """Forces of proportional solenoids, with springs that centre the spool or push it back."""

    force: Annotated[SomeCurve, CurveOf("force", CURRENT_SYMBOL)] = Field(
        description="over the magnitude of the current"
    )
    spring: Annotated[OneNumber, Quantity("stiffness", positive=True)] = Field(description="stiffness of the spring")
    preload: NotNegativeForce = Field(default=0.0, description="of the spring in its middle")
    friction: NotNegativeForce = Field(default=0.0, description="of the spool; dither overcomes it")
    transition_speed: PositiveNumber = Field(default=0.02, description="strokes per second: friction changes its sign")
    flow_force: Truth = Field(default=True, description="whether the force of the flow acts on the spool")


class Dither(Checked):
    """A vibration of the command."""

    amplitude: PositiveNumber = Field(description="share of the full command, of the full force of solenoids")
    frequency: Frequency


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
    Given[
        dict[Annotated[str, AfterValidator(_pair)], Edge],
        dict[str, Edge],
        Mapping[str, Edge | Mapping[str, Any]],
    ],
    BeforeValidator(_edges),
]


class SpoolValve(Component):
    """A spool whose edges have the curves of a catalogue, each its own. Its position goes from -1 to 1.

    It follows a `command`, the `current` of a solenoid against springs, or it is `switching`.
    """

    functions: ClassVar[tuple[str, ...]] = ("command", "current")
    may: ClassVar[tuple[str, ...]] = PORTS
    late: ClassVar[tuple[str, ...]] = ("position",)
    sensing: ClassVar[tuple[str, ...]] = ()
    loads: ClassVar[bool] = True

    type: Literal["spool-valve"] = "spool-valve"
    edges: Edges = Field(description="by pairs of ports: PA is from P to A")
    command: Maybe[Annotated[OneFunction, varying("number")]] = Field(default=None, description="position asked for")
    current: Maybe[Annotated[OneFunction, varying("current")]] = Field(
        default=None, description="of its `solenoid`, in place of `command`; negative: of the second one", usual=CURRENT
    )
    solenoid: Maybe[OneRecord[Solenoid]] = Field(default=None, description="with the springs of the spool")
    switching: Maybe[OneRecord[Switching]] = Field(default=None, description="whether it is on or off alone")
    stroke: Maybe[PositiveLength] = Field(
        default=None, description="from the middle to the full stroke, of notches and springs", usual=SPOOL_STROKE
    )
    frequency: Maybe[Frequency] = Field(
        default=None, description="natural frequency of the spool; default: no lag", usual=SPOOL_FREQUENCY
    )
    damping_ratio: PositiveNumber = Field(default=0.8, description="of the spool")
    dead_band: Annotated[OneNumber, Quantity("number")] = Field(
        default=0.0, description="share of the command that does nothing"
    )
    hysteresis: NotNegativeNumber = Field(
        default=0.0, description="share of the full command between the curves up and down"
    )
    dither: Maybe[OneRecord[Dither]] = Field(default=None)
    transition: Pressure = Field(
        default=0.5e5, description="difference of pressure below which the root is rounded", usual=DIFFERENCE
    )

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
        if (self.command is None) == (self.current is None):
            got = "got both" if self.command is not None else "got neither"
            yield Problem((), f"a `command`, or the `current` of a `solenoid`, was expected; {got}")
        elif (self.current is None) != (self.solenoid is None):
            lacking = "`solenoid` is" if self.solenoid is None else "`current` is"
            yield Problem((), f"{lacking} missing: a solenoid has a `current` and a `force` over it")
        yield from problem_of_share("command", self.command, -1.0)
        needs_stroke = self.solenoid is not None or any(edge.notches for edge in self.edges.values())
        if needs_stroke and self.stroke is None:
            yield Problem((), "`stroke` is missing: notches and springs need the way of the spool")
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
