"""Motions from speeds and accelerations over time: piecewise polynomials of the way, integrated once or twice.

Tables of straight lines and cubic ones are integrated exactly. Other functions are replaced by polynomials through Lobatto's points on
pieces that are halved until they agree with the function between these points as well.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.bounds import values_of
from nivel.machine.units.expression import Expression
from nivel.machine.units.tree import TIME, ExpressionError

Array = NDArray[np.float64]
COEFFICIENTS = 6
# of a polynomial against its function, as a share of its largest value; halvings at most; beyond the run the motion goes on so long [s]
AGREES, HALVINGS, BEYOND = 1e-11, 40, 1e9
# What is known of a function is known past the end of the run as well, by this factor: its last instant has what is prescribed there.
PAST = 1.01
# A change of a speed within a piece that cannot be halved further is a jump if it is more than this share of its largest value.
JUMP = 1e-6
# Lobatto's points on [0, 1] by their number; and where a polynomial is compared with the function
LOBATTO = {
    4: np.array([0.0, 0.5 - np.sqrt(0.05), 0.5 + np.sqrt(0.05), 1.0]),
    5: np.array([0.0, 0.5 - np.sqrt(3.0 / 28.0), 0.5, 0.5 + np.sqrt(3.0 / 28.0), 1.0]),
}
BETWEEN = np.array([0.08, 0.37, 0.61, 0.93])


def integrated(function: TimeFunction, times: int, end: float, speed: float = 0.0) -> tuple[Array, Array]:
    """Points (n,) [s] and coefficients (n - 1, 6) of the way from 0 at t = 0, on to `end` and beyond, where the speed stays.

    times : 1 for a speed, 2 for an acceleration. speed : at t = 0, of an acceleration.

    Raises ModelError where a speed jumps, and where the function has no value.
    """
    points, pieces = _of_table(function, end) if _is_exact(function) else _sampled(function, times, PAST * end)
    for constant in (speed, 0.0)[2 - times :]:
        pieces = _integrated_once(points, pieces, constant)
    pieces = np.hstack([pieces, np.zeros((len(pieces), COEFFICIENTS - pieces.shape[1]))])
    h = points[-1] - points[-2]
    last = [polynomial.polyval(h, pieces[-1]), polynomial.polyval(h, polynomial.polyder(pieces[-1])), *[0.0] * 4]
    return np.append(points, points[-1] + BEYOND), np.vstack([pieces, last])


def _is_exact(function: TimeFunction) -> bool:
    return isinstance(function, Table) and function.interpolation in ("linear", "cubic", "monotone")


def _of_table(function: TimeFunction, end: float) -> tuple[Array, Array]:
    """A table from 0 to the later one of its last point and `end`, with its end values outside it."""
    assert isinstance(function, Table)
    x, c = np.array(function.times), function.coefficients()
    constant = np.zeros((1, c.shape[1]))
    if x[0] > 0.0:
        constant[0, 0] = function.values[0]
        x, c = np.append(0.0, x), np.vstack([constant, c])
    if x[-1] < end:
        constant = np.zeros((1, c.shape[1]))
        constant[0, 0] = function.values[-1]
        x, c = np.append(x, end), np.vstack([c, constant])
    first = int(np.searchsorted(x, 0.0, side="right")) - 1
    x, c = x[first:].copy(), c[first:].copy()
    if x[0] < 0.0:
        c[0] = _shifted(c[0], -x[0])
        x[0] = 0.0
    return x, c


def _shifted(c: Array, h: float) -> Array:
    """The polynomial of x + h."""
    out = np.zeros_like(c)
    power = np.array([1.0])
    for each in c:
        out[: len(power)] += each * power
        power = polynomial.polymul(power, [h, 1.0])
    return out


def _integrated_once(points: Array, pieces: Array, start: float) -> Array:
    out = np.zeros((len(pieces), pieces.shape[1] + 1))
    out[:, 1:] = pieces / np.arange(1, pieces.shape[1] + 1)
    grown = (out * np.diff(points)[:, None] ** np.arange(out.shape[1])).sum(axis=1)
    out[:, 0] = start + np.append(0.0, np.cumsum(grown)[:-1])
    return out[:, :COEFFICIENTS]


def _sampled(function: TimeFunction, times: int, end: float) -> tuple[Array, Array]:
    """Polynomials that agree with a function of time from 0 to `end`."""
    value = _values(function)
    nodes = LOBATTO[COEFFICIENTS - times]
    powers = np.arange(len(nodes))
    largest = max(float(np.abs(value(np.linspace(0.0, end, 65))).max()), 1e-300)
    inverse = np.linalg.inv(np.vander(nodes, increasing=True)).T
    between = np.vander(BETWEEN, len(nodes), increasing=True).T
    bounds = np.linspace(0.0, end, 17)
    begin, stop = bounds[:-1], bounds[1:]
    points, pieces = [np.zeros(1)], []
    for depth in range(HALVINGS + 1):
        h = (stop - begin)[:, None]
        found = value(begin[:, None] + h * nodes)
        c = found @ inverse
        missed = np.abs(c @ between - value(begin[:, None] + h * BETWEEN)).max(axis=1)
        agrees = missed <= AGREES * largest
        if depth == HALVINGS:
            jumps = ~agrees & (np.abs(found[:, -1] - found[:, 0]) > JUMP * largest)
            if times == 1 and jumps.any():
                message = f"the speed jumps at t = {begin[jumps].min():.6g} s; give it a ramp, e.g. with `step`"
                raise ModelError(Fault("", 0, 0, "", message))
            agrees[:] = True
        points.append(stop[agrees])
        pieces.append(c[agrees] / h[agrees] ** powers)
        begin, stop = begin[~agrees], stop[~agrees]
        middle = 0.5 * (begin + stop)
        begin, stop = np.concatenate([begin, middle]), np.concatenate([middle, stop])
        if not len(begin):
            break
    ends = np.concatenate(points)
    order = np.argsort(ends[1:])
    return np.append(0.0, ends[1:][order]), np.vstack(pieces)[order]


def _values(function: TimeFunction) -> Callable[[Array], Array]:
    if isinstance(function, PythonLaw):
        raise ModelError(Fault("", 0, 0, "", "a function in Python drives by its `value`, rate and acceleration"))
    if isinstance(function, int | float):
        return partial(_constant, float(function))
    return partial(_evaluated, function)


def _evaluated(function: TimeFunction, t: Array) -> Array:
    """Raises ModelError where the function has no finite value."""
    if isinstance(function, Expression):
        out = values_of(function.tree, {TIME: t.ravel()}).reshape(t.shape)
        if np.isfinite(out).all():
            return out
    value = partial(evaluate, function.tree) if isinstance(function, Expression) else function
    assert callable(value)
    out = np.empty_like(t)
    for k, each in np.ndenumerate(t):
        try:
            out[k] = value(float(each))
        except ExpressionError as fault:
            raise ModelError(Fault("", 0, 0, "", f"there is no value at t = {each:.6g} s: {fault}")) from None
    if not np.isfinite(out).all():
        when = float(t[~np.isfinite(out)][0])
        raise ModelError(Fault("", 0, 0, "", f"there is no finite value at t = {when:.6g} s"))
    return out


def _constant(value: float, t: Array) -> Array:
    return np.full_like(t, value)
