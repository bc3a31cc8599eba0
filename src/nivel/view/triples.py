"""Three numbers as the page takes them."""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.view.records import Triple


def triple(values: Any) -> Triple:
    """Three numbers that JSON can hold: what is not finite becomes 0."""
    x, y, z = (float(value) if np.isfinite(value) else 0.0 for value in values)
    return x, y, z
