"""Andrews' squeezing mechanism in its seven relative angles, with or without its spring, by scipy.

Schiehlen (1990); in the IVP test set as "Andrews' squeezing mechanism", whose data, coordinates and end values these are. Every
point is a sum of terms a cos(sᵀq) + b sin(sᵀq), so positions, velocities and accelerations follow exactly from three arrays.
Index one: [M Gᵀ; G 0] [q̈; λ] = [f; -Ġ q̇], integrated from consistent values; over 0.03 s the drift is round-off.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from .solution import Solution

MASSES = np.array([0.04325, 0.00365, 0.02373, 0.00706, 0.0705, 0.00706, 0.05498])
INERTIAS = np.array([2.194e-6, 4.41e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5])
XA, YA, XB, YB, XC, YC = -0.06934, -0.00227, -0.03635, 0.03273, 0.014, 0.072
D, DA, E, EA, RR, RA = 0.028, 0.0115, 0.02, 0.01421, 0.007, 0.00092
SS, SA, SB, SC, SD = 0.035, 0.01874, 0.01043, 0.018, 0.02
TA, TB, U, UA, UB, ZF, ZT, FA = 0.02308, 0.00916, 0.04, 0.01228, 0.00449, 0.02, 0.04, 0.01421
STIFFNESS, FREE_LENGTH, TORQUE = 4530.0, 0.07785, 0.033

START = np.array(
    [
        -0.06171389001427645,
        0.0,
        0.45527981916307037,
        0.22266839016588588,
        0.48736497954384256,
        -0.22266839016588588,
        1.2305474445498212,
    ]
)
# end values at 0.03 s of the IVP test set
PUBLISHED = np.array(
    [
        15.81077119629904,
        -15.75637105984298,
        0.04082224013073101,
        -0.5347301163226948,
        0.5244099658805303,
        0.5347301163226948,
        1.048080741042263,
    ]
)
# their rates, accelerations, and the multipliers of the six loop equations, as published there
PUBLISHED_RATES = np.array(
    [
        1139.920302151208,
        -1424.379294994111,
        11.03291221937134,
        19.29337464421385,
        0.5735699284790808,
        -19.29337464421385,
        0.3231791658026955,
    ]
)
PUBLISHED_ACCELERATIONS = np.array(
    [
        -24631.76316945196,
        51850.37701610329,
        324102.5686413781,
        566749.3645176213,
        16743.62929479361,
        -566749.3645176222,
        9826.520791458423,
    ]
)
PUBLISHED_MULTIPLIERS = np.array(
    [199.175333373191, -29.75531228015052, 23.06654119098399, 31.45271365475927, 22.64249232082739, 11.61740700019673]
)

# angles of the bodies K1 … K7 (and of the terms below) in q = (β, Θ, γ, Φ, δ, Ω, ε)
BETA, CRANK, GAMMA, ARM, DELTA, LINK, EPSILON = range(7)
ANGLES = np.array(
    [
        [1, 0, 0, 0, 0, 0, 0],
        [1, 1, 0, 0, 0, 0, 0],
        [0, 0, 1, 0, 0, 0, 0],
        [0, 0, 0, 1, 1, 0, 0],
        [0, 0, 0, 0, 1, 0, 0],
        [0, 0, 0, 0, 0, 1, 1],
        [0, 0, 0, 0, 0, 0, 1],
    ],
    dtype=float,
)


def sums(*points):
    """(constants, a, b) of planar points: each (x0, y0, {angle: (along, across)}), along·(cos, sin) + across·(-sin, cos)."""
    constant, a, b = [], [], []
    for x0, y0, terms in points:
        ax, bx, ay, by = np.zeros((4, 7))
        for angle, (along, across) in terms.items():
            ax[angle], bx[angle] = along, -across
            ay[angle], by[angle] = across, along
        constant += [x0, y0]
        a += [ax, ay]
        b += [bx, by]
    return np.array(constant), np.array(a), np.array(b)


CENTRES = sums(
    (0, 0, {BETA: (RA, 0)}),
    (0, 0, {BETA: (RR, 0), CRANK: (-DA, 0)}),
    (XB, YB, {GAMMA: (SB, -SA)}),
    (XA, YA, {DELTA: (ZT, 0), ARM: (0, -(E - EA))}),
    (XA, YA, {DELTA: (TA, TB)}),
    (XA, YA, {EPSILON: (0, -U), LINK: (ZF - FA, 0)}),
    (XA, YA, {EPSILON: (-UB, -UA)}),
)
# the point E seen from the crank, minus itself seen from B, from A by K4 and K5, from A by K6 and K7
LOOPS = sums(
    (-XB, -YB, {BETA: (RR, 0), CRANK: (-D, 0), GAMMA: (0, SS)}),
    (-XA, -YA, {BETA: (RR, 0), CRANK: (-D, 0), ARM: (0, E), DELTA: (-ZT, 0)}),
    (-XA, -YA, {BETA: (RR, 0), CRANK: (-D, 0), LINK: (-ZF, 0), EPSILON: (0, U)}),
)
SPRING = sums((XB - XC, YB - YC, {GAMMA: (SD, -SC)}))


def point(terms, q):
    """Values of `terms` and their Jacobian with respect to q."""
    constant, a, b = terms
    c, s = np.cos(ANGLES @ q), np.sin(ANGLES @ q)
    return constant + a @ c + b @ s, (b * c - a * s) @ ANGLES


def bias(terms, q, qdot):
    """The part of the acceleration that is quadratic in the rates."""
    _, a, b = terms
    c, s = np.cos(ANGLES @ q), np.sin(ANGLES @ q)
    return -(a * c + b * s) @ (ANGLES @ qdot) ** 2


def accelerations(q, qdot, *, spring):
    """q̈ of the mechanism; torque TORQUE on the crank, no gravity."""
    return solved(q, qdot, spring=spring)[0]


def solved(q, qdot, *, spring):
    """q̈ and the multipliers λ of the loop equations in M q̈ + Gᵀλ = f."""
    _, P = point(CENTRES, q)
    m = np.repeat(MASSES, 2)
    M = P.T @ (m[:, None] * P) + ANGLES.T @ (INERTIAS[:, None] * ANGLES)
    f = -P.T @ (m * bias(CENTRES, q, qdot))
    f[0] += TORQUE
    if spring:
        d, J = point(SPRING, q)
        length = np.linalg.norm(d)
        f -= J.T @ (STIFFNESS * (length - FREE_LENGTH) / length * d)
    _, G = point(LOOPS, q)
    K = np.block([[M, G.T], [G, np.zeros((6, 6))]])
    both = np.linalg.solve(K, np.concatenate([f, -bias(LOOPS, q, qdot)]))
    return both[:7], both[7:]


@dataclass(frozen=True)
class Motion:
    """The mechanism at n times: q, qdot (n, 7); centres (n, 7, 2) [m]; angles (n, 7) [rad] of the bodies."""

    time: np.ndarray
    q: np.ndarray
    qdot: np.ndarray
    centres: np.ndarray
    angles: np.ndarray


def solve(times, *, spring, rtol=1e-12, atol=1e-13):
    """Motion from rest at START at the given times."""
    states = _solution(float(times[0]), spring, rtol, atol)(times)
    q, qdot = states[:7].T, states[7:].T
    centres = np.array([point(CENTRES, each)[0].reshape(7, 2) for each in q])
    return Motion(times, q, qdot, centres, q @ ANGLES.T)


@cache
def _solution(begin, spring, rtol, atol):
    def rates(_t, state):
        return np.concatenate([state[7:], accelerations(state[:7], state[7:], spring=spring)])

    return Solution(rates, begin, np.concatenate([START, np.zeros(7)]), rtol=rtol, atol=atol)
