"""Dry friction in one dimension: sliding to rest, stick-slip on a drawn spring, the bristle of LuGre.

A block of mass m with the normal load N on a rail.

Regularised Coulomb, m v̇ = -μ N tanh(v/v_t), from v0:  sinh(v/v_t) = sinh(v0/v_t) exp(-μ N t/(m v_t)).

Stick-slip: a spring k whose far end moves at V. It sticks until the tension k u reaches μ_s N, after μ_s N/(k V). While it
slips with constant μ_d, the way w of the block obeys m ẅ = D + k V τ - k w, D = (μ_s - μ_d) N, so with ω² = k/m

    w = D/k (1 - cos ωτ) + V (τ - sin(ωτ)/ω),   ẇ = D ω/k sin ωτ + V (1 - cos ωτ),

which comes to rest at ωτ = 2 π - 2 atan(D ω/(k V)). The tension has then fallen to μ_d N - D (the motion of u about μ_d N
is symmetric), and after 2 D/(k V) of sticking the next slip begins: the motion is periodic.

With Stribeck's curve μ(v) = μ_d + (μ_s - μ_d) exp(-(v/v_s)²) the slip phases are integrated, with an event at rest.

LuGre (Canudas de Wit, Olsson, Åström, Lischinsky 1995), per unit of load: ż = v - σ0 |v| z/μ(v), force (σ0 z + σ1 ż) N.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


def sliding_to_rest(times: Array, deceleration: float, transition: float, speed: float) -> Array:
    """Speed (n,) under regularised friction; deceleration = μ N/m, transition = v_t."""
    s = speed / transition
    # asinh(sinh(s) exp(-x)) without overflow: for large s it is s - x
    exponent = -deceleration * np.asarray(times) / transition
    log_sinh = s + np.log1p(-np.exp(-2 * s)) - np.log(2) + exponent
    return transition * np.where(log_sinh > 300, log_sinh + np.log(2), np.arcsinh(np.exp(np.minimum(log_sinh, 300))))


@dataclass(frozen=True)
class Drawn:
    """A block drawn by a spring. load [N]; static, kinetic: coefficients; stribeck [m/s], 0 for none."""

    mass: float
    stiffness: float
    speed: float
    load: float
    static: float
    kinetic: float
    stribeck: float = 0.0

    def coefficient(self, speed: float) -> float:
        if self.stribeck == 0.0:
            return self.kinetic
        return self.kinetic + (self.static - self.kinetic) * float(np.exp(-((speed / self.stribeck) ** 2)))

    @property
    def first_slip(self) -> float:
        """[s]"""
        return self.static * self.load / (self.stiffness * self.speed)

    @property
    def slip_duration(self) -> float:
        """[s], constant kinetic coefficient."""
        omega = np.sqrt(self.stiffness / self.mass)
        drop = (self.static - self.kinetic) * self.load
        return float((2 * np.pi - 2 * np.arctan(drop * omega / (self.stiffness * self.speed))) / omega)

    @property
    def stick_duration(self) -> float:
        """[s] between two slips, constant kinetic coefficient."""
        return 2 * (self.static - self.kinetic) * self.load / (self.stiffness * self.speed)

    def closed_form(self, times: Array) -> Array:
        """Way (n,) of the block without Stribeck's curve, spring slack and block at rest at time 0."""
        omega = np.sqrt(self.stiffness / self.mass)
        drop = (self.static - self.kinetic) * self.load / self.stiffness
        period = self.slip_duration + self.stick_duration
        cycle, tau = np.divmod(np.maximum(np.asarray(times) - self.first_slip, 0.0), period)
        tau = np.minimum(tau, self.slip_duration)
        way = drop * (1 - np.cos(omega * tau)) + self.speed * (tau - np.sin(omega * tau) / omega)
        return cycle * self.speed * period + way

    def integrated(self, times: Array) -> tuple[Array, list[float]]:
        """Way (n,) with Stribeck's curve, and the times at which the block comes to rest."""
        times = np.asarray(times)
        k, N = self.stiffness, self.load
        way, rests, at, x = np.zeros(len(times)), [], 0.0, 0.0

        def at_rest(t: float, y: Array) -> float:
            return y[1]

        at_rest.terminal, at_rest.direction = True, -1  # type: ignore[attr-defined]
        while at < times[-1]:
            start = (self.static * N / k + x) / self.speed  # k (V t - x) = μ_s N
            way[times > at] = x
            if start >= times[-1]:
                break

            def slope(t: float, y: Array) -> list[float]:
                # the tension at the start is written as static load plus growth, so that nothing cancels
                pull = self.static * N + k * (self.speed * t - y[0])
                return [y[1], (pull - self.coefficient(y[1]) * N) / self.mass]

            span = times[-1] - start
            inside = times[times > start] - start
            # with Stribeck's curve v = 0 is a point of rest that is left exponentially fast: tension grows with t
            options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-15, "dense_output": True}
            found = solve_ivp(slope, (0, span), [0.0, 0.0], events=at_rest, first_step=1e-9, **options)
            end = found.t_events[0][0] if len(found.t_events[0]) else span
            way[times > start] = x + found.sol(np.minimum(inside, end))[0]
            at, x = start + end, x + float(found.sol(end)[0])
            if end < span:
                rests.append(at)
        return way, rests


def bristle(
    times: Array, mass: float, load: float, curve: tuple[float, float, float], sigma: tuple[float, float], pull
) -> tuple[Array, Array, Array]:
    """Displacement, speed, bristle (n,) of a block from rest under pull(t) [N] with LuGre friction, by LSODA.

    curve : (static, kinetic, Stribeck speed); sigma : (σ0 [1/m], σ1 [s/m]).
    """
    static, kinetic, stribeck = curve

    def slope(t: float, y: Array) -> list[float]:
        _, v, z = y
        mu = kinetic + (static - kinetic) * np.exp(-(min(abs(v) / stribeck, 25.0) ** 2))  # trial steps may be far off
        zdot = v - sigma[0] * abs(v) * z / mu
        return [v, (pull(t) - load * (sigma[0] * z + sigma[1] * zdot)) / mass, zdot]

    options = {"t_eval": times, "rtol": 1e-10, "atol": 1e-13}
    found = solve_ivp(slope, (0, times[-1]), [0, 0, 0], "LSODA", first_step=1e-6, **options)
    return found.y[0], found.y[1], found.y[2]
