"""Reading aids of the picture: the global axes and a scale, in corners that are free."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from nivel.report.drawing import WIDTH, Frame

Array = NDArray[np.float64]

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
    pixels = length * frame.scale
    if middle[0] < 0.5 * WIDTH:
        left = 14.0
        text = f'<text class="aid" style="text-anchor:start" x="{left + pixels + 6:.1f}" y="{middle[1] + 21:.1f}">'
    else:
        left = WIDTH - 14.0 - pixels
        text = f'<text class="aid" style="text-anchor:end" x="{left - 6:.1f}" y="{middle[1] + 21:.1f}">'
    y = middle[1] + 20.0
    path = f"M{left:.1f} {y - 4:.1f}V{y:.1f}H{left + pixels:.1f}V{y - 4:.1f}"
    return f'<path class="aid-line" d="{path}"/>{text}{_length(float(length))}</text>'


def _length(metres: float) -> str:
    if metres >= 1000.0:
        return f"{metres / 1000.0:g} km"
    if metres >= 1.0:
        return f"{metres:g} m"
    return f"{metres * 1e3:g} mm" if metres >= 1e-3 else f"{metres * 1e6:g} µm"


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
