"""Examples of drives: a press with an accumulator against the same equations by SciPy's Radau, and what loader and excavator do."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from circuits import BAR, LITRE_PER_MINUTE, PA, history
from nivel.api import load
from nivel.elements.circuits.fluids import GRADES

EXAMPLES = Path(__file__).parents[2] / "examples" / "hydraulics"
END = 0.7
OIL = GRADES["HLP 46"].at(323.0)
AIR, EXPONENT, CORNER = 0.001, 1.4, 0.5 * BAR
RHO = (1 - AIR) * OIL.density + AIR * 1.2
TANK, MASS, WEIGHT = 1 * BAR, 3000.0, 3000.0 * 9.81
WHOLE, RING = 0.25 * math.pi * 0.125**2, 0.25 * math.pi * (0.125**2 - 0.080**2)
D, TURNING = 45e-6 / (2 * math.pi), 1480 * math.pi / 30
LEAK = 1.5e-12


def law(p):
    """(ρ, dρ/dp)."""
    stretched = 1 + OIL.bulk_modulus_slope * (p - PA) / OIL.bulk_modulus
    liquid, air = stretched ** (-1 / OIL.bulk_modulus_slope), (PA / p) ** (1 / EXPONENT)
    v = (1 - AIR) * liquid + AIR * air
    slope = -(1 - AIR) * liquid / (OIL.bulk_modulus * stretched) - AIR * air / (EXPONENT * p)
    return RHO / v, -RHO / v**2 * slope


def step(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)


def ramp(z, w=0.02):
    return 0.0 if z <= 0 else z - 0.5 * w if z >= w else z**3 / w**2 - 0.5 * z**4 / w**3


def flow(size, a, b):
    """[kg/s] through K·opening = `size`."""
    return 0.5 * (law(a)[0] + law(b)[0]) * size * (a - b) * ((a - b) ** 2 + CORNER**2) ** -0.25


def rated(litres, drop):
    return litres * LITRE_PER_MINUTE / math.sqrt(drop * BAR)


def rates(t, y):
    """Of the pressures in supply, accumulator, A and B [bar], spool and its speed, setting and its speed, stroke and speed."""
    supply, store, a, b = y[:4] * BAR
    spool, spooling, setting, swinging, s, v = y[4:]
    command = np.interp(t, [0.3, 0.6, 1.1], [0.0, 0.55, 0.55])
    allowed = np.interp(supply - TANK, [200 * BAR, 210 * BAR], [1.0, 0.0])
    omega, swash = 24 * math.pi, 12 * math.pi
    x = TURNING * setting
    side = x / math.hypot(x, 1.0)
    suction = 0.5 * (law(TANK)[0] + law(supply)[0]) + 0.5 * (law(TANK)[0] - law(supply)[0]) * side
    pumped = suction * D * x - 0.5 * (law(supply)[0] + law(TANK)[0]) * LEAK * (supply - TANK)
    into = flow(rated(400, 4), supply, store)
    edge = rated(160, 10) * ramp(spool - 0.03) / (0.97 - 0.01)
    to_a, from_b = flow(edge, supply, a), flow(edge, b, TANK)

    def rate(p, mass_flow, volume, grown=0.0, give=0.0):
        rho, slope = law(p)
        return (mass_flow - rho * grown) / (slope * volume + rho * give) / BAR

    left = (150.0 * BAR / store) ** (1 / 1.3)
    oil = 0.02 * 25e-3 + 25e-3 * (1 - left)
    friction = 2e3 + 0.01 * WHOLE * math.hypot(a - b, BAR)
    force = (a - PA) * WHOLE - (b - PA) * RING - friction * math.tanh(v / 0.01) - 20e3 * v
    return [
        rate(supply, pumped - into - to_a, 3e-3),
        rate(store, into, oil, 0.0, 25e-3 * left / (1.3 * store)),
        rate(a, to_a, 2e-3 + WHOLE * s, WHOLE * v),
        rate(b, -from_b, 2e-3 + RING * (0.6 - s), -RING * v),
        spooling,
        omega**2 * (command - spool) - 1.6 * omega * spooling,
        swinging,
        swash**2 * (min(1.0, allowed) - setting) - 1.6 * swash * swinging,
        v,
        (force + WEIGHT) / MASS,
    ]


def test_the_press_moves_as_by_its_equations_written_anew():
    """From the equilibrium to the speed of the slide; each within 1e-5 of its range."""
    machine = load(EXAMPLES / "accumulator-press.yaml")
    result = machine.simulate(duration=END, integrator="radau", tolerance=1e-9, output_interval=0.02, verify=False)
    t = np.asarray(result.time)
    names = [f"hydraulics.{each}" for each in (
        "supply.pressure", "store.pressure", "ram.pressure_A", "ram.pressure_B", "valve.position",
        "pump.setting", "ram.position", "ram.speed")]  # fmt: skip
    found = np.array([history(result, name) for name in names])
    first = found[:, 0]
    y0 = [*(first[:4] / BAR), first[4], 0.0, first[5], 0.0, first[6], 0.0]
    solved = solve_ivp(rates, (0, END), y0, "Radau", t_eval=t, rtol=1e-9, atol=1e-9, max_step=0.01)
    exact = solved.y[[0, 1, 2, 3, 4, 6, 8, 9]] * np.array([*[BAR] * 4, 1, 1, 1, 1])[:, None]
    for name, one, other in zip(names, found, exact, strict=True):
        assert np.max(np.abs(one - other)) < 1e-5 * np.ptp(other), name


def test_pumps_of_the_excavator_share_the_limit_of_their_torque():
    """D ε (p_1 + p_2)/2 of each stays below its limit, and is there while the ground resists; the engine falls along its droop."""
    machine = load(EXAMPLES / "two-pump-excavator.yaml")
    result = machine.simulate(duration=3.0, verify=False)
    digging = np.searchsorted(np.asarray(result.time), 2.5)
    first, second = (history(result, f"hydraulics.{each}.pressure") for each in ("first", "second"))
    displacement = 71e-6 / (2 * math.pi)
    one, two = (
        history(result, f"hydraulics.pump_{each}.setting") * displacement * (0.5 * (first + second) - 3 * BAR)
        for each in ("first", "second")
    )
    assert max(np.max(one), np.max(two)) < 1.04 * 160
    assert two[digging] == pytest.approx(160.0, rel=0.01)
    speed, torque = (history(result, f"hydraulics.diesel.{each}")[digging] for each in ("speed", "torque"))
    assert torque == pytest.approx(450 / (0.05 * 1900 * math.pi / 30) * (1900 * math.pi / 30 - speed), rel=1e-9)


def test_the_loader_drives_by_its_transmission():
    """At a steady speed the motor takes what the pump gives, less the leaks of both: v = R n_pump ε D_p/(i D_m) within these."""
    machine = load(EXAMPLES / "wheel-loader.yaml")
    result = machine.simulate(duration=4.0, verify=False)
    speed = history(result, "road.displacement.rate")[-1]
    engine = history(result, "hydraulics.diesel.speed")[-1]
    ideal = 0.6 * engine * 0.7 * 71 / (20 * 110)
    assert 0.9 * ideal < speed < ideal
    pressure = history(result, "hydraulics.ahead.pressure")[-1] - history(result, "hydraulics.astern.pressure")[-1]
    force = 20 * 110e-6 / (2 * math.pi) * pressure / 0.6
    assert 900 * speed < force < 2.5 * 900 * speed  # friction of the motor is the rest


@pytest.mark.parametrize("inputs", [{}, {"fast": 1}, {"inch": 0.5}])
def test_a_closed_transmission_drives_flushes_and_parks(inputs):
    """On the way up the slope: the force of the motor, the speed by the displacements less leaks, and the lower side is flushed; at the end
    the brake holds."""
    machine = load(EXAMPLES / "closed-transmission.yaml")
    result = machine.simulate(verify=False, inputs=inputs)
    time = np.asarray(result.time)
    k = np.searchsorted(time, 8.9)

    def now(name):
        return history(result, name)[k]

    speed, torque = now("road.displacement.rate"), now("hydraulics.motor.torque")
    gained = np.gradient(history(result, "road.displacement.rate"), time)[k]
    load_ = 4000 * 9.81 * math.sin(math.radians(6)) + 400 * speed + (4000 + 79.19 / 0.45**2) * gained
    assert abs(torque) * 24 / 0.45 == pytest.approx(load_, rel=2e-3)
    share = now("hydraulics.pump.setting") * 45 / (now("hydraulics.motor.setting") * 80)
    ideal = 0.45 * now("hydraulics.diesel.speed") * share / 24
    assert 0.8 * ideal < speed < 0.97 * ideal
    high, low, behind = (now(f"hydraulics.{node}.pressure") for node in ("ahead", "astern", "flushed"))
    assert high > low + 10 * BAR
    conductance = 20 * LITRE_PER_MINUTE / math.sqrt(6 * BAR)
    expected = conductance * math.sqrt(low - behind)
    assert now("hydraulics.flushing.flow_B") == pytest.approx(expected, rel=5e-3)
    assert now("hydraulics.flushing.flow_A") == pytest.approx(0, abs=1e-12)
    assert np.ptp(history(result, "road.displacement")[time > 11.5]) < 1e-9
    assert history(result, "force.parking.capacity")[[0, k, -1]] == pytest.approx([6000, 0, 6000])
