"""Directional valves and signals of load sensing in numbers."""

from __future__ import annotations

import math

from nivel.elements.states import StateFact
from nivel.kernels.hydraulics import load_signal, restriction, spool, spool_drive
from nivel.kernels.record.record import NONE
from nivel.machine.hydraulics import DirectionalValve, LoadSensing, Section, SpoolValve
from nivel.machine.hydraulics.directional import CENTRED, EDGES, centre_pairs
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.components.spools import add_switch, closed_until
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import signal_nodes
from nivel.system.hydraulics.restrictions import add_flow, rated

ROUNDING = 0.02  # share of the stroke over which a load is first felt


def add_directional(builder: SystemBuilder, component: DirectionalValve) -> None:
    """The spool, and its edges."""
    position = _add_spool(builder, component)
    forward, back = EDGES[component.ways]
    for pairs, sign in ((forward, 1.0), (back, -1.0)):
        for pair in pairs:
            _add_edge(builder, component, pair, position, _slope(component.ways, sign, component.overlap))
    for pair in centre_pairs(component.ways, component.centre):
        quantity = f"flow_{pair}" if pair not in component.edges else f"centre_flow_{pair}"
        width = max(component.overlap, component.rounding)
        numbers = [*rated(component, 0.0), 0.0, 0.0, width]
        add_flow(builder, component.name, quantity, _ends(component, pair), numbers, (restriction.MIDDLE, position))


def _slope(ways: str, sign: float, overlap: float) -> tuple[float, float]:
    """(factor, shift) of z = factor u + shift, which opens an edge where it is positive."""
    if ways in (*CENTRED, "2/2"):
        return sign, -overlap
    return 2.0 * sign, -sign - overlap


def _add_edge(
    builder: SystemBuilder, component: DirectionalValve, pair: str, position: int, slope: tuple[float, float]
) -> None:
    full = 1.0 - component.overlap - 0.5 * component.rounding  # ramp of a full stroke
    numbers = [*rated(component, component.leakage), *slope, component.rounding, 1.0 / full]
    add_flow(builder, component.name, f"flow_{pair}", _ends(component, pair), numbers, (restriction.EDGE, position))


def _ends(component: DirectionalValve, pair: str) -> tuple[str, str]:
    return component.ports[pair[0]], component.ports[pair[1]]


def _add_spool(builder: SystemBuilder, component: DirectionalValve) -> int:
    """The output that is the position of the spool."""
    name = component.name
    output = builder.outputs.add((f"hydraulics.{name}.position", "1", f"position of {name}"))
    if component.switching is not None:
        add_switch(builder, name, output, component.command, component.switching, component.ways in CENTRED)
        return output
    state, speed = NONE, NONE
    if component.frequency is not None:
        state = builder.own_state(StateFact(f"{name}.spool", "1", f"position of {name}", 0.0, 1.0))
        if component.rate_limit is None:
            speed = builder.own_state(
                StateFact(f"{name}.spool_speed", "1/s", f"speed of {name}", 0.0, frequency(component))
            )
    least = -1.0 if component.ways in CENTRED else 0.0
    columns = [output, state, speed, builder.function(component.command)]
    builder.elements.add(
        spool.move, columns, [least, frequency(component), component.damping_ratio, component.rate_limit or 0.0]
    )
    return output


def frequency(component: DirectionalValve) -> float:
    """[rad/s] natural frequency of the spool; 0 without one."""
    return 2.0 * math.pi * (component.frequency or 0.0)


def add_load_signal(builder: SystemBuilder, component: LoadSensing) -> None:
    """The signal, and the valves that it is made of."""
    node = builder.circuit.nodes[component.name]
    columns, numbers = [node.state], [component.lag, component.opens_within]
    valves = {
        each.name: each
        for each in builder.machine.hydraulics
        if isinstance(each, DirectionalValve | Section | SpoolValve)
    }
    for name in component.valves:
        valve = valves[name]
        output, coupled = builder.circuit.signals[f"{name}.position"]
        with builder.noting():  # the loads of valves do not depend on each other
            builder.touch_state(node.state)
            builder.note(coupled)
            columns += [output, *(builder.node(valve.ports[port]) for port in "ABT")]
        shut = (closed_until(valve), ROUNDING) if isinstance(valve, SpoolValve) else (valve.overlap, valve.rounding)
        numbers += shut
    width = 1 + load_signal.WIDE * load_signal.MOST
    builder.elements.add(load_signal.apply, columns + [NONE] * (width - len(columns)), numbers)


OF_SPOOLS = (spool.move, spool_drive.switch, restriction.apply)
KINDS = (
    ComponentKind(DirectionalValve, add_directional, OF_SPOOLS, symbols.directional),
    ComponentKind(LoadSensing, add_load_signal, (load_signal.apply,), symbols.shuttle, signal_nodes),
)
