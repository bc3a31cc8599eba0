"""Nodes of circuits while a machine is built, and what depends on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from nivel.elements.states import Coupled
from nivel.kernels.hydraulics.volume import LAST_TEMPERATURE, VOLUME
from nivel.kernels.record.circuit_record import CircuitTangent
from nivel.kernels.record.record import NONE, Circuit
from nivel.system.tables import Array, index_array

Index = NDArray[np.uint32]
ROOM = LAST_TEMPERATURE + 1  # columns of `Circuit.room`
FLUID = 21  # columns of `Circuit.fluid`


def filled_room(room: Sequence[float]) -> list[float]:
    """A row of `Circuit.room` of these numbers, behind which there are none."""
    return [*room, *[0.0] * (ROOM - len(room))]


def tangent_tables(
    family: Index,
    pistons: Index,
    state: Index,
    unknown: Index,
    coordinate: Index,
    number: Index,
    signal: Index,
    source: Index,
    velocities: int,
) -> CircuitTangent:
    """Room for the derivatives of circuits. family … source : as in `CircuitTangent`."""
    states, count, nodes = len(state), len(coordinate), len(signal)
    size, width = states + count, states + 2 * count
    return CircuitTangent(
        family=family,
        pistons=pistons,
        state=state,
        unknown=unknown,
        coordinate=coordinate,
        number=number,
        signal=signal,
        source=source,
        by_mass=np.zeros(nodes),
        by_stroke=np.zeros((nodes, count)),
        effort=np.zeros((count, width)),
        slopes=np.zeros((size, width)),
        direction=np.zeros((count, velocities)),
        response=np.zeros((count, velocities)),
        compliance=np.zeros((count, count)),
        matrix=np.zeros((2, size, size)),
        b=np.zeros(size),
        load=np.zeros(count),
        travel=np.zeros((2, count)),
    )


def no_tangent() -> CircuitTangent:
    """For methods that do not need it: all arrays empty."""
    none = index_array([], 1)
    return tangent_tables(none, none, none, none, none, none, none, index_array([], 2), 0)


@dataclass(frozen=True)
class Node:
    """One node of a circuit.

    kind : VOLUME, GIVEN or SIGNAL of `nivel.kernels.hydraulics.volume`. state : of its mass or signal, or NONE. room : as `Circuit.room`.
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


@dataclass
class CircuitTable:
    """Nodes by name, fluids as rows of `Circuit.fluid`, signals by path with what they depend on."""

    nodes: dict[str, Node] = field(default_factory=dict)
    fluids: list[tuple[float, ...]] = field(default_factory=list)
    depends: dict[str, Coupled] = field(default_factory=dict)
    signals: dict[str, tuple[int, Coupled]] = field(default_factory=dict)

    def index(self, name: str) -> int:
        """Number of a node."""
        return list(self.nodes).index(name)

    def arrays(self) -> Circuit:
        """The tables."""
        nodes = list(self.nodes.values())
        count = len(nodes)

        def work() -> Array:
            return np.zeros(count)

        flowing = [(node.fluid, node.state if node.is_volume else NONE, node.energy, node.warmth) for node in nodes]
        return Circuit(
            node=index_array(flowing, 4),
            fluid=np.array(self.fluids, dtype=float).reshape(len(self.fluids), FLUID),
            room=np.array([filled_room(node.room) for node in nodes], dtype=float).reshape(count, ROOM),
            secant=np.zeros(1, dtype=np.uint32),
            guard=np.zeros(2),
            kept=work(),
            known=np.zeros((count, 8)),
            volume=work(),
            volume_rate=work(),
            pressure=work(),
            density=work(),
            enthalpy=work(),
            temperature=work(),
            inflow=np.zeros(2 * count),
            power=np.zeros(4),
            stored=np.zeros(1),
            tangent=no_tangent(),
        )
