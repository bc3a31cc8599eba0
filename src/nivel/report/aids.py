"""What helps to read the picture: the global axes and a scale, in corners that are free."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.report.frame import WIDTH, Frame

Array = NDArray[np.float64]

ENOUGH = 70.0  # pixels from the middle of a corner to the next thing drawn: nobody needs more


def free_corners(points: Array, lines: Array, frame: Frame) -> tuple[Array, Array]:
    """Middles of the two emptiest corners, for the axes and for the scale; bottom right and bottom left where these will do."""
    left, right, top, bottom = 60.0, WIDTH - 40.0, 34.0, frame.height - 32.0
    along = np.linspace(0.0, 1.0, 40)[None, :, None]
    drawn = np.concatenate([points, (lines[:, :1] + along * (lines[:, 1:] - lines[:, :1])).reshape(-1, 2)])

    def free(corner: Array) -> float:
        return min(float(np.linalg.norm(drawn - corner, axis=1).min(initial=np.inf)), ENOUGH)

    corners = [np.array(each) for each in ((right, bottom), (left, bottom), (right, top), (left, top))]
    triad = max(corners, key=free)  # the first of equals
    rest = [corner for corner in (corners[1], corners[0], corners[3], corners[2]) if corner is not triad]
    return triad, max(rest, key=free)


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
