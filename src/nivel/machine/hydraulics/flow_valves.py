"""Valves that hold or share a flow, in words: flow control, divider, priority, shuttle."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Leakage, NotNegativeDuration, Pressure, Share, Truth, Volume
from nivel.machine.core.record import entry
from nivel.machine.given import Field
from nivel.machine.hydraulics.component import Rated, problem_of_share
from nivel.machine.hydraulics.usual import DIFFERENCE, LAG, VOLUME
from nivel.machine.hydraulics.valves import VaryingPressure
from nivel.machine.laws.time_function import OneFunction, varying

Setting = Annotated[OneFunction, varying("number")]
INNER_VOLUME = 2e-6  # m³ between two edges of one valve


class FlowControl(Rated):
    """Holds a flow from P to A whatever the pressures are; with a port T the rest of what comes to P goes there (three-way).

    An orifice with the opening `setting`, and a compensator that holds the `margin` over it. `flow` at `pressure_drop` is that of the
    wholly open orifice and of the wholly open compensator.
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    may: ClassVar[tuple[str, ...]] = ("T",)
    nodes: ClassVar[tuple[str, ...]] = (".M",)
    functions: ClassVar[tuple[str, ...]] = ("setting",)
    early: ClassVar[tuple[str, ...]] = ("pressure_M",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "compensator_flow", "bypass_flow", "check_flow")
    relieves: ClassVar[str] = ""

    type: Literal["flow-control"] = "flow-control"
    setting: Setting = Field(default=1.0, description="opening of the orifice from 0 to 1")
    margin: Pressure = Field(default=7e5, description="difference of pressure that is held over the orifice")
    opening_range: Pressure = Field(default=2e5, description="of the compensator, from closed to fully open")
    lag: NotNegativeDuration = Field(default=0.005, description="time constant of the compensator; 0: none", usual=LAG)
    free_return: Truth = Field(default=False, description="whether a check valve lets fluid pass from A to P")
    leakage: Leakage = Field(default=0.0)
    inner_volume: Volume = Field(default=INNER_VOLUME, description="between compensator and orifice", usual=VOLUME)

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        return () if "T" in cls.ports_in(data) else cls.nodes

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        three = "T" in cls.ports_in(data)
        dropped = {"pressure_M", "compensator_flow"} if three else {"bypass_flow"}
        dropped |= set() if entry(data, "free_return") else {"check_flow"}
        return tuple(each for each in (*cls.early, *cls.late) if each not in dropped)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problem_of_share("setting", self.setting, 0.0)


class FlowDivider(Rated):
    """Divides what comes to P between A and B in a fixed ratio, whatever their pressures are; or combines what comes from both.

    Two orifices, and a spool that throttles the side whose pressure behind its orifice is too low.
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "A", "B")
    nodes: ClassVar[tuple[str, ...]] = (".M", ".N")
    early: ClassVar[tuple[str, ...]] = ("pressure_M", "pressure_N")
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B", "position_A", "position_B")

    type: Literal["flow-divider"] = "flow-divider"
    share: Share = Field(default=0.5, description="of A in the whole flow; `flow` is the whole flow")
    combines: Truth = Field(default=False, description="whether it joins the flows of A and B at P")
    opening_range: Pressure = Field(
        default=1e5, description="difference of pressure over which the spool moves from end to end", usual=DIFFERENCE
    )
    lag: NotNegativeDuration = Field(default=0.005, description="time constant of the spool; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)
    inner_volume: Volume = Field(default=INNER_VOLUME, description="behind each orifice", usual=VOLUME)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.share >= 1.0:
            yield Problem(("share",), f"a share between 0 and 1 was expected, got {self.share:g}")
        if self.is_of_gas:
            yield superfluous("sonic_conductance", "is of gases; a divider is for liquids")


class PriorityValve(Rated):
    """Gives CF what it needs to stand a `margin` above LS, and the rest of what comes to P to EF."""

    needs: ClassVar[tuple[str, ...]] = ("P", "CF", "EF", "LS")
    functions: ClassVar[tuple[str, ...]] = ("margin",)
    late: ClassVar[tuple[str, ...]] = ("flow_CF", "flow_EF", "position")

    type: Literal["priority-valve"] = "priority-valve"
    margin: VaryingPressure = Field(default=7e5, description="held between CF and LS", usual=DIFFERENCE)
    opening_range: Pressure = Field(
        default=4e5, description="over which the flow passes from CF to EF", usual=DIFFERENCE
    )
    lag: NotNegativeDuration = Field(default=0.01, description="time constant of the spool; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)


class ShuttleValve(Rated):
    """Joins C with the one of A and B that has the higher pressure."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("A", "B", "C")
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B", "position")

    type: Literal["shuttle-valve"] = "shuttle-valve"
    opening_range: Pressure = Field(
        default=0.5e5, description="difference of pressure over which it changes sides", usual=DIFFERENCE
    )
    lag: NotNegativeDuration = Field(default=0.0, description="time constant; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)
