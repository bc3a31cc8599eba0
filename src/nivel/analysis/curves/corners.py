"""Times at which the functions of time of a machine have corners: points of tables of straight lines, and where an absolute value, a
minimum or a maximum of expressions of time alone changes sides."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import TypeGuard

import numpy as np

from nivel.kernels.record.function import NEAR
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.table import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.expression import Expression
from nivel.machine.units.sides import sides
from nivel.machine.units.tree import TIME, ExpressionError, Node, signals

# Sides of an expression are looked at so many times in a run.
SAMPLES = 2000
# Slopes of a table that differ by less, as a share of the largest, make no corner.
STRAIGHT = 1e-9


def corners(machine: MachineRecord, *, with_values: bool = False) -> tuple[float, ...]:
    """Corners within the run [s], ascending. with_values : only those at which the function has a value, so that a step can end there."""
    end = machine.simulation.duration
    found: set[float] = set()
    for each in machine.functions:
        function = each.function
        if each.sampling is None and _knows_corners(function):
            found |= {
                time
                for time in corners_of(function, end)
                if not with_values or isinstance(function, Table) or _holds(function, time)
            }
    return tuple(sorted(found))


def corners_of(function: Table | Expression, end: float) -> list[float]:
    """Corners of a function of time after the begin of a run, up to its `end` [s]; those of a table ascending."""
    times = _of_table(function) if isinstance(function, Table) else _of_expression(function, end)
    return [time for time in times if 0.0 < time <= end * (1.0 + NEAR)]


def _knows_corners(function: Table | Expression | PythonLaw) -> TypeGuard[Table | Expression]:
    """Whether the corners of a function can be told; those of Python laws and of tables of a signal cannot."""
    return isinstance(function, Expression) or (isinstance(function, Table) and function.of == TIME)


def _of_table(table: Table) -> Iterator[float]:
    if table.interpolation != "linear":
        # a natural spline ends straight: where it does not hold its end value before and after, its slope jumps there
        # the curvature of monotone curves jumps at every point
        yield from table.times if table.interpolation == "monotone" else (table.times[0], table.times[-1])
        return
    slope = np.concatenate([[0.0], np.diff(table.values) / np.diff(table.times), [0.0]])
    for time, jump in zip(table.times, np.abs(np.diff(slope)), strict=True):
        if jump > STRAIGHT * np.abs(slope).max():
            yield float(time)


@lru_cache(maxsize=256)
def _of_expression(expression: Expression, end: float) -> tuple[float, ...]:
    """Remembered, as many runs of one machine ask for the same."""
    return tuple(_found(expression, end))


def _found(expression: Expression, end: float) -> Iterator[float]:
    from scipy.optimize import root_scalar  # takes a fifth of a second to import

    times = np.linspace(0.0, end, SAMPLES + 1)
    for first, second in sides(expression.tree, _of_time_alone, curves=True):

        def difference(time: float, first: Node = first, second: Node | None = second) -> float:
            return evaluate(first, time) - (evaluate(second, time) if second is not None else 0.0)

        try:
            values = np.array([difference(float(time)) for time in times])
        except ExpressionError:
            continue
        roots = [
            root_scalar(difference, bracket=(times[k], times[k + 1]), xtol=1e-15 * end, rtol=1e-14).root
            for k in np.flatnonzero(values[:-1] * values[1:] < 0.0)
        ]
        # where it is zero all along, as between two equal functions, only the ends are corners
        zero = np.concatenate([[False], values == 0.0, [False]])
        yield from (*roots, *map(float, times[zero[1:-1] & ~(zero[:-2] & zero[2:])]))


def _holds(expression: Expression, time: float) -> bool:
    """Whether a function has a value at a corner."""
    if expression.signals:
        return True
    try:
        evaluate(expression.tree, time)
    except ExpressionError:
        return False
    return True


def _of_time_alone(*nodes: Node) -> bool:
    return not any(signals(node) for node in nodes)
