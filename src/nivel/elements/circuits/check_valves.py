"""Valves through which fluid passes one way: check, shuttle and quick-exhaust valves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Final, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated
from nivel.elements.circuits.composed import OF_POPPETS, PASSES, add_opened, sums
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.symbol import Symbol, circle, path
from nivel.known import SystemBuilder
from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Leakage, PositiveNumber
from nivel.machine.core.element import Acts, Inequalities
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
    opens_at: ranges.LeastDrop = Field(default=0.5e5, description="difference of pressure at which it begins to open")
    opening_range: ranges.Drop = Field(default=3e5, description="difference of pressure from there to fully open")
    pilot_ratio: Maybe[PositiveNumber] = Field(default=None, description="area of the pilot over that of the seat")
    lag: ranges.Lag = Field(default=0.0, description="time constant of the opening; 0: none")
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
    opening_range: ranges.Drop = Field(default=0.5e5, description="difference of pressure over which it changes sides")
    lag: ranges.Lag = Field(default=0.0, description="time constant; 0: none")
    leakage: Leakage = Field(default=0.0)


class QuickExhaust(Rated):
    """Lets fluid from P to A while p_P is higher, and from A to R while p_A is."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A", "R")
    late: ClassVar[tuple[str, ...]] = ("flow_PA", "flow_AR", "position", "exhaust_position")

    type: Literal["quick-exhaust"] = "quick-exhaust"
    opens_at: ranges.Drop = Field(default=0.05e5, description="difference at which it begins to open")
    opening_range: ranges.Drop = Field(default=0.2e5, description="difference of pressure from there to fully open")
    lag: ranges.Lag = Field(default=0.0, description="time constant of the opening; 0: none")
    leakage: Leakage = Field(default=0.0)


def add_check(builder: SystemBuilder, component: CheckValve) -> None:
    """p_A - p_B, and of a pilot its ratio times what it is above the air, against the spring."""
    ports, ratio = component.ports, component.pilot_ratio or 0.0
    factors = {ports["A"]: 1.0, ports["B"]: -1.0}
    if "X" in ports:
        factors[ports["X"]] = factors.get(ports["X"], 0.0) + ratio
    ends, constant = (ports["A"], ports["B"]), -ratio * ATMOSPHERE
    add_opened(builder, component, "flow", ends, factors, component.opens_at, constant=constant)


def add_shuttle(builder: SystemBuilder, component: ShuttleValve) -> None:
    """Two seats: the one on the side of the higher pressure is open."""
    ports, half = component.ports, 0.5 * component.opening_range
    for side, other, position in (("A", "B", "position"), ("B", "A", "position_B")):
        factors, ends = sums((ports[side], 1.0), (ports[other], -1.0)), (ports[side], ports["C"])
        add_opened(builder, component, f"flow_{side}", ends, factors, constant=half, position=position)


def add_quick_exhaust(builder: SystemBuilder, component: QuickExhaust) -> None:
    """p_P - p_A against the spring, and the other way round."""
    p, a, opens_at = component.ports["P"], component.ports["A"], component.opens_at
    add_opened(builder, component, "flow_PA", (p, a), {p: 1.0, a: -1.0}, opens_at, position="position")
    ends = a, component.ports["R"]
    add_opened(builder, component, "flow_AR", ends, {a: 1.0, p: -1.0}, opens_at, position="exhaust_position")


CHECK: Final = path("M0 16 V7 M-8 -4 L0 7 L8 -4 M0 -7 V-16") + circle(5.0, -2.0)


def check(data: Mapping[str, Any]) -> Symbol:
    """A check valve, with or without a pilot."""
    pilot = path("M24 16 V3 H3", "dashed") if "X" in (data.get("ports") or {}) else ""
    return Symbol(CHECK + pilot, 24.0 if pilot else 9.0, 16.0, {"B": 0.0}, {"A": 0.0} | ({"X": 24.0} if pilot else {}))


SEATS: Final = path("M-20 -9 H20 V9 H-20 Z M-13 -5 L-6 0 L-13 5 M13 -5 L6 0 L13 5 M0 -9 V-16") + path(
    "M-20 0 H-26 V16 M20 0 H26 V16"
)
SHUTTLE = Symbol(SEATS + '<circle cx="-4" cy="0" r="4"/>', 26.0, 16.0, {"C": 0.0}, {"A": -26.0, "B": 26.0})

# a shuttle whose common port is A, with its exhaust
QUICK_EXHAUST = Symbol(SEATS + '<circle cx="10" cy="0" r="4"/>', 26.0, 16.0, {"A": 0.0}, {"P": -26.0, "R": 26.0})

KINDS = (
    ComponentKind(CheckValve, add_check, OF_POPPETS, symbol=check),
    ComponentKind(ShuttleValve, add_shuttle, OF_POPPETS, symbol=SHUTTLE),
    ComponentKind(QuickExhaust, add_quick_exhaust, OF_POPPETS, symbol=QUICK_EXHAUST),
)
