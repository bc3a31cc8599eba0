"""Interval arithmetic on arrays (Moore 1966): bounds of an operation or a function over intervals of its arguments."""

from __future__ import annotations

from functools import reduce

import numpy as np
from numpy.typing import NDArray

from nivel.machine.units.tree import OPERATORS

Array = NDArray[np.float64]
Interval = tuple[Array, Array]


def hull(*values: Array) -> Interval:
    """The least and the largest of some values."""
    return reduce(np.minimum, values), reduce(np.maximum, values)


def operated(symbol: str, left: Interval, right: Interval) -> Interval:
    """Bounds of an operation."""
    (a, b), (c, d) = left, right
    match symbol:
        case "+":
            return a + c, b + d
        case "-":
            return a - d, b - c
        case "*":
            return products(left, right)
        case "/":
            low, high = products(left, (1.0 / d, 1.0 / c))
            holds_zero = (c <= 0.0) & (d >= 0.0)
            return np.where(holds_zero, -np.inf, low), np.where(holds_zero, np.inf, high)
        case "**":
            return _power(left, right)
    # a comparison surely holds where it does at the end of each interval that is worst for it, and may where it does at the best
    worst, best = ((b, c), (a, d)) if symbol in ("<", "<=") else ((a, d), (b, c))
    if symbol in ("and", "or"):
        worst, best = (a, c), (b, d)
    return OPERATORS[symbol](*worst).astype(float), OPERATORS[symbol](*best).astype(float)


def products(left: Interval, right: Interval) -> Interval:
    """Of zero and infinity zero: the bounds of what is multiplied are finite inside."""
    of_left, of_right = (each[:1] if each[0] is each[1] else each for each in (left, right))  # of a number once
    return hull(*(np.where((x == 0.0) | (y == 0.0), 0.0, x * y) for x in of_left for y in of_right))


def _power(base: Interval, exponent: Interval) -> Interval:
    (a, b), (c, d) = base, exponent
    low, high = hull(*(np.power(x, y) for x in base for y in exponent))
    whole = (c == d) & (c == np.round(c))
    even = whole & (np.mod(c, 2.0) == 0.0) & (a < 0.0) & (b > 0.0)
    low = np.where(even & (c > 0.0), 0.0, low)
    unbounded = (a <= 0.0) & ~(whole & (c >= 0.0)) & ~((a == 0.0) & (c >= 0.0))
    unbounded &= ~(whole & (b < 0.0))
    return np.where(unbounded, -np.inf, low), np.where(unbounded, np.inf, high)


def sine(x: Interval) -> Interval:
    (low, high), turn = x, 2.0 * np.pi
    least, largest = hull(np.sin(low), np.sin(high))
    tops = np.ceil((low - 0.25 * turn) / turn) * turn + 0.25 * turn <= high
    bottoms = np.ceil((low + 0.25 * turn) / turn) * turn - 0.25 * turn <= high
    everywhere = ~(high - low < turn)  # also of infinite intervals
    return np.where(bottoms | everywhere, -1.0, least), np.where(tops | everywhere, 1.0, largest)


def cosine(x: Interval) -> Interval:
    return sine((x[0] + 0.5 * np.pi, x[1] + 0.5 * np.pi))


def tangent(x: Interval) -> Interval:
    low, high = x
    pole = np.floor(low / np.pi + 0.5) != np.floor(high / np.pi + 0.5)
    return np.where(pole, -np.inf, np.tan(low)), np.where(pole, np.inf, np.tan(high))


def arc_cosine(x: Interval) -> Interval:
    return np.arccos(np.clip(x[1], -1.0, 1.0)), np.arccos(np.clip(x[0], -1.0, 1.0))


def polar_angle(y: Interval, x: Interval) -> Interval:
    low, high = hull(*(np.arctan2(each, other) for each in y for other in x))
    right = x[0] > 0.0
    return np.where(right, low, -np.pi), np.where(right, high, np.pi)


def absolute(x: Interval) -> Interval:
    low, high = x
    least, largest = hull(np.abs(low), np.abs(high))
    return np.where((low < 0.0) & (high > 0.0), 0.0, least), largest


def choice(condition: Interval, yes: Interval, no: Interval) -> Interval:
    least, largest = hull(yes[0], no[0])[0], hull(yes[1], no[1])[1]
    surely, never = condition[0] > 0.0, condition[1] <= 0.0
    return (
        np.where(surely, yes[0], np.where(never, no[0], least)),
        np.where(surely, yes[1], np.where(never, no[1], largest)),
    )
