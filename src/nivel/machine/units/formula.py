"""Formulas that blocks are computed with: expressions of symbols and numbers, put together here and not by users."""

from __future__ import annotations

from collections.abc import Sequence

from nivel.lazy import dataclass
from nivel.machine.units.arithmetic import bind
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import Node, Number, Operation, Signal, signals


@dataclass(frozen=True)
class Formula:
    """A value that follows from symbols and the time. tree : without unbound names."""

    tree: Node

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the symbols, each once; `time` is none."""
        return signals(self.tree)


def formula(text: str, **names: str | float) -> Formula:
    """The formula of a text in which `names` stand for symbols (by their paths) and numbers."""
    meaning = {name: Signal(each) if isinstance(each, str) else Number(float(each)) for name, each in names.items()}
    return Formula(bind(parse(text), meaning))


def sum_of(terms: Sequence[Node]) -> Node:
    """The sum, by halves, so that many terms nest little."""
    half = len(terms) // 2
    return Operation("+", sum_of(terms[:half]), sum_of(terms[half:])) if half else terms[0]
