"""Valves of pneumatic circuits in numbers."""

from __future__ import annotations

from nivel.kernels.hydraulics import ejector, restriction, spool
from nivel.machine.hydraulics import Ejector, QuickExhaust, SoftStart
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import composed_symbols as symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.restrictions import add_flow, add_poppet, rated

JET_RATIO = 0.5  # b of jets that do not say
FAMILIES = (spool.lift, restriction.apply)


def add_quick_exhaust(builder: SystemBuilder, component: QuickExhaust) -> None:
    """p_P - p_A against the spring, and the other way round."""
    ports, name, head = component.ports, component.name, rated(component, component.leakage)
    numbers = (component.opening_range, component.lag, -1.0, 0.0)
    opening = add_poppet(builder, name, "position", {ports["P"]: 1.0, ports["A"]: -1.0}, numbers, component.opens_at)
    add_flow(builder, name, "flow_PA", (ports["P"], ports["A"]), head, opening)
    opening = add_poppet(
        builder, name, "exhaust_position", {ports["A"]: 1.0, ports["P"]: -1.0}, numbers, component.opens_at
    )
    add_flow(builder, name, "flow_AR", (ports["A"], ports["R"]), head, opening)


def add_soft_start(builder: SystemBuilder, component: SoftStart) -> None:
    """p_A - share p_P opens what lies beside a throttle."""
    ports, name = component.ports, component.name
    ends, head = (ports["P"], ports["A"]), rated(component, 0.0)
    factors = {ports["A"]: 1.0, ports["P"]: -component.switches_at}
    numbers = (component.opening_range, component.lag, 1.0, 0.0)
    opening = add_poppet(builder, name, "position", factors, numbers, 0.0)
    share = component.throttle
    add_flow(builder, name, "flow", ends, [(1.0 - share) * head[0], *head[1:]], opening)
    add_flow(builder, name, "throttled_flow", ends, [share * head[0], *head[1:]])


def add_ejector(builder: SystemBuilder, component: Ejector) -> None:
    """The jet, and what it draws."""
    ports, name = component.ports, component.name
    ratio = JET_RATIO if component.critical_ratio is None else component.critical_ratio
    add_flow(builder, name, "flow", (ports["P"], ports["R"]), [component.sonic_conductance, ratio, 0.0])
    first = builder.outputs.add((f"hydraulics.{name}.suction_flow", "m^3/s", f"suction flow of {name}"))
    columns = [first, *(builder.node(ports[port]) for port in ("P", "A", "R"))]
    points = [number for pair in zip(component.vacuums, component.suction_flows, strict=True) for number in pair]
    builder.elements.add(ejector.apply, columns, [component.drive, float(len(component.vacuums)), *points])


KINDS = (
    ComponentKind(Ejector, add_ejector, (restriction.apply, ejector.apply), symbols.ejector),
    ComponentKind(QuickExhaust, add_quick_exhaust, FAMILIES, symbols.quick_exhaust),
    ComponentKind(SoftStart, add_soft_start, FAMILIES, symbols.soft_start),
)
