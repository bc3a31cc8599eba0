"""Two arms on hinges, each moved by a cylinder whose valve stands open by a constant share: the machine that both programs integrate.

Plane x-y, gravity -y, SI units, angles from the x axis. Frames of arms are at their hinges, x along the arm; cylinder 1 from the ground to
arm 1, cylinder 2 from arm 1 to arm 2. Pressures are above that of the air. The oil has a constant bulk modulus.
"""

from __future__ import annotations

import math

GRAVITY = 9.81
LENGTH, MASS = (1.2, 1.0), (90.0, 60.0)
ANGLE = (0.2, -0.8)
# points of the cylinders: on what carries them, and on their arms
FOOT = ((0.0, -0.35), (0.85, -0.06))
EYE = ((0.40, -0.06), (0.30, -0.06))
PISTON, ROD, STROKE = 0.07, 0.045, 0.3
AREA = (0.25 * math.pi * PISTON**2, 0.25 * math.pi * (PISTON**2 - ROD**2))
DEAD_VOLUME = 0.5e-3
MODULUS = 1.2e9
DAMPING = 4000.0  # N s/m along a cylinder
SUPPLY, TANK = 140e5, 1e5
FLOW = 5e-4 / math.sqrt(35e5)  # m³/s/√Pa of one edge, wholly open
OPENING = (0.25, -0.2)  # positive extends
START = ((60e5, 30e5), (40e5, 50e5))
DURATION, STEP = 1.0, 1e-3


def inertia(arm: int) -> float:
    """About the centre of mass, which is in the middle of the arm [kg m²]."""
    return MASS[arm] * LENGTH[arm] ** 2 / 12.0


def hinge(arm: int) -> tuple[float, float]:
    """Where the hinge of an arm is at the start."""
    if arm == 0:
        return 0.0, 0.0
    return LENGTH[0] * math.cos(ANGLE[0]), LENGTH[0] * math.sin(ANGLE[0])


def on_arm(arm: int, point: tuple[float, float]) -> tuple[float, float]:
    """A point of an arm at the start, in global axes."""
    x, y = hinge(arm)
    c, s = math.cos(ANGLE[arm]), math.sin(ANGLE[arm])
    return x + c * point[0] - s * point[1], y + s * point[0] + c * point[1]


def ends(cylinder: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Both ends of a cylinder at the start."""
    foot = FOOT[0] if cylinder == 0 else on_arm(0, FOOT[1])
    return foot, on_arm(cylinder, EYE[cylinder])


def retracted_length(cylinder: int) -> float:
    """Such that the piston starts in the middle of its stroke."""
    return math.dist(*ends(cylinder)) - 0.5 * STROKE
