"""Valves that are composed of restrictions and poppets: the edges that they have and the pressures that move them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nivel.elements.circuits.poppets import NODES, lift
from nivel.elements.circuits.restrictions import DIRECT, add_flow, rated, restrict
from nivel.elements.states import StateFact
from nivel.kernels.record.record import NONE
from nivel.lazy import dataclass
from nivel.machine.core.element import Acts
from nivel.machine.laws.time_function import TimeFunction

if TYPE_CHECKING:
    from nivel.elements.circuits.component import Rated
    from nivel.elements.circuits.pilot_valves import CartridgeValve
    from nivel.elements.circuits.reducing_valves import SequenceValve
    from nivel.elements.circuits.relief_valves import UnloadingValve
    from nivel.system.builder import SystemBuilder

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
    columns = [output, state, NONE, builder.function(setting), *nodes, *[NONE] * (NODES - len(nodes))]
    builder.elements.add(lift, columns, [*numbers, *factors.values()])
    return DIRECT, output


OF_POPPETS = (lift, restrict)
OpeningOutput = tuple[int, int]


@dataclass(frozen=True)
class Moved:
    """What moves an opening: S((Σ factor p + sign setting + constant)/range), with a lag."""

    factors: dict[str, float]
    opening_range: float
    setting: TimeFunction = 0.0
    sign: float = -1.0
    constant: float = 0.0
    lag: float = 0.0

    def added(self, builder: SystemBuilder, name: str, quantity: str) -> OpeningOutput:
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


def add_single(
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
