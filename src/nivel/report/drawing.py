"""Drawing of a machine in pixels: parts, the frame from metres to pixels, shading, and names where they hide nothing."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct, field
from nivel.looks.viewpoint import View
from nivel.machine.core.vectors import Array

Box = tuple[float, float, float, float]  # left, top, right, bottom in pixels

FONT = 13.0  # pixels
LETTER = 0.58  # width of a letter over its height, on average
NEAR = 9.0  # pixels from a sign within which a name disturbs it
SAMPLES = 25  # of a line
CROWDED = 3.0  # cost above which a name is left out: it would hide more than it says
MANY = 40  # names; then only those that find room close by are shown
CLOSE_BY = 0.5
TRIED = 100  # names; of more, so many evenly taken
DISTANCES = (15.0, 25.0, 38.0, 56.0)  # pixels from the point to the label
LEADING = (78.0, 104.0)  # and further ones, where a line leads from the point to the label
WITHOUT_LINE = "body"  # kind of labels that have none
APART = 14.0  # pixels between two labels from which on they do not crowd each other
CLOSE = 1.2  # cost of a label that touches another
ANGLES = np.deg2rad([-40.0, 40.0, -140.0, 140.0, 0.0, 180.0, -90.0, 90.0, -65.0, 65.0, -115.0, 115.0])


class Label(Struct):
    """A name at its point; `kind` is its class in the picture."""

    text: str
    x: float
    y: float
    kind: str


class Placed(Struct):
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
    around = _Surroundings(points, lines)
    for label in labels[:: -(-len(labels) // TRIED) or 1]:
        near = around.of(label)
        inside = [
            (box, far)
            for box, far in _candidates(label)
            if box[0] >= 2.0 and box[1] >= 2.0 and box[2] <= width - 2.0 and box[3] <= height - 2.0
        ]
        found = [(_cost(box, far, placed, near), box) for box, far in inside]
        cost, box = min(found, key=lambda each: each[0], default=(np.inf, (0.0, 0.0, 0.0, 0.0)))
        if cost < limit:
            placed.append(Placed(label, box))
    return placed


class _Surroundings:
    """Signs, and samples along lines, of which a label meets only those nearby."""

    def __init__(self, points: Array, lines: Array) -> None:
        along = np.linspace(0.0, 1.0, SAMPLES)[None, :, None]
        lines = np.reshape(lines, (-1, 2, 2))
        self.points = np.reshape(points, (-1, 2))
        self.samples = (lines[:, :1] + along * (lines[:, 1:] - lines[:, :1])).reshape(-1, 2)
        self.line = np.repeat(np.arange(len(lines)), SAMPLES)

    def of(self, label: Label) -> tuple[Array, Array, NDArray[np.int64]]:
        """Points, samples and the lines of these that any place of the label may touch."""
        reach = np.array([text_width(label.text), 1.15 * FONT]) + LEADING[-1] + NEAR
        place = np.array([label.x, label.y])
        near, beside = (np.all(np.abs(each - place) <= reach, axis=1) for each in (self.points, self.samples))
        return self.points[near], self.samples[beside], self.line[beside]


def text_width(text: str) -> float:
    """Estimated width of a text in pixels."""
    return FONT * LETTER * len(text)


def _candidates(label: Label) -> list[tuple[Box, float]]:
    """Boxes around the point, and how far each is off."""
    wide, high = text_width(label.text), FONT * 1.15
    out = []
    for k, distance in enumerate(DISTANCES if label.kind == WITHOUT_LINE else DISTANCES + LEADING):
        for angle in ANGLES:
            dx, dy = np.cos(angle), np.sin(angle)
            x = label.x + distance * dx + 0.5 * wide * _eased(dx)
            y = label.y + distance * dy + 0.5 * high * _eased(dy)
            out.append(((x - 0.5 * wide, y - 0.5 * high, x + 0.5 * wide, y + 0.5 * high), 0.3 * k + 0.02 * abs(dy)))
    return out


def _eased(direction: float) -> float:
    """How much of half its size a box moves away from the point in this direction."""
    return float(np.clip(1.4 * direction, -1.0, 1.0))


def _cost(box: Box, far: float, placed: list[Placed], near: tuple[Array, Array, NDArray[np.int64]]) -> float:
    (left, top, right, bottom), (points, samples, line), cost = box, near, far
    for other in placed:
        a = other.box
        if left < a[2] + 3.0 and right > a[0] - 3.0 and top < a[3] + 1.0 and bottom > a[1] - 1.0:
            cost += 10.0
        else:
            gap = max(left - a[2], a[0] - right, top - a[3], a[1] - bottom)
            cost += CLOSE * max(1.0 - gap / APART, 0.0)
    if len(points):
        dx = np.maximum(np.maximum(left - points[:, 0], points[:, 0] - right), 0.0)
        dy = np.maximum(np.maximum(top - points[:, 1], points[:, 1] - bottom), 0.0)
        cost += 1.5 * float(np.clip(1.0 - np.hypot(dx, dy) / NEAR, 0.0, 1.0).sum())
    if len(samples):
        x, y = samples[:, 0], samples[:, 1]
        inside = (x > left) & (x < right) & (y > top) & (y < bottom)
        cost += 0.6 * len(np.unique(line[inside]))
    return cost


class Drawing(Struct, frozen=False):
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


class Frame(Struct):
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


ENOUGH = 70.0  # pixels from the middle of a corner to the next thing drawn: nobody needs more
LEAST_TRIAD, LEAST_BAR = 40.0, 14.0  # pixels that they need at least
BAR_WIDTH = 150.0  # with its text, at most
ROOM_BELOW = 36.0


def aid_places(drawn: Array, frame: Frame) -> tuple[Frame, Array, Array]:
    """The frame, and the middles of two corners for the axes and for the scale: the emptiest ones, bottom right and bottom left
    where these will do. Where no two are empty, the frame gets room below.

    drawn : (n, 2) pixels where something is.
    """
    left, right, top, bottom = 60.0, WIDTH - 40.0, 34.0, frame.height - 32.0
    corners = [np.array(each) for each in ((right, bottom), (left, bottom), (right, top), (left, top))]
    triad = max(corners, key=lambda corner: _free(corner[None], drawn))  # the first of equals
    rest = [corner for corner in (corners[1], corners[0], corners[3], corners[2]) if corner is not triad]
    bar = max(rest, key=lambda corner: _free(bar_strip(corner), drawn))
    if _free(triad[None], drawn) >= LEAST_TRIAD and _free(bar_strip(bar), drawn) >= LEAST_BAR:
        return frame, triad, bar
    below = np.array([0.0, ROOM_BELOW])
    return replace(frame, height=frame.height + ROOM_BELOW), corners[0] + below, corners[1] + below


def _free(places: Array, drawn: Array) -> float:
    """Pixels from any of `places` (k, 2) to the next thing drawn."""
    distances = np.linalg.norm(drawn[:, None] - places, axis=-1)
    return min(float(distances.min(initial=np.inf)), ENOUGH)


def bar_strip(middle: Array) -> Array:
    """(k, 2) pixels along the scale and its text in a corner."""
    first = 14.0 if middle[0] < 0.5 * WIDTH else WIDTH - 14.0 - BAR_WIDTH
    x = np.linspace(first, first + BAR_WIDTH, 12)
    return np.column_stack([x, np.full(len(x), middle[1] + 18.0)])


def scale_bar(frame: Frame, middle: Array) -> str:
    """A bar of a round length."""
    metres = 90.0 / frame.scale
    power = 10.0 ** np.floor(np.log10(metres))
    length = max(step * power for step in (1.0, 2.0, 5.0) if step * power <= metres)
    pixels, on_left, y = length * frame.scale, middle[0] < 0.5 * WIDTH, middle[1] + 20.0
    left = 14.0 if on_left else WIDTH - 14.0 - pixels
    anchor, x = ("start", left + pixels + 6) if on_left else ("end", left - 6)
    path = f"M{left:.1f} {y - 4:.1f}V{y:.1f}H{left + pixels:.1f}V{y - 4:.1f}"
    units = ((1e3, "km"), (1.0, "m"), (1e-3, "mm"), (0.0, "µm"))
    unit = next(word for least, word in units if length >= least)
    shown = f"{float(length) * {'km': 1e-3, 'm': 1.0, 'mm': 1e3, 'µm': 1e6}[unit]:g} {unit}"
    text = f'<text class="aid" style="text-anchor:{anchor}" x="{x:.1f}" y="{y + 1:.1f}">{shown}</text>'
    return f'<path class="aid-line" d="{path}"/>{text}'


def triad_sign(frame: Frame, middle: Array) -> str:
    """The global axes; one seen end-on is left out."""
    origin = middle + np.array([-4.0, 4.0])
    out = []
    for name, axis in zip("XYZ", np.eye(3), strict=True):
        direction = frame.view.on_screen(axis) * [1.0, -1.0]
        if np.linalg.norm(direction) < 0.2:
            continue
        tip, mark = origin + 22.0 * direction, origin + (22.0 + 9.0 / np.linalg.norm(direction)) * direction
        out.append(f'<path class="aid-line" d="M{origin[0]:.1f} {origin[1]:.1f}L{tip[0]:.1f} {tip[1]:.1f}"/>')
        out.append(f'<text class="aid" x="{mark[0]:.1f}" y="{mark[1] + 4:.1f}">{name}</text>')
    return "".join(out)
