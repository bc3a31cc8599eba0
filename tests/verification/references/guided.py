"""Particles and a rod held by one or two constraints: on a turning wire, on a sphere, on a smooth floor.

Bead on a straight wire that turns at ω in a horizontal plane: s̈ = ω² s, so s = s0 cosh ωt from rest on the wire. The
wire pushes it sideways with 2 m ω ṡ, and turning the wire takes d/dt[(J + m s²) ω] = 2 m ω s ṡ.

Spherical pendulum of length L, θ from the downward vertical, ψ about it: with h = ψ̇ sin²θ constant,
θ̈ = sin θ cos θ ψ̇² - (g/L) sin θ, tension T = m (L θ̇² + L ψ̇² sin²θ + g cos θ). Conical: ψ̇² = g/(L cos θ), θ constant.

Rod of half length a, mass m, inertia J about its centre, one end on a smooth floor, θ from the vertical: its centre
stays above one point, y = a cos θ, and from T = ½ (J + m a² sin²θ) θ̇², V = m g a cos θ:
(J + m a² sin²θ) θ̈ + m a² sin θ cos θ θ̇² = m g a sin θ. The floor carries N = m (g + ÿ).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
_TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}


@dataclass(frozen=True)
class Bead:
    """A bead of `mass` at `start` [m] on a wire that turns at `speed` [rad/s]."""

    mass: float
    start: float
    speed: float

    def displacement(self, times: Array) -> Array:
        return self.start * np.cosh(self.speed * times)

    def rate(self, times: Array) -> Array:
        return self.start * self.speed * np.sinh(self.speed * times)

    def side_force(self, times: Array) -> Array:
        """[N] of the wire on the bead, in the sense of turning."""
        return 2 * self.mass * self.speed * self.rate(times)

    def torque(self, times: Array) -> Array:
        """[N m] on the wire that keeps its speed."""
        return self.side_force(times) * self.displacement(times)


@dataclass(frozen=True)
class SphericalSwing:
    """Spherical pendulum at n times, vertical = Z upwards: position (n, 3), tension (n,)."""

    position: Array
    tension: Array


def spherical_pendulum(times: Array, mass: float, length: float, g: float, theta: float, spin: float) -> SphericalSwing:
    """From θ at ψ = 0 (X axis) with ψ̇ = `spin` and θ̇ = 0."""
    h = spin * np.sin(theta) ** 2

    def slope(_t: float, state: Array) -> list[float]:
        s, c = np.sin(state[0]), np.cos(state[0])
        turning = h / s**2
        return [state[1], s * c * turning**2 - g / length * s, turning]

    found = solve_ivp(slope, (0, times[-1]), [theta, 0, 0], t_eval=times, **_TIGHT)
    angle, rate, azimuth = found.y
    s, c = np.sin(angle), np.cos(angle)
    position = length * np.stack([s * np.cos(azimuth), s * np.sin(azimuth), -c], axis=1)
    tension = mass * (length * rate**2 + length * (h / s) ** 2 + g * c)
    return SphericalSwing(position, tension)


@dataclass(frozen=True)
class FallingRod:
    """Rod on a smooth floor at n times: θ, θ̇ and the force N of the floor (n,)."""

    angle: Array
    rate: Array
    floor_force: Array


def falling_rod(times: Array, mass: float, half_length: float, inertia: float, g: float, start: float) -> FallingRod:
    """Let go at rest at θ = `start` from the vertical."""
    a = half_length

    def second(angle: Array, rate: Array) -> Array:
        s, c = np.sin(angle), np.cos(angle)
        return (mass * g * a * s - mass * a**2 * s * c * rate**2) / (inertia + mass * a**2 * s**2)

    found = solve_ivp(lambda _t, y: [y[1], second(y[0], y[1])], (0, times[-1]), [start, 0], t_eval=times, **_TIGHT)
    angle, rate = found.y
    height = -a * (np.cos(angle) * rate**2 + np.sin(angle) * second(angle, rate))  # ÿ
    return FallingRod(angle, rate, mass * (g + height))
