"""Basis of the pictures of machines: a drawing of parts, the frame from metres to pixels, and the shading of colours."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from nivel.looks.viewpoint import View
from nivel.report.labels import Label

Array = NDArray[np.float64]


@dataclass
class Drawing:
    """What is drawn, and what names must keep clear of. Pixels.

    parts : (depth, SVG) of bodies, drawn far things first. links : over them. signs : over all.
    points, covered : to keep free. lines : better not crossed.
    """

    parts: list[tuple[float, str]] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    signs: list[str] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    points: list[Array] = field(default_factory=list)
    covered: list[Array] = field(default_factory=list)
    lines: list[Array] = field(default_factory=list)


WIDTH = 560.0  # pixels; names stay readable when a phone shows it at two thirds
HEIGHTS = (260.0, 470.0)
MARGIN = (54.0, 46.0)  # room for names and ground signs
ROOMY = 28.0  # pixels between points from which on signs have their full size


@dataclass(frozen=True)
class Frame:
    """From metres in space to pixels on the picture."""

    view: View
    scale: float
    shift: Array
    height: float
    sign: float  # scale of the signs: smaller where they stand close together

    def pixels(self, points: Array) -> Array:
        """(…, 2) right and down."""
        return self.view.on_screen(points) * [self.scale, -self.scale] + self.shift


def fit(view: View, cloud: Array, skeleton: Array) -> Frame:
    flat = view.on_screen(cloud)
    low, size = flat.min(axis=0), np.ptp(flat, axis=0)
    room = np.array([WIDTH, HEIGHTS[1]]) - 2.0 * np.array(MARGIN)
    scale = float(min(room / np.maximum(size, 1e-12)))
    scale = min(scale, 1e9) if size.max() > 0.0 else 100.0
    height = float(np.clip(scale * size[1] + 2.0 * MARGIN[1], *HEIGHTS))
    middle = low + 0.5 * size
    shift = np.array([0.5 * WIDTH, 0.5 * height - 4.0]) - middle * [scale, -scale]
    apart = scale * _usual_distance(view.on_screen(skeleton))
    return Frame(view, scale, shift, height, float(np.clip(apart / ROOMY, 0.45, 1.0)))


def _usual_distance(flat: Array) -> float:
    """Median distance of points (n, 2) from their nearest neighbour elsewhere; infinite for less than two."""
    flat = np.unique(np.round(flat, 12), axis=0)[:400]
    distances = np.linalg.norm(flat[:, None] - flat[None, :], axis=-1)
    np.fill_diagonal(distances, np.inf)
    return float(np.median(distances.min(axis=1))) if len(flat) > 1 else np.inf


LIGHT = np.array([-0.45, 0.65, 0.61])  # where it comes from: right, up, towards the eye


def shaded(colour: str, normal: Array, view: View) -> str:
    facing = float(np.array([normal @ view.right, normal @ view.up, normal @ view.towards]) @ LIGHT)
    return mixed(colour, 0.34 * max(facing, 0.0), 0.22 * max(0.35 - facing, 0.0))


def mixed(colour: str, white: float, black: float) -> str:
    rgb = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)], dtype=float)
    rgb = (rgb + white * (255.0 - rgb)) * (1.0 - black)
    return "#" + "".join(f"{round(each):02x}" for each in rgb)


def between(first: str, second: str, share: float) -> str:
    a, b = (np.array([int(c[k : k + 2], 16) for k in (1, 3, 5)], dtype=float) for c in (first, second))
    return "#" + "".join(f"{round(each):02x}" for each in a + share * (b - a))
