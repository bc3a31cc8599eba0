"""Valves of pneumatic circuits in numbers."""

from __future__ import annotations

from nivel.kernels.hydraulics import restriction, spool
from nivel.kernels.hydraulics.tangent import LIFT, RESTRICT
from nivel.machine.hydraulics import QuickExhaust, SoftStart
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import composed_symbols as symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.restrictions import add_flow, add_poppet, rated

SLOPES = {spool.lift: LIFT, restriction.apply: RESTRICT}


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


KINDS = (
    ComponentKind(QuickExhaust, add_quick_exhaust, tuple(SLOPES), symbols.quick_exhaust, SLOPES),
    ComponentKind(SoftStart, add_soft_start, tuple(SLOPES), symbols.soft_start, SLOPES),
)
