"""What beams of large motion add to a machine in numbers, beside their nodes, which are bodies, and their elements, which are forces."""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.arrays import F1, F3, U2


class SharedMass(NamedTuple):
    """Mass that nodes of beams have in common; see `nivel.kernels.shared_mass`. Without numbers for lumped masses."""

    pair: U2  # (m, 4) bodies a, b, markers with the axes of their sections
    mass: F1  # (m,) [kg]
    moment: F3  # (m, 3, 3) [kg m²] J_ab, axes of a and of b
    turn: F3  # (m, 3, 3) from axes of a to axes of b, unstressed
