"""Drawing of a machine: its parts, and the places of its points in space."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

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
