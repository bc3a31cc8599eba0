"""Machines whose friction acts on its own normal load: a pendulum on a thick pin, two sliders joined by a rod.

Pendulum, φ from the downward vertical, J about the hinge, arm l, pin of radius r: the pin carries

    N² = m² ((g cos φ + l φ̇²)² + (l φ̈ + g sin φ)²),   J φ̈ = -m g l sin φ - μ r N s(φ̇),

s the sign, or tanh(r φ̇/v_t). N depends on φ̈, which depends on N: solved for φ̈ by bisection-safe iteration.

Two sliders: A on the rail along X, B on the rail along Y, a massless rod of length L between them pushes with S on both.
With (x, y) the places, θ the angle of the rod at A, c = x/L, s = y/L, and a force P on A towards the corner:

    m_A ẍ = -P + S c - μ |m_A g + S s| tanh(ẋ/v_t)
    m_B ÿ = -m_B g + S s - μ |S c| tanh(ẏ/v_t)
    x ẍ + y ÿ = -(ẋ² + ẏ²).

While A moves inwards and B up, S (s - μ c) = m_B (g + ÿ): no force lifts B where tan θ <= μ. The drive locks itself.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

Array = NDArray[np.float64]


@dataclass(frozen=True)
class RubbingPendulum:
    """mass, arm, inertia about the hinge; friction coefficient and radius of the pin; g."""

    mass: float
    arm: float
    inertia: float
    coefficient: float
    radius: float
    g: float = 9.81

    def load(self, angle: float, rate: float, acceleration: float) -> float:
        """N [N]"""
        along = self.g * np.cos(angle) + self.arm * rate**2
        across = self.arm * acceleration + self.g * np.sin(angle)
        return float(self.mass * np.hypot(along, across))

    def acceleration(self, angle: float, rate: float, sense: float) -> float:
        """φ̈ for friction of `sense` -1 … 1."""
        free = -self.mass * self.g * self.arm * np.sin(angle) / self.inertia
        grip = self.coefficient * self.radius * sense / self.inertia
        second = free
        for _ in range(200):
            new = free - grip * self.load(angle, rate, second)
            if abs(new - second) <= 1e-15 * (1 + abs(new)):
                break
            second = new
        return float(new)

    def regularised(self, times: Array, start: float, transition: float) -> Array:
        """φ (n,) from rest at `start`."""

        def slope(_t: float, y: Array) -> list[float]:
            return [y[1], self.acceleration(y[0], y[1], np.tanh(self.radius * y[1] / transition))]

        found = solve_ivp(slope, (0, times[-1]), [start, 0], "LSODA", t_eval=times, rtol=1e-11, atol=1e-13)
        return found.y[0]

    def dry(self, times: Array, start: float) -> tuple[Array, list[float]]:
        """φ (n,) and the angles of the reversals, with sticking: integrated from reversal to reversal.

        It rests for good where gravity is held: m g l |sin φ| <= μ r m g (the load at rest is m g).
        """
        times = np.asarray(times)
        angle, turns = np.zeros(len(times)), []
        at, now = 0.0, start

        def reversal(_t: float, y: Array) -> float:
            return y[1]

        reversal.terminal = True  # type: ignore[attr-defined]
        while at < times[-1] and self.arm * abs(np.sin(now)) > self.coefficient * self.radius:
            sense = -np.sign(now)
            span = times[-1] - at

            def slope(_t: float, y: Array, sense: float = sense) -> list[float]:
                return [y[1], self.acceleration(y[0], y[1], sense)]

            # from just past rest, so that the event at the start does not count
            second = self.acceleration(now, 0.0, sense)
            tiny = 1e-6
            begin = [now + second * tiny**2 / 2, second * tiny]
            options = {"rtol": 1e-12, "atol": 1e-14, "dense_output": True}
            found = solve_ivp(slope, (tiny, span), begin, "DOP853", events=reversal, **options)
            end = found.t_events[0][0] if len(found.t_events[0]) else span
            inside = (times >= at) & (times <= at + end)
            angle[inside] = found.sol(np.maximum(times[inside] - at, tiny))[0]
            at, now = at + end, float(found.sol(end)[0])
            if end < span:
                turns.append(now)
        angle[times > at] = now
        return angle, turns


@dataclass(frozen=True)
class TwoSliders:
    """Sliders A (X rail) and B (Y rail), masses [kg]; rod length [m]; friction coefficient; v_t [m/s]."""

    mass_a: float
    mass_b: float
    length: float
    coefficient: float
    transition: float
    g: float = 9.81

    def solve(self, state: Array, push: float) -> tuple[float, float, float]:
        """ẍ, ÿ, S at (x, y, ẋ, ẏ): the residual of the third equation is monotone in S, its root is bracketed."""
        x, y, vx, vy = state
        c, s = x / self.length, y / self.length
        ta, tb = np.tanh(vx / self.transition), np.tanh(vy / self.transition)

        def accelerations(S: float) -> tuple[float, float]:
            load_a = abs(self.mass_a * self.g + S * s)
            load_b = abs(S * c)
            ax = (-push + S * c - self.coefficient * load_a * ta) / self.mass_a
            ay = -self.g + (S * s - self.coefficient * load_b * tb) / self.mass_b
            return ax, ay

        def excess(S: float) -> float:
            ax, ay = accelerations(S)
            return x * ax + y * ay + vx**2 + vy**2

        bound = 1e3 * (abs(push) + (self.mass_a + self.mass_b) * (self.g + (vx**2 + vy**2) / self.length))
        S = float(brentq(excess, -bound, bound, xtol=1e-13, rtol=1e-14))
        return *accelerations(S), S

    def motion(self, times: Array, angle: float, push: Callable[[float], float]) -> tuple[Array, Array]:
        """θ (n,) and S (n,) from rest at θ = `angle`."""

        def slope(t: float, y: Array) -> list[float]:
            state = self._state(y[0], y[1])
            ax, ay, _ = self.solve(state, push(t))
            # x = L cos θ, y = L sin θ: θ̈ = (x ÿ - y ẍ)/L²
            return [y[1], (state[0] * ay - state[1] * ax) / self.length**2]

        found = solve_ivp(slope, (0, times[-1]), [angle, 0], "LSODA", t_eval=times, rtol=1e-11, atol=1e-13)
        rod = [
            self.solve(self._state(a, r), push(t))[2] for t, a, r in zip(found.t, found.y[0], found.y[1], strict=True)
        ]
        return found.y[0], np.array(rod)

    def _state(self, angle: float, rate: float) -> Array:
        c, s = self.length * np.cos(angle), self.length * np.sin(angle)
        return np.array([c, s, -s * rate, c * rate])
