"""Description of a kind of component of circuits."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from nivel.kernels.hydraulics.phase import PHASES, SLOPES
from nivel.kernels.record.hook import Family
from nivel.machine.hydraulics import Component
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics.nodes import NodeMaker
from nivel.system.hydraulics.symbols import Symbol


@dataclass(frozen=True)
class ComponentKind:
    """All that the package knows of a kind of component.

    words : its record. add(builder, record) : gives the tables of a machine its numbers; None where its node is all there is of it.
    families : kernels that it may need, each with a phase (`nivel.kernels.hydraulics.phase`). symbol(data) : what is drawn of it, from its
    record as JSON; None: a box with its type. nodes(builder, record, swept) : its nodes, those that its words name. present(builder,
    record) : gives numbers of what is known with the pressures.

    Raises ValueError where a family states no phase, and where words name nodes that nothing makes.
    """

    words: type[Component]
    add: Callable[[SystemBuilder, Any], None] | None
    families: tuple[Family, ...]
    symbol: Callable[[Mapping[str, Any]], Symbol] | None = None
    nodes: NodeMaker | None = None
    present: Callable[[SystemBuilder, Any], None] | None = None

    def __post_init__(self) -> None:
        if bool(self.words.nodes) != (self.nodes is not None):
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

    @property
    def type(self) -> str:
        """The word for it in machine files."""
        return str(self.words.model_fields["type"].default)
