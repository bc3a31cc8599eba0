"""Deflections in a page: lines of bent beams at some times with the paths of their named stations; load–displacement diagrams of a statics
result, and its vibrations as a table."""

import json
from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.known import Result
from nivel.looks.solids import colour_of
from nivel.looks.viewpoint import body_poses, choose_view, sliding_axes, turning_axes, upwards
from nivel.report.drawing import WIDTH, Frame, Label, aid_places, bar_strip, fit, place, scale_bar, triad_sign
from nivel.report.panel import Array
from nivel.report.plots import Axis
from nivel.results.scales import Readable

Numbers = NDArray[np.intp]
SHAPES = 11  # of each beam
PATH = 400  # points of a path, at most
FAINT = 0.22  # opacity of the first shape; the last one has all
STYLE: Final = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")


def beam_shapes(result: Result) -> str:
    """SVG text of the shapes; empty for a result without beams, or without motion."""
    nodes = beam_nodes(result)
    if not nodes or "position" not in result.variables:
        return ""
    position = result.array("position")
    known = np.flatnonzero(np.isfinite(position).all(axis=(1, 2)))
    if len(known) < 2:
        return ""
    at = known[_evenly(result.time[known])]
    paths = known[np.unique(np.linspace(0, len(known) - 1, PATH).astype(int))]
    bodies = result.coordinates["body"]
    ends = [bodies.index(name) for beam in nodes for name in stations(result, beam)]
    shown = np.concatenate([position[at][:, own].reshape(-1, 3) for own in nodes.values()])
    frame = _frame(result, np.concatenate([shown, position[paths][:, ends].reshape(-1, 3)]), int(at[0]))
    lines = {name: frame.pixels(position[at][:, own]) for name, own in nodes.items()}
    tracks = [frame.pixels(position[paths, end]) for end in ends]
    colours = [colour_of(int(own[0])) for own in nodes.values()]  # as in the picture of the machine
    return _svg(frame, lines, colours, tracks, result.time[at])


def _evenly(times: Array) -> Numbers:
    """Numbers of frames evenly over the time, or where that goes back, as along a path of equilibria, over the frames."""
    count = len(times)
    if np.any(np.diff(times) <= 0.0):
        return np.unique(np.linspace(0, count - 1, SHAPES).astype(int))
    # a frame at this time is not missed
    wanted = np.linspace(times[0], times[-1], SHAPES) - 1e-9 * (times[-1] - times[0])
    return np.unique(np.searchsorted(times, wanted).clip(max=count - 1))


def _frame(result: Result, cloud: Array, first: int) -> Frame:
    """Seen as the machine is in its picture, but fitting all shapes."""
    here = slice(first, first + 1)
    poses = body_poses(result.scene, result.array("position", here)[0], result.array("orientation", here)[0])
    gravity = json.loads(str(result.attributes.get("machine_record", "{}"))).get("gravity")
    view = choose_view(cloud, turning_axes(result.scene, poses), sliding_axes(result.scene, poses), upwards(gravity))
    return fit(view, cloud, cloud)


def _svg(frame: Frame, lines: dict[str, Array], colours: list[str], tracks: list[Array], times: Array) -> str:
    drawn = np.concatenate([each.reshape(-1, 2) for each in (*lines.values(), *tracks)])
    frame, triad, bar = aid_places(drawn, frame)
    parts = [f'<path class="path" d="{_path(track)}"/>' for track in tracks if np.ptp(track, axis=0).max() > 1.0]
    opacity = FAINT + (1.0 - FAINT) * np.linspace(0.0, 1.0, len(times)) ** 1.5
    for k in range(len(times)):
        for colour, (name, shape) in zip(colours, lines.items(), strict=True):
            style = f'stroke="{colour}" stroke-opacity="{opacity[k]:.2f}"'
            title = f"<title>{escape(name)}, {times[k]:.4g} s</title>"
            parts.append(f'<path class="line" {style} d="{_path(shape[k])}">{title}</path>')
    last = list(lines.values())[-1][:, -1]
    labels = [Label(f"{time:.3g} s", float(x), float(y), "aid") for time, (x, y) in zip(times, last, strict=True)]
    placed = place(labels, np.array([*bar_strip(bar), triad]), np.empty((0, 2, 2)), WIDTH, frame.height)
    middles = [(*each.centre, each.label.text) for each in placed]
    texts = [f'<text x="{x:.1f}" y="{y + 4.0:.1f}">{text}</text>' for x, y, text in middles]
    box = f'viewBox="0 0 {WIDTH:.0f} {frame.height:.0f}"'
    aids = triad_sign(frame, triad) + scale_bar(frame, bar)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="shapes" {box} role="img" aria-label="shapes of the beams at {len(times)} times">'
        f"<style>{STYLE}</style>{''.join(parts)}{aids}{''.join(texts)}</svg>"
    )


def _path(points: Iterable[Iterable[float]]) -> str:
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def beam_nodes(result: Readable) -> dict[str, NDArray[np.intp]]:
    """Beam → numbers of its nodes among the bodies of the result, from start to end."""
    record = json.loads(str(result.attributes.get("machine_record", "{}")))
    owner = np.array([name.partition(".")[0] for name in result.coordinates.get("body", ())])
    return {beam["name"]: np.flatnonzero(owner == beam["name"]) for beam in record.get("beams") or ()}


def stations(result: Readable, beam: str) -> list[str]:
    """Names of the bodies of a result that are named places on a beam, among them its ends; nodes between them have numbers."""
    inside = f"{beam}."
    bodies = result.coordinates.get("body", ())
    return [name for name in bodies if name.startswith(inside) and not name.removeprefix(inside).isdecimal()]


CURVE_WIDTH, HEIGHT = 420.0, 300.0
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
    across = Axis(horizontal[0], horizontal[-1], LEFT, CURVE_WIDTH - RIGHT)
    up = Axis(vertical[0], vertical[-1], HEIGHT - BOTTOM, TOP)
    parts = [_grid(across, up, horizontal, vertical)]
    for dashed, first, last in _stretches(unstable):
        points = " ".join(f"{across.at(x[k]):.1f},{up.at(t[k]):.1f}" for k in range(first, last + 1))
        parts.append(f'<polyline class="{"unstable" if dashed else "stable"}" points="{points}"/>')
    parts += [_mark(across, up, kind, x, t, result.abscissa, at) for kind, at in result.marks]
    bottom = HEIGHT - 6
    parts.append(
        f'<text class="axis" x="{(LEFT + CURVE_WIDTH - RIGHT) / 2}" y="{bottom}">{escape(name)} [{unit}]</text>'
    )
    parts.append(f'<text class="axis" x="{LEFT - 30}" y="{TOP - 12}" style="text-anchor:start">t [s]</text>')
    label = escape(f"time over {name}")
    return f'<svg class="load-path" viewBox="0 0 {CURVE_WIDTH:.0f} {HEIGHT:.0f}" role="img" aria-label="{label}">{"".join(parts)}</svg>'


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
        lines.append(f'<line class="grid" x1="{LEFT}" x2="{CURVE_WIDTH - RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>')
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
