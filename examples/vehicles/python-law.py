"""The damper of examples/vehicles/python-law.yaml: a law that no line of arithmetic says well."""

import math

# pressures of the two valves' springs, as forces on the rod
OPENING_SPEED = 0.08  # m/s, where the valve begins to open
BUMP = 900.0  # N s/m, in compression before it opens
REBOUND = 2600.0  # N s/m, in extension
OPEN_SHARE = 0.25  # of the damping that is left when the valve is wide open


def damper(rate, length, stroke_end):
    """Tension [N] of the damper at `rate` [m/s, extension positive], with a hydraulic stop near full compression."""
    damping = REBOUND if rate > 0.0 else BUMP
    speed = abs(rate)
    force = damping * speed
    if speed > OPENING_SPEED:
        force = damping * (OPENING_SPEED + OPEN_SHARE * (speed - OPENING_SPEED))
    tension = math.copysign(force, rate)
    squeezed = stroke_end - length
    if squeezed > 0.0:
        tension -= 4.0e5 * squeezed
    return tension
