"""Valves that hold or share a flow: flow control, divider, priority."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Final, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, VaryingPressure, problem_of_share
from nivel.elements.circuits.composed import INNER_VOLUME, OF_POPPETS, add_check_between, add_opened
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.nodes import inner_nodes
from nivel.elements.circuits.restrictions import GIVEN, add_flow, rated
from nivel.elements.circuits.symbol import SPRING, Symbol, adjustable, check_at, in_bar, letters, moved, path, varies
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import Leakage, Pressure, Share, Truth
from nivel.machine.core.record import Problem, entry, superfluous
from nivel.machine.given import Field
from nivel.machine.laws.time_function import OneFunction, varying

Setting = Annotated[OneFunction, varying("number")]


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
    setting: Setting = Field("opening of the orifice from 0 to 1", default=1.0)
    margin: Pressure = Field("difference of pressure that is held over the orifice", default=7e5)
    opening_range: Pressure = Field("of the compensator, from closed to fully open", default=2e5)
    lag: ranges.Lag = Field("time constant of the compensator; 0: none", default=0.005)
    free_return: Truth = Field("whether a check valve lets fluid pass from A to P", default=False)
    leakage: Leakage = Field(default=0.0)
    inner_volume: ranges.Size = Field("between compensator and orifice", default=INNER_VOLUME)

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
    share: Share = Field("of A in the whole flow; `flow` is the whole flow", default=0.5)
    combines: Truth = Field("whether it joins the flows of A and B at P", default=False)
    opening_range: ranges.Drop = Field("difference of pressure over which the spool moves from end to end", default=1e5)
    lag: ranges.Lag = Field("time constant of the spool; 0: none", default=0.005)
    leakage: Leakage = Field(default=0.0)
    inner_volume: ranges.Size = Field("behind each orifice", default=INNER_VOLUME)

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
    margin: VaryingPressure = Field("held between CF and LS", default=7e5, usual=ranges.DIFFERENCE)
    opening_range: ranges.Drop = Field("over which the flow passes from CF to EF", default=4e5)
    lag: ranges.Lag = Field("time constant of the spool; 0: none", default=0.01)
    leakage: Leakage = Field(default=0.0)


def add_flow_control(builder: SystemBuilder, component: FlowControl) -> None:
    """An orifice, with a compensator before it or a bypass beside it that holds the margin over it."""
    half, margin, spool = 0.5 * component.opening_range, component.margin, rated(component, 0.0)
    meter, head = (GIVEN, builder.function(component.setting)), rated(component, component.leakage)
    how: dict[str, Any] = {"constant": half, "numbers": spool, "position": "position"}
    if "T" in component.ports:
        add_flow(builder, component, "flow", ("P", "A"), head, meter)
        add_opened(builder, component, "bypass_flow", ("P", "T"), {"P": 1.0, "A": -1.0}, margin, **how)
    else:
        add_opened(builder, component, "compensator_flow", ("P", ".M"), {".M": -1.0, "A": 1.0}, margin, 1.0, **how)
        add_flow(builder, component, "flow", (".M", "A"), head, meter)
    if component.free_return:
        add_check_between(builder, component, "check_flow", ("A", "P"))


def add_divider(builder: SystemBuilder, component: FlowDivider) -> None:
    """Two orifices, and two edges of one spool behind them that the pressures between move against each other."""
    whole, corner, leak = rated(component, component.leakage)
    way, half = -1.0 if component.combines else 1.0, 0.5 * component.opening_range
    for side, own, other, share in (("A", ".M", ".N", component.share), ("B", ".N", ".M", 1.0 - component.share)):
        numbers, factors = [share * whole, corner, leak], {own: way, other: -way}
        add_flow(builder, component, f"orifice_flow_{side}", ("P", own), numbers)
        add_opened(builder, component, f"flow_{side}", (own, side), factors, constant=half, numbers=numbers)


def add_priority(builder: SystemBuilder, component: PriorityValve) -> None:
    """Two edges of one spool: CF closes as EF opens."""
    half, margin = 0.5 * component.opening_range, component.margin
    for side, sign, position in (("CF", 1.0, "position"), ("EF", -1.0, "position_EF")):
        factors = {"LS": sign, "CF": -sign}
        add_opened(builder, component, f"flow_{side}", ("P", side), factors, margin, sign, half, position=position)


THROTTLE: Final = "M-7 -7 Q-1 0 -7 7 M7 -7 Q1 0 7 7"


def flow_control(data: Mapping[str, Any]) -> Symbol:
    """A flow control valve, of two or three ways."""
    body = path(f"M-14 -14 H14 V14 H-14 Z M0 -20 V20 {THROTTLE}") + path("M0 -14 l-3 6 h6 z", "full")
    if varies(data, "setting") or data.get("setting", 1.0) != 1.0:
        body += adjustable(-13, 12, 13, -12)
    three = "T" in (data.get("ports") or {})
    body += path("M0 9 H10 V20") if three else ""
    if data.get("free_return"):
        body += path("M0 -17 H22 V-7 M22 7 V17 H0") + check_at(22.0, 0.0, up=False)
    right = 29.0 if data.get("free_return") else 14.0
    return Symbol(body, right, 20.0, {"A": 0.0}, {"P": 0.0} | ({"T": 10.0} if three else {}))


def divider(data: Mapping[str, Any]) -> Symbol:
    """A flow divider, or one that combines."""
    body = path("M-24 -14 H24 V14 H-24 Z M0 20 V6 H-14 V-20 M0 6 H14 V-20")
    body += moved(path("M-5 -5 Q0 0 -5 5 M5 -5 Q0 0 5 5"), -14, -4) + moved(
        path("M-5 -5 Q0 0 -5 5 M5 -5 Q0 0 5 5"), 14, -4
    )
    tip = "M{x} 4 l-3 -6 h6 z" if data.get("combines") else "M{x} -14 l-3 5 h6 z"
    body += "".join(path(tip.format(x=x), "full") for x in (-14, 14))
    share = data.get("share", 0.5)
    said = (f"{100.0 * share:.3g} : {100.0 * (1.0 - share):.3g}",)
    return Symbol(body, 24.0, 20.0, {"A": -14.0, "B": 14.0}, {"P": 0.0}, settings=said)


def priority(data: Mapping[str, Any]) -> Symbol:
    """A priority valve: at rest the way to CF is open."""
    body = path("M-24 -12 H0 V12 H-24 Z M0 -12 H24 V12 H0 Z M6 -20 V-12 M18 -20 V-12 M12 12 V20")
    body += path("M12 12 L7 -7") + path("M6 -12 l-1 6.5 l5 -1.5 z", "full")
    body += path("M-12 12 L-7 -7") + path("M-6 -12 l1 6.5 l-5 -1.5 z", "full") + path("M18 -12 v5 m-3 0 h6")
    body += path(f"M24 0 {SPRING}") + path("M38 0 V20 M6 -16 H-30 V0 H-24", "dashed")
    body += letters({"CF": (-8.0, -14.0), "EF": (20.0, -14.0)})
    return Symbol(body, 38.0, 20.0, {"CF": 6.0, "EF": 18.0}, {"P": 12.0, "LS": 38.0}, settings=in_bar(data, "margin"))


KINDS = (
    ComponentKind(FlowControl, add_flow_control, OF_POPPETS, symbol=flow_control, nodes=inner_nodes("M")),
    ComponentKind(FlowDivider, add_divider, OF_POPPETS, symbol=divider, nodes=inner_nodes("M", "N")),
    ComponentKind(PriorityValve, add_priority, OF_POPPETS, symbol=priority),
)
