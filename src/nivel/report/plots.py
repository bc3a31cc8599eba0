"""Plots of a page as SVG: curves over a linear or logarithmic axis, and points."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from html import escape
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 560.0, 300.0, 62.0, 14.0, 12.0, 42.0
TONES: Final = 8
MOST: Final = 1200  # points of a curve


class Axis(Struct):
    """Values from `low` to `high` on pixels from `start` to `end`."""

    low: float
    high: float
    start: float
    end: float

    @classmethod
    def around(cls, values: Array, start: float, end: float) -> Axis:
        """An axis with a little room beyond the values."""
        low, high = (float(np.min(values)), float(np.max(values))) if len(values) else (0.0, 1.0)
        size = high - low
        if size <= 1e-9 * max(abs(low), abs(high)):
            size = max(abs(low), 1.0)
            low, high = low - 0.5 * size, high + 0.5 * size
        return cls(low - 0.04 * size, high + 0.04 * size, start, end)

    def at(self, value: float) -> float:
        """Pixel of a value."""
        share = (value - self.low) / (self.high - self.low)
        return self.start + min(max(share, 0.0), 1.0) * (self.end - self.start)

    def ticks(self) -> list[Tick]:
        """Round values, about six."""
        rough = (self.high - self.low) / 6.0
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(each * power for each in (1.0, 2.0, 5.0, 10.0) if each * power >= rough)
        first = math.ceil(self.low / step)
        values = [k * step for k in range(first, math.floor(self.high / step) + 1)]
        return [Tick(value, f"{value:.6g}") for value in values]


class Line(Struct):
    """A curve (n,) with a label; gaps where y is not a number."""

    label: str
    x: Array
    y: Array


def curves(
    lines: Sequence[Line], x_title: str, y_title: str, *, log_x: bool = False, log_y: bool = False, title: str = ""
) -> str:
    """SVG of curves with a legend."""
    known = [np.isfinite(line.x) & np.isfinite(line.y) for line in lines]
    x = np.concatenate([line.x[each] for line, each in zip(lines, known, strict=True)] or [np.zeros(0)])
    y = np.concatenate([line.y[each] for line, each in zip(lines, known, strict=True)] or [np.zeros(0)])
    across = _axis(x, LEFT, WIDTH - RIGHT, log_x)
    up = _axis(y, HEIGHT - BOTTOM, TOP, log_y)
    paths = []
    for k, line in enumerate(lines):
        path = _path(line, across, up, log_y)
        paths.append(
            f'<path d="{path}" fill="none" stroke="var(--tone-{k % TONES})" stroke-width="1.7" stroke-linejoin="round">'
            f"<title>{escape(line.label)}</title></path>"
        )
    return _drawing(across, up, "".join(paths), x_title, y_title, title or y_title) + _legend(lines)


def path_drawing(x: Array, y: Array, x_title: str, y_title: str) -> str:
    """SVG of a path in the plane, with one scale for both axes; its start is marked."""
    wide, high = WIDTH - RIGHT - LEFT, HEIGHT - BOTTOM - TOP
    size = max(float(np.ptp(x)) / wide, float(np.ptp(y)) / high, 1e-12) * 1.1
    middle = 0.5 * (float(x.min()) + float(x.max())), 0.5 * (float(y.min()) + float(y.max()))
    across = Axis(middle[0] - 0.5 * size * wide, middle[0] + 0.5 * size * wide, LEFT, WIDTH - RIGHT)
    up = Axis(middle[1] - 0.5 * size * high, middle[1] + 0.5 * size * high, HEIGHT - BOTTOM, TOP)
    path = _path(Line("", x, y), across, up, log_y=False)
    start = f'<circle cx="{across.at(float(x[0])):.1f}" cy="{up.at(float(y[0])):.1f}" r="3.5" fill="var(--tone-1)"/>'
    drawn = f'<path d="{path}" fill="none" stroke="var(--tone-0)" stroke-width="1.7" stroke-linejoin="round"/>{start}'
    return _drawing(across, up, drawn, x_title, y_title, "path of a point")


def points(x: Array, y: Array, labels: Sequence[str], x_title: str, y_title: str) -> str:
    """SVG of points, each with its label; the axes pass through zero."""
    across = Axis.around(np.append(x, 0.0), LEFT, WIDTH - RIGHT)
    up = Axis.around(np.append(y, 0.0), HEIGHT - BOTTOM, TOP)
    zero = f'<path class="zero" d="M{across.at(0):.1f} {TOP}V{HEIGHT - BOTTOM}M{LEFT} {up.at(0):.1f}H{WIDTH - RIGHT}"/>'
    marks = [
        f'<circle cx="{across.at(a):.1f}" cy="{up.at(b):.1f}" r="4" fill="var(--tone-0)"><title>{escape(label)}</title></circle>'
        for a, b, label in zip(x, y, labels, strict=True)
    ]
    return _drawing(across, up, zero + "".join(marks), x_title, y_title, y_title)


def unit_circle(z: NDArray[np.complex128], labels: Sequence[str]) -> str:
    """SVG of the z-plane: poles, each with its label, and the unit circle inside of which motions decay."""
    size = 1.08 * max(1.0, float(np.max(np.abs(z), initial=0.0)))
    high = HEIGHT - BOTTOM - TOP
    wide = size * (WIDTH - RIGHT - LEFT) / high
    across, up = Axis(-wide, wide, LEFT, WIDTH - RIGHT), Axis(-size, size, HEIGHT - BOTTOM, TOP)
    zero = f'<path class="zero" d="M{across.at(0):.1f} {TOP}V{HEIGHT - BOTTOM}M{LEFT} {up.at(0):.1f}H{WIDTH - RIGHT}"/>'
    place = f'cx="{across.at(0):.1f}" cy="{up.at(0):.1f}" r="{0.5 * high / size:.1f}"'
    circle = f'<circle {place} fill="none" stroke="var(--tone-1)"/>'
    marks = [
        f'<path d="M{across.at(each.real) - 4:.1f} {up.at(each.imag) - 4:.1f}l8 8m0 -8l-8 8" stroke="var(--tone-0)" '
        f'stroke-width="1.7"><title>{escape(label)}</title></path>'
        for each, label in zip(z, labels, strict=True)
    ]
    return _drawing(across, up, zero + circle + "".join(marks), "real part of z", "imaginary part of z", "poles")


def _axis(values: Array, start: float, end: float, log: bool) -> Axis | LogAxis:
    if not log:
        return Axis.around(values, start, end)
    positive = values[values > 0.0]
    return LogAxis.around(positive.tolist() if len(positive) else [0.1, 10.0], start, end, room=0.02)


def _path(line: Line, across: Axis | LogAxis, up: Axis | LogAxis, log_y: bool) -> str:
    every = max(1, len(line.x) // MOST)
    out, pen = [], "M"
    for a, b in zip(line.x[::every], line.y[::every], strict=True):
        if not (np.isfinite(a) and np.isfinite(b)) or (log_y and b <= 0.0):
            pen = "M"
            continue
        out.append(f"{pen}{across.at(float(a)):.1f} {up.at(float(b)):.1f}")
        pen = "L"
    return "".join(out)


def _ticks(axis: Axis | LogAxis) -> list[Tick]:
    return axis.ticks() if isinstance(axis, Axis) else axis.ticks(lambda value: f"{value:g}")


def _drawing(across: Axis | LogAxis, up: Axis | LogAxis, inner: str, x_title: str, y_title: str, title: str) -> str:
    grid = []
    for tick in _ticks(across):
        x = across.at(tick.value)
        grid.append(f'<path class="grid" d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}"/>')
        grid.append(f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 15:.1f}" text-anchor="middle">{tick.label}</text>')
    for tick in _ticks(up):
        y = up.at(tick.value)
        grid.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>')
        grid.append(f'<text x="{LEFT - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{tick.label}</text>')
    middle = 0.5 * (LEFT + WIDTH - RIGHT)
    place = f"translate(12 {0.5 * (TOP + HEIGHT - BOTTOM):.0f}) rotate(-90)"
    titles = (
        f'<text class="axis" x="{middle:.0f}" y="{HEIGHT - 6:.0f}" text-anchor="middle">{escape(x_title)}</text>'
        f'<text class="axis" transform="{place}" text-anchor="middle">{escape(y_title)}</text>'
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="plot" viewBox="0 0 {WIDTH:.0f} {HEIGHT:.0f}" role="img" '
        f'aria-label="{escape(title)}">{"".join(grid)}{titles}{inner}</svg>'
    )


def _legend(lines: Sequence[Line]) -> str:
    if len(lines) < 2:
        return ""
    tones = [f"background:var(--tone-{k % TONES})" for k in range(len(lines))]
    items = [f'<li><i style="{tone}"></i>{escape(line.label)}</li>' for tone, line in zip(tones, lines, strict=True)]
    return f'<ul class="legend">{"".join(items)}</ul>'


LABELS = 8  # at most about so many along an axis
FEW_DECADES = 2.2  # an axis this short is labelled at 2 and 5 too
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Tick(Struct):
    """A line of the grid at `value`, with its label or none."""

    value: float
    label: str


class LogAxis(Struct):
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
