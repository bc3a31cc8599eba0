"""Put names beside what they name, where they hide nothing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Box = tuple[float, float, float, float]  # left, top, right, bottom in pixels

FONT = 13.0  # pixels
LETTER = 0.58  # width of a letter over its height, on average
CROWDED = 3.0  # cost above which a name is left out: it would hide more than it says
MANY = 40  # names; then only those that find room close by are shown
CLOSE_BY = 0.5
DISTANCES = (15.0, 25.0, 38.0, 56.0)  # pixels from the point to the label
ANGLES = np.deg2rad([-40.0, 40.0, -140.0, 140.0, 0.0, 180.0, -90.0, 90.0, -65.0, 65.0, -115.0, 115.0])


@dataclass(frozen=True)
class Label:
    """A name at its point; `kind` is its class in the picture."""

    text: str
    x: float
    y: float
    kind: str


@dataclass(frozen=True)
class Placed:
    """A label in its place: the box of its text."""

    label: Label
    box: Box

    @property
    def centre(self) -> tuple[float, float]:
        return 0.5 * (self.box[0] + self.box[2]), 0.5 * (self.box[1] + self.box[3])


def place(labels: list[Label], points: Array, lines: Array, width: float, height: float) -> list[Placed]:
    """Place labels one after the other, each where it costs least; those that cannot be placed are left out.

    points : (n, 2) signs to keep free. lines : (k, 2, 2) lines better not crossed. All in pixels.
    """
    placed: list[Placed] = []
    limit = CROWDED if len(labels) <= MANY else CLOSE_BY
    for label in labels:
        found = [(_cost(label, box, far, placed, points, lines, width, height), box) for box, far in _candidates(label)]
        cost, box = min(found, key=lambda each: each[0])
        if cost < limit:
            placed.append(Placed(label, box))
    return placed


def text_width(text: str) -> float:
    """Estimated width of a text in pixels."""
    return FONT * LETTER * len(text)


def _candidates(label: Label) -> list[tuple[Box, float]]:
    """Boxes around the point, and how far each is off."""
    wide, high = text_width(label.text), FONT * 1.15
    out = []
    for k, distance in enumerate(DISTANCES):
        for angle in ANGLES:
            dx, dy = np.cos(angle), np.sin(angle)
            x = label.x + distance * dx + 0.5 * wide * _eased(dx)
            y = label.y + distance * dy + 0.5 * high * _eased(dy)
            out.append(((x - 0.5 * wide, y - 0.5 * high, x + 0.5 * wide, y + 0.5 * high), 0.3 * k + 0.02 * abs(dy)))
    return out


def _eased(direction: float) -> float:
    """How much of half its size a box moves away from the point in this direction."""
    return float(np.clip(1.4 * direction, -1.0, 1.0))


def _cost(
    label: Label, box: Box, far: float, placed: list[Placed], points: Array, lines: Array, width: float, height: float
) -> float:
    left, top, right, bottom = box
    if left < 2.0 or top < 2.0 or right > width - 2.0 or bottom > height - 2.0:
        return np.inf
    cost = far
    for other in placed:
        a = other.box
        if left < a[2] + 3.0 and right > a[0] - 3.0 and top < a[3] + 1.0 and bottom > a[1] - 1.0:
            cost += 10.0
    if len(points):
        dx = np.maximum(np.maximum(left - points[:, 0], points[:, 0] - right), 0.0)
        dy = np.maximum(np.maximum(top - points[:, 1], points[:, 1] - bottom), 0.0)
        cost += 1.5 * float(np.clip(1.0 - np.hypot(dx, dy) / 9.0, 0.0, 1.0).sum())
    if len(lines):
        along = np.linspace(0.0, 1.0, 25)[None, :, None]
        samples = lines[:, :1] + along * (lines[:, 1:] - lines[:, :1])
        inside = (
            (samples[..., 0] > left) & (samples[..., 0] < right) & (samples[..., 1] > top) & (samples[..., 1] < bottom)
        )
        cost += 0.6 * float(inside.any(axis=1).sum())
    return cost
