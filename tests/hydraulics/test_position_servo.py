"""The digital position servo against the same equations by SciPy's Radau, from sample to sample."""

import math
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from circuits import BAR, LITRE_PER_MINUTE, density, history
from nivel.api import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "position-servo.yaml"
END, PERIOD = 0.24, 4e-3
AREA, DEAD, STROKE, MASS, LEAK = 0.25 * math.pi * 0.05**2, 1e-4, 0.6, 400.0, 2e-12
SUPPLY, TANK, CORNER = 100 * BAR, 1 * BAR, 0.5 * BAR
K = 40 * LITRE_PER_MINUTE / math.sqrt(35 * BAR)


def place(t):
    x = min(max((t - 0.1) / 0.3, 0.0), 1.0)
    return 0.05 * x**3 * (10 + x * (6 * x - 15))


def opening(u, w=0.02):
    """R(u + 0.02)/R(1.02)."""
    z = u + 0.02
    return (0.0 if z <= 0 else z - 0.5 * w if z >= w else z**3 / w**2 - 0.5 * z**4 / w**3) / (1.02 - 0.5 * w)


def rates(y, command):
    """Of stroke from the middle, speed, pressures [bar], spool and its speed."""
    x, v, a, b, u, spooling = y
    a, b, u = a * BAR, b * BAR, min(max(u, -1.0), 1.0)

    def flow(size, p, q):
        return 0.5 * (density(p) + density(q)) * size * (p - q)

    def edge(sign, p, q):
        return flow(K * opening(sign * u) * ((p - q) ** 2 + CORNER**2) ** -0.25, p, q)

    leak = flow(LEAK, a, b)
    into_a, into_b = edge(1, SUPPLY, a) - edge(-1, a, TANK) - leak, edge(-1, SUPPLY, b) - edge(1, b, TANK) + leak

    def rate(p, mass_flow, volume, grown):
        slope = density(p + 1e-20j).imag / 1e-20
        return (mass_flow - density(p) * grown) / (slope * volume) / BAR

    omega = 120 * math.pi
    volumes = DEAD + AREA * (0.5 * STROKE + x), DEAD + AREA * (0.5 * STROKE - x)
    return [
        v,
        AREA * (a - b) / MASS,
        rate(a, into_a, volumes[0], AREA * v),
        rate(b, into_b, volumes[1], -AREA * v),
        spooling,
        omega**2 * (command - y[4]) - 1.4 * omega * spooling,
    ]


def test_the_servo_moves_as_by_its_equations_written_anew():
    """The command is kp times the error at each sample; each quantity within 1e-5 of its range."""
    result = load(EXAMPLE).simulate(
        duration=END, integrator="radau", tolerance=1e-9, step=None, output_interval=PERIOD, verify=False
    )
    names = (
        "rail.displacement",
        *(f"hydraulics.{each}" for each in ("ram.speed", "ram.pressure_A", "ram.pressure_B", "valve.position")),
    )
    found = np.array([history(result, name) for name in names])
    y = [*found[:2, 0], *(found[2:4, 0] / BAR), found[4, 0], 0.0]
    exact = [y[:5]]
    for k in range(round(END / PERIOD)):
        command = min(max(6.0 * (place(k * PERIOD) - y[0]), -1.0), 1.0)
        y = solve_ivp(lambda _, y, u=command: rates(y, u), (0, PERIOD), y, "Radau", rtol=1e-9, atol=1e-11).y[:, -1]
        exact.append(y[:5])
    exact = np.array(exact).T * np.array([1, 1, BAR, BAR, 1])[:, None]
    assert np.ptp(exact[0]) > 0.002
    for name, one, other in zip(names, found, exact, strict=True):
        assert np.max(np.abs(one - other)) < 1e-5 * np.ptp(other), name
