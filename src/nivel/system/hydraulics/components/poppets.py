"""Valves that pressures open, in numbers."""

from __future__ import annotations

import math

from nivel.kernels.hydraulics import restriction, spool
from nivel.kernels.hydraulics.fluid import ATMOSPHERE
from nivel.machine.hydraulics import CheckValve, Compensator, CounterbalanceValve, ReducingValve, ReliefValve
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import inner_nodes
from nivel.system.hydraulics.restrictions import TRANSITION, add_flow, add_poppet, rated

BORE_COEFFICIENT = 0.65  # discharge coefficient of orifices in pilot lines
FAMILIES = (spool.lift, restriction.apply)


def add_check(builder: SystemBuilder, component: CheckValve) -> None:
    """p_A - p_B, and of a pilot its ratio times what it is above the air, against the spring."""
    ports, ratio = component.ports, component.pilot_ratio or 0.0
    factors = {ports["A"]: 1.0, ports["B"]: -1.0}
    if "X" in ports:
        factors[ports["X"]] = factors.get(ports["X"], 0.0) + ratio
    numbers = (component.opening_range, component.lag, -1.0, -ratio * ATMOSPHERE)
    opening = add_poppet(builder, component.name, "position", factors, numbers, component.opens_at)
    add_flow(builder, component.name, "flow", (ports["A"], ports["B"]), rated(component, component.leakage), opening)


def add_relief(builder: SystemBuilder, component: ReliefValve) -> None:
    """p_P - p_T against the spring."""
    ports = component.ports
    factors = {ports["P"]: 1.0, ports["T"]: -1.0}
    numbers = (component.opening_range, component.lag, -1.0, 0.0)
    opening = add_poppet(builder, component.name, "position", factors, numbers, component.opens_at)
    add_flow(builder, component.name, "flow", (ports["P"], ports["T"]), rated(component, component.leakage), opening)


def add_counterbalance(builder: SystemBuilder, component: CounterbalanceValve) -> None:
    """p_L + R p_X - (1 + R) p_V against the spring; where that is vented or drained, the air or p_T in place of p_V. And its check valve.

    An orifice in the pilot line fills a chamber, whose pressure is that of the pilot; another one may drain that to V.
    """
    ports, ratio = component.ports, component.pilot_ratio
    pilot = ports["X"] if component.pilot_orifice is None else f"{component.name}.Y"
    factors = {ports["L"]: 1.0}
    factors[pilot] = factors.get(pilot, 0.0) + ratio
    constant = -(1.0 + ratio) * ATMOSPHERE
    if not component.vented:
        behind = ports.get("T", ports["V"])
        factors[behind], constant = factors.get(behind, 0.0) - (1.0 + ratio), 0.0
    if component.pilot_orifice is not None:
        density = builder.circuit.fluids[builder.circuit.nodes[ports["L"]].fluid][4]

        def bore(diameter: float) -> list[float]:
            return [BORE_COEFFICIENT * 0.25 * math.pi * diameter**2 * math.sqrt(2.0 / density), TRANSITION, 0.0]

        add_flow(builder, component.name, "pilot_flow", (ports["X"], pilot), bore(component.pilot_orifice))
        if component.drain_orifice is not None:
            add_flow(builder, component.name, "drain_flow", (pilot, ports["V"]), bore(component.drain_orifice))
    numbers = (component.opening_range, component.lag, -1.0, constant)
    opening = add_poppet(builder, component.name, "position", factors, numbers, component.opens_at)
    add_flow(builder, component.name, "flow", (ports["L"], ports["V"]), rated(component, component.leakage), opening)
    back = {ports["V"]: 1.0, ports["L"]: -1.0}
    numbers = (component.check_opening_range, 0.0, -1.0, 0.0)
    opening = add_poppet(builder, component.name, "check_position", back, numbers, component.check_opens_at)
    check = [component.check_conductance, TRANSITION, 0.0]
    add_flow(builder, component.name, "check_flow", (ports["V"], ports["L"]), check, opening)


def add_reducing(builder: SystemBuilder, component: ReducingValve) -> None:
    """The setting against p_A; the other way round for what relieves A."""
    ports = component.ports
    numbers = (component.opening_range, component.lag, 1.0, 0.0)
    opening = add_poppet(builder, component.name, "position", {ports["A"]: -1.0}, numbers, component.pressure)
    add_flow(builder, component.name, "flow", (ports["P"], ports["A"]), rated(component, component.leakage), opening)
    if "T" in ports:
        numbers = (component.opening_range, component.lag, -1.0, 0.0)
        opening = add_poppet(builder, component.name, "relief_position", {ports["A"]: 1.0}, numbers, component.pressure)
        add_flow(builder, component.name, "relief_flow", (ports["A"], ports["T"]), rated(component, 0.0), opening)


def add_compensator(builder: SystemBuilder, component: Compensator) -> None:
    """The margin and half the range against p_A - p_LS."""
    ports = component.ports
    factors = {ports["A"]: -1.0, ports["LS"]: 1.0}
    numbers = (component.opening_range, component.lag, 1.0, 0.5 * component.opening_range)
    opening = add_poppet(builder, component.name, "position", factors, numbers, component.margin)
    add_flow(builder, component.name, "flow", (ports["P"], ports["A"]), rated(component, component.leakage), opening)


KINDS = tuple(
    ComponentKind(words, add, FAMILIES, symbol, nodes)
    for words, add, symbol, nodes in (
        (CheckValve, add_check, symbols.check, None),
        (ReliefValve, add_relief, symbols.relief, None),
        (CounterbalanceValve, add_counterbalance, symbols.counterbalance, inner_nodes("Y")),
        (ReducingValve, add_reducing, symbols.reducing, None),
        (Compensator, add_compensator, symbols.compensator, None),
    )
)
