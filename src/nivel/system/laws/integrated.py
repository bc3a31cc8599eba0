"""Motions from speeds and accelerations over time: piecewise polynomials of the way, integrated once or twice.

Tables of straight lines and cubic ones are integrated exactly. Other functions are replaced by polynomials through Lobatto's points on
pieces between their corners, halved until they agree with the function at many places between these points as well.
"""

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.sides import marks
from nivel.machine.units.tree import TIME, ExpressionError, Lookup, Node, Time
from nivel.system.laws.program import PlacedProgram

Array = NDArray[np.float64]
COEFFICIENTS = 6
# of a polynomial against its function, as a share of its largest value; halvings at most; beyond the run the motion goes on so long [s]
AGREES, HALVINGS, BEYOND = 1e-11, 40, 1e9
# What passes zero at a corner is looked at so often; corners at most of one of them, and pieces at most.
LOOKS, CORNERS, PIECES = 8192, 4096, 1_000_000
# Corners nearer to each other, as a share of the run, are one.
APART = 1e-12
# Polynomials are compared with the function at so many places on each of PARTS equal parts of the run, and at half as many on halves of
# these: no short pulse lies between them.
PLACES, PARTS = 1024, 16
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
# of the distance of two numbers at the end of the run: ends of pieces are looked at so far within them, where a jump is not yet or is done
WITHIN = 4.0


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
    inverse = np.linalg.inv(np.vander(nodes, increasing=True)).T
    within = WITHIN * np.spacing(end)
    largest = float(np.abs(value(np.array([0.0, end]))).max())
    bounds = _bounds(function, end)
    begin, stop = bounds[:-1], bounds[1:]
    points, pieces, edges = [np.zeros(1)], [], []
    for depth in range(HALVINGS + 1):
        h = (stop - begin)[:, None]
        at = begin[:, None] + h * nodes
        at[:, 0], at[:, -1] = begin + within, stop - within
        found = value(at)
        c = found @ inverse
        between = BETWEEN if PLACES >> depth <= len(BETWEEN) else _places(PLACES >> depth)
        true = value(begin[:, None] + h * between)
        largest = max(largest, float(np.abs(found).max()), float(np.abs(true).max()))
        missed = np.abs(c @ np.vander(between, len(nodes), increasing=True).T - true).max(axis=1)
        # a time that is rounded moves the value by its slope
        agrees = missed <= AGREES * largest + 4.0 * within * np.ptp(found, axis=1) / h[:, 0]
        if depth == HALVINGS:
            agrees[:] = True
        points.append(stop[agrees])
        pieces.append(c[agrees] / h[agrees] ** powers)
        edges.append(found[agrees][:, [0, -1]])
        begin, stop = begin[~agrees], stop[~agrees]
        middle = 0.5 * (begin + stop)
        begin, stop = np.concatenate([begin, middle]), np.concatenate([middle, stop])
        if not len(begin):
            break
        if sum(map(len, pieces)) + len(begin) > PIECES:
            message = f"it varies too fast to be integrated over {end:.6g} s; give a table of its values"
            raise ModelError(Fault.at("", message))
    ends = np.concatenate(points)
    order = np.argsort(ends[1:])
    ends = np.append(0.0, ends[1:][order])
    if times == 1:
        _refuse_jumps(ends, np.vstack(edges)[order], JUMP * largest)
    return ends, np.vstack(pieces)[order]


def _places(count: int) -> Array:
    """Places on [0, 1] without a common distance: a wave that is zero at all of them is rare."""
    return np.mod(np.arange(1, count + 1) * 0.6180339887498949, 1.0)


def _refuse_jumps(ends: Array, edges: Array, most: float) -> None:
    """Raises ModelError where a speed jumps: from one piece to the next, or within one that cannot be halved further."""
    between = np.append(np.abs(edges[1:, 0] - edges[:-1, 1]) > most, False)
    short = np.diff(ends) < 2.0 * (ends[-1] / PARTS) * 2.0**-HALVINGS
    inside = short & (np.abs(edges[:, 1] - edges[:, 0]) > most)
    if (between | inside).any():
        when = min([*ends[1:][between], *ends[:-1][inside]])
        raise ModelError(Fault.at("", f"the speed jumps at t = {when:.6g} s; give it a ramp, e.g. with `step`"))


def _bounds(function: TimeFunction, end: float) -> Array:
    """Ends of the first pieces [s]: corners and jumps, and equal parts of the run."""
    corners = _corners(function, end)
    parts = np.linspace(0.0, end, PARTS + 1)
    if not len(corners):
        return parts
    far = np.abs(parts[1:-1, None] - corners).min(axis=1) > end / LOOKS
    bounds = np.unique([0.0, end, *parts[1:-1][far], *corners])
    return np.append(bounds[:-1][np.diff(bounds) > APART * end], end)


def _corners(function: TimeFunction, end: float) -> Array:
    """Where between 0 and `end` a function has a corner or jumps [s]."""
    found = [np.empty(0)]
    if isinstance(function, Expression | Table):
        grid = np.linspace(0.0, end, LOOKS + 1)
        for mark in marks(function):
            above = PlacedProgram.of(mark).values({TIME: grid}) >= 0.0
            k = np.flatnonzero(above[1:] != above[:-1])
            if 0 < len(k) <= CORNERS:
                found.append(_passed(mark, grid[k], grid[k + 1], above[k]))
    corners = np.unique(np.concatenate(found))
    return corners[(corners > APART * end) & (corners < (1.0 - APART) * end)]


def _passed(mark: Node, low: Array, high: Array, above: NDArray[np.bool_]) -> Array:
    """Where `mark` passes zero between `low` and `high`, by halving. above : whether it is not below zero at `low`."""
    program = PlacedProgram.of(mark)
    for _ in range(60):
        middle = 0.5 * (low + high)
        same = (program.values({TIME: middle}) >= 0.0) == above
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return high


def _values(function: TimeFunction) -> Callable[[Array], Array]:
    if isinstance(function, PythonLaw):
        raise ModelError(Fault.at("", "a function in Python drives by its `value`, rate and acceleration"))
    if isinstance(function, int | float):
        return partial(np.full_like, fill_value=float(function))
    return partial(_evaluated, function)


def _evaluated(function: TimeFunction, t: Array) -> Array:
    """Raises ModelError where the function has no finite value."""
    tree = _tree(function)
    if tree is not None:
        out = PlacedProgram.of(tree).values({TIME: t.ravel()}).reshape(t.shape)
        if np.isfinite(out).all():
            return out
    value = partial(evaluate, function.tree) if isinstance(function, Expression) else function
    assert callable(value)
    out = np.empty_like(t)
    for k, each in np.ndenumerate(t):
        try:
            out[k] = value(float(each))
        except ExpressionError as fault:
            raise ModelError(Fault.at("", f"there is no value at t = {each:.6g} s: {fault}")) from None
    if not np.isfinite(out).all():
        when = float(t[~np.isfinite(out)][0])
        raise ModelError(Fault.at("", f"there is no finite value at t = {when:.6g} s"))
    return out


def _tree(function: TimeFunction) -> Node | None:
    """A function of time as an expression."""
    if isinstance(function, Table) and not _is_exact(function):
        return Lookup(Time(), function.interpolation, tuple(function.times), tuple(function.values))
    return function.tree if isinstance(function, Expression) else None
