"""Pressures of circuits in a frame of a result, as diagrams show them."""

from __future__ import annotations

import numpy as np

from nivel.results.scales import Readable


def pressures_at(result: Readable, frame: int) -> dict[str, float]:
    """Pressures of circuits [Pa] in one frame, by the name of the variable."""
    names = [name for name in result.variables if name.startswith("hydraulics.") and ".pressure" in name]
    return {name: float(np.asarray(result.array(name), dtype=float).ravel()[frame]) for name in names}
