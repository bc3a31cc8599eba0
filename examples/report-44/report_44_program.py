"""The program of report 44 (Rouvinen 2003) written again from the report's text, in NumPy: the Lagrange method in Euler parameters.

It is kept as the report describes it, weaknesses and all, so that its tables can be reproduced; it shares no line with the library.
Bodies 0, 1, … move, the last one is the ground. q = (R, θ) of all moving bodies, 7 each; y = (q, q̇). Units: SI.

What differs from the library:
- A(θ) is homogeneous of degree two, A = E Ēᵀ (report: eq. 5), so it stretches bodies where |θ| ≠ 1; C_θ = C_π 2Ē (eqs. 27, 28).
  Without `homogeneous` A is that of θ/|θ|, and C_θ and Q_d are its exact derivatives also where |θ| ≠ 1;
- M of eq. 75 stays singular along θ; the system of eq. 77 is solved as it stands, normalisation rows included;
- the velocity term Q_v of eq. 63 can be left out (`gyroscopic`): the report's numbers for the slider-crank are those without it;
- direct correction is one pass over positions and one over velocities (eqs. 127, 137) with unit weights, or with those of the
  mass metric (`mass_weights`), which the library takes;
- external work is Σ Q_eᵀ Δq, by rectangles, with Q_e at the start of each step; with `angles` it is torque times angle turned.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from report_44_rows import Array, Rows, tilde

GRAVITY = np.array([0.0, -9.81, 0.0])
# Gear's method of order 4 (Table 4) and the Adams–Bashforth predictor of order 3 (Table 2), newest first
BACKWARD, RATE = np.array([48.0, -36.0, 16.0, -3.0]) / 25.0, 12.0 / 25.0
PREDICTOR = np.array([23.0, -16.0, 5.0]) / 12.0
MOST_ITERATIONS = 100


@dataclass(frozen=True)
class Machine:
    """A machine of the report: n moving bodies with frames at their centres of mass, and basic constraints.

    mass (n,) [kg]; inertia (n, 3) [kg m²], body axes; position (n, 3) [m], theta (n, 4) at the start; torque (n, 3) [N m], global
    axes; duration [s]; rows: ("s", i, u_i, j, u_j), ("d1", i, a_i, j, a_j) or ("d2", i, a_i, u_i, j, u_j), vectors in body axes.
    """

    mass: Array
    inertia: Array
    position: Array
    theta: Array
    torque: Array
    duration: float
    rows: tuple[tuple[Any, ...], ...]

    @property
    def start(self) -> Array:
        """(14 n,) y at rest."""
        q = np.hstack([self.position, self.theta]).ravel()
        return np.concatenate([q, np.zeros_like(q)])


@dataclass(frozen=True)
class Settings:
    """stabilisation: "none", "baumgarte" or "direct"; alpha, beta [1/s] of eq. 110; tolerance of the corrector (largest change)."""

    integrator: str = "rk4"
    stabilisation: str = "none"
    step: float = 0.01
    alpha: float = 5.0
    beta: float = 5.0
    gyroscopic: bool = True
    homogeneous: bool = True
    mass_weights: bool = False
    angles: bool = False
    tolerance: float = 1e-5


@dataclass(frozen=True)
class Run:
    """time (s,); violation (s, rows) C; energy_error (s,) [J] T + V - W less its start; iterations (s,) of the corrector in each step."""

    time: Array
    violation: Array
    energy_error: Array
    iterations: Array


class Equations:
    """The equations of motion of a machine: accelerations, constraints and energy of a state."""

    def __init__(self, machine: Machine, settings: Settings) -> None:
        self.machine, self.settings = machine, settings
        self.bodies = len(machine.mass)
        self.size = 7 * self.bodies
        self.rows = Rows(machine.rows, self.bodies)

    def place(self, q: Array) -> tuple[Array, Array, Array]:
        """R (n+1, 3), A (n+1, 3, 3) and Ḡ = 2Ē (n+1, 3, 4); the ground is the last body."""
        x = np.append(q, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]).reshape(-1, 7)
        e0, e1, e2, e3 = x[:, 3:].T
        local = np.array([[-e1, e0, e3, -e2], [-e2, -e3, e0, e1], [-e3, e2, -e1, e0]]).transpose(2, 0, 1)
        space = np.array([[-e1, e0, -e3, e2], [-e2, e3, e0, -e1], [-e3, -e2, e1, e0]]).transpose(2, 0, 1)
        A = space @ local.transpose(0, 2, 1)
        if not self.settings.homogeneous:
            square = np.sum(x[:, 3:] ** 2, axis=1)[:, None, None]
            A, local = A / square, local / square
        return x[:, :3], A, 2.0 * local

    def stretching(self, y: Array) -> Array:
        """(n,) κ = -2 θᵀθ̇/|θ|² of ᾱ = Ḡ θ̈ + κ ω̄ with Ḡ = 2Ē/|θ|²; zero for Ḡ = 2Ē, where Ḡ̇ θ̇ = 0."""
        theta, thetadot = (part.reshape(-1, 7)[:, 3:] for part in np.split(y, 2))
        return (
            np.zeros(self.bodies)
            if self.settings.homogeneous
            else -2.0 * np.sum(theta * thetadot, 1) / np.sum(theta**2, 1)
        )

    def constraints(self, y: Array) -> tuple[Array, Array, Array]:
        """C (rows,), C_q (rows, 7 n) and Q_d (rows,) of the joints, then of θᵀθ = 1 of every body."""
        n, count = self.bodies, self.rows.count
        R, A, G = self.place(y[: self.size])
        rates = np.append(y[self.size :], np.zeros(7)).reshape(-1, 7)
        C, Qd, Cq = np.empty(count + n), np.empty(count + n), np.zeros((count + n, n + 1, 7))
        self.rows.fill(R, A, G, rates, C, Cq, Qd)
        Qd[:count] -= np.einsum("rbj,bj,b->r", Cq[:count, :-1, 3:], rates[:-1, 3:], self.stretching(y))
        theta, thetadot = y[: self.size].reshape(-1, 7)[:, 3:], rates[:-1, 3:]
        C[count:] = np.sum(theta**2, axis=1) - 1.0
        Qd[count:] = -2.0 * np.sum(thetadot**2, axis=1)
        Cq[np.arange(count, count + n), np.arange(n), 3:] = 2.0 * theta
        return C, Cq[:, :-1].reshape(count + n, -1), Qd

    def forces(self, y: Array) -> Array:
        """(7 n,) Q_e: weight, and the torque as Ḡᵀ Aᵀ n (eq. 67)."""
        _, A, G = self.place(y[: self.size])
        weight = self.machine.mass[:, None] * GRAVITY
        turning = np.einsum("bij,bki,bk->bj", G[:-1], A[:-1], self.machine.torque)
        return np.hstack([weight, turning]).ravel()

    def mass(self, G: Array, along: float = 0.0) -> Array:
        """(7 n, 7 n) M of eq. 75 at G = Ḡ (n, 3, 4), with `along` [kg m²] added where it is singular, in the direction of θ."""
        blocks = G.transpose(0, 2, 1) @ (self.machine.inertia[:, :, None] * G)
        # ḠᵀḠ is a multiple of 1 - θ θᵀ/|θ|², whose trace is 3
        square = G.transpose(0, 2, 1) @ G
        blocks += along * (np.eye(4) - 3.0 * square / np.trace(square, axis1=1, axis2=2)[:, None, None])
        M = np.zeros((self.size, self.size))
        for b in range(self.bodies):
            R, theta = slice(7 * b, 7 * b + 3), slice(7 * b + 3, 7 * b + 7)
            M[R, R] = self.machine.mass[b] * np.eye(3)
            M[theta, theta] = blocks[b]
        return M

    def accelerations(self, y: Array) -> Array:
        """(7 n,) q̈ of eq. 77, with eq. 110 in place of Q_d where Baumgarte's stabilisation is on."""
        settings, n, inertia = self.settings, self.size, self.machine.inertia
        C, Cq, Qd = self.constraints(y)
        if settings.stabilisation == "baumgarte":
            Qd = Qd - 2.0 * settings.alpha * (Cq @ y[n:]) - settings.beta**2 * C
        G, Q = self.place(y[:n])[2][:-1], self.forces(y).reshape(-1, 7)
        omega = np.einsum("bij,bj->bi", G, y[n:].reshape(-1, 7)[:, 3:])
        Q[:, 3:] -= np.einsum("bij,bi,b->bj", G, inertia * omega, self.stretching(y))
        if settings.gyroscopic:
            Q[:, 3:] -= np.einsum("bij,bik,bk->bj", G, tilde(omega), inertia * omega)
        saddle = np.zeros((n + len(C), n + len(C)))
        saddle[:n, :n] = self.mass(G)
        saddle[n:, :n], saddle[:n, n:] = Cq, Cq.T
        return np.asarray(np.linalg.solve(saddle, np.concatenate([Q.ravel(), Qd]))[:n], dtype=float)

    def rates(self, y: Array) -> Array:
        """(14 n,) ẏ."""
        return np.concatenate([y[self.size :], self.accelerations(y)])

    def correct(self, y: Array) -> Array:
        """y after one pass of eq. 127 and one of eq. 137, each with the Jacobian at the position it finds."""
        y = y.copy()
        C, Cq, _ = self.constraints(y)
        y[: self.size] -= self.shortest(y, Cq, C)
        _, Cq, _ = self.constraints(y)
        y[self.size :] -= self.shortest(y, Cq, Cq @ y[self.size :])
        return y

    def shortest(self, y: Array, Cq: Array, C: Array) -> Array:
        """(7 n,) the least Δq with C_q Δq = C: in its own length, or in that of the mass metric."""
        weighted = Cq.T
        if self.settings.mass_weights:
            weighted = np.linalg.solve(self.mass(self.place(y[: self.size])[2][:-1], along=1.0), Cq.T)
        return weighted @ np.linalg.solve(Cq @ weighted, C)

    def work(self, y: Array, new: Array) -> float:
        """[J] done by the torques from y to the next state."""
        begin, end = (state[: self.size].reshape(-1, 7)[:, 3:] for state in (y, new))
        if not self.settings.angles:
            return float(np.sum(self.forces(y).reshape(-1, 7)[:, 3:] * (end - begin)))
        _, A, G = self.place(y[: self.size])
        axis = np.einsum("bki,bij,bj->bk", A[:-1], G[:-1], end)
        length = np.sqrt(np.sum(axis**2, axis=1))
        cosine = np.sum(begin * end, axis=1) / np.sqrt(np.sum(begin**2, axis=1) * np.sum(end**2, axis=1))
        angle = 2.0 * np.arccos(np.clip(cosine, -1.0, 1.0))
        return float(np.sum(np.sum(self.machine.torque * axis, axis=1) * angle / np.where(length > 0.0, length, 1.0)))

    def energy(self, y: Array) -> float:
        """T + V [J]."""
        _, _, G = self.place(y[: self.size])
        rates = y[self.size :].reshape(-1, 7)
        omega = np.einsum("bij,bj->bi", G[:-1], rates[:, 3:])
        kinetic = 0.5 * (
            self.machine.mass @ np.sum(rates[:, :3] ** 2, axis=1) + np.sum(self.machine.inertia * omega**2)
        )
        return kinetic - self.machine.mass @ (y[: self.size].reshape(-1, 7)[:, :3] @ GRAVITY)


def runge_kutta(equations: Equations, y: Array, h: float) -> Array:
    """Eqs. 102–106."""
    k1 = equations.rates(y)
    k2 = equations.rates(y + 0.5 * h * k1)
    k3 = equations.rates(y + 0.5 * h * k2)
    k4 = equations.rates(y + h * k3)
    return y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)


def nystrom(equations: Equations, y: Array, h: float) -> Array:
    """The Runge–Kutta–Nyström method of order 4 for q̈ = f(q, q̇) (Kreyszig, Advanced Engineering Mathematics)."""
    q, v = np.split(y, 2)

    def half(position: Array, velocity: Array) -> Array:
        return 0.5 * h * equations.accelerations(np.concatenate([position, velocity]))

    k1 = half(q, v)
    middle = q + 0.5 * h * (v + 0.5 * k1)
    k2 = half(middle, v + k1)
    k3 = half(middle, v + k2)
    k4 = half(q + h * (v + k3), v + 2.0 * k3)
    return np.concatenate([q + h * (v + (k1 + k2 + k3) / 3.0), v + (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 3.0])


def gear(equations: Equations, states: list[Array], rates: list[Array], settings: Settings) -> tuple[Array, int]:
    """Gear's method of order 4 (Table 4), predicted by AB3, corrected by functional iteration (Fig. 15). Newest states first."""
    h = settings.step
    known = sum(weight * state for weight, state in zip(BACKWARD, states, strict=True))
    y = states[0] + h * sum(weight * rate for weight, rate in zip(PREDICTOR, rates[:3], strict=True))
    for count in range(1, MOST_ITERATIONS + 1):
        following = known + RATE * h * equations.rates(y)
        change = np.max(np.abs(following - y))
        y = following
        if change < settings.tolerance:
            return y, count
    return y, MOST_ITERATIONS


def simulate(machine: Machine, settings: Settings) -> Run:
    """A run from rest: every step's violations, energy error and corrector iterations."""
    equations = Equations(machine, settings)
    steps = round(machine.duration / settings.step)
    y = machine.start
    states, rates = [y], [equations.rates(y)]
    history, work, iterations = [y], [0.0], []
    for _ in range(steps):
        if settings.integrator == "rkn4":
            new = nystrom(equations, y, settings.step)
        elif settings.integrator == "rk4" or len(states) < 4:
            new = runge_kutta(equations, y, settings.step)
        else:
            new, count = gear(equations, states, rates, settings)
            iterations.append(count)
        if settings.stabilisation == "direct":
            new = equations.correct(new)
        work.append(work[-1] + equations.work(y, new))
        y = new
        if settings.integrator == "gear":
            states, rates = [y, *states[:3]], [equations.rates(y), *rates[:3]]
        history.append(y)
    energies = np.array([equations.energy(y) for y in history])
    return Run(
        time=np.arange(steps + 1.0) * settings.step,
        violation=np.array([equations.constraints(y)[0] for y in history]),
        energy_error=energies - energies[0] - np.array(work),
        iterations=np.array(iterations),
    )
