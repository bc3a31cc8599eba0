"""Intervals of time as ratios of whole numbers, so that the n-th multiple of one is the decimal number that a user writes for it."""

from __future__ import annotations

from fractions import Fraction
from math import gcd

# Denominators up to here are tried: nanoseconds, and thirds, sevenths, nineteenths of microseconds.
MOST = 10**9
# A ratio this close to an interval is that interval: some units in its last place.
SAME = 1e-15


def ratio_of(interval: float) -> Fraction:
    """The simplest ratio of whole numbers that is `interval` [s], except for its round-off.

    With it n · numerator / denominator is rounded once: 3 samples of 0.3 s are 0.9 s, where 3 * 0.3 is a unit in the last place less.
    An interval that is no such ratio stays what it is.
    """
    ratio = Fraction(interval).limit_denominator(MOST)
    return ratio if abs(ratio - Fraction(interval)) <= SAME * abs(interval) else Fraction(interval)


def ticks(offset: float, interval: float) -> tuple[float, float, float]:
    """First, step and rate with (first + n step) / rate = offset + n interval [s], all whole where both times are such ratios."""
    begin, step = ratio_of(offset), ratio_of(interval)
    rate = begin.denominator * step.denominator
    first, each = begin * rate, step * rate
    if max(first, each, rate) > 2**53:
        return offset, interval, 1.0
    common = gcd(first.numerator, each.numerator, rate)
    return float(first / common), float(each / common), float(rate / common)
