"""Statics of a plane beam with shear and stretch (Reissner 1972) as a boundary value problem: what elements have to come near to.

    x' = (1 + n·d₁/EA) d₁ + (n·d₂/GA) d₂,  θ' = κ₀ + m/EI,  n' = -q,  m' = -x' × n,      d₁ = (cos θ, sin θ), d₂ = (-sin θ, cos θ)

over the unstressed length; n and m act from the part that lies ahead, q is the load over the length.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp

X, Z, THETA, N_X, N_Z, M = range(6)


@dataclass(frozen=True)
class PlanarBeam:
    """EA, GA [N], EI [N m²]; length [m]; begin (x, z, θ) unstressed; curvature [1/m]; weight, downwards along z [N/m]."""

    EA: float
    GA: float
    EI: float
    length: float
    begin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    curvature: float = 0.0
    weight: float = 0.0

    def unstressed(self, s):
        """(3, n) x, z, θ of the circle, or the straight line."""
        x, z, theta = self.begin
        turned = theta + self.curvature * s
        if self.curvature == 0.0:
            return np.array([x + s * np.cos(theta), z + s * np.sin(theta), turned])
        radius = 1.0 / self.curvature
        along, up = radius * (np.sin(turned) - np.sin(theta)), radius * (np.cos(theta) - np.cos(turned))
        return np.array([x + along, z + up, turned])

    def places(self, shares, ends, *, tip=(0.0, 0.0), moment=0.0):
        """(n, 2) x and z at shares of the length, and the solution at both ends (2, 6). ends : `clamped`, `free`, `rolling` along x,
        `guided` along z, of each end; tip : force, and moment (from x to z) on an end that is free."""
        wanted = [self.unstressed(np.array([at]))[:, 0] for at in (0.0, self.length)]

        def rates(s, y):
            cosine, sine = np.cos(y[THETA]), np.sin(y[THETA])
            stretch = 1.0 + (y[N_X] * cosine + y[N_Z] * sine) / self.EA
            shear = (y[N_Z] * cosine - y[N_X] * sine) / self.GA
            dx, dz = stretch * cosine - shear * sine, stretch * sine + shear * cosine
            turning = self.curvature + y[M] / self.EI
            zero = np.zeros_like(s)
            return np.array([dx, dz, turning, zero, self.weight + zero, -(dx * y[N_Z] - dz * y[N_X])])

        def at_end(y, kind, place):
            if kind == "clamped":
                return list(y[:3] - place)
            if kind == "guided":
                return [y[X] - place[0], y[THETA] - place[2], y[N_Z]]
            if kind == "rolling":
                return [y[N_X], y[Z] - place[1], y[M]]
            return [y[N_X] - tip[0], y[N_Z] - tip[1], y[M] - moment]

        def boundary(a, b):
            return np.array([*at_end(a, ends[0], wanted[0]), *at_end(b, ends[1], wanted[1])])

        s = np.linspace(0.0, self.length, 41)
        guess = np.vstack([self.unstressed(s), np.zeros((3, len(s)))])
        found = solve_bvp(rates, boundary, s, guess, tol=1e-8, max_nodes=20_000)
        assert found.success, found.message
        at = found.sol(self.length * np.asarray(shares))
        return at[[X, Z]].T, found.sol(np.array([0.0, self.length])).T
