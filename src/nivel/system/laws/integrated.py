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
from nivel.machine.units.tree import ExpressionError

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
    for k, h in enumerate(np.diff(points)):
        out[k, 0] = start
        start = float(polynomial.polyval(h, out[k]))
    return out[:, :COEFFICIENTS]


def _sampled(function: TimeFunction, times: int, end: float) -> tuple[Array, Array]:
    """Polynomials that agree with a function of time from 0 to `end`."""
    value = _values(function)
    nodes = LOBATTO[COEFFICIENTS - times]
    largest = max(float(np.abs(value(np.linspace(0.0, end, 65))).max()), 1e-300)
    points, pieces = [0.0], []
    waiting = [(k / 16.0 * end, (k + 1) / 16.0 * end, 0) for k in reversed(range(16))]
    inverse = np.linalg.inv(np.vander(nodes, increasing=True))
    while waiting:
        begin, stop, depth = waiting.pop()
        h = stop - begin
        found = value(begin + h * nodes)
        c = inverse @ found
        missed = np.abs(polynomial.polyval(BETWEEN, c) - value(begin + h * BETWEEN)).max()
        if missed > AGREES * largest and depth < HALVINGS:
            middle = 0.5 * (begin + stop)
            waiting += [(middle, stop, depth + 1), (begin, middle, depth + 1)]
            continue
        if times == 1 and abs(found[-1] - found[0]) > JUMP * largest and depth == HALVINGS:
            raise ModelError(
                Fault("", 0, 0, "", f"the speed jumps at t = {begin:.6g} s; give it a ramp, e.g. with `step`")
            )
        points.append(stop)
        pieces.append(c / h ** np.arange(len(nodes)))
    return np.array(points), np.array(pieces)


def _values(function: TimeFunction) -> Callable[[Array], Array]:
    if isinstance(function, PythonLaw):
        raise ModelError(Fault("", 0, 0, "", "a function in Python drives by its `value`, rate and acceleration"))
    if isinstance(function, int | float):
        return partial(_constant, float(function))
    return partial(_evaluated, function)


def _evaluated(function: TimeFunction, t: Array) -> Array:
    """Raises ModelError where the function has no finite value."""
    assert callable(function)
    out = np.empty_like(t)
    for k, each in enumerate(t):
        try:
            out[k] = function(float(each))
        except ExpressionError as fault:
            raise ModelError(Fault("", 0, 0, "", f"there is no value at t = {each:.6g} s: {fault}")) from None
    if not np.isfinite(out).all():
        when = float(t[~np.isfinite(out)][0])
        raise ModelError(Fault("", 0, 0, "", f"there is no finite value at t = {when:.6g} s"))
    return out


def _constant(value: float, t: Array) -> Array:
    return np.full_like(t, value)
