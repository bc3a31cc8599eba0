"""Valves that are composed of restrictions and poppets: each is the edges that it has and the pressures that move them."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.kernels.hydraulics import restriction, spool
from nivel.kernels.hydraulics.fluid import ATMOSPHERE
from nivel.machine.hydraulics import (
    BrakeValve,
    CartridgeValve,
    CrossPortRelief,
    FlowControl,
    FlowDivider,
    PilotReducingValve,
    PilotReliefValve,
    PriorityValve,
    SequenceValve,
    ShuttleValve,
    UnloadingValve,
)
from nivel.machine.hydraulics.component import Rated
from nivel.machine.hydraulics.pressure_valves import CHECK_OPENS_AT, CHECK_RANGE
from nivel.machine.laws.time_function import TimeFunction
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import composed_symbols as symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import inner_nodes
from nivel.system.hydraulics.restrictions import add_flow, add_poppet, rated

FAMILIES = (spool.lift, restriction.apply)
Opening = tuple[int, int]


@dataclass(frozen=True)
class Moved:
    """What moves an opening: S((Σ factor p + sign setting + constant)/range), with a lag."""

    factors: dict[str, float]
    opening_range: float
    setting: TimeFunction = 0.0
    sign: float = -1.0
    constant: float = 0.0
    lag: float = 0.0

    def added(self, builder: SystemBuilder, name: str, quantity: str) -> Opening:
        """The opening as restrictions read it."""
        numbers = (self.opening_range, self.lag, self.sign, self.constant)
        return add_poppet(builder, name, quantity, self.factors, numbers, self.setting)


def sums(*terms: tuple[str, float]) -> dict[str, float]:
    """Factors of nodes, of which several ports may be one."""
    out: dict[str, float] = {}
    for node, factor in terms:
        out[node] = out.get(node, 0.0) + factor
    return out


def add_check_between(
    builder: SystemBuilder,
    component: Rated,
    quantity: str,
    ends: tuple[str, str],
    numbers: list[float] | None = None,
    spring: tuple[float, float] = (CHECK_OPENS_AT, CHECK_RANGE),
) -> None:
    """A check valve from one node to another within a component; `quantity` as in `flow_TA`."""
    factors = sums((ends[0], 1.0), (ends[1], -1.0))
    position = quantity.replace("flow", "position", 1)
    opening = Moved(factors, spring[1], spring[0]).added(builder, component.name, position)
    add_flow(builder, component.name, quantity, ends, numbers or rated(component, 0.0), opening)


def add_flow_control(builder: SystemBuilder, component: FlowControl) -> None:
    """An orifice, with a compensator before it or a bypass beside it that holds the margin over it."""
    name, ports = component.name, component.ports
    p, a = ports["P"], ports["A"]
    half, span = 0.5 * component.opening_range, component.opening_range
    meter = (restriction.GIVEN, builder.function(component.setting))
    head = rated(component, component.leakage)
    if "T" in ports:
        add_flow(builder, name, "flow", (p, a), head, meter)
        moved = Moved(sums((p, 1.0), (a, -1.0)), span, component.margin, -1.0, half, component.lag)
        opening = moved.added(builder, name, "position")
        add_flow(builder, name, "bypass_flow", (p, ports["T"]), rated(component, 0.0), opening)
    else:
        m = f"{name}.M"
        moved = Moved(sums((m, -1.0), (a, 1.0)), span, component.margin, 1.0, half, component.lag)
        opening = moved.added(builder, name, "position")
        add_flow(builder, name, "compensator_flow", (p, m), rated(component, 0.0), opening)
        add_flow(builder, name, "flow", (m, a), head, meter)
    if component.free_return:
        add_check_between(builder, component, "check_flow", (a, p))


def add_divider(builder: SystemBuilder, component: FlowDivider) -> None:
    """Two orifices, and two edges of one spool behind them that the pressures between move against each other."""
    name, ports = component.name, component.ports
    m, n = f"{name}.M", f"{name}.N"
    whole, corner, leak = rated(component, component.leakage)
    way, half = -1.0 if component.combines else 1.0, 0.5 * component.opening_range
    for side, own, other, share in (("A", m, n, component.share), ("B", n, m, 1.0 - component.share)):
        numbers = [share * whole, corner, leak]
        add_flow(builder, name, f"orifice_flow_{side}", (ports["P"], own), numbers)
        moved = Moved(sums((own, way), (other, -way)), component.opening_range, constant=half, lag=component.lag)
        opening = moved.added(builder, name, f"position_{side}")
        add_flow(builder, name, f"flow_{side}", (own, ports[side]), numbers, opening)


def add_priority(builder: SystemBuilder, component: PriorityValve) -> None:
    """Two edges of one spool: CF closes as EF opens."""
    name, ports, half = component.name, component.ports, 0.5 * component.opening_range
    for side, sign in (("CF", 1.0), ("EF", -1.0)):
        factors = sums((ports["LS"], sign), (ports["CF"], -sign))
        moved = Moved(factors, component.opening_range, component.margin, sign, half, component.lag)
        opening = moved.added(builder, name, "position" if side == "CF" else "position_EF")
        ends = (ports["P"], ports[side])
        add_flow(builder, name, f"flow_{side}", ends, rated(component, component.leakage), opening)


def add_shuttle(builder: SystemBuilder, component: ShuttleValve) -> None:
    """Two seats: the one on the side of the higher pressure is open."""
    name, ports, half = component.name, component.ports, 0.5 * component.opening_range
    for side, other in (("A", "B"), ("B", "A")):
        factors = sums((ports[side], 1.0), (ports[other], -1.0))
        moved = Moved(factors, component.opening_range, constant=half, lag=component.lag)
        opening = moved.added(builder, name, "position" if side == "A" else "position_B")
        ends = (ports[side], ports["C"])
        add_flow(builder, name, f"flow_{side}", ends, rated(component, component.leakage), opening)


def add_unloading(builder: SystemBuilder, component: UnloadingValve) -> None:
    """p_P - p_LS, or a pilot above the air, against the spring."""
    ports = component.ports
    factors, constant = sums((ports["P"], 1.0), (ports.get("LS", ""), -1.0)), 0.0
    if "X" in ports:
        factors, constant = {ports["X"]: 1.0}, -ATMOSPHERE
    _add_single(builder, component, ("P", "T"), factors, constant)


def add_sequence(builder: SystemBuilder, component: SequenceValve) -> None:
    """p_P against the spring and its drain; perhaps a check valve back."""
    ports = component.ports
    factors, constant = {ports["P"]: 1.0}, -ATMOSPHERE
    if "T" in ports:
        factors, constant = sums((ports["P"], 1.0), (ports["T"], -1.0)), 0.0
    _add_single(builder, component, ("P", "A"), factors, constant)
    if component.free_return:
        add_check_between(builder, component, "check_flow", (ports["A"], ports["P"]))


def add_cartridge(builder: SystemBuilder, component: CartridgeValve) -> None:
    """p_A and p_B on their shares of the area of X against p_X and the spring."""
    ports, share = component.ports, component.area_share
    factors = sums((ports["A"], share), (ports["B"], 1.0 - share), (ports["X"], -1.0))
    _add_single(builder, component, ("A", "B"), factors, 0.0)


def _add_single(
    builder: SystemBuilder,
    component: UnloadingValve | SequenceValve | CartridgeValve,
    ports: tuple[str, str],
    factors: dict[str, float],
    constant: float,
) -> None:
    """One poppet and one edge."""
    moved = Moved(factors, component.opening_range, component.opens_at, -1.0, constant, component.lag)
    opening = moved.added(builder, component.name, "position")
    ends = (component.ports[ports[0]], component.ports[ports[1]])
    add_flow(builder, component.name, "flow", ends, rated(component, component.leakage), opening)


def add_pilot_relief(builder: SystemBuilder, component: PilotReliefValve) -> None:
    """An orifice from P to X, a pilot from X to T, and the main poppet that p_P - p_X lifts."""
    p, t, x = component.ports["P"], component.ports["T"], f"{component.name}.X"
    main = Moved(sums((p, 1.0), (x, -1.0)), component.opening_range, component.spring, lag=component.lag)
    _add_piloted(builder, component, (p, t), (p, x, t), main, component.opens_at)


def add_pilot_reducing(builder: SystemBuilder, component: PilotReducingValve) -> None:
    """An orifice from A to X, a pilot from X to T, and the main spool that p_A - p_X closes."""
    p, a, t = (component.ports[port] for port in "PAT")
    x = f"{component.name}.X"
    spring = component.spring + component.opening_range
    main = Moved(sums((a, -1.0), (x, 1.0)), component.opening_range, spring, 1.0, lag=component.lag)
    _add_piloted(builder, component, (p, a), (a, x, t), main, component.pressure)


def _add_piloted(
    builder: SystemBuilder,
    component: PilotReliefValve | PilotReducingValve,
    ends: tuple[str, str],
    pilot: tuple[str, str, str],
    main: Moved,
    setting: TimeFunction,
) -> None:
    """pilot : the nodes before its orifice, between orifice and seat, and behind the seat."""
    name = component.name
    before, x, drain = pilot
    corner = component.transition
    opening = main.added(builder, name, "position")
    add_flow(builder, name, "flow", ends, rated(component, component.leakage), opening)
    orifice = [component.pilot_conductance, corner, 0.0]
    add_flow(builder, name, "orifice_flow", (before, x), orifice)
    seat = Moved(sums((x, 1.0), (drain, -1.0)), component.pilot_range, setting).added(builder, name, "pilot_position")
    add_flow(builder, name, "pilot_flow", (x, drain), [2.0 * component.pilot_conductance, corner, 0.0], seat)


def add_cross_port(builder: SystemBuilder, component: CrossPortRelief) -> None:
    """A relief valve each way, and check valves from the tank line."""
    name, ports = component.name, component.ports
    for a, b in (("A", "B"), ("B", "A")):
        factors = sums((ports[a], 1.0), (ports[b], -1.0))
        moved = Moved(factors, component.opening_range, component.opens_at, lag=component.lag)
        opening = moved.added(builder, name, f"position_{a}{b}")
        ends = (ports[a], ports[b])
        add_flow(builder, name, f"flow_{a}{b}", ends, rated(component, component.leakage), opening)
    if "T" in ports:
        numbers = [component.check_conductance, component.transition, 0.0]
        spring = (component.check_opens_at, component.check_opening_range)
        for side in "AB":
            ends = (ports["T"], ports[side])
            add_check_between(builder, component, f"flow_T{side}", ends, numbers, spring)


def add_brake(builder: SystemBuilder, component: BrakeValve) -> None:
    """For each side a check valve in, and an edge back that the other side opens."""
    name, ports = component.name, component.ports
    for side, other in (("A", "B"), ("B", "A")):
        valve, line = ports[f"V{side}"], ports[side]
        pilot = {ports[f"V{other}"]: 1.0}
        moved = Moved(pilot, component.opening_range, component.opens_at, -1.0, -ATMOSPHERE, component.lag)
        opening = moved.added(builder, name, f"position_{side}")
        add_flow(builder, name, f"flow_{side}", (line, valve), rated(component, component.leakage), opening)
        add_check_between(builder, component, f"check_flow_{side}", (valve, line))


KINDS = tuple(
    ComponentKind(words, add, FAMILIES, symbol, nodes)
    for words, add, symbol, nodes in (
        (FlowControl, add_flow_control, symbols.flow_control, inner_nodes("M")),
        (FlowDivider, add_divider, symbols.divider, inner_nodes("M", "N")),
        (PriorityValve, add_priority, symbols.priority, None),
        (ShuttleValve, add_shuttle, symbols.shuttle, None),
        (UnloadingValve, add_unloading, symbols.unloading, None),
        (SequenceValve, add_sequence, symbols.sequence, None),
        (CartridgeValve, add_cartridge, symbols.cartridge, None),
        (PilotReliefValve, add_pilot_relief, symbols.pilot_relief, inner_nodes("X")),
        (PilotReducingValve, add_pilot_reducing, symbols.pilot_reducing, inner_nodes("X")),
        (CrossPortRelief, add_cross_port, symbols.cross_port, None),
        (BrakeValve, add_brake, symbols.brake, None),
    )
)
