"""Reductions of curves to numbers: extremes, means and integrals of the cubics between frames, each with its doubt."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final, NamedTuple

import numpy as np

from nivel.machine.core.vectors import Array
from nivel.results.curve import Curve, hermite

_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(4)
GAUSS: Final = tuple(zip(0.5 + 0.5 * _PLACES, 0.5 * _WEIGHTS, strict=True))  # exact for products of two cubics
CROSSING: Final = np.linspace(0.0, 1.0, 17)  # places in an interval in which the magnitude of a number has a corner


class Number(NamedTuple):
    """A number of each column of a curve, its doubt in the same units, and the time [s] at which it is an extreme; arrays (m,)."""

    value: Array
    doubt: Array
    time: Array


def largest(of: Curve) -> Number:
    """The largest value, and when. Where a cubic goes beyond its two frames by no more than its doubt, the larger frame counts: polynomials
    swing beside a jump."""
    if len(of.time) < 2:
        value = of.value[0] if len(of.time) else np.full(of.value.shape[1], np.nan)
        return Number(value, np.zeros_like(value), np.full_like(value, of.time[0] if len(of.time) else np.nan))
    h, corners, doubt = of.step, of.corners, of.hidden
    higher = corners[1] > corners[0]
    share, top = np.where(higher, 1.0, 0.0), np.maximum(*corners[:2])
    ends = top
    for root in _turns(h, *corners):
        value = hermite(root, h, *corners)
        beyond = value - ends
        counts = (value > top) & (beyond > of.doubt)
        doubt = np.where((value > top) & ~counts & (doubt > 0.0), np.maximum(doubt, beyond), doubt)
        share, top = np.where(counts, root, share), np.where(counts, value, top)
    known = np.where(np.isfinite(top), top, -np.inf)
    k, column = np.argmax(known, axis=0), np.arange(top.shape[1])
    value = np.where(np.isnan(of.value).any(axis=0), np.nan, top[k, column])
    most = np.max(np.where(np.isfinite(top), top + doubt, -np.inf), axis=0)
    return Number(value, np.where(np.isfinite(value), most - value, 0.0), of.time[k] + share[k, column] * h[k, 0])


def _turns(h: Array, a: Array, b: Array, slope_a: Array, slope_b: Array) -> tuple[Array, Array]:
    """Shares of intervals where cubics turn; 0 where they do not."""
    first = h * slope_a
    second, third = 3.0 * (b - a) - h * (2.0 * slope_a + slope_b), h * (slope_a + slope_b) - 2.0 * (b - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -(second + np.copysign(np.sqrt(second * second - 3.0 * third * first), second))
        roots = q / (3.0 * third), first / q
    before, after = (np.where((each > 0.0) & (each < 1.0), each, 0.0) for each in roots)
    return before, after


def turning_values(of: Curve) -> Array:
    """(k,) values at the frames and where the cubics turn between them, beyond the doubt, of a curve of one column."""
    if len(of.time) < 2:
        return of.value[:, 0]
    h, corners = of.step, of.corners
    roots = np.sort(np.stack(_turns(h, *corners)), axis=0)
    inside = np.stack([hermite(root, h, *corners) for root in roots])
    low, high = np.minimum(*corners[:2]), np.maximum(*corners[:2])
    is_turn = (roots > 0.0) & (np.maximum(inside - high, low - inside) > of.doubt)
    every = np.concatenate([corners[0][None], np.where(is_turn, inside, np.nan)])[:, :, 0].T.ravel()
    every = np.append(every, of.value[-1, 0])
    return every[~np.isnan(every)]


def smallest(of: Curve) -> Number:
    """The smallest value, and when."""
    found = largest(of.negative)
    return found._replace(value=-found.value)


def extreme(of: Curve) -> Number:
    """The value of largest magnitude, with its sign, and when."""
    high, low = largest(of), smallest(of)
    up = high.value >= -low.value
    most = np.maximum(high.value + high.doubt, low.doubt - low.value)
    doubt = most - np.maximum(high.value, -low.value)
    return Number(np.where(up, high.value, low.value), doubt, np.where(up, high.time, low.time))


def peak(of: Curve) -> Number:
    """The largest magnitude, and when."""
    found = extreme(of)
    return found._replace(value=np.abs(found.value))


def integral(of: Curve) -> Number:
    """The integral over time."""
    h, (a, b, slope_a, slope_b) = of.step, of.corners
    return _summed(of, 0.5 * h * (a + b) + h * h * (slope_a - slope_b) / 12.0, h * of.doubt)


def integral_of_product(a: Curve, b: Curve) -> Number:
    """The integral of the product of two curves with the same times."""
    h, total, doubt = a.step, np.zeros_like(a.doubt), np.zeros_like(a.doubt)
    for share, weight in GAUSS:
        first, second = hermite(share, h, *a.corners), hermite(share, h, *b.corners)
        total += weight * h * first * second
        doubt += weight * h * (np.abs(first) * b.doubt + np.abs(second) * a.doubt + a.doubt * b.doubt)
    return _summed(a, total, doubt)


def integral_of_magnitude(of: Curve) -> Number:
    """The integral of the magnitude over time."""
    h, corners = of.step, of.corners
    parts = np.abs(0.5 * h * (corners[0] + corners[1]) + h * h * (corners[2] - corners[3]) / 12.0)
    low, high = smallest_and_largest(of)
    crosses = np.flatnonzero(((low < 0.0) & (high > 0.0)).any(axis=1))
    if len(crosses):
        fine = np.abs([hermite(share, h[crosses], *(each[crosses] for each in corners)) for share in CROSSING])
        parts[crosses] = h[crosses] * np.mean(0.5 * (fine[1:] + fine[:-1]), axis=0)
    return _summed(of, parts, h * of.doubt)


def smallest_and_largest(of: Curve) -> tuple[Array, Array]:
    """Bounds (n - 1, m) of the cubics of all intervals."""
    h, corners = of.step, of.corners
    values = [*corners[:2], *(hermite(root, h, *corners) for root in _turns(h, *corners))]
    return np.min(values, axis=0), np.max(values, axis=0)


def _summed(of: Curve, parts: Array, doubts: Array) -> Number:
    end = np.full(of.value.shape[1], of.time[-1] if len(of.time) else np.nan)
    return Number(parts.sum(axis=0), doubts.sum(axis=0), end)


def mean(of: Curve) -> Number:
    """The integral over the time, as a share of that; of one frame its value."""
    span = _span(of)
    if not span > 0.0:
        return largest(of)
    found = integral(of)
    return found._replace(value=found.value / span, doubt=found.doubt / span)


def rms(of: Curve) -> Number:
    """The root of the mean square."""
    span = _span(of)
    if not span > 0.0:
        return peak(of)
    found = integral_of_product(of, of)
    value = np.sqrt(found.value / span)
    return found._replace(value=value, doubt=np.sqrt((found.value + found.doubt) / span) - value)


def _span(of: Curve) -> float:
    return float(of.time[-1] - of.time[0]) if len(of.time) > 1 else 0.0


REDUCTIONS: Final[Mapping[str, Callable[[Curve], Number]]] = {
    "max": largest,
    "min": smallest,
    "peak": peak,
    "mean": mean,
    "rms": rms,
    "integral": integral,
}
