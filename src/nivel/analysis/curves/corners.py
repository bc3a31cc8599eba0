"""Corners and jumps of the functions of a machine: times at which functions of time have corners, as points of tables of straight lines,
and where an absolute value, a minimum or a maximum of expressions of time alone changes sides; and functions that jump with the motion."""

from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
from functools import lru_cache
from typing import TypeGuard

import numpy as np

from nivel.analysis.curves.functions import Curve, TableCurve, varying
from nivel.integrate.loop.run import PARTS
from nivel.kernels.record.function import NEAR
from nivel.lazy import scipy
from nivel.machine.core.vectors import Array
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.sides import is_of_time_alone, jumps, sides
from nivel.machine.units.tree import TIME, ExpressionError, Node, signals
from nivel.words.wording import shown

# Sides of an expression are looked at so many times in a run.
SAMPLES = 2000
# Slopes of a table that differ by less, as a share of the largest, make no corner.
STRAIGHT = 1e-9
FEW = 64
# [s] What jumps at the time 0 begins with what is written for it: a first part of a step ends here, and the method begins anew.
BEGUN = 1e-12
# Corners are found to less than NEAR of their time, as functions pass them within that. The first is no limit [s].
LEAST, CLOSE, MOST = 1e-300, 0.25 * NEAR, 2000


def corners(machine: MachineRecord, *, with_values: bool = False, at_begin: bool = False) -> tuple[float, ...]:
    """Corners within the run [s], ascending. with_values : only those at which the function has a value, so that a step can end there.
    at_begin : with BEGUN where a function jumps at the begin of the run."""
    end = machine.simulation.duration
    found: set[float] = set()
    for each in machine.functions:
        function = each.function
        if each.sampling is None and _knows_corners(function):
            found |= {
                time
                for time in corners_of(function, end, all_points=with_values)
                if not with_values or isinstance(function, Table) or _holds(function, time)
            }
            if at_begin and isinstance(function, Expression) and _jumps_at_begin(function, end):
                found.add(BEGUN)
    return tuple(sorted(found))


def _jumps_at_begin(expression: Expression, end: float) -> bool:
    """Whether an expression jumps behind the time 0, as by `time > 0`; one of signals, too, whose comparison of time changes there."""
    if not jumps(expression.tree, is_of_time_alone) or 0.0 not in _of_expression(expression, end):
        return False
    if expression.signals:
        return True
    try:
        first, second = evaluate(expression.tree, 0.0), evaluate(expression.tree, BEGUN)
    except ExpressionError:
        return False
    return abs(second - first) > STRAIGHT * max(abs(first), abs(second))


def corners_of(function: Table | Expression, end: float, *, all_points: bool = False) -> list[float]:
    """Corners of a function of time after the begin of a run, up to its `end` [s]; those of a table ascending. all_points : of a table of
    FEW points all of them, so that slopes by its values have the same corners whatever these are."""
    if all_points and isinstance(function, Table) and len(function.times) <= FEW:
        times: Iterable[float] = map(float, function.times)
    else:
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
    times = np.linspace(0.0, end, SAMPLES + 1)
    for first, second in sides(expression.tree, lambda *nodes: not any(map(signals, nodes)), curves=True):

        def difference(time: float, first: Node = first, second: Node | None = second) -> float:
            return evaluate(first, time) - (evaluate(second, time) if second is not None else 0.0)

        try:
            values = np.array([difference(float(time)) for time in times])
        except ExpressionError:
            continue
        roots = [
            scipy.optimize.root_scalar(
                difference, bracket=(times[k], times[k + 1]), xtol=LEAST, rtol=CLOSE, maxiter=MOST
            ).root
            for k in np.flatnonzero(values[:-1] * values[1:] < 0.0)
        ]
        # where it is zero all along, as between two equal functions, only the ends are corners
        zero = np.concatenate([[False], values == 0.0, [False]])
        yield from (*roots, *map(float, times[zero[1:-1] & ~(zero[:-2] & zero[2:])]))
        # round-off may put a corner at the end behind it
        with suppress(ExpressionError):
            if values[-1] * difference(end * (1.0 + NEAR)) < 0.0:
                yield end


def _holds(expression: Expression, time: float) -> bool:
    if expression.signals:
        return True
    try:
        evaluate(expression.tree, time)
    except ExpressionError:
        return False
    return True


def jumping_functions(machine: MachineRecord, among: Collection[Node] | None = None) -> tuple[str, ...]:
    """Names and texts of the functions that jump where something of the motion passes a value; those of samples jump anyway.

    among : these functions alone.
    """
    return tuple(
        f"{shown(each.function.text)} of {each.section}.{each.part}"
        for each in machine.functions
        if each.sampling is None
        and isinstance(each.function, Expression)
        and (among is None or each.function.tree in among)
        and jumps(each.function.tree, lambda node: bool(signals(node)))
    )


# samples in one of the PARTS of a run
SAMPLES_OF_A_PART = 16
# Within a step a function changes by this share of its range at most: six steps a period.
CHANGE = 0.5
# Bounds beyond the samples by this share of the range are looked into by so many halvings, so many intervals at once.
BEYOND, HALVINGS, MOST_INTERVALS = 0.05, 16, 4096


def allowed_steps(machine: MachineRecord, duration: float) -> Array:
    """(PARTS,) [s] the longest step that may begin in each part of a run; infinite where nothing varies fast."""
    allowed = np.full(PARTS, np.inf)
    time = np.linspace(0.0, duration, PARTS * SAMPLES_OF_A_PART + 1)
    for function in varying(machine):
        curve = function.curve
        if curve.signals or (isinstance(curve, TableCurve) and curve.table.interpolation == "linear"):
            continue  # steps end at the points of tables of straight lines
        values = curve.values({TIME: time})
        if not np.isfinite(values).any():
            continue
        at, seen = with_features(curve, time, np.nan_to_num(values))
        with np.errstate(over="ignore"):  # a jump has no slope that is a number
            slope = np.abs(np.diff(seen)) / np.maximum(np.diff(at), 1e-300)
        # a jump, which no step resolves
        slope[np.diff(at) < 1.5 * duration / (PARTS * SAMPLES_OF_A_PART * 2**HALVINGS)] = 0.0
        part = np.minimum((0.5 * (at[:-1] + at[1:]) / duration * PARTS).astype(int), PARTS - 1)
        steepest = np.zeros(PARTS)
        np.maximum.at(steepest, part, slope)
        span = float(np.ptp(seen))
        moving = steepest * duration > span * (1.0 + 1e-9)
        allowed[moving] = np.minimum(allowed[moving], CHANGE * span / steepest[moving])
    part = duration / PARTS
    return _ending_before(_beside(allowed, part), part)


@np.errstate(over="ignore", invalid="ignore")  # of functions that are no numbers somewhere
def rounding_of_times(machine: MachineRecord, duration: float) -> float:
    """By what share of its impulse a function of time alone is uncertain, at most, because times are rounded: its total variation by what
    the end of the run [s] is rounded to, over the integral of its magnitude. Two runs are not apart by that."""
    share = 0.0
    for function in varying(machine):
        curve = function.curve
        if curve.signals:
            continue
        time = np.linspace(0.0, duration, PARTS * SAMPLES_OF_A_PART + 1)
        if isinstance(curve, TableCurve):
            points = curve.points[0]
            time = np.union1d(time, points[(points > 0.0) & (points < duration)])
        at, seen = with_features(curve, time, np.nan_to_num(curve.values({TIME: time})))
        impulse = float(np.trapezoid(np.abs(seen), at))
        uncertain = float(np.abs(np.diff(seen)).sum()) * float(np.spacing(duration))
        if impulse > 0.0 and np.isfinite(uncertain / impulse):
            share = max(share, uncertain / impulse)
    return share


def with_features(curve: Curve, time: Array, values: Array, share: float = BEYOND) -> tuple[Array, Array]:
    """Times and values with more of them where the function has more than was sampled, by this share of its range."""
    begin, width = time[:-1], np.diff(time)
    low, high = np.minimum(values[:-1], values[1:]), np.maximum(values[:-1], values[1:])
    for _ in range(HALVINGS):
        found = curve.bounds({TIME: begin}, {TIME: begin + width})
        if found is None:
            break
        beyond = np.maximum(found[1] - high, low - found[0])
        floor = max(share * float(np.ptp(values)), 1e-6 * float(np.max(beyond, initial=0.0, where=np.isfinite(beyond))))
        keep = np.flatnonzero(beyond > floor)
        if len(keep) > MOST_INTERVALS:
            keep = keep[np.argsort(-beyond[keep], kind="stable")[:MOST_INTERVALS]]
        if not len(keep):
            break
        begin, width, low, high = begin[keep], width[keep], low[keep], high[keep]
        middle = begin + 0.5 * width
        inside = np.nan_to_num(curve.values({TIME: middle}))
        order = np.argsort(np.concatenate([time, middle]), kind="stable")
        time, values = np.concatenate([time, middle])[order], np.concatenate([values, inside])[order]
        low, high = np.minimum(low, inside), np.maximum(high, inside)
        begin, width = np.concatenate([begin, middle]), np.tile(0.5 * width, 2)
        low, high = np.tile(low, 2), np.tile(high, 2)
    return time, values


def _beside(allowed: Array, part: float) -> Array:
    """No more than what is allowed in any part nearer than a step of that length: the top of a sine is as fast as its sides."""
    out = allowed.copy()
    for k in np.flatnonzero(np.isfinite(allowed)):
        reach = int(allowed[k] / part)
        near = slice(max(0, k - reach), k + reach + 1)
        out[near] = np.minimum(out[near], allowed[k])
    return out


def _ending_before(allowed: Array, part: float) -> Array:
    """What is allowed where a step may not reach beyond the begin of a later part by more than what is allowed there."""
    out = allowed.copy()
    for k in range(len(out) - 2, -1, -1):
        out[k] = min(out[k], out[k + 1] + part)
    return out
