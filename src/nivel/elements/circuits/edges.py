"""Flows through edges of spools that are known by curves over the position, one for each difference of pressure.

    Q = K(u, |Δp|) Δp (Δp² + c²)^(-1/4) + G Δp        ṁ = ½ (ρ_a + ρ_b) Q

The force of the flow on its spool, f Q √Δp, closes the edge; it belongs to the balance of `nivel.elements.circuits.spools`, or acts on the
joint of a spool that is a body.

K lies on its curves at their differences of pressure and on a straight line between them; outside, the nearest curve holds. A single
curve is that of a sharp edge, whose flow grows with √Δp.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.circuits import ranges
from nivel.elements.circuits.curves import Curve, CurveOf, SomeCurve
from nivel.elements.circuits.density import thickness
from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.ledger import DELIVERED, lose_between, transfer
from nivel.elements.circuits.smooth import root_flow
from nivel.elements.circuits.spools import SYMBOL
from nivel.elements.circuits.tangent import add_by_pressure, add_flow_by_column, add_flow_by_pressure
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import table_value
from nivel.kernels.record.record import NONE, record_at
from nivel.machine.core.coefficient import Leakage, Share
from nivel.machine.core.record import Checked, Problem, superfluous
from nivel.machine.given import Field, Given, ManyNumbers, ManyRecords, Maybe, OneNumber
from nivel.machine.laws.varying_value import Table
from nivel.machine.units.quantity import Angle, PositiveLength, Quantity, Whole, listed
from nivel.native.function import leaf

MOST_CURVES, MOST_EDGES = 8, 6
JET_ANGLE = math.radians(69.0)  # of the jet behind a sharp edge (von Mises 1917)
NOTCH_POINTS = 33


class Notch(Checked):
    """A notch in the land of a spool, open from `begins` on.

    Areas over the way s beyond that: a rectangle `width` s, a triangle tan(angle/2) s², a bore of a `diameter` the segment of its circle.
    """

    shape: Literal["rectangle", "triangle", "bore"]
    begins: Annotated[OneNumber, Quantity("number")] = Field(
        "share of the stroke at which it begins to open; the sign is that of the edge", default=0.0
    )
    width: Maybe[PositiveLength] = Field("of a rectangle; of a whole edge its circumference", default=None)
    angle: Maybe[Angle] = Field("between the sides of a triangle", default=None)
    diameter: Maybe[PositiveLength] = Field("of a bore", default=None)
    length: Maybe[PositiveLength] = Field("over which it opens; default: to the full stroke", default=None)
    number: Whole = Field("of equal notches", default=1)

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

    flow: Maybe[Annotated[SomeCurve, CurveOf("volume flow", SYMBOL)]] = Field(
        "over the position, at `pressure_drop`", default=None
    )
    pressure_drop: Maybe[ranges.Drop] = Field("at which `flow` is measured", default=None)
    flows: Annotated[
        Given[
            tuple[Annotated[Curve, CurveOf("volume flow", SYMBOL)], ...],
            tuple[Curve, ...],
            Sequence[Curve | Mapping[str, Any]],
        ],
        BeforeValidator(listed),
    ] = Field("curves over the position, one for each of `pressure_drops`", default=())
    pressure_drops: Annotated[
        ManyNumbers[Annotated[OneNumber, Quantity("pressure", positive=True)]], BeforeValidator(listed)
    ] = Field("increasing; outside, the nearest curve holds", default=(), usual=ranges.DIFFERENCE)
    area: Maybe[Annotated[SomeCurve, CurveOf("area", SYMBOL)]] = Field("over the position", default=None)
    notches: ManyRecords[Notch] = Field("in place of `area`", default=())
    discharge_coefficient: Share = Field("of an area", default=0.65)
    jet_angle: Angle = Field("between jet and spool, of the force of the flow", default=JET_ANGLE)
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
        return Curve(Table(tuple(points), tuple(values), "linear", SYMBOL))


# columns of `columns`; POSITION: output of the valve; SPEED: state of its spool on which the flow acts, or NONE; then its curves, which are
# tables. Output: flow [m³/s]. `push` has the coordinate of a spool that is a body in place of SPEED
OUTPUT, FROM, TO, POSITION, SPEED, FIRST_CURVE = 0, 1, 2, 3, 4, 5
COORDINATE = SPEED
MOST = 8  # curves of an edge
# columns of `number`: corner c [Pa], leak G [m³/s/Pa], acceleration of the spool over Q √Δp, of a body the force on it, then the difference
# of pressure [Pa] of each curve
CORNER, LEAK, FORCE, FIRST_DROP = 0, 1, 2, 3
PER_METRE = LEAK  # of `push`: strokes a metre of the coordinate


@leaf
def has_curve(index, i):
    """Whether an edge has a curve of this number."""
    return i < MOST and FIRST_CURVE + i < index.shape[0] and index[FIRST_CURVE + i] != NONE


@leaf
def curve_below(index, n, size):
    """Number of the curve at or below the difference of pressure `size`, the first one where there is none."""
    low = np.int64(0)
    while has_curve(index, low + 1) and size >= n[FIRST_DROP + low + 1]:
        low += 1
    return low


@leaf
def conductance_at(functions, index, n, u, difference):
    """(K [m³/s/√Pa], ∂K/∂u) at the position u and a real difference of pressure."""
    size = np.abs(difference)
    low = curve_below(index, n, size)
    value, slope, _ = table_value(functions, index[FIRST_CURVE + low], u)
    if has_curve(index, low + 1) and size > n[FIRST_DROP + low]:
        above, steeper, _ = table_value(functions, index[FIRST_CURVE + low + 1], u)
        share = (size - n[FIRST_DROP + low]) / (n[FIRST_DROP + low + 1] - n[FIRST_DROP + low])
        value = value + share * (above - value)
        slope = slope + share * (steeper - slope)
    return value, slope


@leaf
def rise_of_conductance(functions, index, n, u, difference):
    """∂K/∂|Δp| at a real position and difference of pressure."""
    size = np.abs(difference)
    low = curve_below(index, n, size)
    if has_curve(index, low + 1) and size > n[FIRST_DROP + low]:
        value, _, _ = table_value(functions, index[FIRST_CURVE + low], u)
        above, _, _ = table_value(functions, index[FIRST_CURVE + low + 1], u)
        return (above - value) / (n[FIRST_DROP + low + 1] - n[FIRST_DROP + low])
    return 0.0


@called(Phase.FLOWS, 12)
@element
def meter(machine, index, n, t):
    """Flows of all edges."""
    record = record_at(machine)
    elements, circuit, functions = record.elements, record.circuit, record.functions
    secant = circuit.secant[0]
    a, b = index[FROM], index[TO]
    u = record.outputs.value[index[POSITION]]
    difference = circuit.pressure[a] - circuit.pressure[b]
    conductance, _ = conductance_at(functions, index, n, u, real(difference))
    if secant == 0:
        rise = rise_of_conductance(functions, index, n, real(u), real(difference))
        way = rise if real(difference) >= 0.0 else -rise
        conductance = conductance + way * (difference - real(difference))
    flow = conductance * root_flow(difference, n[CORNER], secant) + n[LEAK] / thickness(circuit, a, b) * difference
    mass_flow = 0.5 * (circuit.density[a] + circuit.density[b]) * flow
    lose_between(machine, a, b, mass_flow, transfer(machine, a, b, mass_flow))
    record.outputs.value[index[OUTPUT]] = flow
    if index[SPEED] != NONE:
        elements.state_rate[index[SPEED]] += n[FORCE] * flow * root_flow(difference, n[CORNER], 0)


@slopes_of(meter)
@element
def add_slopes(machine, index, n, t):
    """Slopes of all flows, those with pressures as secants."""
    record = record_at(machine)
    circuit, functions = record.circuit, record.functions
    a, b = index[FROM], index[TO]
    difference = circuit.pressure[a] - circuit.pressure[b]
    density = 0.5 * (circuit.density[a] + circuit.density[b])
    through = density / np.sqrt(np.sqrt(difference * difference + n[CORNER] * n[CORNER]))
    u = record.outputs.value[index[POSITION]]
    conductance, slope = conductance_at(functions, index, n, u, difference)
    by_pressure = through * conductance + density * n[LEAK] / thickness(circuit, a, b)
    if by_pressure != 0.0:
        add_flow_by_pressure(circuit, a, b, a, by_pressure)
        add_flow_by_pressure(circuit, a, b, b, -by_pressure)
    state = circuit.tangent.source[index[POSITION], 0]
    if state != NONE and slope != 0.0:
        add_flow_by_column(circuit, a, b, state, through * difference * slope)
    if index[SPEED] != NONE:
        size = np.sqrt(difference * difference + n[CORNER] * n[CORNER])
        tangent = circuit.tangent
        row = tangent.slopes[tangent.unknown[index[SPEED]]]
        by_difference = n[FORCE] * record.outputs.value[index[OUTPUT]] / np.sqrt(size)
        add_by_pressure(circuit, row, a, by_difference)
        add_by_pressure(circuit, row, b, -by_difference)
        if state != NONE:
            row[state] += n[FORCE] * slope * difference * difference / size


@called(Phase.FLOWS, 16)
@element
def push(machine, index, n, t):
    """Forces of the flows of edges on spools that are bodies; what they do to these the fluid does not lose."""
    record = record_at(machine)
    circuit = record.circuit
    a, b, flow = index[FROM], index[TO], record.outputs.value[index[OUTPUT]]
    effort = n[FORCE] * flow * root_flow(circuit.pressure[a] - circuit.pressure[b], n[CORNER], 0)
    power = add_coordinate_force(machine, index[COORDINATE], effort)
    circuit.power[DELIVERED] += power
    lose_between(machine, a, b, flow, -power)


@slopes_of(push)
@element
def add_slopes_along(machine, index, n, t):
    """Slopes of the flows with the displacements of spools that are bodies, and of the forces on these."""
    record = record_at(machine)
    circuit = record.circuit
    tangent, a, b = circuit.tangent, index[FROM], index[TO]
    c = np.int64(tangent.number[index[COORDINATE]])
    row, column = tangent.effort[c], tangent.state.shape[0] + c
    difference = circuit.pressure[a] - circuit.pressure[b]
    size = np.sqrt(difference * difference + n[CORNER] * n[CORNER])
    _, slope = conductance_at(record.functions, index, n, record.outputs.value[index[POSITION]], difference)
    density = 0.5 * (circuit.density[a] + circuit.density[b])
    add_flow_by_column(circuit, a, b, column, n[PER_METRE] * density * slope * difference / np.sqrt(size))
    by_difference = n[FORCE] * record.outputs.value[index[OUTPUT]] / np.sqrt(size)
    add_by_pressure(circuit, row, a, by_difference)
    add_by_pressure(circuit, row, b, -by_difference)
    row[column] += n[FORCE] * n[PER_METRE] * slope * difference * difference / size
