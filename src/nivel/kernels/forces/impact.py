"""Contact of compliant surfaces (Hunt & Crossley 1975): K δⁿ (1 + a δ̇) while the surfaces overlap by δ, never pulling.

The factor a follows from the approach speed v and the coefficient of restitution e: the motion m v̇ = -K δⁿ (1 + a δ̇) leaves with
speed e v where ln((1 + x)/(1 - e x)) = x (1 + e), x = a v, whatever K, n and m are (integrate v dv/(1 + a v) over the contact). x is
a number of the element; v is remembered from the first accepted state in contact.
"""

from __future__ import annotations

from nivel.kernels.compile import leaf

# approach speeds below this [m/s or rad/s] count as this one: a slower touch would be damped without bounds
SLOWEST = 1e-2


@leaf
def impact(depth, rate, stiffness, exponent, x, remembered):
    """(force, stored energy, dissipated power, approach speed to be remembered) at overlap `depth` and its `rate`."""
    if depth <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    speed = remembered if remembered > 0.0 else max(rate, SLOWEST)
    elastic = stiffness * depth**exponent
    force = max(elastic * (1.0 + x / speed * rate), 0.0)
    return force, elastic * depth / (exponent + 1.0), (force - elastic) * rate, speed
