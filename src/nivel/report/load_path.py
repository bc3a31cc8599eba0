"""Load–displacement diagrams of a statics result as SVG, and its vibrations as a table."""

from html import escape

import numpy as np
from numpy.typing import NDArray

from nivel.known import Result
from nivel.report.panel import Array
from nivel.report.plots import Axis

WIDTH, HEIGHT = 420.0, 300.0
LEFT, RIGHT, TOP, BOTTOM = 64.0, 16.0, 28.0, 44.0
DIAGRAMS = 3
# Less motion than this share of the machine's size, or of a radian, is none.
STILL = 1e-9
FEW = 2  # states from which on there is a path
ROWS = 20  # vibrations in the table


def load_paths(result: Result) -> list[str]:
    """A diagram for each of the few joint coordinates, or components of positions, that move most; none for a single state."""
    if not result.is_statics or len(result.time) < FEW:
        return []
    return [_diagram(result, *each) for each in _moving(result)[:DIAGRAMS]]


def _moving(result: Result) -> list[tuple[str, str, Array]]:
    """(name, unit, values) of what moves, most first: of joint coordinates, where there are none of positions."""
    size, found = result.trust.size, []
    if "joint_coordinate" in result.variables:
        names = result.coordinates[result.variables["joint_coordinate"].dims[1]]
        for name, values in zip(names, result.array("joint_coordinate").T, strict=True):
            unit = result.units(name)
            found.append((name, unit, values, 1.0 if unit == "rad" else size))
    if "position" in result.variables:
        position = result.array("position")
        found += [
            (f"{body}.position.{axis}", "m", position[:, b, k], size)
            for b, body in enumerate(result.coordinates["body"])
            for k, axis in enumerate("xyz")
        ]
    spans = [float(np.ptp(values)) / scale for _, _, values, scale in found]
    order = [k for k in np.argsort(np.negative(spans), kind="stable") if spans[k] > STILL]
    chosen, seen = [], set()
    for k in order:  # one of a joint or body
        owner = found[k][0].split(".")[0]
        if owner not in seen:
            seen.add(owner)
            chosen.append(found[k][:3])
    return chosen


def _diagram(result: Result, name: str, unit: str, x: Array) -> str:
    """Time over x; stable and unstable stretches, and critical points."""
    t, unstable = result.time, result.array("unstable_directions") > 0
    horizontal, vertical = _ticks(x), _ticks(t)
    across = Axis(horizontal[0], horizontal[-1], LEFT, WIDTH - RIGHT)
    up = Axis(vertical[0], vertical[-1], HEIGHT - BOTTOM, TOP)
    parts = [_grid(across, up, horizontal, vertical)]
    for dashed, first, last in _stretches(unstable):
        points = " ".join(f"{across.at(x[k]):.1f},{up.at(t[k]):.1f}" for k in range(first, last + 1))
        parts.append(f'<polyline class="{"unstable" if dashed else "stable"}" points="{points}"/>')
    parts += [_mark(across, up, kind, x, t, result.abscissa, at) for kind, at in result.marks]
    bottom = HEIGHT - 6
    parts.append(f'<text class="axis" x="{(LEFT + WIDTH - RIGHT) / 2}" y="{bottom}">{escape(name)} [{unit}]</text>')
    parts.append(f'<text class="axis" x="{LEFT - 30}" y="{TOP - 12}" style="text-anchor:start">t [s]</text>')
    label = escape(f"time over {name}")
    return f'<svg class="load-path" viewBox="0 0 {WIDTH:.0f} {HEIGHT:.0f}" role="img" aria-label="{label}">{"".join(parts)}</svg>'


def _ticks(values: Array) -> Array:
    """Round numbers around all values, about six."""
    low, high = float(np.min(values)), float(np.max(values))
    span = high - low if high > low else abs(high) or 1.0
    rough = span / 5.0
    unit = 10.0 ** np.floor(np.log10(rough))
    step = next(unit * factor for factor in (1.0, 2.0, 2.5, 5.0, 10.0) if unit * factor >= rough * (1 - 1e-9))
    first, last = np.floor(low / step + 1e-9), np.ceil(high / step - 1e-9)
    return step * np.arange(first, max(last, first + 1) + 1)


def _grid(across: Axis, up: Axis, horizontal: Array, vertical: Array) -> str:
    lines = []
    for value in horizontal:
        x = across.at(value)
        lines.append(f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}"/>')
        lines.append(f'<text class="tick" x="{x:.1f}" y="{HEIGHT - BOTTOM + 15}">{_short(value)}</text>')
    for value in vertical:
        y, anchor = up.at(value), 'style="text-anchor:end"'
        lines.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>')
        lines.append(f'<text class="tick" x="{LEFT - 6}" y="{y + 4:.1f}" {anchor}>{_short(value)}</text>')
    return "".join(lines)


def _short(value: float) -> str:
    return f"{value:.4g}".replace("e-0", "e-").replace("e+0", "e") if abs(value) > 1e-14 else "0"


def _stretches(unstable: NDArray[np.bool_]) -> list[tuple[bool, int, int]]:
    """(unstable, first, last) of the stretches of states of one kind; a line between two kinds is dashed."""
    between = unstable[:-1] | unstable[1:]
    edges = np.flatnonzero(np.diff(between.astype(int))) + 1
    starts, ends = np.append(0, edges), np.append(edges, len(between))
    return [(bool(between[a]), int(a), int(b)) for a, b in zip(starts, ends, strict=True)]


def _mark(across: Axis, up: Axis, kind: str, x: Array, t: Array, along: Array, at: float) -> str:
    px, py = across.at(float(np.interp(at, along, x))), up.at(float(np.interp(at, along, t)))
    title = f"<title>{kind}</title>"
    if kind == "limit point":
        return f'<circle class="critical" cx="{px:.1f}" cy="{py:.1f}" r="5">{title}</circle>'
    return f'<rect class="critical" x="{px - 4.5:.1f}" y="{py - 4.5:.1f}" width="9" height="9">{title}</rect>'


def vibration_table(result: Result) -> list[tuple[str, str, str]]:
    """(number, frequency about the last state, about the first) in words, of each vibration."""
    if "vibration_stiffness" not in result.variables or not len(result.time):
        return []
    squares = result.array("vibration_stiffness")
    known = [k for k in range(squares.shape[1]) if np.isfinite(squares[-1, k])][:ROWS]
    return [(str(k + 1), _frequency(squares[-1, k]), _frequency(squares[0, k])) for k in known]


def _frequency(square: float) -> str:
    if not np.isfinite(square):
        return "–"
    if square < 0.0:
        return f"unstable, grows by e in {1.0 / np.sqrt(-square):.4g} s"
    return f"{np.sqrt(square) / (2.0 * np.pi):.6g} Hz"
