"""Spool valves from catalogues, and sections with compensators, in numbers."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from nivel.elements.states import StateFact
from nivel.kernels.hydraulics import metering, restriction, spool, spool_drive
from nivel.kernels.record.record import NONE
from nivel.machine.hydraulics import Section, SpoolValve, Switching
from nivel.machine.hydraulics.spool_valve import Edge, ends_of
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import TimeFunction
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import composed_symbols as symbols
from nivel.system.hydraulics.components.composed import Moved, sums
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import inner_nodes
from nivel.system.hydraulics.restrictions import add_flow

SLOW_START = 1e-3  # [s] the least time in which a valve that switches moves
DIRECTING = 4.0  # size of the edges behind a compensator over that of the metering ones


def add_spool_valve(builder: SystemBuilder, component: SpoolValve) -> None:
    """The spool, and its edges, whose flows act on it where solenoids hold it."""
    position, speed = _add_position(builder, component)
    for pair, edge in component.edges.items():
        _add_edge(builder, component, pair, edge, position, speed)


def _add_position(builder: SystemBuilder, component: SpoolValve) -> tuple[int, int]:
    """(the output that is the position, the state on which forces of flows act, or NONE)."""
    name = component.name
    position = builder.outputs.add((f"hydraulics.{name}.position", "1", f"position of {name}"))
    if component.switching is not None:
        assert component.command is not None  # the record was checked
        add_switch(builder, name, position, component.command, component.switching, component.two_sided)
        return position, NONE
    speed = _add_drive(builder, component, position)
    return position, speed if component.solenoid is not None and component.solenoid.flow_force else NONE


def add_switch(
    builder: SystemBuilder, name: str, output: int, command: TimeFunction, switching: Switching, two_sided: bool
) -> None:
    """A valve that is on or off, with its delays."""
    state = builder.own_state(StateFact(f"{name}.energy", "1", f"energy of the solenoid of {name}", 0.0, 1.0))
    moving = max(switching.time, SLOW_START)
    share = 1.0 / (1.0 + switching.on_delay / moving + switching.off_delay / moving)
    begin = share * switching.on_delay / moving
    pace = share / moving
    numbers = [-1.0 if two_sided else 0.0, pace, pace, begin, begin + share]
    builder.elements.add(spool_drive.switch, [output, state, NONE, builder.function(command)], numbers)


def _add_drive(builder: SystemBuilder, component: SpoolValve, position: int) -> int:
    """A proportional spool. Returns the state that is its speed, or NONE."""
    name, omega = component.name, 2.0 * math.pi * (component.frequency or 0.0)
    solenoid, dither = component.solenoid, component.dither
    state, speed, play = NONE, NONE, NONE
    if component.frequency is not None:
        state = builder.own_state(StateFact(f"{name}.spool", "1", f"position of {name}", 0.0, 1.0))
        speed = builder.own_state(StateFact(f"{name}.spool_speed", "1/s", f"speed of {name}", 0.0, omega))
    if component.hysteresis:
        play = builder.own_state(StateFact(f"{name}.input", "1", f"input of {name} behind its play", 0.0, 1.0))
    curve, preload, friction = NONE, 0.0, 0.0
    slow = 1.0
    least = -1.0 if component.two_sided else 0.0
    if solenoid is None:
        assert component.command is not None  # the record was checked
        command = builder.function(component.command)
    else:
        assert component.current is not None  # the record was checked
        full = _full_force(component)
        command = builder.function(component.current)
        force = Table(solenoid.force.points, tuple(y / full for y in solenoid.force.values), "linear", "current")
        curve = _curve(builder, replace(force, interpolation=solenoid.force.table.interpolation))
        preload, friction, slow = solenoid.preload / full, solenoid.friction / full, solenoid.transition_speed
    amplitude = dither.amplitude if dither is not None else 0.0
    numbers = [least, omega, component.damping_ratio, preload, friction, slow, component.hysteresis]
    numbers += [component.dead_band, amplitude, 2.0 * math.pi * (dither.frequency if dither is not None else 0.0)]
    builder.elements.add(spool_drive.drive, [position, state, speed, command, play, curve], numbers)
    return speed


def _full_force(component: SpoolValve) -> float:
    """[N] of the springs between the middle and the full stroke."""
    assert component.solenoid is not None
    assert component.stroke is not None
    return component.solenoid.spring * component.stroke


def _add_edge(builder: SystemBuilder, component: SpoolValve, pair: str, edge: Edge, position: int, speed: int) -> None:
    """An edge with its curves; speed : state of the spool on which its flow acts, or NONE."""
    ports = ends_of(pair)
    assert ports is not None  # the record was checked
    a, b = (builder.node(component.ports[port]) for port in ports)
    output = builder.outputs.add(
        (f"hydraulics.{component.name}.flow_{pair}", "m^3/s", f"flow {pair} of {component.name}")
    )
    density = builder.circuit.fluids[builder.circuit.nodes[component.ports[ports[0]]].fluid][4]
    drops, curves = conductances(component, edge, density)
    tables = [_curve(builder, curve) for curve in curves]
    force = 0.0
    if speed != NONE:
        builder.touch_state(speed)
        opens = -1.0 if opens_backwards(curves[0]) else 1.0
        jet = math.sqrt(2.0 * density) * math.cos(edge.jet_angle) / _full_force(component)
        force = -opens * jet * (2.0 * math.pi * (component.frequency or 0.0)) ** 2
    numbers = [component.transition, edge.leakage, force, *drops]
    builder.elements.add(metering.apply, [output, a, b, position, speed, *tables], numbers)


def conductances(component: SpoolValve, edge: Edge, density: float) -> tuple[list[float], list[Table]]:
    """(differences of pressure [Pa], K [m³/s/√Pa] over the position at each) of an edge."""
    curves = component.curves_of(edge)
    drops = list(edge.pressure_drops) if edge.flows else [edge.pressure_drop or 0.0]
    out = []
    for curve, drop in zip(curves, drops, strict=True):
        root = drop * (drop * drop + component.transition**2) ** -0.25
        factor = 1.0 / root if drop else edge.discharge_coefficient * math.sqrt(2.0 / density)
        values = tuple(factor * value for value in curve.values)
        out.append(Table(curve.points, values, curve.table.interpolation, "position"))
    return drops, out


def opens_backwards(curve: Table) -> bool:
    """Whether an edge is more open at its least position than at its greatest one."""
    return curve.values[0] > curve.values[-1]


def _curve(builder: SystemBuilder, curve: Table) -> int:
    """A table with its end values beyond its ends."""
    inner = curve.coefficients().tolist()
    rows = [[curve.values[0], 0.0, 0.0, 0.0], *inner, [curve.values[-1], 0.0, 0.0, 0.0]]
    return builder.functions.add_table([curve.times[0] - 1.0, *curve.times], np.array(rows))


def closed_until(component: SpoolValve) -> float:
    """Share of the stroke within which P is joined with neither A nor B."""
    ends = []
    for pair, edge in component.edges.items():
        if pair in ("PA", "PB", "CA", "CB"):
            curve = component.curves_of(edge)[-1]
            shut = [abs(x) for x, y in zip(curve.points, curve.values, strict=True) if y == 0.0]
            ends.append(min(max(shut, default=0.0), 0.9))
    return min(ends, default=0.0)


# --- sections ---


def add_section(builder: SystemBuilder, component: Section) -> None:
    """A spool, its metering edges with a compensator before or behind them, and its return edges."""
    position = _add_section_spool(builder, component)
    kind, ports, name = component.compensation, component.ports, component.name
    forward = component.conductance
    back = component.flow_B / component.pressure_drop**0.5 if component.flow_B and component.pressure_drop else forward
    p, m, c = ports["P"], f"{name}.M", f"{name}.C"

    def edge(quantity: str, ends: tuple[str, str], size: float, sign: float) -> None:
        full = 1.0 - component.overlap - 0.5 * component.rounding
        slope = [sign, -component.overlap, component.rounding, 1.0 / full]
        numbers = [size, component.transition, component.leakage, *slope]
        add_flow(builder, name, quantity, ends, numbers, (restriction.EDGE, position))

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
    if component.compensation == "post":
        moved = Moved(sums((m, 1.0), (ls, -1.0)), component.opening_range, component.margin, -1.0, half, component.lag)
    elif component.saturation_share is not None:
        factors = sums((m, -1.0), (ls, rest), (p, component.saturation_share))
        moved = Moved(factors, component.opening_range, 0.0, 1.0, half, component.lag)
    else:
        moved = Moved(sums((m, -1.0), (ls, 1.0)), component.opening_range, component.margin, 1.0, half, component.lag)
    opening = moved.added(builder, component.name, "compensator_position")
    size = 2.0 * component.conductance
    if component.compensator_flow and component.pressure_drop:
        size = component.compensator_flow / component.pressure_drop**0.5
    numbers = [size, component.transition, component.leakage]
    add_flow(builder, component.name, "compensator_flow", ends, numbers, opening)


def _add_section_spool(builder: SystemBuilder, component: Section) -> int:
    name, omega = component.name, 2.0 * math.pi * (component.frequency or 0.0)
    output = builder.outputs.add((f"hydraulics.{name}.position", "1", f"position of {name}"))
    state, speed = NONE, NONE
    if component.frequency is not None:
        state = builder.own_state(StateFact(f"{name}.spool", "1", f"position of {name}", 0.0, 1.0))
        speed = builder.own_state(StateFact(f"{name}.spool_speed", "1/s", f"speed of {name}", 0.0, omega))
    columns = [output, state, speed, builder.function(component.command)]
    builder.elements.add(spool.move, columns, [-1.0, omega, component.damping_ratio, 0.0])
    return output


OF_VALVES = (spool_drive.drive, spool_drive.switch, metering.apply)
OF_SECTIONS = (spool.move, spool.lift, restriction.apply)
KINDS = (
    ComponentKind(SpoolValve, add_spool_valve, OF_VALVES, symbols.spool_valve),
    ComponentKind(Section, add_section, OF_SECTIONS, symbols.section, inner_nodes("M", "C")),
)
