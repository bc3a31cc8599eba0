"""The chain that all programs integrate: bars on a hinge at the origin, stretched along X and at rest; hinges about Z, gravity -Y.

Bars are homogeneous boxes; the frame of each is at its centre of mass, x along the bar, and its hinges are at both ends.
"""

from __future__ import annotations

LENGTH, WIDTH, MASS, GRAVITY = 1.0, 0.1, 1.0, 9.81  # m, m, kg, m/s²
ACROSS = MASS * (LENGTH**2 + WIDTH**2) / 12
INERTIA = (MASS * WIDTH**2 / 6, ACROSS, ACROSS)  # kg m², about the centre of mass
STEP = 1e-3  # s
# After so many steps the programs' last bars and energies are compared: long enough to move, too short for chaos.
CHECK_STEPS = 500
WORK = 200_000  # links times steps of a timed run


def timed_steps(links: int) -> int:
    """Steps of a timed run: enough for its start not to count."""
    return max(CHECK_STEPS, WORK // links)
