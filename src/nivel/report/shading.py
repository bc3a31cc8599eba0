"""Shading of colours by light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.looks.viewpoint import View

Array = NDArray[np.float64]

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
