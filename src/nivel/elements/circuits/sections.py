"""Sections of mobile directional valves: a metering spool with its pressure compensator."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, VaryingPressure, problem_of_share
from nivel.elements.circuits.composed import INNER_VOLUME, add_check_between, add_opened
from nivel.elements.circuits.directional_valves import add_spool, directional_valve, move, spool
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.nodes import inner_nodes
from nivel.elements.circuits.poppets import lift
from nivel.elements.circuits.restrictions import BAND, EDGE, MIDDLE, add_flow, restrict
from nivel.elements.circuits.symbol import Symbol, arrow, check_at, in_bar, moved, path
from nivel.known import SystemBuilder
from nivel.lazy import replace
from nivel.machine.core.coefficient import Leakage, PositiveNumber
from nivel.machine.core.coefficient import Share as Proportion
from nivel.machine.core.record import Problem, entry, superfluous
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Quantity

# ports of a section by its `open_centre`: N is the inlet of the neutral circulation, C its outlet to the next section
PORTS = {
    None: (("P", "T", "A", "B"), ("LS",)),
    "parallel": (("P", "N", "C", "T", "A", "B"), ()),
    "tandem": (("N", "C", "T", "A", "B"), ("P",)),
    "series": (("N", "C", "A", "B"), ()),
}
# signals by what feeds the metering edges, and nodes within: M before or behind them, C behind a compensator
FED_BY: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "none": (("flow_PA", "flow_PB"), ()),
    "pre": (("compensator_position", "compensator_flow", "flow_MA", "flow_MB"), (".M",)),
    "post": (("compensator_position", "compensator_flow", "flow_PM", "flow_CA", "flow_CB"), (".M", ".C")),
    "parallel": (("flow_PM", "flow_NC", "flow_MA", "flow_MB"), (".M",)),
    "tandem": (("flow_NM", "flow_PM", "flow_NC", "flow_MA", "flow_MB"), (".M",)),
    "series": (("flow_NM", "flow_NC", "flow_MA", "flow_MB"), (".M",)),
}
BACK = {"A": "B", "B": "A"}


class Section(Rated):
    """A section of a mobile valve: `command` from -1 to 1 meters the flow from P to A, or to B; the other side drains to T.

    pre : a compensator before the spool holds the `margin` over it; with `saturation_share` it holds that share of what the pump gives
    above LS. post : a compensator behind the metering edge brings the pressure there to LS plus `margin`, so that all sections share
    what there is. none : the spool alone. `open_centre`, a 6/3 section: a passage from N to C is open about the middle, and the feed has
    a check valve.
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "T", "A", "B")
    may: ClassVar[tuple[str, ...]] = ("LS", "N", "C")
    nodes: ClassVar[tuple[str, ...]] = (".M", ".C", ".R", ".HA", ".HB")
    loads: ClassVar[bool] = True
    functions: ClassVar[tuple[str, ...]] = ("command", "margin", "regeneration_until")
    early: ClassVar[tuple[str, ...]] = tuple(f"pressure_{node[1:]}" for node in nodes)
    late: ClassVar[tuple[str, ...]] = tuple(
        dict.fromkeys(
            [
                "position",
                *(signal for signals, _ in FED_BY.values() for signal in signals),
                *("flow_AT", "flow_BT", "flow_AC", "flow_BC", "flow_AR", "flow_BR", "flow_RT", "flow_RC"),
                *("regenerated_flow_RA", "regenerated_flow_RB", "float_flow_AT", "float_flow_BT", "float_flow_NC"),
                *(f"{word}_flow_{side}" for side in "AB" for word in ("check", "release")),
            ]
        )
    )

    type: Literal["section"] = "section"
    compensation: Literal["pre", "post", "none"] = Field("where its compensator is", default="pre")
    command: Annotated[OneFunction, varying("number")] = Field("position asked for")
    flow_B: Maybe[ranges.Flow] = Field("of the edge to B; default `flow`", default=None)
    return_flow: Maybe[ranges.Flow] = Field(
        "of the edges to T, at `pressure_drop`; default: that of the other edges", default=None
    )
    overlap: Annotated[OneNumber, Quantity("number")] = Field("share of the stroke before an edge opens", default=0.05)
    rounding: Proportion = Field("share of the stroke over which an edge begins to open", default=0.02)
    frequency: Maybe[ranges.SpoolFrequency] = Field("natural frequency of the spool; default: no lag", default=None)
    damping_ratio: PositiveNumber = Field("of the spool", default=0.8)
    margin: VaryingPressure = Field(
        "of pre: held over the spool; of post: above LS; 0 of post with `saturation_share`", default=7e5
    )
    saturation_share: Maybe[Proportion] = Field(
        "of pre, in place of `margin`: share of p_P - p_LS, so that all fall together", default=None
    )
    opening_range: ranges.Drop = Field("of the compensator, from closed to fully open", default=4e5)
    compensator_flow: Maybe[ranges.Flow] = Field(
        "of it, fully open, at `pressure_drop`; default twice `flow`", default=None
    )
    lag: ranges.Lag = Field("time constant of the compensator; 0: none", default=0.01)
    leakage: Leakage = Field("of each edge", default=0.0)
    inner_volume: ranges.Size = Field("between spool and compensator", default=INNER_VOLUME)
    open_centre: Literal["parallel", "tandem", "series"] | None = Field(
        "a 6/3 section: P feeds it; N does, and it cuts off the next ones; it returns to C too", default=None
    )
    bypass_flow: Maybe[ranges.Flow] = Field(
        "from N to C in the middle, at `pressure_drop`; default `flow`", default=None
    )
    bypass_closes: Proportion = Field("share of the stroke at which N and C are apart", default=0.7)
    parallel_flow: Maybe[ranges.Flow] = Field(
        "of tandem, from P at `pressure_drop`: what others before it leave of its feed", default=None
    )
    float_from: Maybe[Proportion] = Field(
        "share of the stroke to B from which on A, B and T are joined and P is closed", default=None
    )
    regeneration: Literal["A", "B"] | None = Field(
        "side that also gets what comes out of the other one, through a check valve", default=None
    )
    regeneration_until: VaryingPressure = Field(
        "of the side with `regeneration` over the return, from which on the other one drains", default=1e7
    )
    holding: Literal["A", "B", "both"] | None = Field(
        "sides with a poppet that is tight until the spool moves to the other side", default=None
    )

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        _, nodes = FED_BY.get(_feed(data), ((), ()))
        regeneration = (".R",) if entry(data, "regeneration") else ()
        return (*nodes, *regeneration, *(f".H{side}" for side in _held(data)))

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        feed, regenerates = _feed(data), entry(data, "regeneration")
        signals, _ = FED_BY.get(feed, ((), ()))
        out = "C" if feed == "series" else "T"
        returns = [f"flow_{side}{'R' if BACK[side] == regenerates else out}" for side in "AB"]
        if regenerates:
            returns += [f"flow_R{out}", f"regenerated_flow_R{regenerates}"]
        if entry(data, "float_from"):
            returns += ["float_flow_BT", *(("float_flow_NC",) if "flow_NC" in signals else ())]
        held = [f"{word}_flow_{side}" for side in _held(data) for word in ("check", "release")]
        pressures = (f"pressure_{node[1:]}" for node in cls.nodes_in(data))
        wanted = (signal for signal in signals if signal != "flow_PM" or feed != "tandem" or "P" in cls.ports_in(data))
        return (*pressures, "position", *wanted, *returns, *held)

    def problems(self) -> Iterator[Problem]:
        yield from self.problems_of_ports(*PORTS[self.open_centre])
        yield from self.problems_of_rating()
        yield from problem_of_share("command", self.command, -1.0)
        if not 0.0 <= self.overlap < 0.9:
            yield Problem(("overlap",), f"a share of the stroke from 0 to 0.9 was expected, got {self.overlap:g}")
        if self.is_of_gas:
            yield superfluous("sonic_conductance", "is of gases; a section is for liquids")
        if self.open_centre is None and (self.compensation == "none") == ("LS" in self.ports):
            if self.compensation == "none":
                yield superfluous("ports", "LS belongs to a section with a compensator")
            else:
                yield Problem((), "port LS is missing: the compensator reads the load-sensing pressure; write `LS: ls`")
        usual = {key: field.default for key, field in type(self).model_fields.items()}
        if self.margin != usual["margin"] and (self.open_centre or self.compensation == "none"):
            yield superfluous("margin", "belongs to a section with a compensator")
        if self.saturation_share is not None and _feed(self) != "pre":
            yield superfluous("saturation_share", "belongs to `compensation: pre`; post shares the flow by itself")
        if self.open_centre and self.compensation == "post":
            yield superfluous(
                "compensation", "belongs to a section with a closed centre; leave out `open_centre` or it"
            )
        if (self.parallel_flow is None) == (self.open_centre == "tandem" and "P" in self.ports):
            what = "belongs to `open_centre: tandem` with a port P, from which it comes"
            yield (
                superfluous("parallel_flow", what)
                if self.parallel_flow
                else Problem((), "`parallel_flow` is missing: what a tandem section gets from P, at `pressure_drop`")
            )
        if self.float_from is not None and self.open_centre == "series":
            yield superfluous("float_from", "belongs to a section with a port T, to which A and B are joined")
        elif self.float_from is not None and not self.overlap + 0.1 < self.float_from < 0.95:
            least = self.overlap + 0.1
            yield Problem(("float_from",), f"a share from {least:g} to 0.95 was expected, got {self.float_from:g}")
        if self.bypass_closes <= self.overlap:
            yield Problem(("bypass_closes",), f"more than the overlap was expected, got {self.bypass_closes:g}")
        for key, owner in (
            ("bypass_flow", "open_centre"),
            ("bypass_closes", "open_centre"),
            ("regeneration_until", "regeneration"),
        ):
            if getattr(self, key) != usual[key] and getattr(self, owner) is None:
                yield superfluous(key, f"belongs to a section with `{owner}`")


def _feed(data: Any) -> str:
    """What feeds the metering edges: the word of an open centre, else that of the compensator."""
    return str(entry(data, "open_centre") or entry(data, "compensation") or "pre")


def _held(data: Any) -> str:
    """The sides that have a holding poppet."""
    return {"A": "A", "B": "B", "both": "AB"}.get(str(entry(data, "holding")), "")


DIRECTING = 4.0  # size of the edges behind a compensator over that of the metering ones


def add_section(builder: SystemBuilder, component: Section) -> None:
    """A spool, what feeds its metering edges, its return edges, and what they pass on their ways to A, B and T."""
    kind, ports, name = _feed(component), component.ports, component.name
    position = builder.outputs.add((f"hydraulics.{name}.position", "1", f"position of {name}"))
    add_spool(builder, component, position, -1.0)
    forward, drop = component.conductance, component.pressure_drop or 1.0
    back = component.flow_B / drop**0.5 if component.flow_B else forward
    side = {each: f".H{each}" if each in _held(component) else each for each in "AB"}
    floats = component.float_from or 1.0

    def edge(quantity: str, ends: tuple[str, str], size: float, sign: float, *, meters: bool = False) -> None:
        """One that opens with the position, or against it; one that `meters` closes where the section floats."""
        full = (floats if sign < 0.0 else 1.0) - component.overlap - 0.5 * component.rounding
        slope = [sign, -component.overlap, component.rounding, 1.0 / full]
        numbers = [size, component.transition, component.leakage, *slope]
        if meters and sign < 0.0 and component.float_from is not None:
            numbers.append(floats - component.overlap)
            return add_flow(builder, component, quantity, ends, numbers, (BAND, position))
        return add_flow(builder, component, quantity, ends, numbers, (EDGE, position))

    def joined_where_it_floats(quantity: str, ends: tuple[str, str], size: float) -> None:
        slope = [-1.0, -floats, component.rounding, 1.0 / (1.0 - floats)]
        add_flow(builder, component, quantity, ends, [size, component.transition, 0.0, *slope], (EDGE, position))

    if kind == "pre":
        _add_compensator(builder, component, ("P", ".M"), 1.0 - (component.saturation_share or 0.0))
    elif kind == "post":
        edge("flow_PM", ("P", ".M"), forward, 1.0)
        edge("flow_PM_back", ("P", ".M"), back, -1.0, meters=True)
        _add_compensator(builder, component, (".M", ".C"), 1.0)
        edge("flow_CA", (".C", side["A"]), DIRECTING * forward, 1.0)
        edge("flow_CB", (".C", side["B"]), DIRECTING * back, -1.0)
    elif kind != "none":
        bypass = component.bypass_flow / drop**0.5 if component.bypass_flow else forward
        numbers = [bypass, component.transition, 0.0, 0.0, 0.0, component.bypass_closes]
        add_flow(builder, component, "flow_NC", ("N", "C"), numbers, (MIDDLE, position))
        if component.float_from is not None:
            joined_where_it_floats("float_flow_NC", ("N", "C"), bypass)
        for port, share in (("N", 1.0), ("P", component.parallel_flow)):
            if port in ports and (kind == "parallel") <= (port == "P"):
                size = DIRECTING * forward if share is None or port == "N" else share / drop**0.5
                numbers = [size, component.transition, 0.0]
                add_check_between(builder, component, f"flow_{port}M", (port, ".M"), numbers)
    if kind != "post":
        fed = "P" if kind == "none" else ".M"
        edge(f"flow_{fed[-1]}A", (fed, side["A"]), forward, 1.0)
        edge(f"flow_{fed[-1]}B", (fed, side["B"]), back, -1.0, meters=True)
    returned = component.return_flow / drop**0.5 if component.return_flow else None
    out = "C" if kind == "series" else "T"
    for each, size, sign in (("B", returned or back, 1.0), ("A", returned or forward, -1.0)):
        to = "R" if component.regeneration == BACK[each] else out
        edge(f"flow_{each}{to}", (side[each], ".R" if to == "R" else out), size, sign)
    if component.float_from is not None:
        joined_where_it_floats("float_flow_BT", ("B", "T"), returned or back)
    if component.regeneration is not None:
        _add_regeneration(builder, component, side[component.regeneration], out)
    for each in _held(component):
        _add_holding(builder, component, each, position)


def _add_regeneration(builder: SystemBuilder, component: Section, fed: str, out: str) -> None:
    """From R to the side that is fed a check valve; to the return what opens as the pressure of that side rises."""
    numbers = [DIRECTING * component.conductance, component.transition, 0.0]
    add_check_between(builder, component, f"regenerated_flow_R{component.regeneration}", (".R", fed), numbers)
    ends, factors, until = (".R", out), {fed: 1.0, out: -1.0}, component.regeneration_until
    add_opened(builder, component, f"flow_R{out}", ends, factors, until, numbers=numbers, lag=0.0)


def _add_holding(builder: SystemBuilder, component: Section, side: str, position: int) -> None:
    """A check valve from the spool to A or B, which the spool opens as it moves to the other side."""
    numbers = [DIRECTING * component.conductance, component.transition, 0.0]
    add_check_between(builder, component, f"check_flow_{side}", (f".H{side}", side), numbers)
    begins = 0.5 * component.overlap
    slope = [1.0 if side == "B" else -1.0, -begins, component.rounding, 1.0 / (1.0 - begins - 0.5 * component.rounding)]
    ends = side, f".H{side}"
    add_flow(builder, component, f"release_flow_{side}", ends, [*numbers, *slope], (EDGE, position))


def _add_compensator(builder: SystemBuilder, component: Section, ends: tuple[str, str], rest: float) -> None:
    """pre: margin, or its share of p_P - p_LS, against p_M - p_LS. post: p_M against p_LS and the margin."""
    half = 0.5 * component.opening_range
    sign, setting = (-1.0 if component.compensation == "post" else 1.0), component.margin
    factors = {".M": -sign, "LS": sign}
    if component.compensation != "post" and component.saturation_share is not None:
        factors, setting = {".M": -1.0, "LS": rest, "P": component.saturation_share}, 0.0
    size = 2.0 * component.conductance
    if component.compensator_flow and component.pressure_drop:
        size = component.compensator_flow / component.pressure_drop**0.5
    numbers = [size, component.transition, component.leakage]
    add_opened(builder, component, "compensator_flow", ends, factors, setting, sign, half, numbers=numbers)


OF_SECTIONS = (move, lift, restrict)


def section(data: Mapping[str, Any]) -> Symbol:
    """A section: its spool, and its compensator before or behind the metering edge; poppets that hold stand on its ports."""
    kind = _feed(data)
    if kind in ("pre", "post"):
        return _with_compensator(data, kind, directional_valve({"ways": "4/3", "frequency": 1.0}))
    feed, out = ("N" if kind in ("tandem", "series") else "P"), ("C" if kind == "series" else "T")
    below = [port for port in ("P", "N", "C", "T") if port in data["ports"]]
    forward, back = [(feed, "A"), ("B", out)], [(feed, "B"), ("A", out)]
    if data.get("regeneration"):
        (forward if data["regeneration"] == "A" else back).append(("A", "B"))
    positions = [forward, [("N", "C")] if "N" in below else [], back]
    if data.get("float_from"):
        positions.append([("A", out), ("B", out)])
    drawn = spool(positions, ["A", "B"], below)
    held = "".join(check_at(drawn.above[side], -18.0) for side in _held(data))
    return replace(drawn, body=drawn.body + held)


def _with_compensator(data: Mapping[str, Any], kind: str, spool: Symbol) -> Symbol:
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


KINDS = (
    ComponentKind(Section, add_section, OF_SECTIONS, symbol=section, nodes=inner_nodes("M", "C", "R", "HA", "HB")),
)
