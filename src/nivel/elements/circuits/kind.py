"""Description of a kind of component of circuits."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from nivel.elements.circuits.phase import PHASES, SLOPES
from nivel.elements.kind import Kind
from nivel.lazy import dataclass

if TYPE_CHECKING:
    from nivel.elements.circuits.component import Component
    from nivel.elements.circuits.nodes import Node
    from nivel.elements.circuits.symbol import Symbol
    from nivel.kernels.record.hook import Family
    from nivel.system.builder import SystemBuilder

    NodeMaker = Callable[[SystemBuilder, Any, "Swept"], Iterator[Node]]

Swept = dict[str, float]  # what pistons leave open in each node at half their strokes [m³]


@dataclass(frozen=True)
class ComponentKind(Kind):
    """All that the package knows of a kind of component.

    record : its keys. add(builder, record) : gives the tables of a machine its numbers; None where its node is all there is of it.
    families : kernels that it may need, each with a phase (`nivel.elements.circuits.phase`). symbol(data) : what is drawn of it, from its
    record as JSON; None: a box with its type. nodes(builder, record, swept) : its nodes, those that its record names. present(builder,
    record) : gives numbers of what is known with the pressures. last : it reads what others report, and comes behind them.

    Raises ValueError where a family states no phase, and where a record names nodes that nothing makes.
    """

    record: type[Component]
    add: Callable[[SystemBuilder, Any], None] | None  # type: ignore[assignment]
    families: tuple[Family, ...] = ()
    symbol: Callable[[Mapping[str, Any]], Symbol] | None = None
    nodes: NodeMaker | None = None
    present: Callable[[SystemBuilder, Any], None] | None = None
    last: bool = False

    def __post_init__(self) -> None:
        if bool(self.record.nodes) != (self.nodes is not None):
            raise ValueError(f"the nodes of '{self.type}' need `nodes` of both its record and its kind")
        for family in self.families:
            if family not in PHASES:
                name = family.py_func.__name__
                raise ValueError(
                    f"{family.module}.{name} states no phase; write `@called(Phase.FLOWS)` above its `@family`"
                )

    @property
    def has_slopes(self) -> bool:
        """Whether special integrators of circuits take machines with it."""
        return all(family in SLOPES for family in self.families)
