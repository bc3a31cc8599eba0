"""Laws of circuits of oil and of planar arms written a second time, for references by SciPy's Radau; nothing here is from the package."""

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from circuits import BAR, LITRE_PER_MINUTE, PA

CORNER, G = 0.5 * BAR, 9.81


class Oil(NamedTuple):
    """ρ of the liquid at the pressure of the air, its bulk modulus and the slope of that, and undissolved air."""

    liquid: float = 870.0
    modulus: float = 1.5e9
    slope: float = 10.0
    air: float = 0.005

    def at(self, p):
        """(ρ, dρ/dp)."""
        stretched = 1 + self.slope * (p - PA) / self.modulus
        liquid, air = (1 - self.air) * stretched ** (-1 / self.slope), self.air * (PA / p) ** (1 / 1.4)
        v, rho = liquid + air, (1 - self.air) * self.liquid + self.air * 1.2
        return rho / v, rho / v**2 * (liquid / (self.modulus * stretched) + air / (1.4 * p))


def rated(litres, drop):
    """K of a flow [L/min] at a difference of pressure [bar]."""
    return litres * LITRE_PER_MINUTE / math.sqrt(drop * BAR)


def step(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)


def rising(t, begin, end):
    """`step` of machine files, of time or else, from 0 to 1."""
    t = min(max((t - begin) / (end - begin), 0.0), 1.0)
    return t**3 * (10 + t * (6 * t - 15))


def ramp(z, w=0.02):
    return 0.0 if z <= 0 else z - 0.5 * w if z >= w else z**3 / w**2 - 0.5 * z**4 / w**3


def higher(a, b):
    """The larger pressure, rounded."""
    return 0.5 * (a + b + math.hypot(a - b, 1e4))


class Circuit:
    """Pressures [Pa] of nodes, and the mass flows [kg/s] into them that components add."""

    def __init__(self, oil, **pressures):
        self.p = {name: max(p, 1e3) for name, p in pressures.items()}  # trials of the solver may be below
        laws = {name: oil.at(p) for name, p in self.p.items()}
        self.rho, self.slope = ({name: law[k] for name, law in laws.items()} for k in (0, 1))
        self.into = dict.fromkeys(self.p, 0.0)

    def carry(self, a, b, mass_flow):
        self.into[a] -= mass_flow
        self.into[b] += mass_flow

    def over(self, a, b):
        return self.p[a] - self.p[b]

    def restrict(self, a, b, size, leak=0.0):
        """K x = `size` and a laminar leak."""
        d = self.over(a, b)
        flow = size * d * (d * d + CORNER**2) ** -0.25 + leak * d
        self.carry(a, b, 0.5 * (self.rho[a] + self.rho[b]) * flow)

    def poppet(self, a, b, size, opens_at, over):
        """A valve from a to b that the difference of their pressures opens."""
        self.restrict(a, b, size * step((self.over(a, b) - opens_at) / over))

    def spool(self, u, overlap, size, P, T, A, B):
        """The edges of a 4/3 valve with a closed centre."""
        u = min(max(u, -1.0), 1.0)
        for sign, pairs in ((1, ((P, A), (B, T))), (-1, ((P, B), (A, T)))):
            opening = ramp(sign * u - overlap) / (1 - overlap - 0.01)
            for pair in pairs:
                self.restrict(*pair, size * opening)

    def felt(self, u, overlap, A, B, T):
        """What a load-sensing signal feels of a valve [Pa]."""
        u, out = min(max(u, -1.0), 1.0), self.p[T]
        for sign, port in ((1, A), (-1, B)):
            out += step(ramp(sign * u - overlap) / 0.05) * self.over(port, T)
        return out

    def turn(self, a, b, displacement, setting, omega, leak=0.0):
        """A pump or motor; returns its torque without friction."""
        x = omega * setting
        mean, half = 0.5 * (self.rho[a] + self.rho[b]), 0.5 * (self.rho[a] - self.rho[b])
        taken = mean + half * x / math.hypot(x, 1.0)
        self.carry(a, b, taken * displacement * x - mean * leak * self.over(b, a))
        return displacement * setting * self.over(b, a)

    def rate(self, name, volume, grown=0.0):
        """ṗ [bar/s]."""
        return (self.into[name] - self.rho[name] * grown) / (self.slope[name] * volume) / BAR


def sensing(p_ls, p, margin, share, setting, over=10 * BAR, response=0.08):
    """ε̇ of a load-sensing pump whose limits allow `share`."""
    g = min((p_ls + margin - p) / over, (share - setting) / 0.05)
    room = 1 - setting if g > 0 else setting
    return g / math.hypot(1, g) / response * step(room / 0.05)


class Ram(NamedTuple):
    """A cylinder: bore, rod, stroke, retracted length, dead volumes, and the numbers of its friction."""

    bore: float
    rod: float
    stroke: float
    retracted: float
    dead: tuple[float, float] | None
    sliding: float
    seal: float
    viscous: float

    @property
    def areas(self):
        return 0.25 * math.pi * self.bore**2, 0.25 * math.pi * (self.bore**2 - self.rod**2)

    def rooms(self, s):
        whole, ring = self.areas
        dead = self.dead or (0.02 * whole * self.stroke, 0.02 * ring * self.stroke)
        return dead[0] + whole * s, dead[1] + ring * (self.stroke - s)

    def force(self, a, b, v):
        whole, ring = self.areas
        sliding = self.sliding + self.seal * whole * math.hypot(a - b, BAR)
        return (a - PA) * whole - (b - PA) * ring - sliding * math.tanh(v / 0.01) - self.viscous * v


class Link(NamedTuple):
    """A body of a planar arm: mass, moment of inertia, its centre and the next joint from its own joint, unturned."""

    mass: float
    inertia: float
    centre: tuple[float, float]
    tip: tuple[float, float] = (0.0, 0.0)


def turned(angle, x):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * x[0] - s * x[1], s * x[0] + c * x[1]])


class Arm:
    """A chain of links in a vertical plane at relative angles q, up positive, with its speeds; points are those of the unturned arm."""

    def __init__(self, root, links, q, w):
        self.links, self.count = links, len(links)
        self.angle, self.speed = np.cumsum(q), np.cumsum(w)
        self.rest, self.joint = [np.array(root, float)], [np.array(root, float)]
        self.joint_speed, self.joint_bias = [np.zeros(2)], [np.zeros(2)]  # bias: acceleration where all q̈ are 0
        for k, link in enumerate(links):
            arm = turned(self.angle[k], link.tip)
            self.rest.append(self.rest[k] + link.tip)
            self.joint.append(self.joint[k] + arm)
            self.joint_speed.append(self.joint_speed[k] + self.speed[k] * np.array([-arm[1], arm[0]]))
            self.joint_bias.append(self.joint_bias[k] - self.speed[k] ** 2 * arm)

    def point(self, k, rest):
        """(place, velocity, its slopes with q̇) of a point of link k, or of the ground with k = -1."""
        if k < 0:
            return np.array(rest, float), np.zeros(2), np.zeros((2, self.count))
        arm = turned(self.angle[k], np.subtract(rest, self.rest[k]))
        place, slopes = self.joint[k] + arm, np.zeros((2, self.count))
        for j in range(k + 1):
            d = place - self.joint[j]
            slopes[:, j] = -d[1], d[0]
        return place, self.joint_speed[k] + self.speed[k] * np.array([-arm[1], arm[0]]), slopes

    def ram(self, k, one, other):
        """(length, its rate, its slopes with q) between a point of link k - 1 and one of link k."""
        (a, va, Ja), (b, vb, Jb) = self.point(k - 1, one), self.point(k, other)
        length = math.hypot(*(b - a))
        n = (b - a) / length
        return length, float(n @ (vb - va)), n @ (Jb - Ja)

    def accelerate(self, effort):
        """q̈ under generalised efforts and the weight."""
        M, h = np.zeros((self.count, self.count)), np.array(effort, float)
        for k, link in enumerate(self.links):
            centre = turned(self.angle[k], link.centre)
            _, _, J = self.point(k, self.rest[k] + link.centre)
            spin = (np.arange(self.count) <= k).astype(float)
            M += link.mass * J.T @ J + link.inertia * np.outer(spin, spin)
            bias = self.joint_bias[k] - self.speed[k] ** 2 * centre
            h -= link.mass * J.T @ (bias + np.array([0.0, G]))
        return np.linalg.solve(M, h)


def bar(mass, length, height):
    """Moment of inertia of a box about its middle."""
    return mass / 12 * (length**2 + height**2)


def radau(rates, y, times, **settings):
    """The states at `times`, from y at the first one."""
    solved = solve_ivp(
        rates, (times[0], times[-1]), y, "Radau", t_eval=times, **{"rtol": 1e-7, "atol": 1e-8, **settings}
    )
    assert solved.success
    return solved.y
