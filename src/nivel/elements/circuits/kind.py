"""Kinds of components of circuits, and phases of the evaluation of a circuit: the order in which their families are called.

    begin → volumes → pressures → strokes → (control) → positions → flows → balance

A control may read at once what is sensed: pressures, and positions, speeds and frictions of pistons. It acts on all that follows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from enum import IntEnum
from typing import TYPE_CHECKING, Any

from nivel.elements.kind import Kind
from nivel.kernels.record.hook import Family

if TYPE_CHECKING:
    from nivel.elements.circuits.component import Component
    from nivel.elements.circuits.nodes import Node
    from nivel.elements.circuits.symbol import Symbol
    from nivel.kernels.record.hook import Family
    from nivel.system.builder import SystemBuilder

    NodeMaker = Callable[[SystemBuilder, Any, "Swept"], Iterator[Node]]


Swept = dict[str, float]  # what pistons leave open in each node at half their strokes [m³]


class ComponentKind(Kind):
    """All that the package knows of a kind of component.

    record : its keys. add(builder, record) : gives the tables of a machine its numbers; None where its node is all there is of it.
    families : kernels that it may need, each with a phase (`nivel.elements.circuits.kind`). symbol(data) : what is drawn of it, from its
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


class Phase(IntEnum):
    """When a family is called.

    BEGIN : sums are set to zero. VOLUMES : what pistons leave open. PRESSURES : of all nodes. STROKES : of pistons, and their end stops.
    POSITIONS : of valves, and settings of pumps. FLOWS : flows, forces and the rates that follow from these. BALANCE : energies and mass.
    """

    BEGIN = 0
    VOLUMES = 1
    PRESSURES = 2
    STROKES = 3
    POSITIONS = 4
    FLOWS = 5
    BALANCE = 6

    @property
    def sensed(self) -> bool:
        """Whether a control may read it at once."""
        return self < Phase.POSITIONS


PHASES: dict[Family, tuple[Phase, int]] = {}
# what adds the slopes of a family to those of `nivel.elements.circuits.tangent`; None: they are none, or slow beside steps
SLOPES: dict[Family, Family | None] = {}


def called(phase: Phase, order: int = 99, *, slow: bool = False) -> Callable[[Family], Family]:
    """Decorator above `@family`: the phase in which it is called, and its order there. slow : steps over circuits need no slopes of it."""

    def state(family: Family) -> Family:
        PHASES[family] = (phase, order)
        if slow:
            SLOPES[family] = None
        return family

    return state


def slopes_of(family: Family) -> Callable[[Family], Family]:
    """Decorator above `@family`: a function that adds the slopes of another one. Special integrators of circuits take machines all of
    whose families have one, or are slow."""

    def state(slopes: Family) -> Family:
        SLOPES[family] = slopes
        return slopes

    return state
