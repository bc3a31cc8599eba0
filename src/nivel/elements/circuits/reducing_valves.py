"""Valves that hold or switch a pressure behind them: reducing and sequence valves, compensators, soft start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, VaryingPressure
from nivel.elements.circuits.composed import OF_POPPETS, add_check_between, add_opened, sums
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.restrictions import add_flow, rated
from nivel.elements.circuits.symbol import BAR, Symbol, adjustable, check_at, in_bar, path, square, varies
from nivel.known import SystemBuilder
from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Leakage, Share, Truth
from nivel.machine.core.record import entry
from nivel.machine.given import Field


class ReducingValve(Rated):
    """Closes from P to A as the pressure at A comes to `pressure`; with a port T it relieves A above that."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    may: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("pressure",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "relief_flow")

    type: Literal["reducing-valve"] = "reducing-valve"
    pressure: ranges.VaryingLevel = Field(description="at A, absolute, at which it is closed")
    opening_range: ranges.Drop = Field(default=5e5, description="pressure below that at which it is fully open")
    lag: ranges.Lag = Field(default=0.0, description="time constant of the opening; 0: none")
    leakage: Leakage = Field(default=0.0)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        ports = entry(data, "ports")
        relieves = isinstance(ports, Mapping) and "T" in ports
        return tuple(each for each in cls.late if relieves or each != "relief_flow")


class Compensator(Rated):
    """Holds the pressure at A, in front of a valve, a `margin` above the load pressure LS; in series, from P to A.

    Opening S(½ - (p_A - p_LS - margin)/opening_range).
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "A", "LS")
    functions: ClassVar[tuple[str, ...]] = ("margin",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")

    type: Literal["compensator"] = "compensator"
    margin: VaryingPressure = Field(default=7e5, description="held between A and LS", usual=ranges.DIFFERENCE)
    opening_range: ranges.Drop = Field(default=6e5, description="from closed to fully open")
    lag: ranges.Lag = Field(default=0.01, description="time constant of the opening; 0: none")
    leakage: Leakage = Field(default=0.0)


class SequenceValve(Rated):
    """Opens from P to A where P is more than `opens_at` above its spring chamber, which drains to T, or to the air without one."""

    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    may: ClassVar[tuple[str, ...]] = ("T",)
    sensing: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "check_flow")

    type: Literal["sequence-valve"] = "sequence-valve"
    opens_at: ranges.VaryingLevel = Field(description="pressure of P above that of the drain")
    opening_range: ranges.Drop = Field(default=10e5, description="from there to fully open")
    lag: ranges.Lag = Field(default=0.0, description="time constant of the opening; 0: none")
    free_return: Truth = Field(default=False, description="whether a check valve lets fluid pass from A to P")
    leakage: Leakage = Field(default=0.0)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        return tuple(each for each in cls.late if each != "check_flow" or entry(data, "free_return"))


class SoftStart(Rated):
    """Fills A from P through a throttle until p_A is a share of p_P; then it opens."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    late: ClassVar[tuple[str, ...]] = ("flow", "throttled_flow", "position")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("P", "A"), ("A", "P"))

    type: Literal["soft-start"] = "soft-start"
    throttle: Share = Field(default=0.05, description="opening while it fills, as a share of the whole one")
    switches_at: Share = Field(default=0.5, description="p_A over p_P, absolute, at which it opens")
    opening_range: ranges.Drop = Field(default=0.2e5, description="difference of pressure from there to fully open")
    lag: ranges.Lag = Field(default=0.05, description="time constant of the opening; 0: none")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not 0.0 < self.throttle < 1.0:
            yield Problem(("throttle",), f"a share above 0 and below 1 was expected, got {self.throttle:g}")


def add_reducing(builder: SystemBuilder, component: ReducingValve) -> None:
    """The setting against p_A; the other way round for what relieves A."""
    ports = component.ports
    add_opened(builder, component, "flow", (ports["P"], ports["A"]), {ports["A"]: -1.0}, component.pressure, 1.0)
    if "T" in ports:
        ends, numbers = (ports["A"], ports["T"]), rated(component, 0.0)
        add_opened(builder, component, "relief_flow", ends, {ports["A"]: 1.0}, component.pressure, numbers=numbers)


def add_compensator(builder: SystemBuilder, component: Compensator) -> None:
    """The margin and half the range against p_A - p_LS."""
    ports = component.ports
    factors, half = {ports["A"]: -1.0, ports["LS"]: 1.0}, 0.5 * component.opening_range
    add_opened(builder, component, "flow", (ports["P"], ports["A"]), factors, component.margin, 1.0, half)


def add_sequence(builder: SystemBuilder, component: SequenceValve) -> None:
    """p_P against the spring and its drain; perhaps a check valve back."""
    ports = component.ports
    factors, constant = {ports["P"]: 1.0}, -ATMOSPHERE
    if "T" in ports:
        factors, constant = sums((ports["P"], 1.0), (ports["T"], -1.0)), 0.0
    ends = ports["P"], ports["A"]
    add_opened(builder, component, "flow", ends, factors, component.opens_at, constant=constant)
    if component.free_return:
        add_check_between(builder, component, "check_flow", (ports["A"], ports["P"]))


def add_soft_start(builder: SystemBuilder, component: SoftStart) -> None:
    """p_A - share p_P opens what lies beside a throttle."""
    ports, name = component.ports, component.name
    ends, head = (ports["P"], ports["A"]), rated(component, 0.0)
    factors, share = {ports["A"]: 1.0, ports["P"]: -component.switches_at}, component.throttle
    add_opened(builder, component, "flow", ends, factors, 0.0, 1.0, numbers=[(1.0 - share) * head[0], *head[1:]])
    add_flow(builder, name, "throttled_flow", ends, [share * head[0], *head[1:]])


def reducing(data: Mapping[str, Any]) -> Symbol:
    """A reducing valve."""
    body, drain = square(True, True) + path("M0 -17 H-18 V0 H-12", "dashed"), "T" in (data.get("ports") or {})
    body += path("M8 12 V16 H30 V20") if drain else ""
    below = {"P": 0.0} | ({"T": 30.0} if drain else {})
    return Symbol(body, 30.0 if drain else 27.0, 20.0, {"A": 0.0}, below, settings=in_bar(data, "pressure"))


FELT = path("M0 -17 H-18 V0 H-12 M26 0 H34 V20", "dashed")
COMPENSATOR = Symbol(square(True, True) + FELT, 34.0, 20.0, {"A": 0.0}, {"P": 0.0, "LS": 34.0}, key="margin", unit=BAR)


def sequence(data: Mapping[str, Any]) -> Symbol:
    """A sequence valve, drained outside."""
    drained = "T" in (data.get("ports") or {})
    body = square(False, True, drained) + path("M0 17 H-18 V0 H-12", "dashed")
    if data.get("free_return"):
        body += path("M0 -17 H34 V-7 M34 7 V17 H0") + check_at(34.0, 0.0, up=False)
    if varies(data, "opens_at"):
        body += adjustable(13, 9, 27, -10)
    below = {"P": 0.0} | ({"T": 20.0} if drained else {})
    wide = 41.0 if data.get("free_return") else 27.0
    return Symbol(body, wide, 20.0, {"A": 0.0}, below, settings=in_bar(data, "opens_at"))


# a throttle beside what its outlet opens
VALVE = path("M-30 -12 H-6 V12 H-30 Z M-18 -20 V-12 M-18 12 V20 M-18 -8 V8 M-18 -8 l-3 6 h6 z")
THROTTLE = path("M-18 -16 H14 V-8 M14 8 V16 H-18 M14 -8 V8 M6 -8 Q13 0 6 8 M22 -8 Q15 0 22 8")
SOFT_START = Symbol(VALVE + THROTTLE + path("M-18 -18 H-36 V0 H-30", "dashed"), 36.0, 20.0, {"A": -18.0}, {"P": -18.0})

KINDS = (
    ComponentKind(ReducingValve, add_reducing, OF_POPPETS, symbol=reducing),
    ComponentKind(Compensator, add_compensator, OF_POPPETS, symbol=COMPENSATOR),
    ComponentKind(SequenceValve, add_sequence, OF_POPPETS, symbol=sequence),
    ComponentKind(SoftStart, add_soft_start, OF_POPPETS, symbol=SOFT_START),
)
