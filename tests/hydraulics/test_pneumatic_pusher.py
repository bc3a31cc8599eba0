"""The pneumatic pusher against the same equations by SciPy's Radau, from its first movement into the cushion at the end."""

import math
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from circuits import BAR, PA, history
from nivel.api import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "pneumatic-pusher.yaml"
BEGIN, END = 0.15, 0.77
T0, RHO, KAPPA = 293.15, 1.185, 1.4
R = 1e5 / (RHO * T0)
CP, CV = R * KAPPA / (KAPPA - 1), R / (KAPPA - 1)
C = 1e-8  # 1 dm³/(s bar)
WHOLE, RING = 0.25 * math.pi * 0.04**2, 0.25 * math.pi * (0.04**2 - 0.016**2)
STROKE, DEAD, PORT, LINE, LENGTH, WALLS, MASS = 0.25, 30e-6, 10e-6, 40e-6, 0.025, 1.0, 12.0
NODES = ("line_A", "line_B", "A", "B", "port_A", "port_B")


def step(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)


def opening(z, w=0.02):
    """R(z)/R(1)."""
    return (0.0 if z <= 0 else z - 0.5 * w if z >= w else z**3 / w**2 - 0.5 * z**4 / w**3) / (1 - 0.5 * w)


def through(size, one, other, b=0.3):
    """[kg/s] from `one` to `other`, each (p, T); C·opening = `size`."""
    up, down, sign = (one, other, 1.0) if one[0] >= other[0] else (other, one, -1.0)
    x = (up[0] - down[0]) / (up[0] * (1 - b))
    e = 1e-3
    psi = 1.0 if x >= 1 else x * (1 + e * e) ** 0.25 * math.sqrt(2 - x) * (x * x + e * e) ** -0.25
    return sign * size * up[0] * RHO * math.sqrt(T0 / up[1]) * psi


def rooms(s):
    return dict(zip(NODES, (LINE, LINE, DEAD + WHOLE * s, DEAD + RING * (STROKE - s), PORT, PORT), strict=True))


def rates(t, y):
    """Of masses [g] and energies [100 J] of all nodes, spool and its speed, stroke and speed."""
    m, U, (u, spooling, s, v) = y[:6] * 1e-3, y[6:12] * 1e2, y[12:]
    rooms_now, grown = rooms(s), {"A": WHOLE * v, "B": -RING * v}
    state = {"supply": (7 * BAR, T0), "room": (PA, T0)}
    rate_m, rate_U = dict.fromkeys(NODES, 0.0), dict.fromkeys(NODES, 0.0)
    for name, mass, energy in zip(NODES, m, U, strict=True):
        T = energy / (mass * CV)
        state[name] = (mass * R * T / rooms_now[name], T)
        if name not in ("line_A", "line_B"):
            rate_U[name] = WALLS * (T0 - T) - state[name][0] * grown.get(name, 0.0)

    def flow(size, one, other):
        mass_flow = through(size, state[one], state[other])
        heat = mass_flow * CP * state[one if mass_flow >= 0 else other][1]
        for name, sign in ((one, -1.0), (other, 1.0)):
            if name in rate_m:
                rate_m[name] += sign * mass_flow
                rate_U[name] += sign * heat

    def excess(one, other):
        return state[one][0] - state[other][0]

    on, off = opening(2 * min(max(u, 0.0), 1.0) - 1), opening(1 - 2 * min(max(u, 0.0), 1.0))
    flow(4 * C * on, "supply", "line_A")
    flow(4 * C * on, "line_B", "room")
    flow(4 * C * off, "supply", "line_B")
    flow(4 * C * off, "line_A", "room")
    for side, away in (("A", s), ("B", STROKE - s)):
        line, port = f"line_{side}", f"port_{side}"
        flow(0.4 * C, port, line)
        flow(2 * C * step((excess(line, port) - 0.1 * BAR) / (0.3 * BAR)), line, port)
        flow(2 * C * (0.02 + 0.98 * step(away / LENGTH)), side, port)
        flow(2 * C * step((excess(port, side) - 0.05 * BAR) / (0.2 * BAR)), port, side)
    a, b = state["A"][0], state["B"][0]
    sliding = 20.0 + 0.02 * WHOLE * math.hypot(a - b, BAR)
    friction = sliding * (1 + 0.3 * math.exp(-((v / 0.02) ** 2))) * math.tanh(v / 0.004) + 60.0 * v
    force = (a - PA) * WHOLE - (b - PA) * RING - friction
    omega = 50 * math.pi
    command = np.interp(t, [0.1, 0.11], [0.0, 1.0])
    return [
        *(rate_m[name] * 1e3 for name in NODES),
        *(rate_U[name] * 1e-2 for name in NODES),
        spooling,
        omega**2 * (command - u) - 1.6 * omega * spooling,
        v,
        force / MASS,
    ]


def test_the_pusher_moves_as_by_its_equations_written_anew():
    """From a moving state on, until the cushion has braked it; pressures, stroke and speed within 1e-5 of their ranges."""
    result = load(EXAMPLE).simulate(duration=END, tolerance=1e-9, output_interval=0.01, verify=False)
    first = round(BEGIN / 0.01)
    t = np.asarray(result.time)[first:]
    stored = {
        name: name if name.startswith("line") else f"push.{name}" for name in NODES
    }  # where results have what a node is

    def found(kind, name):
        path, _, end = stored[name].partition(".")
        return history(result, f"state.{path}.{kind}_{end}" if end else f"state.{path}.{kind}")[first:]

    def pressure(name):
        path, _, end = stored[name].partition(".")
        return history(result, f"hydraulics.{path}.pressure" + (f"_{end}" if end else ""))[first:]

    motion = [history(result, f"hydraulics.push.{name}")[first:] for name in ("position", "speed")]
    spool = [history(result, f"state.valve.{name}")[first] for name in ("spool", "spool_speed")]
    y0 = [found("mass", name)[0] * 1e3 for name in NODES] + [found("energy", name)[0] * 1e-2 for name in NODES]
    y0 += [*spool, *(each[0] for each in motion)]
    assert y0[-2] > 0
    solved = solve_ivp(rates, (t[0], t[-1]), y0, "Radau", t_eval=t, rtol=1e-8, atol=1e-9)
    volumes = [rooms(s) for s in solved.y[14]]
    for k, name in enumerate(NODES):
        exact = solved.y[6 + k] * 1e2 * (KAPPA - 1) / np.array([each[name] for each in volumes])
        assert np.max(np.abs(pressure(name) - exact)) < 1e-5 * np.ptp(exact), name
    for one, other in zip(motion, solved.y[14:], strict=True):
        assert np.max(np.abs(one - other)) < 1e-5 * np.ptp(other)
    assert 0.247 < motion[0][-1] < STROKE
