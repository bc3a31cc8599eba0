"""Switches of functions: corners and jumps with signals. Steps end there along the path of a run that chose its steps."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import ExpressionCurve, Varying
from nivel.analysis.curves.path import Array, Path, Steps
from nivel.machine.laws.functions import functions_of
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.bounds import values_of
from nivel.machine.units.expression import Expression
from nivel.machine.units.sides import sides
from nivel.machine.units.tree import Node, signals

# Halvings of the time between two frames, and the share of it that is left out around a switch: on either side the function is smooth.
HALVINGS, LEFT_OUT = 40, 1e-10


def has_switches(machine: MachineRecord) -> bool:
    """Whether a function has corners or jumps with signals. Those of blocks, which have laws of their own, are taken to."""
    return bool(machine.control) or any(
        isinstance(each.function, Expression) and any(_switches(each.function)) for each in functions_of(machine)
    )


def _switches(expression: Expression) -> Iterator[tuple[Node, Node | None]]:
    """Pairs of expressions whose order decides. Corners of curves are no switches."""
    return sides(expression.tree, _of_signals, curves=False)


def cut_at_switches(function: Varying, path: Path, steps: Steps) -> Steps:
    """The steps, each in parts where it contains a switch of the function."""
    if not isinstance(function.curve, ExpressionCurve) or function.motion:
        return steps
    found = [_changes(first, second, path) for first, second in _switches(function.curve.expression)]
    times = np.unique(np.concatenate([*found, []]))
    times = times[(times > steps.begin[0]) & (times < steps.begin[-1] + steps.length[-1])]
    if not len(times):
        return steps
    gap = LEFT_OUT * float(np.diff(path.time).min())
    begin = np.concatenate([steps.begin, times + gap])
    end = np.concatenate([steps.begin + steps.length, times - gap])
    begin, end = np.sort(begin), np.sort(end)
    longer = end > begin
    return Steps(begin[longer], (end - begin)[longer])


def _of_signals(*nodes: Node) -> bool:
    return any(signals(node) for node in nodes)


def _changes(first: Node, second: Node | None, path: Path) -> Array:
    """Times [s] at which the order of two expressions changes, one at most between two frames."""

    def is_above(time: Array) -> NDArray[np.bool_]:
        known = path.at(time)
        return values_of(first, known) > (values_of(second, known) if second is not None else 0.0)

    above = is_above(path.time)
    at = np.flatnonzero(above[1:] != above[:-1])
    low, high, before = path.time[at], path.time[at + 1], above[at]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = is_above(middle) == before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return high
