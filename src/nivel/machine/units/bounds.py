"""Arithmetic trees on arrays: their values at many places at once, and bounds of their values over intervals.

Bounds hold for every point of an interval (Moore 1966); they are wide where a symbol comes twice, and become exact as intervals shrink.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.machine.units.arithmetic import TIME, Call, Lookup, Negative, Node, Number, Operation, Signal, Time
from nivel.machine.units.elementary import COMPOUND, elementary
from nivel.machine.units.interpolation import curve_of

Array = NDArray[np.float64]
Interval = tuple[Array, Array]
BLOCK: Final = 4096  # places at once

_VALUES: Final[dict[str, Callable[..., Array]]] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "abs": np.abs,
    "floor": np.floor,
    "tanh": np.tanh,
    "if": lambda condition, yes, no: np.where(condition > 0.0, yes, no),
}
# functions that rise with their argument, and the least and the largest argument that they take
_RISING: Final = {
    "asin": (-1.0, 1.0),
    "atan": (-np.inf, np.inf),
    "sqrt": (0.0, np.inf),
    "exp": (-np.inf, np.inf),
    "log": (0.0, np.inf),
    "floor": (-np.inf, np.inf),
    "tanh": (-np.inf, np.inf),
}


@np.errstate(all="ignore")  # a division by zero is no number, as in a run
def values_of(node: Node, known: Mapping[str, Array]) -> Array:
    """Values (n,) of a tree; known : values (n,) of the time and of each signal by its path. Not a number where there is none."""
    (count,) = next(iter(known.values())).shape
    if count <= BLOCK:
        return np.broadcast_to(_values(node, known), (count,))
    out = np.empty(count)
    for first in range(0, count, BLOCK):  # what stands in between stays in the cache of the processor
        block = slice(first, first + BLOCK)
        out[block] = _values(node, {name: values[block] for name, values in known.items()})
    return out


def _values(node: Node, known: Mapping[str, Array]) -> Array:
    """The same; of what is constant a single value ()."""
    match node:
        case Number(value, _):
            return np.asarray(value, dtype=float)
        case Time():
            return known[TIME]
        case Signal(path):
            return known[path]
        case Negative(operand):
            return -_values(operand, known)
        case Operation(symbol, left, right):
            return _operate(symbol, _values(left, known), _values(right, known))
        case Call(("min" | "max") as function, arguments):
            chosen = np.minimum if function == "min" else np.maximum
            return reduce(chosen, (_values(each, known) for each in arguments))
        case Call(function, _) if function in COMPOUND:
            return _values(elementary(node), known)
        case Call(function, arguments):
            return _VALUES[function](*(_values(each, known) for each in arguments))
        case Lookup(argument):
            return _values_of_curve(node, _values(argument, known))
    raise ValueError(f"a name is not bound: {node}")


@np.errstate(all="ignore")
def bounds_of(node: Node, known: Mapping[str, Interval]) -> Interval:
    """Bounds (n,), (n,) of a tree over intervals; known : those of the time and of each signal. Infinite where there are none."""
    low, high = _bounds(node, known)
    shape = next(iter(known.values()))[0].shape
    return np.broadcast_to(low, shape), np.broadcast_to(high, shape)


def _bounds(node: Node, known: Mapping[str, Interval]) -> Interval:
    """The same; of what is constant a single value (), twice."""
    match node:
        case Number(value, _):
            at = np.asarray(value, dtype=float)
            return at, at
        case Time():
            return known[TIME]
        case Signal(path):
            return known[path]
        case Negative(operand):
            low, high = _bounds(operand, known)
            return -high, -low
        case Operation(symbol, left, right):
            return _bounded(*_bounds_of_operation(symbol, _bounds(left, known), _bounds(right, known)))
        case Call(function, _) if function in COMPOUND:
            return _bounds(elementary(node), known)
        case Call(function, arguments):
            return _bounded(*_bounds_of_call(function, [_bounds(each, known) for each in arguments]))
        case Lookup(argument):
            return _bounds_of_curve(node, *_bounds(argument, known))
    raise ValueError(f"a name is not bound: {node}")


def _operate(symbol: str, left: Array, right: Array) -> Array:
    match symbol:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "/":
            return left / right
        case "**":
            return np.power(left, right)
    return _truth(symbol, left, right).astype(float)


def _truth(symbol: str, left: Array, right: Array) -> NDArray[np.bool_]:
    match symbol:
        case "<":
            return left < right
        case "<=":
            return left <= right
        case ">":
            return left > right
        case ">=":
            return left >= right
        case "and":
            return (left > 0.0) & (right > 0.0)
    return (left > 0.0) | (right > 0.0)


def _bounded(low: Array, high: Array) -> Interval:
    """What is no number says nothing."""
    return np.where(np.isnan(low), -np.inf, low), np.where(np.isnan(high), np.inf, high)


def _hull(*values: Array) -> Interval:
    return reduce(np.minimum, values), reduce(np.maximum, values)


def _bounds_of_operation(symbol: str, left: Interval, right: Interval) -> Interval:
    (a, b), (c, d) = left, right
    match symbol:
        case "+":
            return a + c, b + d
        case "-":
            return a - d, b - c
        case "*":
            return _products(left, right)
        case "/":
            low, high = _products(left, (1.0 / d, 1.0 / c))
            holds_zero = (c <= 0.0) & (d >= 0.0)
            return np.where(holds_zero, -np.inf, low), np.where(holds_zero, np.inf, high)
        case "**":
            return _bounds_of_power(left, right)
    # a comparison surely holds where it does at the end of each interval that is worst for it, and may where it does at the best
    worst, best = ((b, c), (a, d)) if symbol in ("<", "<=") else ((a, d), (b, c))
    if symbol in ("and", "or"):
        worst, best = (a, c), (b, d)
    return _truth(symbol, *worst).astype(float), _truth(symbol, *best).astype(float)


def _products(left: Interval, right: Interval) -> Interval:
    """Of zero and infinity zero: the bounds of what is multiplied are finite inside."""
    of_left, of_right = (each[:1] if each[0] is each[1] else each for each in (left, right))  # of a number once
    return _hull(*(np.where((x == 0.0) | (y == 0.0), 0.0, x * y) for x in of_left for y in of_right))


def _bounds_of_power(base: Interval, exponent: Interval) -> Interval:
    (a, b), (c, d) = base, exponent
    low, high = _hull(*(np.power(x, y) for x in base for y in exponent))
    whole = (c == d) & (c == np.round(c))
    even = whole & (np.mod(c, 2.0) == 0.0) & (a < 0.0) & (b > 0.0)
    low = np.where(even & (c > 0.0), 0.0, low)
    unbounded = (a <= 0.0) & ~(whole & (c >= 0.0)) & ~((a == 0.0) & (c >= 0.0))
    unbounded &= ~(whole & (b < 0.0))
    return np.where(unbounded, -np.inf, low), np.where(unbounded, np.inf, high)


def _bounds_of_call(function: str, arguments: list[Interval]) -> Interval:
    if function in ("min", "max"):
        chosen = np.minimum if function == "min" else np.maximum
        return reduce(chosen, [each[0] for each in arguments]), reduce(chosen, [each[1] for each in arguments])
    if function == "atan2":
        corners = [np.arctan2(y, x) for y in arguments[0] for x in arguments[1]]
        right = arguments[1][0] > 0.0
        low, high = _hull(*corners)
        return np.where(right, low, -np.pi), np.where(right, high, np.pi)
    low, high = arguments[0]
    if function == "if":
        (_, yes, no) = arguments
        least, largest = _hull(yes[0], no[0])[0], _hull(yes[1], no[1])[1]
        surely, never = low > 0.0, high <= 0.0
        return (
            np.where(surely, yes[0], np.where(never, no[0], least)),
            np.where(surely, yes[1], np.where(never, no[1], largest)),
        )
    match function:
        case "sin":
            return _bounds_of_sine(low, high)
        case "cos":
            return _bounds_of_sine(low + 0.5 * np.pi, high + 0.5 * np.pi)
        case "tan":
            pole = np.floor(low / np.pi + 0.5) != np.floor(high / np.pi + 0.5)
            return np.where(pole, -np.inf, np.tan(low)), np.where(pole, np.inf, np.tan(high))
        case "abs":
            inside = (low < 0.0) & (high > 0.0)
            least, largest = _hull(np.abs(low), np.abs(high))
            return np.where(inside, 0.0, least), largest
        case "acos":
            return np.arccos(np.clip(high, -1.0, 1.0)), np.arccos(np.clip(low, -1.0, 1.0))
    least, largest = _RISING[function]
    rising = _VALUES[function]
    return rising(np.clip(low, least, largest)), rising(np.clip(high, least, largest))


def _bounds_of_sine(low: Array, high: Array) -> Interval:
    turn = 2.0 * np.pi
    least, largest = _hull(np.sin(low), np.sin(high))
    tops = np.ceil((low - 0.25 * turn) / turn) * turn + 0.25 * turn <= high
    bottoms = np.ceil((low + 0.25 * turn) / turn) * turn - 0.25 * turn <= high
    everywhere = ~(high - low < turn)  # also of infinite intervals
    return np.where(bottoms | everywhere, -1.0, least), np.where(tops | everywhere, 1.0, largest)


def _values_of_curve(curve: Lookup, x: Array) -> Array:
    points, coefficients, before, behind = curve_of(curve.kind, curve.points, curve.values, curve.order)
    inner = np.full_like(x, before)
    if len(coefficients):
        k = np.clip(np.searchsorted(points, x, side="right") - 1, 0, len(coefficients) - 1)
        inner = sum(c * (x - points[k]) ** i for i, c in enumerate(coefficients[k].T))
    return np.where(x < points[0], before, np.where(x >= points[-1], behind, inner))


def _bounds_of_curve(curve: Lookup, low: Array, high: Array) -> Interval:
    """Of what each piece is over the part of the interval that lies in it."""
    points, coefficients, before, behind = curve_of(curve.kind, curve.points, curve.values, curve.order)
    least, largest = np.full_like(low, np.inf), np.full_like(high, -np.inf)
    for k, piece in enumerate(coefficients):
        inside = (low <= points[k + 1]) & (high >= points[k])
        part = np.maximum(low, points[k]) - points[k], np.minimum(high, points[k + 1]) - points[k]
        bounds: Interval = (np.zeros_like(low), np.zeros_like(high))
        for c in piece[::-1]:
            lower, upper = _products(bounds, part)
            bounds = lower + c, upper + c
        least, largest = (
            np.where(inside, np.minimum(least, bounds[0]), least),
            np.where(inside, np.maximum(largest, bounds[1]), largest),
        )
    for beyond, value in ((low < points[0], before), (high >= points[-1], behind)):
        least, largest = (
            np.where(beyond, np.minimum(least, value), least),
            np.where(beyond, np.maximum(largest, value), largest),
        )
    return least, largest
