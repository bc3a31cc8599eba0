"""Impacts with the law of Hunt and Crossley (1975): F = K δⁿ (1 + a δ̇), δ the penetration, no force beyond contact.

m δ̈ = -F gives v dv/(1 + a v) = -(K/m) δⁿ dδ. Integrated from contact at the speed v_i to the deepest point and back to
separation at v_o, both sides meet the same ∫ δⁿ dδ, so stiffness and exponent drop out:

    a (v_i + v_o) = ln((1 + a v_i)/(1 - a v_o)).

Asking for v_o = e v_i leaves one equation for d = a v_i:  d (1 + e) = ln((1 + d)/(1 - e d)),  0 <= e d < 1; d → 0 as
e → 1, d ≈ 3 (1 - e)/2 there. Without damping (e = 1)

    δmax = ((n + 1) m v²/(2 K))^(1/(n + 1)),
    T = 2 (δmax/v) ∫₀¹ dx/√(1 - x^(n+1)) = 2 (δmax/v) B(1/(n + 1), ½)/(n + 1),

π √(m/K) for n = 1 and 2.9432 δmax/v for the sphere of Hertz, n = 3/2, whose K is 4/3 E* √R with
1/E* = (1 - ν1²)/E1 + (1 - ν2²)/E2 and 1/R = 1/R1 + 1/R2.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import beta


def damping_number(restitution: float) -> float:
    """d = a v_i that gives the coefficient of restitution e exactly."""
    e = restitution
    if e == 1.0:
        return 0.0

    def excess(d: float) -> float:
        return d * (1 + e) - np.log1p(d) + np.log1p(-e * d)

    # excess is d² (1 - e²)/2 + … > 0 near 0 and falls to -∞ at d = 1/e
    return float(brentq(excess, 1e-6 * (1 - e), (1 - 1e-15) / e, xtol=1e-15, rtol=1e-14))


def rebound_speed(a: float, speed: float) -> float:
    """v_o for the damping factor a [s/m] and the speed of impact v_i."""

    def excess(out: float) -> float:
        return np.log1p(a * speed) - np.log1p(-a * out) - a * (speed + out)

    highest = min(speed, (1 - 1e-15) / a)
    return float(brentq(excess, 0.0, highest, xtol=1e-15)) if excess(highest) > 0 else highest


def deepest(mass: float, stiffness: float, exponent: float, speed: float) -> float:
    """δmax [m] without damping."""
    n = exponent
    return ((n + 1) * mass * speed**2 / (2 * stiffness)) ** (1 / (n + 1))


def duration(mass: float, stiffness: float, exponent: float, speed: float) -> float:
    """T [s] from contact to separation without damping."""
    p = 1 / (exponent + 1)
    return 2 * deepest(mass, stiffness, exponent, speed) / speed * p * beta(p, 0.5)


def damped_duration(mass: float, stiffness: float, exponent: float, speed: float, restitution: float) -> float:
    """T [s] with damping, by time integration to the moment of separation."""
    return integrated(mass, stiffness, exponent, speed, restitution)[0]


def integrated(
    mass: float, stiffness: float, exponent: float, speed: float, restitution: float
) -> tuple[float, float, float]:
    """(T, v_o, δmax) by time integration in the units of the undamped impact."""
    depth = deepest(mass, stiffness, exponent, speed)
    d = damping_number(restitution)

    def slope(_s: float, y: np.ndarray) -> list[float]:  # y = δ/δmax, its rate; time in δmax/v
        x = max(y[0], 0.0)
        return [y[1], -0.5 * (exponent + 1) * x**exponent * (1 + d * y[1])]

    def separated(_s: float, y: np.ndarray) -> float:
        return y[0]

    def turned(_s: float, y: np.ndarray) -> float:
        return y[1]

    separated.terminal, separated.direction = True, -1  # type: ignore[attr-defined]
    found = solve_ivp(slope, (0, 1e3), [0.0, 1.0], "DOP853", events=[separated, turned], rtol=1e-11, atol=1e-13)
    return (
        float(found.t_events[0][0]) * depth / speed,
        -float(found.y_events[0][0][1]) * speed,
        float(found.y_events[1][0][0]) * depth,
    )


def hertz_stiffness(radii: tuple[float, ...], moduli: tuple[float, float], ratios: tuple[float, float]) -> float:
    """K [N/m^1.5] of two spheres, or of one sphere and a plane where one radius is given."""
    curvature = sum(1 / radius for radius in radii)
    softness = sum((1 - ratio**2) / modulus for modulus, ratio in zip(moduli, ratios, strict=True))
    return 4 / 3 / softness / np.sqrt(curvature)
