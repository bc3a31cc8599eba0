"""Valves that pressures open, in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import (
    Leakage,
    NotNegativeDuration,
    NotNegativePressure,
    PositiveNumber,
    Pressure,
    Truth,
    Volume,
    VolumeFlow,
)
from nivel.machine.core.element import Acts, Inequalities
from nivel.machine.core.record import entry
from nivel.machine.given import Field, Maybe
from nivel.machine.hydraulics.component import Rated
from nivel.machine.hydraulics.usual import BORE, DIFFERENCE, FLOW, LAG, PRESSURE, VOLUME
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import PositiveLength

VaryingPressure = Annotated[OneFunction, varying("pressure")]

# what is closed has no flow but its leak
PASSES = Acts(
    ("is closed", "is open"),
    "position",
    lambda own, of: of["position"],
    lambda own, of: of["flow"],
    always=lambda own: False,
    applies=lambda own: not own.leakage,
)


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
    opens_at: NotNegativePressure = Field(
        default=0.5e5, description="difference of pressure at which it begins to open", usual=DIFFERENCE
    )
    opening_range: Pressure = Field(
        default=3e5, description="difference of pressure from there to fully open", usual=DIFFERENCE
    )
    pilot_ratio: Maybe[PositiveNumber] = Field(default=None, description="area of the pilot over that of the seat")
    lag: NotNegativeDuration = Field(default=0.0, description="time constant of the opening; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)

    @property
    def inlets(self) -> tuple[str, ...]:
        return ("A", "B") if self.leakage or "X" in self.ports else ("B",)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if ("X" in self.ports) != (self.pilot_ratio is not None):
            lacking = "`pilot_ratio` is" if self.pilot_ratio is None else "port X is"
            yield Problem((), f"{lacking} missing: a pilot has a port X and a `pilot_ratio`")


class ReliefValve(Rated):
    """Opens from P to T where the difference of pressure exceeds `opens_at`."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "T")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    relieves: ClassVar[str] = "P"

    inequalities: ClassVar[Inequalities] = (PASSES,)

    type: Literal["relief-valve"] = "relief-valve"
    opens_at: VaryingPressure = Field(description="difference of pressure at which it begins to open", usual=PRESSURE)
    opening_range: Pressure = Field(description="difference of pressure from there to fully open", usual=DIFFERENCE)
    lag: NotNegativeDuration = Field(default=0.0, description="time constant of the opening; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)

    @property
    def inlets(self) -> tuple[str, ...]:
        return ("P", "T") if self.leakage else ("T",)


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
    opens_at: VaryingPressure = Field(
        description="load pressure at which it begins to open without a pilot", usual=PRESSURE
    )
    opening_range: Pressure = Field(
        default=80e5, description="control pressure from there to fully open", usual=DIFFERENCE
    )
    pilot_ratio: PositiveNumber = Field(default=3.0, description="R")
    vented: Truth = Field(default=False, description="whether the pressure at V does not act on it")
    lag: NotNegativeDuration = Field(default=0.01, description="time constant of the opening; 0: none", usual=LAG)
    check_flow: Maybe[VolumeFlow] = Field(default=None, description="of the check valve; default `flow`", usual=FLOW)
    check_pressure_drop: Maybe[Pressure] = Field(
        default=None, description="of the check valve; default `pressure_drop`", usual=DIFFERENCE
    )
    check_opens_at: NotNegativePressure = Field(default=0.5e5, usual=DIFFERENCE)
    check_opening_range: Pressure = Field(default=4e5, usual=DIFFERENCE)
    leakage: Leakage = Field(default=0.0)
    pilot_orifice: Maybe[PositiveLength] = Field(
        default=None, description="diameter of an orifice in the pilot line; default: none", usual=BORE
    )
    drain_orifice: Maybe[PositiveLength] = Field(
        default=None, description="diameter of an orifice from behind it to V: the pilot is a share of X", usual=BORE
    )
    inner_volume: Volume = Field(default=2e-6, description="of the pilot chamber behind its orifice", usual=VOLUME)

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


class ReducingValve(Rated):
    """Closes from P to A as the pressure at A comes to `pressure`; with a port T it relieves A above that."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    may: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("pressure",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "relief_flow")

    type: Literal["reducing-valve"] = "reducing-valve"
    pressure: VaryingPressure = Field(description="at A, absolute, at which it is closed", usual=PRESSURE)
    opening_range: Pressure = Field(
        default=5e5, description="pressure below that at which it is fully open", usual=DIFFERENCE
    )
    lag: NotNegativeDuration = Field(default=0.0, description="time constant of the opening; 0: none", usual=LAG)
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
    margin: VaryingPressure = Field(default=7e5, description="held between A and LS", usual=DIFFERENCE)
    opening_range: Pressure = Field(default=6e5, description="from closed to fully open", usual=DIFFERENCE)
    lag: NotNegativeDuration = Field(default=0.01, description="time constant of the opening; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)
