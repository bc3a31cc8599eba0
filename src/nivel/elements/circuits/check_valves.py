"""Valves through which fluid passes one way: check, shuttle, flushing and quick-exhaust valves; and by a pilot the other way, so that they
hold a load: counterbalance and brake valves."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Final, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated
from nivel.elements.circuits.composed import OF_POPPETS, PASSES, add_check_between, add_opened
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.nodes import inner_nodes
from nivel.elements.circuits.restrictions import TRANSITION, add_flow
from nivel.elements.circuits.symbol import Symbol, arrow, check_at, circle, in_bar, moved, path
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import Leakage, PositiveNumber, Truth
from nivel.machine.core.element import Acts, Inequalities
from nivel.machine.core.record import Problem, entry
from nivel.machine.given import Field, Maybe


class CheckValve(Rated):
    """Lets fluid pass from A to B; with a port X it is opened the other way by a pilot, control pressure p_A - p_B + ratio p_X."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    may: ClassVar[tuple[str, ...]] = ("X",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"),)

    inequalities: ClassVar[Inequalities] = (
        Acts(
            ("is closed", "is open"),
            "opens_at",
            lambda own, of: of.pressure("A") - of.pressure("B") - own.opens_at,
            lambda own, of: of["flow"],
            applies=lambda own: not own.lag and not own.leakage and "X" not in own.ports,
        ),
        PASSES,
    )

    type: Literal["check-valve"] = "check-valve"
    opens_at: ranges.LeastDrop = Field("difference of pressure at which it begins to open", default=0.5e5)
    opening_range: ranges.Drop = Field("difference of pressure from there to fully open", default=3e5)
    pilot_ratio: Maybe[PositiveNumber] = Field("area of the pilot over that of the seat", default=None)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.0)
    leakage: Leakage = Field(default=0.0)

    @property
    def inlets(self) -> tuple[str, ...]:
        return ("A", "B") if self.leakage or "X" in self.ports else ("B",)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if ("X" in self.ports) != (self.pilot_ratio is not None):
            lacking = "`pilot_ratio` is" if self.pilot_ratio is None else "port X is"
            yield Problem((), f"{lacking} missing: a pilot has a port X and a `pilot_ratio`")


class ShuttleValve(Rated):
    """Joins C with the one of A and B that has the higher pressure."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("A", "B", "C")
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B", "position")

    type: Literal["shuttle-valve"] = "shuttle-valve"
    opening_range: ranges.Drop = Field("difference of pressure over which it changes sides", default=0.5e5)
    lag: ranges.Lag = Field("time constant; 0: none", default=0.0)
    leakage: Leakage = Field(default=0.0)


class FlushingValve(Rated):
    """Joins C with the one of A and B that has the lower pressure, where they differ enough: it takes warm oil from a closed circuit."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B", "C")
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B", "position_A", "position_B")

    type: Literal["flushing-valve"] = "flushing-valve"
    opens_at: ranges.Drop = Field(
        default=5e5, description="difference of pressure at which it leaves its centre, in which all is closed"
    )
    opening_range: ranges.Drop = Field(default=5e5, description="difference of pressure from there to fully open")
    lag: ranges.Lag = Field(default=0.0, description="time constant; 0: none")
    leakage: Leakage = Field(default=0.0)


class QuickExhaust(Rated):
    """Lets fluid from P to A while p_P is higher, and from A to R while p_A is."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A", "R")
    late: ClassVar[tuple[str, ...]] = ("flow_PA", "flow_AR", "position", "exhaust_position")

    type: Literal["quick-exhaust"] = "quick-exhaust"
    opens_at: ranges.Drop = Field("difference at which it begins to open", default=0.05e5)
    opening_range: ranges.Drop = Field("difference of pressure from there to fully open", default=0.2e5)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.0)
    leakage: Leakage = Field(default=0.0)


def add_check(builder: SystemBuilder, component: CheckValve) -> None:
    """p_A - p_B, and of a pilot its ratio times what it is above the air, against the spring."""
    ratio = component.pilot_ratio or 0.0
    factors = {"A": 1.0, "B": -1.0} | ({"X": ratio} if "X" in component.ports else {})
    add_opened(builder, component, "flow", ("A", "B"), factors, component.opens_at, constant=-ratio * ATMOSPHERE)


def add_shuttle(builder: SystemBuilder, component: ShuttleValve) -> None:
    """Two seats: the one on the side of the higher pressure is open."""
    half = 0.5 * component.opening_range
    for side, other, position in (("A", "B", "position"), ("B", "A", "position_B")):
        factors = {side: 1.0, other: -1.0}
        add_opened(builder, component, f"flow_{side}", (side, "C"), factors, constant=half, position=position)


def add_flushing(builder: SystemBuilder, component: FlushingValve) -> None:
    """A spool between both sides, centred by springs: the higher pressure joins the other side with C."""
    for side, other in (("A", "B"), ("B", "A")):
        add_opened(builder, component, f"flow_{side}", (side, "C"), {other: 1.0, side: -1.0}, component.opens_at)


def add_quick_exhaust(builder: SystemBuilder, component: QuickExhaust) -> None:
    """p_P - p_A against the spring, and the other way round."""
    for a, b, to, position in (("P", "A", "A", "position"), ("A", "P", "R", "exhaust_position")):
        factors = {a: 1.0, b: -1.0}
        add_opened(builder, component, f"flow_{a}{to}", (a, to), factors, component.opens_at, position=position)


CHECK: Final = path("M0 16 V7 M-8 -4 L0 7 L8 -4 M0 -7 V-16") + circle(5.0, -2.0)


def check(data: Mapping[str, Any]) -> Symbol:
    """A check valve, with or without a pilot."""
    pilot = path("M24 16 V3 H3", "dashed") if "X" in (data.get("ports") or {}) else ""
    return Symbol(CHECK + pilot, 24.0 if pilot else 9.0, 16.0, {"B": 0.0}, {"A": 0.0} | ({"X": 24.0} if pilot else {}))


SEATS: Final = path("M-20 -9 H20 V9 H-20 Z M-13 -5 L-6 0 L-13 5 M13 -5 L6 0 L13 5 M0 -9 V-16") + path(
    "M-20 0 H-26 V16 M20 0 H26 V16"
)
SHUTTLE = Symbol(SEATS + '<circle cx="-4" cy="0" r="4"/>', 26.0, 16.0, {"C": 0.0}, {"A": -26.0, "B": 26.0})

# three positions: closed in the middle, one side each way
FLUSHING = Symbol(
    path(
        "M-30 -9 H30 V9 H-30 Z M-10 -9 V9 M10 -9 V9 M0 -9 V-16 M-15 9 L-25 -9 M15 9 L25 -9 M-30 0 H-34 V16 M30 0 H34 V16"
    )
    + path("M-4 5 H4 M-4 -5 H4 M-25 9 V6 M-28 6 H-22 M25 9 V6 M22 6 H28"),
    34.0,
    16.0,
    {"C": 0.0},
    {"A": -34.0, "B": 34.0},
)

# a shuttle whose common port is A, with its exhaust
QUICK_EXHAUST = Symbol(SEATS + '<circle cx="10" cy="0" r="4"/>', 26.0, 16.0, {"A": 0.0}, {"P": -26.0, "R": 26.0})


class CounterbalanceValve(Rated):
    """Holds a load at L until L and the pilot X open it towards V; from V to L fluid passes through a check valve.

    Control pressure p_L + R p_X - (1 + R) p_V - opens_at; without p_V where the spring chamber is vented, with p_T in its place where a
    port T drains it. An orifice in the pilot line gives the pilot a chamber of its own, NAME.Y, and a delay.
    """

    needs: ClassVar[tuple[str, ...]] = ("L", "V", "X")
    may: ClassVar[tuple[str, ...]] = ("T",)
    nodes: ClassVar[tuple[str, ...]] = (".Y",)
    sensing: ClassVar[tuple[str, ...]] = ("X", "T")
    early: ClassVar[tuple[str, ...]] = ("pressure_Y",)
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "check_flow", "position", "pilot_flow")

    inequalities: ClassVar[Inequalities] = (
        PASSES,
        Acts(
            ("has its check valve closed", "has its check valve open"),
            "opens_at",
            lambda own, of: of.pressure("V") - of.pressure("L") - own.check_opens_at,
            lambda own, of: of["check_flow"],
        ),
    )

    type: Literal["counterbalance-valve"] = "counterbalance-valve"
    opens_at: ranges.VaryingLevel = Field("load pressure at which it begins to open without a pilot")
    opening_range: ranges.Drop = Field("control pressure from there to fully open", default=80e5)
    pilot_ratio: PositiveNumber = Field("R", default=3.0)
    vented: Truth = Field("whether the pressure at V does not act on it", default=False)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.01)
    check_flow: Maybe[ranges.Flow] = Field("of the check valve; default `flow`", default=None)
    check_pressure_drop: Maybe[ranges.Drop] = Field("of the check valve; default `pressure_drop`", default=None)
    check_opens_at: ranges.LeastDrop = Field(default=0.5e5)
    check_opening_range: ranges.Drop = Field(default=4e5)
    leakage: Leakage = Field(default=0.0)
    pilot_orifice: Maybe[ranges.Bore] = Field("diameter of an orifice in the pilot line; default: none", default=None)
    drain_orifice: Maybe[ranges.Bore] = Field(
        "diameter of an orifice from behind it to V: the pilot is a share of X", default=None
    )
    inner_volume: ranges.Size = Field("of the pilot chamber behind its orifice", default=2e-6)

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        return cls.nodes if entry(data, "pilot_orifice") is not None else ()

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        piloted = ("pressure_Y", "pilot_flow") if cls.nodes_in(data) else ()
        return ("flow", "check_flow", "position", *piloted)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.vented and "T" in self.ports:
            yield Problem(("vented",), "a spring chamber with a drain T is not vented; remove `vented`, or the port T")
        if self.drain_orifice is not None and self.pilot_orifice is None:
            yield Problem((), "`pilot_orifice` is missing: the pilot chamber stands between it and the `drain_orifice`")

    @property
    def check_conductance(self) -> float:
        """K [m³/s/√Pa] of the check valve."""
        flow, drop = self.check_flow or self.flow, self.check_pressure_drop or self.pressure_drop
        return flow / drop**0.5 if flow and drop else 0.0


class BrakeValve(Rated):
    """A brake valve of a motor: fluid passes freely from VA to A and from VB to B; back it passes as the other side is pressurised.

    From A to VA it opens where VB is `opens_at` above the air, from B to VB where VA is.
    """

    needs: ClassVar[tuple[str, ...]] = ("VA", "VB", "A", "B")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B", "position_A", "position_B", "check_flow_A", "check_flow_B")

    type: Literal["brake-valve"] = "brake-valve"
    opens_at: ranges.VaryingLevel = Field("of the pilot, above the air", default=10e5)
    opening_range: ranges.Drop = Field("from there to fully open", default=15e5)
    lag: ranges.Lag = Field("time constant of the spool; 0: none", default=0.02)
    leakage: Leakage = Field(default=0.0)


BORE_COEFFICIENT = 0.65  # discharge coefficient of orifices in pilot lines


def add_counterbalance(builder: SystemBuilder, component: CounterbalanceValve) -> None:
    """p_L + R p_X - (1 + R) p_V against the spring; where that is vented or drained, the air or p_T in place of p_V. And its check valve.

    An orifice in the pilot line fills a chamber, whose pressure is that of the pilot; another one may drain that to V.
    """
    ratio, pilot = component.pilot_ratio, "X" if component.pilot_orifice is None else ".Y"
    factors, constant = {"L": 1.0, pilot: ratio}, -(1.0 + ratio) * ATMOSPHERE
    if not component.vented:
        factors["T" if "T" in component.ports else "V"], constant = -(1.0 + ratio), 0.0
    if component.pilot_orifice is not None:
        density = builder.circuit.fluids[builder.circuit.nodes[component.ports["L"]].fluid][4]

        def bore(diameter: float) -> list[float]:
            return [BORE_COEFFICIENT * 0.25 * math.pi * diameter**2 * math.sqrt(2.0 / density), TRANSITION, 0.0]

        add_flow(builder, component, "pilot_flow", ("X", pilot), bore(component.pilot_orifice))
        if component.drain_orifice is not None:
            add_flow(builder, component, "drain_flow", (pilot, "V"), bore(component.drain_orifice))
    add_opened(builder, component, "flow", ("L", "V"), factors, component.opens_at, constant=constant)
    check = [component.check_conductance, TRANSITION, 0.0]
    spring = (component.check_opens_at, component.check_opening_range)
    add_check_between(builder, component, "check_flow", ("V", "L"), check, spring)


def add_brake(builder: SystemBuilder, component: BrakeValve) -> None:
    """For each side a check valve in, and an edge back that the other side opens."""
    for side, valve, pilot in (("A", "VA", "VB"), ("B", "VB", "VA")):
        how = {pilot: 1.0}, component.opens_at
        add_opened(builder, component, f"flow_{side}", (side, valve), *how, constant=-ATMOSPHERE)
        add_check_between(builder, component, f"check_flow_{side}", (valve, side))


def counterbalance(data: Mapping[str, Any]) -> Symbol:
    """A counterbalance valve with its check valve."""
    square = path("M-26 -10 H-6 V10 H-26 Z") + arrow(-20, -10, 10) + path("M-6 0 l2 -4 l3 8 l3 -8 l2 4")
    sides = path("M0 -26 V-18 M-16 -10 V-18 H20 V-9 M0 26 V18 M-16 10 V18 H20 V9")
    check = path("M20 9 V6 M13 -3 L20 6 L27 -3 M20 -6 V-9") + '<circle cx="20" cy="-1.5" r="4"/>'
    pilots = path("M-16 -15 H-30 V-4 H-26 M-36 26 V4 H-26", "dashed")
    frame = path("M-33 -22 H31 V22 H-33 Z", "frame")
    body, below = square + sides + check + pilots + frame, {"V": 0.0, "X": -36.0}
    if data.get("pilot_orifice") is not None:
        body += path("M-40 12 Q-36 15.5 -40 19 M-32 12 Q-36 15.5 -32 19")
    if "T" in (data.get("ports") or {}):
        body, below = body + path("M5 0 H10 V26", "dashed"), {**below, "T": 10.0}
    return Symbol(body, 40.0, 26.0, {"L": 0.0}, below, settings=in_bar(data, "opens_at"))


def brake(data: Mapping[str, Any]) -> Symbol:
    """A brake valve: for each side a check valve in, and a piloted edge back."""
    body = path("M-48 -24 H48 V24 H-48 Z", "frame")
    for side in (-1.0, 1.0):
        x = 22.0 * side
        body += path(f"M{x:g} -30 V30 M{x:g} -18 H{x + 15 * side:g} V-10 M{x + 15 * side:g} 10 V18 H{x:g}")
        body += moved(path("M-7 -7 H7 V7 H-7 Z") + arrow(-3, -7, 7), x + 15 * side, 0.0)
        body += check_at(x, 0.0)
    body += path("M-22 22 L28 5 M22 22 L-28 5", "dashed")
    return Symbol(
        body, 48.0, 30.0, {"A": -22.0, "B": 22.0}, {"VA": -22.0, "VB": 22.0}, settings=in_bar(data, "opens_at")
    )


KINDS = (
    ComponentKind(CheckValve, add_check, OF_POPPETS, symbol=check),
    ComponentKind(ShuttleValve, add_shuttle, OF_POPPETS, symbol=SHUTTLE),
    ComponentKind(FlushingValve, add_flushing, OF_POPPETS, symbol=FLUSHING),
    ComponentKind(QuickExhaust, add_quick_exhaust, OF_POPPETS, symbol=QUICK_EXHAUST),
    ComponentKind(CounterbalanceValve, add_counterbalance, OF_POPPETS, symbol=counterbalance, nodes=inner_nodes("Y")),
    ComponentKind(BrakeValve, add_brake, OF_POPPETS, symbol=brake),
)
