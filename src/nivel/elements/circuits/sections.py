"""Sections of mobile directional valves: a metering spool with its pressure compensator."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, VaryingPressure, problem_of_share
from nivel.elements.circuits.composed import INNER_VOLUME, add_opened, sums
from nivel.elements.circuits.directional_valves import add_spool, move
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.nodes import inner_nodes
from nivel.elements.circuits.poppets import lift
from nivel.elements.circuits.restrictions import EDGE, add_flow, restrict
from nivel.elements.circuits.symbol import Symbol, arrow, in_bar, moved, path
from nivel.elements.circuits.ways import directional_valve
from nivel.known import SystemBuilder
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Leakage, PositiveNumber
from nivel.machine.core.coefficient import Share as Proportion
from nivel.machine.core.record import entry
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Quantity

NODES_OF = {"none": (), "pre": (".M",), "post": (".M", ".C")}


class Section(Rated):
    """A 4/3 section of a mobile valve: `command` from -1 to 1 meters the flow from P to A, or to B; the other side drains to T.

    pre : a compensator before the spool holds the `margin` over it; with `saturation_share` it holds that share of what the pump gives
    above LS. post : a compensator behind the metering edge brings the pressure there to LS plus `margin`, so that all sections share
    what there is. none : the spool alone.
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "T", "A", "B")
    may: ClassVar[tuple[str, ...]] = ("LS",)
    nodes: ClassVar[tuple[str, ...]] = (".M", ".C")
    loads: ClassVar[bool] = True
    functions: ClassVar[tuple[str, ...]] = ("command", "margin")
    early: ClassVar[tuple[str, ...]] = ("pressure_M", "pressure_C")
    late: ClassVar[tuple[str, ...]] = (
        "position",
        "compensator_position",
        "compensator_flow",
        "flow_PA",
        "flow_PB",
        "flow_PM",
        "flow_MA",
        "flow_MB",
        "flow_CA",
        "flow_CB",
        "flow_AT",
        "flow_BT",
    )

    type: Literal["section"] = "section"
    compensation: Literal["pre", "post", "none"] = Field(default="pre", description="where its compensator is")
    command: Annotated[OneFunction, varying("number")] = Field(description="position asked for")
    flow_B: Maybe[ranges.Flow] = Field(default=None, description="of the edge to B; default `flow`")
    return_flow: Maybe[ranges.Flow] = Field(
        default=None, description="of the edges to T, at `pressure_drop`; default: that of the other edges"
    )
    overlap: Annotated[OneNumber, Quantity("number")] = Field(
        default=0.05, description="share of the stroke before an edge opens"
    )
    rounding: Proportion = Field(default=0.02, description="share of the stroke over which an edge begins to open")
    frequency: Maybe[ranges.SpoolFrequency] = Field(
        default=None, description="natural frequency of the spool; default: no lag"
    )
    damping_ratio: PositiveNumber = Field(default=0.8, description="of the spool")
    margin: VaryingPressure = Field(
        default=7e5, description="of pre: held over the spool; of post: above LS; 0 of post with `saturation_share`"
    )
    saturation_share: Maybe[Proportion] = Field(
        default=None, description="of pre, in place of `margin`: share of p_P - p_LS, so that all fall together"
    )
    opening_range: ranges.Drop = Field(default=4e5, description="of the compensator, from closed to fully open")
    compensator_flow: Maybe[ranges.Flow] = Field(
        default=None, description="of it, fully open, at `pressure_drop`; default twice `flow`"
    )
    lag: ranges.Lag = Field(default=0.01, description="time constant of the compensator; 0: none")
    leakage: Leakage = Field(default=0.0, description="of each edge")
    inner_volume: ranges.Size = Field(default=INNER_VOLUME, description="between spool and compensator")

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        return NODES_OF.get(str(entry(data, "compensation") or "pre"), ())

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        kind = str(entry(data, "compensation") or "pre")
        of_kind = {
            "none": ("flow_PA", "flow_PB"),
            "pre": ("compensator_position", "compensator_flow", "flow_MA", "flow_MB"),
            "post": ("compensator_position", "compensator_flow", "flow_PM", "flow_CA", "flow_CB"),
        }
        pressures = tuple(f"pressure_{node[1:]}" for node in cls.nodes_in(data))
        return (*pressures, "position", *of_kind.get(kind, ()), "flow_AT", "flow_BT")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problem_of_share("command", self.command, -1.0)
        if not 0.0 <= self.overlap < 0.9:
            yield Problem(("overlap",), f"a share of the stroke from 0 to 0.9 was expected, got {self.overlap:g}")
        if self.is_of_gas:
            yield superfluous("sonic_conductance", "is of gases; a section is for liquids")
        if (self.compensation == "none") == ("LS" in self.ports):
            if self.compensation == "none":
                yield superfluous("ports", "LS belongs to a section with a compensator")
            else:
                yield Problem((), "port LS is missing: the compensator reads the load-sensing pressure; write `LS: ls`")
        if self.saturation_share is not None and self.compensation != "pre":
            yield superfluous("saturation_share", "belongs to `compensation: pre`; post shares the flow by itself")


DIRECTING = 4.0  # size of the edges behind a compensator over that of the metering ones


def add_section(builder: SystemBuilder, component: Section) -> None:
    """A spool, its metering edges with a compensator before or behind them, and its return edges."""
    kind, ports, name = component.compensation, component.ports, component.name
    position = builder.outputs.add((f"hydraulics.{name}.position", "1", f"position of {name}"))
    add_spool(builder, component, position, -1.0)
    forward = component.conductance
    back = component.flow_B / component.pressure_drop**0.5 if component.flow_B and component.pressure_drop else forward
    p, m, c = ports["P"], f"{name}.M", f"{name}.C"

    def edge(quantity: str, ends: tuple[str, str], size: float, sign: float) -> None:
        full = 1.0 - component.overlap - 0.5 * component.rounding
        slope = [sign, -component.overlap, component.rounding, 1.0 / full]
        numbers = [size, component.transition, component.leakage, *slope]
        add_flow(builder, name, quantity, ends, numbers, (EDGE, position))

    if kind == "pre":
        _add_compensator(builder, component, (p, m), (m, 1.0 - (component.saturation_share or 0.0)))
        edge("flow_MA", (m, ports["A"]), forward, 1.0)
        edge("flow_MB", (m, ports["B"]), back, -1.0)
    elif kind == "post":
        edge("flow_PM", (p, m), forward, 1.0)
        edge("flow_PM_back", (p, m), back, -1.0)
        _add_compensator(builder, component, (m, c), (m, 1.0))
        edge("flow_CA", (c, ports["A"]), DIRECTING * forward, 1.0)
        edge("flow_CB", (c, ports["B"]), DIRECTING * back, -1.0)
    else:
        edge("flow_PA", (p, ports["A"]), forward, 1.0)
        edge("flow_PB", (p, ports["B"]), back, -1.0)
    returned = component.return_flow / component.pressure_drop**0.5 if component.return_flow else None  # type: ignore[operator]
    edge("flow_BT", (ports["B"], ports["T"]), returned or back, 1.0)
    edge("flow_AT", (ports["A"], ports["T"]), returned or forward, -1.0)


def _add_compensator(
    builder: SystemBuilder, component: Section, ends: tuple[str, str], felt: tuple[str, float]
) -> None:
    """pre: margin, or its share of p_P - p_LS, against p_M - p_LS. post: p_M against p_LS and the margin."""
    ls, p, half = component.ports["LS"], component.ports["P"], 0.5 * component.opening_range
    m, rest = felt
    sign, setting = (-1.0 if component.compensation == "post" else 1.0), component.margin
    factors = sums((m, -sign), (ls, sign))
    if component.compensation != "post" and component.saturation_share is not None:
        factors, setting = sums((m, -1.0), (ls, rest), (p, component.saturation_share)), 0.0
    size = 2.0 * component.conductance
    if component.compensator_flow and component.pressure_drop:
        size = component.compensator_flow / component.pressure_drop**0.5
    numbers = [size, component.transition, component.leakage]
    add_opened(builder, component, "compensator_flow", ends, factors, setting, sign, half, numbers=numbers)


OF_SECTIONS = (move, lift, restrict)


def section(data: Mapping[str, Any]) -> Symbol:
    """A section: its spool, and its compensator before or behind the metering edge."""
    spool = directional_valve({"ways": "4/3", "frequency": data.get("frequency") or 1.0})
    kind = data.get("compensation") or "pre"
    if kind == "none":
        return spool
    body, wide, below = moved(spool.body, 0.0, -13.0), spool.wide, spool.below
    p, t = below["P"], below["T"]
    if kind == "pre":
        body += path(f"M{p:g} 8 V12 M{p:g} 28 V34 M{p - 8:g} 12 h16 v16 h-16 z") + arrow(p, 28, 12)
        body += path(f"M{p + 8:g} 20 l2 -4 l3 8 l3 -8 l2 4") + path(f"M{p + 18:g} 20 H40 V34", "dashed")
        body += path(f"M{p:g} 10 H{p - 13:g} V20 H{p - 8:g}", "dashed") + path(f"M{t:g} 8 V34")
    else:
        body += path(f"M{p:g} 8 V34 M{t:g} 8 V34 M-36 8 h16 v16 h-16 z M-28 8 V4 H{p:g} M-28 24 V30 H{p:g}")
        body += arrow(-28, 24, 8) + path("M-20 16 H40 V34", "dashed")
    body += path(f"M{-wide + 2:g} -32 H{wide - 2:g} V31 H{-wide + 2:g} Z", "frame")
    return Symbol(body, wide, 34.0, spool.above, {**below, "LS": 40.0}, "valve", in_bar(data, "margin"))


KINDS = (ComponentKind(Section, add_section, OF_SECTIONS, symbol=section, nodes=inner_nodes("M", "C")),)
