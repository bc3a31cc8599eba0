"""Restrictions and poppets as rows of their kernels, for all components that are made of these."""

from __future__ import annotations

from nivel.elements.states import StateFact
from nivel.kernels.hydraulics import gas_flow, restriction, spool
from nivel.kernels.record.record import NONE
from nivel.machine.hydraulics.component import Rating
from nivel.machine.laws.time_function import TimeFunction
from nivel.system.builder import SystemBuilder

TRANSITION = 0.5e5  # Pa, of restrictions that do not say
CRITICAL_RATIO = 0.3  # of pneumatic valves that do not say


def add_flow(
    builder: SystemBuilder,
    component: str,
    quantity: str,
    ends: tuple[str, str],
    numbers: list[float],
    opening: tuple[int, int] = (restriction.FIXED, 0),
) -> None:
    """A restriction between two nodes, of the family of their fluid. opening : its kind, and the output or function that it follows."""
    first = builder.outputs.add(
        (f"hydraulics.{component}.{quantity}", "m^3/s", f"{quantity.replace('_', ' ')} of {component}")
    )
    family = gas_flow.apply if builder.circuit.nodes[ends[0]].gas else restriction.apply
    builder.elements.add(family, [first, builder.node(ends[0]), builder.node(ends[1]), *opening], numbers)


def rated(component: Rating, leakage: float) -> list[float]:
    """FLOW, CORNER, LEAK of a component from a catalogue, or SONIC, CRITICAL, LEAK of one for gases."""
    if component.sonic_conductance is not None:
        return [component.sonic_conductance, component.critical_ratio or CRITICAL_RATIO, leakage]
    return [component.conductance, getattr(component, "transition", TRANSITION), leakage]


def add_poppet(
    builder: SystemBuilder,
    component: str,
    quantity: str,
    factors: dict[str, float],
    numbers: tuple[float, float, float, float],
    setting: TimeFunction,
) -> tuple[int, int]:
    """A valve that pressures open, and its opening as restrictions read it.

    factors : of the pressures of nodes. numbers : range, time constant (0: none), factor of the setting, constant.
    """
    output = builder.outputs.add(
        (f"hydraulics.{component}.{quantity}", "1", f"{quantity.replace('_', ' ')} of {component}, 0 closed")
    )
    state = NONE
    if numbers[1] > 0.0:
        state = builder.own_state(StateFact(f"{component}.{quantity}", "1", f"{quantity} of {component}", 0.0, 1.0))
    nodes = [builder.node(name) for name in factors]
    columns = [output, state, NONE, builder.function(setting), *nodes, *[NONE] * (spool.NODES - len(nodes))]
    builder.elements.add(spool.lift, columns, [*numbers, *factors.values()])
    return restriction.DIRECT, output
