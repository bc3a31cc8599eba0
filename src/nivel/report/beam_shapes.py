"""Shapes of bent beams: their lines at some times of a run in one picture, with the paths of their named stations."""

import json
from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.known import Result
from nivel.looks.poses import Array, body_poses, sliding_axes, turning_axes, upwards
from nivel.looks.solids import colour_of
from nivel.looks.viewpoint import choose_view
from nivel.report.drawing import WIDTH, Frame, Label, aid_places, bar_strip, fit, place, scale_bar, triad_sign
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
