"""Section resultants of beams."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Felt:
    """What a beam feels at times t and points p: the Gauss points of its elements, or where its segments meet.

    share : (p,) of the length. weight : (p,) [m]. strain : (t, p, 6) Γ [1] and Κ [1/m], axes of the section, beyond those of the unstressed
    beam. stress : (t, p, 6) force [N] and moment [N m] that go with it. energy : (t,) [J] stored.
    """

    share: Array
    weight: Array
    strain: Array
    stress: Array
    energy: Array
