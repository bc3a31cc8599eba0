"""Valves that bound a pressure: relief, unloading and cross-port relief valves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated
from nivel.elements.circuits.composed import OF_POPPETS, PASSES, add_check_between, add_opened, sums
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.symbol import BAR, Symbol, check_at, in_bar, path, square
from nivel.known import SystemBuilder
from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Leakage
from nivel.machine.core.element import Inequalities
from nivel.machine.given import Field, Maybe


class ReliefValve(Rated):
    """Opens from P to T where the difference of pressure exceeds `opens_at`."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "T")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    relieves: ClassVar[str] = "P"

    inequalities: ClassVar[Inequalities] = (PASSES,)

    type: Literal["relief-valve"] = "relief-valve"
    opens_at: ranges.VaryingLevel = Field(description="difference of pressure at which it begins to open")
    opening_range: ranges.Drop = Field(description="difference of pressure from there to fully open")
    lag: ranges.Lag = Field(default=0.0, description="time constant of the opening; 0: none")
    leakage: Leakage = Field(default=0.0)

    @property
    def inlets(self) -> tuple[str, ...]:
        return ("P", "T") if self.leakage else ("T",)


class UnloadingValve(Rated):
    """Opens from P to T where P is more than `opens_at` above LS, or where a pilot X is above it."""

    needs: ClassVar[tuple[str, ...]] = ("P", "T")
    may: ClassVar[tuple[str, ...]] = ("LS", "X")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    relieves: ClassVar[str] = "P"

    type: Literal["unloading-valve"] = "unloading-valve"
    opens_at: ranges.VaryingLevel = Field(description="with LS: difference of P and LS; with X: that of X and the air")
    opening_range: ranges.Drop = Field(default=3e5, description="from there to fully open")
    lag: ranges.Lag = Field(default=0.01, description="time constant of the opening; 0: none")
    leakage: Leakage = Field(default=0.0)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if ("LS" in self.ports) == ("X" in self.ports):
            got = "got both" if "X" in self.ports else "got neither"
            yield Problem((), f"an unloading valve has a port LS, which it stands above, or a pilot X; {got}")


class CrossPortRelief(Rated):
    """Two relief valves between the lines of a motor, from A to B and from B to A; with a port T also anti-cavitation valves from there."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    may: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = (
        "flow_AB",
        "flow_BA",
        "position_AB",
        "position_BA",
        "flow_TA",
        "flow_TB",
        "position_TA",
        "position_TB",
    )

    type: Literal["cross-port-relief"] = "cross-port-relief"
    opens_at: ranges.VaryingLevel = Field(description="difference of pressure of both lines")
    opening_range: ranges.Drop = Field(default=20e5, description="from there to fully open")
    lag: ranges.Lag = Field(default=0.0, description="time constant of the relief valves; 0: none")
    check_flow: Maybe[ranges.Flow] = Field(default=None, description="of the anti-cavitation valves; default `flow`")
    check_pressure_drop: Maybe[ranges.Drop] = Field(default=None, description="of these; default `pressure_drop`")
    check_opens_at: ranges.LeastDrop = Field(default=0.2e5)
    check_opening_range: ranges.Drop = Field(default=1e5)
    leakage: Leakage = Field(default=0.0)

    @property
    def check_conductance(self) -> float:
        """K [m³/s/√Pa] of the anti-cavitation valves."""
        flow, drop = self.check_flow or self.flow, self.check_pressure_drop or self.pressure_drop
        return flow / drop**0.5 if flow and drop else 0.0

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        return cls.late if "T" in cls.ports_in(data) else cls.late[:4]


def add_relief(builder: SystemBuilder, component: ReliefValve) -> None:
    """p_P - p_T against the spring."""
    ports = component.ports
    factors = {ports["P"]: 1.0, ports["T"]: -1.0}
    add_opened(builder, component, "flow", (ports["P"], ports["T"]), factors, component.opens_at)


def add_unloading(builder: SystemBuilder, component: UnloadingValve) -> None:
    """p_P - p_LS, or a pilot above the air, against the spring."""
    ports = component.ports
    factors, constant = sums((ports["P"], 1.0), (ports.get("LS", ""), -1.0)), 0.0
    if "X" in ports:
        factors, constant = {ports["X"]: 1.0}, -ATMOSPHERE
    ends = ports["P"], ports["T"]
    add_opened(builder, component, "flow", ends, factors, component.opens_at, constant=constant)


def add_cross_port(builder: SystemBuilder, component: CrossPortRelief) -> None:
    """A relief valve each way, and check valves from the tank line."""
    ports = component.ports
    for a, b in (("A", "B"), ("B", "A")):
        factors = sums((ports[a], 1.0), (ports[b], -1.0))
        add_opened(builder, component, f"flow_{a}{b}", (ports[a], ports[b]), factors, component.opens_at)
    if "T" in ports:
        numbers = [component.check_conductance, component.transition, 0.0]
        spring = (component.check_opens_at, component.check_opening_range)
        for side in "AB":
            ends = (ports["T"], ports[side])
            add_check_between(builder, component, f"flow_T{side}", ends, numbers, spring)


RELIEF = Symbol(
    square(False, False) + path("M0 -17 H-18 V0 H-12", "dashed"), 27.0, 20.0, {"P": 0.0}, {"T": 0.0}, "relief",
    key="opens_at", unit=BAR, arrow=(13, 9, 27, -10),
)  # fmt: skip


def unloading(data: Mapping[str, Any]) -> Symbol:
    """An unloading valve: P above, as of a relief valve."""
    ports = data.get("ports") or {}
    body = square(False, False)
    if "X" in ports:
        body += path("M-30 20 V0 H-12", "dashed")
        return Symbol(body, 30.0, 20.0, {"P": 0.0}, {"T": 0.0, "X": -30.0}, "relief", in_bar(data, "opens_at"))
    body += path("M0 -17 H-18 V0 H-12 M26 0 H34 V20", "dashed")
    return Symbol(body, 34.0, 20.0, {"P": 0.0}, {"T": 0.0, "LS": 34.0}, "relief", in_bar(data, "opens_at"))


def cross_port(data: Mapping[str, Any]) -> Symbol:
    """Two relief valves between two lines, and anti-cavitation valves from below."""
    anti = "T" in (data.get("ports") or {})
    body = path("M-40 -30 V-14 M40 -30 V-14 M-40 -24 H-22 V-20 M40 -8 H-22 V-12 M40 -24 H22 V-20 M-40 -8 H22 V-12")
    for x in (-22.0, 22.0):
        body += path(f"M{x - 6:g} -20 h12 v8 h-12 z") + path(f"M{x + 6:g} -16 l2 -3 l2 6 l2 -6 l2 3")
    body += path("M-40 -14 V-8 M40 -14 V-8")
    if anti:
        body += (
            path("M-40 -8 V4 M-40 17 V24 H40 V17 M40 4 V-8 M0 24 V30") + check_at(-40.0, 10.0) + check_at(40.0, 10.0)
        )
    body += path("M-48 -27 H48 V27 H-48 Z", "frame")
    above = {"A": -40.0, "B": 40.0}
    return Symbol(body, 48.0, 30.0, above, {"T": 0.0} if anti else {}, settings=in_bar(data, "opens_at"))


KINDS = (
    ComponentKind(ReliefValve, add_relief, OF_POPPETS, symbol=RELIEF),
    ComponentKind(UnloadingValve, add_unloading, OF_POPPETS, symbol=unloading),
    ComponentKind(CrossPortRelief, add_cross_port, OF_POPPETS, symbol=cross_port),
)
