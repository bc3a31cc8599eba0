"""Arithmetic of `time` and of signals as a value that varies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from nivel.machine.units.arithmetic import LOCAL_SYMBOLS, evaluate, render
from nivel.machine.units.derivative import derivative
from nivel.machine.units.quantity import bound_tree
from nivel.machine.units.tree import Node, signals
from nivel.words.arguments import checked_arguments, checked_fields


@checked_fields
@dataclass(frozen=True)
class Expression:
    """Arithmetic of `time` [s] and signals, e.g. ``10 + 3*sin(2*pi*time)`` or ``-20*hinge.angle_rate``.

    Once in a record, the text has SI numbers only, in Python's syntax except for the dots in names of signals.
    """

    text: str

    @checked_arguments
    def __call__(self, time: float, values: Mapping[str, float] | None = None) -> float:
        """The value at `time` [s], SI. `values` are those of the signals by their paths.

        Raises ExpressionError where there is none.
        """
        return evaluate(self.tree, time, values)

    @cached_property
    def tree(self) -> Node:
        """The text as a tree without unbound names; `length`, `angle`, `value` and `rate` are local symbols."""
        return bound_tree(self.text, {}, LOCAL_SYMBOLS)

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the signals, in the order in which they stand in the text; `time` is not a signal."""
        return signals(self.tree)

    @cached_property
    def derivative(self) -> Expression:
        """The exact derivative with respect to time.

        Raises ExpressionError where there is none: corners, signals.
        """
        return expression_of(derivative(self.tree))


def expression_of(tree: Node) -> Expression:
    """The expression that `tree` is; its text may be longer than what is read from files."""
    expression = Expression(render(tree))
    vars(expression)["tree"] = tree  # as if computed already: cached_property keeps it there
    return expression
