"""Valves that are composed of restrictions and poppets: the edges that they have and the pressures that move them."""

from typing import Any

from nivel.elements.circuits.poppets import NODES, lift
from nivel.elements.circuits.restrictions import DIRECT, add_flow, rated, restrict
from nivel.elements.facts import StateFact
from nivel.kernels.record.record import NONE
from nivel.known import SystemBuilder
from nivel.machine.core.element import Acts
from nivel.machine.laws.time_function import TimeFunction

# what is closed has no flow but its leak
PASSES = Acts(
    ("is closed", "is open"),
    "position",
    lambda own, of: of["position"],
    lambda own, of: of["flow"],
    always=lambda own: False,
    applies=lambda own: not own.leakage,
)

INNER_VOLUME = 2e-6  # m³ between two edges of one valve

CHECK_OPENS_AT, CHECK_RANGE = 0.5e5, 3e5  # Pa, of check valves within other valves


OF_POPPETS = (lift, restrict)


def add_opened(
    builder: SystemBuilder,
    component: Any,
    quantity: str,
    ends: tuple[str, str],
    factors: dict[str, float],
    setting: TimeFunction = 0.0,
    sign: float = -1.0,
    constant: float = 0.0,
    *,
    numbers: list[float] | None = None,
    span: float | None = None,
    lag: float | None = None,
    position: str = "",
) -> None:
    """An edge from one place of a component to another that a poppet opens: S((Σ factor p + sign setting + constant)/span), with a lag.

    ends, factors : ports, or `.M`, a node within the component; of the pressures there. numbers, span, lag : of the component, where they
    are not given: rated with its leakage, its `opening_range`, its `lag`. quantity, position : outputs, as `flow_TA` and `position_TA`.
    """
    width: float = component.opening_range if span is None else span
    delay: float = component.lag if lag is None else lag
    position = position or quantity.replace("flow", "position", 1)
    name, words = component.name, f"{position.replace('_', ' ')} of {component.name}, 0 closed"
    output, state = builder.outputs.add((f"hydraulics.{name}.{position}", "1", words)), NONE
    if delay > 0.0:
        state = builder.own_state(StateFact(f"{name}.{position}", "1", f"{position} of {name}", 0.0, 1.0))
    by_node: dict[str, float] = {}  # several ports may be at one
    for place, factor in factors.items():
        by_node[component.node(place)] = by_node.get(component.node(place), 0.0) + factor
    nodes = [builder.node(node) for node in by_node]
    columns = [output, state, NONE, builder.function(setting), *nodes, *[NONE] * (NODES - len(nodes))]
    builder.elements.add(lift, columns, [width, delay, sign, constant, *by_node.values()])
    numbers = rated(component, component.leakage) if numbers is None else numbers
    add_flow(builder, component, quantity, ends, numbers, (DIRECT, output))


def add_check_between(
    builder: SystemBuilder,
    component: Any,
    quantity: str,
    ends: tuple[str, str],
    numbers: list[float] | None = None,
    spring: tuple[float, float] = (CHECK_OPENS_AT, CHECK_RANGE),
    position: str = "",
) -> None:
    """A check valve from one place to another of a component; `quantity` as in `flow_TA`."""
    factors = {ends[0]: 1.0, ends[1]: -1.0}
    how = {"numbers": numbers or rated(component, 0.0), "span": spring[1], "lag": 0.0, "position": position}
    add_opened(builder, component, quantity, ends, factors, spring[0], **how)
