"""Pictures of belts and chains: a closed line around two pulleys."""

from __future__ import annotations

from html import escape
from typing import Any

import numpy as np

from nivel.looks.belts import belt_line
from nivel.looks.poses import Array, Pose
from nivel.report.drawing import Drawing
from nivel.report.frame import Frame
from nivel.report.labels import Label
from nivel.report.strokes import rope_sign


def belt_points(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(n, 3) [m] global points of all belts."""
    lines = [belt_line(belt, scene["joints"], poses) for belt in scene.get("belts", [])]
    return np.concatenate([np.empty((0, 3)), *lines])


def draw_belt(
    drawing: Drawing, frame: Frame, belt: dict[str, Any], scene: dict[str, Any], poses: dict[str, Pose]
) -> None:
    """Draw a belt with its name at the middle of a strand."""
    line = belt_line(belt, scene["joints"], poses)
    if not len(line):
        return
    line = frame.pixels(line)
    title = f"{belt['name']}: {belt['type']}, {' – '.join(belt['joints'])}"
    drawing.links.append(f"<g><title>{escape(title)}</title>{rope_sign(line)}</g>")
    parts = np.stack([line[:-1], line[1:]], axis=1)
    drawing.lines.extend(parts)
    x, y = parts[np.argmax(np.linalg.norm(parts[:, 1] - parts[:, 0], axis=1))].mean(axis=0)
    drawing.labels.append(Label(belt["name"], float(x), float(y), "force-name"))
