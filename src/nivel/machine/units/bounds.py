"""Arithmetic trees on arrays: their values at many places at once, and bounds of their values over intervals.

Bounds hold for every point of an interval (Moore 1966); they are wide where a symbol comes twice, and become exact as intervals shrink.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import Final

import numpy as np

from nivel.machine.units.functions import FUNCTIONS, FunctionKind
from nivel.machine.units.interpolation import PERIODIC, curve_of
from nivel.machine.units.intervals import Array, Interval, operated, products
from nivel.machine.units.tree import OPERATORS, TIME, Call, Lookup, Negative, Node, Number, Operation, Signal, Time

BLOCK: Final = 4096  # places at once


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
        case Call(function, arguments):
            kind, given = FUNCTIONS[function], [_values(each, known) for each in arguments]
            if kind.array is None:
                return _values(kind.body, dict(zip(kind.names, given, strict=True)))
            return reduce(kind.array, given) if kind.more else kind.array(*given)
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
            return _bounded(*operated(symbol, _bounds(left, known), _bounds(right, known)))
        case Call(function, arguments):
            return _bounds_of_call(FUNCTIONS[function], [_bounds(each, known) for each in arguments])
        case Lookup(argument):
            return _bounds_of_curve(node, *_bounds(argument, known))
    raise ValueError(f"a name is not bound: {node}")


def _operate(symbol: str, left: Array, right: Array) -> Array:
    value = np.power(left, right) if symbol == "**" else OPERATORS[symbol](left, right)
    return np.asarray(value, dtype=float)


def _bounded(low: Array, high: Array) -> Interval:
    """What is no number says nothing."""
    return np.where(np.isnan(low), -np.inf, low), np.where(np.isnan(high), np.inf, high)


def _bounds_of_call(kind: FunctionKind, arguments: list[Interval]) -> Interval:
    if kind.array is None:
        return _bounds(kind.body, dict(zip(kind.names, arguments, strict=True)))
    if kind.bounds is not None:
        return _bounded(*kind.bounds(*arguments))
    ends = [[np.clip(each, *kind.domain) for each in side] for side in zip(*arguments, strict=True)]
    low, high = (reduce(kind.array, end) if kind.more else kind.array(*end) for end in ends)
    return _bounded(low, high)


def _values_of_curve(curve: Lookup, x: Array) -> Array:
    points, coefficients, before, behind = curve_of(curve.kind, curve.points, curve.values, curve.order)
    if curve.kind == PERIODIC:
        x = points[0] + np.mod(x - points[0], points[-1] - points[0])
    inner = np.full_like(x, before)
    if len(coefficients):
        k = np.clip(np.searchsorted(points, x, side="right") - 1, 0, len(coefficients) - 1)
        inner = sum(c * (x - points[k]) ** i for i, c in enumerate(coefficients[k].T))
    return np.where(x < points[0], before, np.where(x >= points[-1], behind, inner))


def _bounds_of_curve(curve: Lookup, low: Array, high: Array) -> Interval:
    """Of what each piece is over the part of the interval that lies in it."""
    points, coefficients, before, behind = curve_of(curve.kind, curve.points, curve.values, curve.order)
    if curve.kind == PERIODIC:  # all that it ever is
        low, high = np.full_like(low, points[0]), np.full_like(high, points[-1])
    least, largest = np.full_like(low, np.inf), np.full_like(high, -np.inf)
    for k, piece in enumerate(coefficients):
        inside = (low <= points[k + 1]) & (high >= points[k])
        part = np.maximum(low, points[k]) - points[k], np.minimum(high, points[k + 1]) - points[k]
        bounds: Interval = (np.zeros_like(low), np.zeros_like(high))
        for c in piece[::-1]:
            lower, upper = products(bounds, part)
            bounds = lower + c, upper + c
        least = np.where(inside, np.minimum(least, bounds[0]), least)
        largest = np.where(inside, np.maximum(largest, bounds[1]), largest)
    for beyond, value in ((low < points[0], before), (high >= points[-1], behind)):
        least = np.where(beyond, np.minimum(least, value), least)
        largest = np.where(beyond, np.maximum(largest, value), largest)
    return least, largest
