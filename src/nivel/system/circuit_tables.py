"""Nodes of circuits while a machine is built, and what depends on them."""

from __future__ import annotations

import numpy as np

from nivel.elements.circuits.density import FLUID
from nivel.elements.circuits.nodes import Node
from nivel.elements.circuits.volumes import ROOM_COLUMNS, filled_room
from nivel.elements.states import Coupled
from nivel.kernels.record.circuit_record import CircuitTangent
from nivel.kernels.record.record import NONE, Circuit
from nivel.lazy import dataclass, field
from nivel.system.tables import Array, empty, index_array


@dataclass
class CircuitTable:
    """Nodes by name, fluids as rows of `Circuit.fluid`, that of each component by its number, signals by path with what they depend on."""

    nodes: dict[str, Node] = field(default_factory=dict)
    fluids: list[tuple[float, ...]] = field(default_factory=list)
    fluid: dict[str, int] = field(default_factory=dict)
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
            room=np.array([filled_room(node.room) for node in nodes], dtype=float).reshape(count, ROOM_COLUMNS),
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
            tangent=empty(CircuitTangent),
        )
