"""Still pictures of the modes of a flexible body."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.body import ReducedBody
from nivel.looks.viewpoint import View, choose_view
from nivel.report.drawing import HEIGHTS, LIGHT, WIDTH, Frame, between, fit

Array = NDArray[np.float64]

AMPLITUDE: Final = 0.12  # of the size of the body: the largest displacement in a picture
MOST_TRIANGLES: Final = 1400
CALM, STRONG = "#4a74a8", "#e0a33a"  # no and the largest displacement
PROBED: Final = 400  # nodes from which the view is chosen


def mode_pictures(body: ReducedBody, count: int) -> list[str]:
    """SVG texts of the first `count` modes, all seen from the same place. Empty where there is nothing to draw."""
    if not len(body.triangles) and not len(body.lines):
        return []
    every = max(1, len(body.position) // PROBED)
    none = np.zeros((0, 3))
    view = choose_view(body.position[::every], none, none)
    triangles = _thinned(body) if len(body.triangles) else body.triangles
    return [_picture(body, k, view, triangles) for k in range(min(count, body.modes.shape[2]))]


def _thinned(body: ReducedBody) -> NDArray[np.int64]:
    """The triangles on fewer nodes: nodes in one cell of a grid become one, until there are few enough."""
    triangles = body.triangles
    x = body.position - body.position.min(axis=0)
    cells = 60.0
    while len(triangles) > MOST_TRIANGLES and cells > 6.0:
        size = np.ptp(body.position, axis=0).max() / cells
        _, first, cell = np.unique(np.floor(x / size).astype(int), axis=0, return_index=True, return_inverse=True)
        merged = first[cell.ravel()][body.triangles]
        whole = (merged[:, 0] != merged[:, 1]) & (merged[:, 1] != merged[:, 2]) & (merged[:, 2] != merged[:, 0])
        triangles = np.unique(merged[whole], axis=0)
        cells *= 0.82
    return triangles


def _picture(body: ReducedBody, mode: int, view: View, triangles: NDArray[np.int64]) -> str:
    moved = np.nan_to_num(body.modes[:, :3, mode])
    turned = np.nan_to_num(body.modes[:, 3:, mode])
    size = float(np.linalg.norm(np.ptp(body.position, axis=0)))
    far = np.linalg.norm(moved, axis=1)
    largest = far.max()
    if largest * size < 1e-6 * np.abs(turned).max() * size**2:  # a beam that twists: shown by colour alone
        far, largest = np.linalg.norm(turned, axis=1), np.linalg.norm(turned, axis=1).max()
        moved = np.zeros_like(moved)
    place = body.position + AMPLITUDE * size / (largest or 1.0) * moved
    share = far / (largest or 1.0)
    frame = fit(view, np.concatenate([place, body.position]), body.position[:: max(1, len(body.position) // PROBED)])
    parts = _lines(frame, body.position, body.lines, None)
    parts += _faces(frame, place, triangles, share) if len(triangles) else _outline(frame, body)
    parts += _lines(frame, place, body.lines, share)
    parts += [_mark(frame, place[each.node]) for each in body.interfaces]
    label = f"mode {mode + 1}, {body.frequencies[mode]:.4g} Hz"
    height = max(frame.height, HEIGHTS[0])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="mode" viewBox="0 0 {WIDTH:.0f} {height:.0f}" role="img" '
        f'aria-label="{label}">{"".join(parts)}</svg>'
    )


def _outline(frame: Frame, body: ReducedBody) -> list[str]:
    """Nodes as dots where a model has neither lines nor surfaces."""
    return [] if len(body.lines) else [_mark(frame, x) for x in body.position]


def _faces(frame: Frame, place: Array, triangles: NDArray[np.int64], share: Array) -> list[str]:
    """Faces that look at the eye, far ones first; colour by displacement, shade by light."""
    corners = place[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    normal = normal / np.maximum(length, 1e-300)[:, None]
    view = frame.view
    seen = np.flatnonzero((normal @ view.towards > 0.0) & (length > 0.0))
    order = seen[np.argsort(view.depth(corners[seen].mean(axis=1)))]
    facing = np.stack([normal @ view.right, normal @ view.up, normal @ view.towards], axis=1) @ LIGHT
    flat = frame.pixels(corners)
    out = []
    for t in order:
        colour = between(CALM, STRONG, float(share[triangles[t]].mean()))
        colour = between("#18212c", colour, float(np.clip(0.62 + 0.5 * facing[t], 0.5, 1.0)))
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in flat[t])
        out.append(f'<path color="{colour}" d="M{path}z"/>')
    return [f'<g class="faces">{"".join(out)}</g>']


def _lines(frame: Frame, place: Array, lines: NDArray[np.int64], share: Array | None) -> list[str]:
    """Beams; with `share` coloured by displacement, else as they lie undeformed."""
    flat = frame.pixels(place)
    out = []
    for i, j in lines:
        colour = "" if share is None else f' color="{between(CALM, STRONG, float(share[[i, j]].mean()))}"'
        out.append(f'<path{colour} d="M{flat[i, 0]:.1f} {flat[i, 1]:.1f}L{flat[j, 0]:.1f} {flat[j, 1]:.1f}"/>')
    kind = "rest" if share is None else "beams"
    return [f'<g class="{kind}">{"".join(out)}</g>'] if out else []


def _mark(frame: Frame, at: Array) -> str:
    x, y = frame.pixels(at[None])[0]
    return f'<circle class="interface" cx="{x:.1f}" cy="{y:.1f}" r="4"/>'
