"""A logarithmic axis of a drawing: where values stand on it, and its ticks."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

LABELS = 8  # at most about so many along an axis
FEW_DECADES = 2.2  # an axis this short is labelled at 2 and 5 too
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Tick:
    """A line of the grid at `value`, with its label or none."""

    value: float
    label: str


@dataclass(frozen=True)
class LogAxis:
    """Values from `low` to `high` (positive) on pixels from `start` to `end`."""

    low: float
    high: float
    start: float
    end: float

    @classmethod
    def around(cls, values: Sequence[float], start: float, end: float, room: float = 0.12) -> LogAxis:
        """An axis with `room` decades beyond the positive `values`, at least one decade long."""
        low, high = math.log10(min(values)) - room, math.log10(max(values)) + room
        spare = max(0.0, 1.0 - (high - low)) / 2.0
        return cls(10.0 ** (low - spare), 10.0 ** (high + spare), start, end)

    def at(self, value: float) -> float:
        """Pixel of `value`; what is beyond an end stands there."""
        share = math.log10(max(value, 1e-300) / self.low) / math.log10(self.high / self.low)
        return self.start + min(max(share, 0.0), 1.0) * (self.end - self.start)

    def ticks(self, label: Callable[[float], str]) -> list[Tick]:
        """Decades, with 2 and 5 between them where there are few."""
        low, high = math.log10(self.low), math.log10(self.high)
        few = high - low < FEW_DECADES
        every = max(1, math.ceil((high - low) / LABELS))
        out = []
        for decade in range(math.floor(low), math.ceil(high) + 1):
            for factor in (1, 2, 5) if few else (1,):
                value = factor * 10.0**decade
                if self.low <= value <= self.high:
                    out.append(Tick(value, label(value) if few or decade % every == 0 else ""))
        return out


def power_of_ten(value: float) -> str:
    """``10⁻⁶``, ``2·10⁻⁶``."""
    exponent = math.floor(math.log10(value) + 1e-9)
    factor = round(value / 10.0**exponent)
    if exponent == 0:
        return str(factor)
    power = f"10{str(exponent).translate(SUPERSCRIPTS)}"
    return power if factor == 1 else f"{factor}·{power}"
