"""Nodes of components: volumes of fluid, of their own or within a valve."""

from collections.abc import Iterator
from typing import Any

from nivel.elements.circuits.density import HEAT_CAPACITY, START, density_and_modulus
from nivel.elements.circuits.fluids import OIL
from nivel.elements.circuits.kind import Swept
from nivel.elements.circuits.volumes import VOLUME
from nivel.elements.facts import StateFact
from nivel.kernels.record.record import NONE
from nivel.known import Component, Gas, NodeMaker, SystemBuilder
from nivel.lazy import Struct


class Node(Struct):
    """One node of a circuit.

    kind : VOLUME, GIVEN or SIGNAL of `nivel.elements.circuits.volumes`. state : of its mass or signal, or NONE. room : as `Circuit.room`.
    swept : volume that its pistons leave open at half their strokes [m³]. start : pressure at t = 0 that was given [Pa], or None.
    owner : name of its component. output : its pressure. gas : whether it holds gas. energy : state of the inner energy of gas, or NONE.
    warmth : state of the temperature of a liquid, or NONE. walls : heat through its walls [W/K]; walls_by_volume : and what of it grows
    with its volume [W/(K m³)]. quantity : its pressure among the results of its component.
    """

    name: str
    kind: int
    fluid: int
    state: int
    room: tuple[float, ...]
    swept: float
    start: float | None
    owner: str
    output: int
    gas: bool = False
    energy: int = NONE
    warmth: int = NONE
    walls: float = 0.0
    walls_by_volume: float = 0.0
    quantity: str = "pressure"

    @property
    def is_volume(self) -> bool:
        """Whether its state is a mass."""
        return self.kind == VOLUME

    @property
    def variable(self) -> str:
        """Result variable of its pressure."""
        return f"hydraulics.{self.owner}.{self.quantity}"

    @property
    def states(self) -> frozenset[int]:
        """Numbers of its states."""
        return frozenset({self.state, self.energy, self.warmth} - {NONE})


# pressure that the tolerance is a share of [Pa], and that masses start from until the circuit is at rest
TYPICAL = 1e7
TYPICAL_OF_GAS = 5e5
NO_ACCUMULATOR = (0.0, 1.0, 1.0)  # GAS, PRECHARGE, EXPONENT of `Circuit.room`
RIGID = (0.0, 0.0, 0.0, 1.0, 1.0)  # of `Circuit.room`: no volume, no wall, no gas


def inner_nodes(*names: str) -> NodeMaker:
    """Small volumes within a valve, NAME.C of a name C, each of the size `inner_volume`."""

    def make(builder: SystemBuilder, component: Any, swept: Swept) -> Iterator[Node]:
        room = (component.inner_volume, 0.0, 0.0, 1.0, 1.0)
        for name in names:
            if f".{name}" in component.nodes_in(component):
                yield volume_node(builder, component, f"{component.name}.{name}", f"_{name}", room, None, swept)

    return make


def volume_node(
    builder: SystemBuilder,
    component: Component,
    name: str,
    ending: str,
    room: tuple[float, ...],
    start: float | None,
    swept: Swept,
    more_walls: tuple[float, ...] = (0.0, 0.0),
    temperature: str = "",
    *,
    warmer: bool = False,
) -> Node:
    """A node with mass, at first at TYPICAL pressure.

    more_walls : beside its `heat_conductance`, as in `Node`. temperature : name of that output, where there is one; warmer : there is.
    """
    fluid = builder.circuit.fluid[component.name]
    constants = builder.circuit.fluids[fluid]
    size = room[0] + swept.get(name, 0.0)
    gas = gas_of(builder, fluid)
    typical = TYPICAL if gas is None else TYPICAL_OF_GAS
    density, modulus = density_and_modulus(constants, typical)
    scale = density * size / modulus * typical
    fact = StateFact(
        f"{component.name}.mass{ending}",
        "kg",
        f"mass of the fluid in {name}",
        start=density * size,
        scale=scale,
        relative=False,
    )
    warmer = warmer or gas is not None or is_warm(builder, fluid)
    named = temperature or f"temperature{ending}"
    output = pressure_output(builder, component.name, f"pressure{ending}", named if warmer else "")
    state, energy, walls = builder.own_state(fact), NONE, getattr(component, "heat_conductance", None) or 0.0
    if gas is not None and not gas.isothermal:
        inner = scale * gas.temperature * gas.gas_constant / (gas.heat_capacity_ratio - 1.0)
        words = f"inner energy of the gas in {name}"
        energy = builder.own_state(
            StateFact(f"{component.name}.energy{ending}", "J", words, inner, inner, relative=False)
        )
    warmth = _add_warmth(builder, component, name, ending) if is_warm(builder, fluid) else NONE
    return Node(
        name,
        VOLUME,
        fluid,
        state,
        room,
        size - room[0],
        start,
        component.name,
        output,
        gas=gas is not None,
        energy=energy,
        warmth=warmth,
        walls=walls + more_walls[0],
        walls_by_volume=more_walls[1],
        quantity=f"pressure{ending}",
    )


def _add_warmth(builder: SystemBuilder, component: Component, node: str, ending: str) -> int:
    """The state of the temperature of a liquid."""
    words = f"temperature of the fluid in {node}, expanded to atmospheric pressure without heat"
    start = builder.circuit.fluids[builder.circuit.fluid[component.name]][START]
    fact = StateFact(f"{component.name}.temperature{ending}", "K", words, start, start, relative=False)
    return builder.own_state(fact)


def is_warm(builder: SystemBuilder, fluid: int) -> bool:
    """Whether the temperature of a liquid of this number is a state of its volumes."""
    return builder.circuit.fluids[fluid][HEAT_CAPACITY] > 0.0


def pressure_output(builder: SystemBuilder, name: str, quantity: str, temperature: str = "") -> int:
    """Index of the pressure of a node, and of its temperature behind it where that has a name."""
    words = quantity.replace("_", " in ", 1)
    first = (f"hydraulics.{name}.{quantity}", "Pa", f"{words} of {name}, absolute")
    if not temperature:
        return builder.outputs.add(first)
    said = f"{temperature.replace('_', ' ')} of {name}"
    return builder.outputs.add(first, (f"hydraulics.{name}.{temperature}", "K", said))


def gas_of(builder: SystemBuilder, fluid: int) -> Gas | None:
    """The gas of this number; None where it is a liquid."""
    found = (builder.machine.fluids or (OIL,))[fluid]
    return found if isinstance(found, Gas) else None


def growth_of_walls(size: float, modulus: float | None) -> float:
    """Room that walls make per pressure [m³/Pa]."""
    return size / modulus if modulus else 0.0
