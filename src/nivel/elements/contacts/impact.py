"""Contact of compliant surfaces (Hunt & Crossley 1975): K δⁿ (1 + a δ̇) while the surfaces overlap by δ, never pulling.

The factor a follows from the approach speed v and the coefficient of restitution e: the motion m v̇ = -K δⁿ (1 + a δ̇) leaves with
speed e v where ln((1 + x)/(1 - e x)) = x (1 + e), x = a v, whatever K, n and m are (integrate v dv/(1 + a v) over the contact). x is
a number of the element; v is remembered from the first accepted state in contact, and is the rate itself until then. A negative x is -a
itself, given as damping.
"""

import math
from typing import Any

from nivel.kernels.algebra.analytic import absolute, maximum, real
from nivel.lazy import scipy
from nivel.native.function import leaf


def damping_of_restitution(restitution: float) -> float:
    """x with ln((1 + x)/(1 - e x)) = x (1 + e), see above; zero for e = 1."""
    e = restitution
    if e >= 1.0 - 1e-9:
        return 0.0

    def excess(x: float) -> float:
        return math.log1p(x) - math.log1p(-e * x) - x * (1.0 + e)

    # negative just above the root at zero (-(1 - e²) x²/2), infinite at 1/e
    largest = 1.0 / e
    gap = 1e-3 * largest
    while excess(largest - gap) <= 0.0:
        gap *= 1e-3
        if gap < 1e-15 * largest:
            return largest
    root: Any = scipy.optimize.bisect(excess, 1e-6 * (1.0 - e), largest - gap, xtol=1e-15)
    return float(root)


# approach speeds below this [m/s or rad/s] count as this one: a slower touch would be damped without bounds
SLOWEST = 1e-2


@leaf
def impact(depth, rate, stiffness, exponent, x, remembered, followed):
    """(force, stored energy, dissipated power, approach speed to be remembered) at overlap `depth` and its `rate`.

    followed : the surfaces touch or are apart as in the last accepted state, whatever `depth` is, so that the force is smooth over the
    whole step; it is continued as an odd function of `depth`. The step is then cut where `depth` changes its sign.
    """
    nothing = 0.0 * rate
    if real(depth) <= 0.0 and not (followed == 1 and remembered > 0.0):
        return nothing, nothing, nothing, nothing
    speed = remembered if remembered > 0.0 else maximum(rate, SLOWEST)
    kept = speed if real(depth) > 0.0 else nothing
    if followed == 1 and remembered == 0.0:
        return nothing, nothing, nothing, kept
    elastic = stiffness * absolute(depth) ** exponent
    if real(depth) < 0.0:
        elastic = -elastic
    force = elastic * (1.0 + (x / speed if real(x) >= 0.0 else -x) * rate)
    if real(depth) > 0.0 and real(force) < 0.0:
        force = nothing
    return force, elastic * depth / (exponent + 1.0), (force - elastic) * rate, kept


@leaf
def slopes_of_impact(depth, rate, stiffness, x, remembered):
    """(∂F/∂δ, ∂F/∂δ̇) of `impact` with the exponent 1, for real numbers: K (1 + a δ̇) and K δ a while the surfaces push."""
    speed = remembered if remembered > 0.0 else max(rate, SLOWEST)
    damping = x / speed if x >= 0.0 else -x
    push = 1.0 + damping * rate
    if depth <= 0.0 or push <= 0.0:
        return 0.0, 0.0
    return stiffness * push, stiffness * depth * damping


@leaf
def meet(elements, k, i):
    """Whether surface i of element k, apart in the last accepted state, touches in the state last evaluated: then the approach speed is
    that of this state."""
    if elements.memory[k, i] > 0.0 or not real(elements.depth[k, i]) > 0.0:
        return False
    elements.memory[k, i] = real(elements.proposal[k, i])
    return True


@leaf
def part(elements, k, i):
    """Forget that surface i of element k has touched, where it is apart in the state last evaluated."""
    if not real(elements.depth[k, i]) > 0.0:
        elements.memory[k, i] = 0.0
