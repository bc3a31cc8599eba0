"""The pneumatic pick and place against the same equations by SciPy's Radau, its speed of computation and what it does."""

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from circuits import BAR, history
from nivel.api import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "pick-and-place.yaml"
END = 0.44
PA, T0, KAPPA = 101325.0, 293.15, 1.4
R = 1e5 / (1.185 * T0)
CP, CV = R * KAPPA / (KAPPA - 1), R / (KAPPA - 1)
C = 1e-8  # 1 dm³/(s bar)
WALLS, STOP, G = 60.0, 4e6, 9.81
SUPPLY = 7 * BAR
# volume → (constant part [m³], heat through its walls without what grows with the volume [W/K])
VOLUMES = {
    "axis.A": 20e-6, "axis.B": 20e-6, "lift.A": 10e-6, "lift.B": 10e-6, "out_A": 20e-6, "out_B": 20e-6, "low_A": 10e-6,
    "low_B": 10e-6, "nozzle": 8e-6, "cup": 60e-6,
}  # fmt: skip
SURFACE = {"out_A": 60e-4, "out_B": 60e-4, "low_A": 40e-4, "low_B": 40e-4, "cup": 80e-4}
RAMS = {"axis": (0.032, 0.012, 0.300, 8.0), "lift": (0.025, 0.010, 0.120, 5.0)}  # bore, rod, stroke, friction
NAMES = list(VOLUMES)


def smooth(t, begin, end):
    t = min(max((t - begin) / (end - begin), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def rising(t, begin, end):
    """`step` of machine files."""
    t = min(max((t - begin) / (end - begin), 0.0), 1.0)
    return t**3 * (10 + t * (6 * t - 15))


def pulse(t, begin, end):
    return rising(t, begin, begin + 0.02) - rising(t, end, end + 0.02)


def opening(z, w=0.02):
    """R(z)/R(1)."""
    out = 0.0 if z <= 0 else z - 0.5 * w if z >= w else z**3 / w**2 - 0.5 * z**4 / w**3
    return out / (1 - 0.5 * w)


def through(size, one, other, b=0.3):
    """[kg/s] from `one` to `other`, each (p, T); C·opening = `size`."""
    if size == 0.0:
        return 0.0
    up, down, sign = (one, other, 1.0) if one[0] >= other[0] else (other, one, -1.0)
    x = (up[0] - down[0]) / (up[0] * (1 - b))
    e = 1e-3
    psi = 1.0 if x >= 1 else x * (1 + e * e) ** 0.25 * math.sqrt(2 - x) * (x * x + e * e) ** -0.25
    return sign * size * up[0] * 1.185 * math.sqrt(T0 / up[1]) * psi


def geometry(ram, s):
    """Volumes of A and B without their dead ones, areas, and walls [m²] of each at the stroke s."""
    bore, rod, stroke, _ = RAMS[ram]
    whole, ring = 0.25 * math.pi * bore**2, 0.25 * math.pi * (bore**2 - rod**2)
    dead = VOLUMES[f"{ram}.A"]
    a, b = whole * s + dead, ring * (stroke - s) + dead
    return a, b, whole, ring, 2 * whole + math.pi * bore * a / whole, 2 * ring + math.pi * (bore + rod) * b / ring


def rates(t, y):
    """Of 1e3 m and 1e-2 U of all volumes, spools and their speeds, and stroke and speed of both axes."""
    m, U = y[:20:2] * 1e-3, y[1:20:2] * 1e2
    valves, (x, xv, d, dv) = y[20:24], y[24:28]
    shapes = {"axis": geometry("axis", x), "lift": geometry("lift", d)}
    speeds = {"axis": xv, "lift": dv}
    state = {"supply": (SUPPLY, T0), "room": (PA, T0)}
    rate_m, rate_U = dict.fromkeys(NAMES, 0.0), dict.fromkeys(NAMES, 0.0)
    for k, name in enumerate(NAMES):
        T = U[k] / (m[k] * CV)
        ram, _, side = name.partition(".")
        volume, walls = VOLUMES[name], SURFACE.get(name, 0.0)
        if side:
            a, b, whole, ring, at_a, at_b = shapes[ram]
            volume, walls, grown = (a, at_a, whole * speeds[ram]) if side == "A" else (b, at_b, -ring * speeds[ram])
        p = m[k] * R * T / volume
        state[name] = (p, T)
        rate_U[name] = WALLS * walls * (T0 - T) - (p * grown if side else 0.0)

    def flow(size, one, other, b=0.3):
        carry(through(size, state[one], state[other], b), one, other)

    def carry(mass_flow, one, other):
        heat = mass_flow * CP * state[one if mass_flow >= 0 else other][1]
        for name, sign in ((one, -1.0), (other, 1.0)):
            if name in rate_m:
                rate_m[name] += sign * mass_flow
                rate_U[name] += sign * heat

    for ram, size, position, out in (("axis", 2.0, valves[0], "out"), ("lift", 1.5, valves[2], "low")):
        u = min(max(position, 0.0), 1.0)
        on, off = opening(2 * u - 1), opening(1 - 2 * u)
        flow(size * C * on, "supply", f"{ram}.A")
        flow(size * C * on, f"{ram}.B", f"{out}_B")
        flow(size * C * off, "supply", f"{ram}.B")
        flow(size * C * off, f"{ram}.A", f"{out}_A")
    for side in "AB":
        flow(0.25 * C, f"out_{side}", "room")
        flow(0.20 * C, f"low_{side}", "room")
    flow(C * opening(pulse(t, 0.3, 2.3)), "supply", "nozzle")
    flow(0.15 * C, "nozzle", "room", 0.5)
    flow(2e-3 * C, "room", "cup")
    vacuum = PA - state["cup"][0]
    drawn = np.interp(vacuum, [0.0, 0.4 * BAR, 0.85 * BAR], [40.0, 18.0, 0.0]) * 1e-3 / 60
    carry(1.185 * drawn * smooth(state["nozzle"][0] - PA, 0.0, 3 * BAR), "cup", "room")

    def force(ram, s, v):
        _, _, stroke, sliding = RAMS[ram]
        a, b = state[f"{ram}.A"][0], state[f"{ram}.B"][0]
        _, _, whole, ring, _, _ = shapes[ram]
        friction = (sliding + 0.01 * whole * math.hypot(a - b, BAR)) * math.tanh(v / 0.01) + 60.0 * v
        stops = STOP * (max(-s, 0.0) - max(s - stroke, 0.0))
        return (a - PA) * whole - (b - PA) * ring - friction + stops

    part = 19.6 * rising(0.93 * BAR - state["cup"][0], 0.0, 0.3 * BAR)
    omega = 60 * math.pi
    commands = pulse(t, 1.0, 2.6), pulse(t, 0.2, 0.8) + pulse(t, 1.9, 2.4)
    out = [each for name in NAMES for each in (rate_m[name] * 1e3, rate_U[name] * 1e-2)]
    for k, command in enumerate(commands):
        out += [valves[2 * k + 1], omega**2 * (command - valves[2 * k]) - 1.6 * omega * valves[2 * k + 1]]
    return [*out, xv, force("axis", x, xv) / 9.0, dv, (force("lift", d, dv) + 3.0 * G + part) / 3.0]


@cache
def machine():
    """The example whose end stops give back all of the speed, which is what a spring without damping does."""
    return load(EXAMPLE, {f"hydraulics.{ram}.stop_restitution": 1 for ram in RAMS})


def test_the_axes_and_the_vacuum_are_those_of_the_equations_written_anew():
    """From the equilibrium, while the lifting axis goes down and the cup takes its part; each within 1e-5 of its range."""
    result = machine().simulate(duration=END, tolerance=1e-8, output_interval=0.02, verify=False)
    t = np.asarray(result.time)
    names = [f"hydraulics.{each}" for each in (
        "axis.pressure_A", "axis.pressure_B", "lift.pressure_A", "lift.pressure_B", "out_A.pressure", "out_B.pressure",
        "low_A.pressure", "low_B.pressure", "nozzle.pressure", "cup.pressure")]  # fmt: skip
    found = {name: history(result, name) for name in (*names, "hydraulics.lift.position", "hydraulics.lift.speed")}
    y0 = []
    for name, path in zip(NAMES, names, strict=True):
        state = f"state.{path.removeprefix('hydraulics.')}"
        mass = history(result, state.replace("pressure", "mass"))[0]
        y0 += [mass * 1e3, history(result, state.replace("pressure", "energy"))[0] * 1e-2]
        assert VOLUMES[name] > 0
    y0 += [0.0] * 4
    for ram in RAMS:
        y0 += [history(result, f"hydraulics.{ram}.position")[0], history(result, f"hydraulics.{ram}.speed")[0]]
    solved = solve_ivp(rates, (0, END), y0, "Radau", t_eval=t, rtol=1e-7, atol=1e-8, max_step=0.01)
    exact = {}
    for k, (name, path) in enumerate(zip(NAMES, names, strict=True)):
        ram, _, side = name.partition(".")
        s = solved.y[{"axis": 24, "lift": 26}.get(ram, 24)]
        volume = geometry(ram, s)["AB".index(side)] if side else VOLUMES[name]
        exact[path] = solved.y[2 * k + 1] * 1e2 * (KAPPA - 1) / volume
    exact["hydraulics.lift.position"], exact["hydraulics.lift.speed"] = solved.y[26], solved.y[27]
    for name, other in exact.items():
        size = max(np.ptp(other), 0.01 * BAR) if "pressure" in name else np.ptp(other)
        assert np.max(np.abs(found[name] - other)) < 1e-5 * size, name
    assert found["hydraulics.lift.position"][-1] > 0.06
    assert found["hydraulics.cup.pressure"][-1] < 0.9 * BAR


def test_the_example_starts_at_rest_and_takes_its_part_over():
    """It rests until its first command; the axis goes to its end and back, the cup holds between; and one run in 1 ms is near the other."""
    result = load(EXAMPLE).simulate(verify=False)
    t = np.asarray(result.time)
    place, lift = (history(result, f"hydraulics.{ram}.position") for ram in RAMS)
    assert np.abs(lift[t < 0.2] - lift[0]).max() < 1e-6
    assert place.max() == pytest.approx(0.3, abs=1e-3)
    assert place[-1] == pytest.approx(0.0, abs=1e-3)
    assert history(result, "hydraulics.cup.pressure")[np.searchsorted(t, 2.2)] < 0.3 * BAR
    steps = load(EXAMPLE).simulate(
        integrator="extrapolated-euler", step=1e-3, tolerance=None, output_interval=2e-3, verify=False
    )
    for ram in RAMS:
        for side in "AB":
            one, other = (history(each, f"hydraulics.{ram}.pressure_{side}") for each in (result, steps))
            assert np.abs(one - other).max() < 0.01 * np.ptp(one)
