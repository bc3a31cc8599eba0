"""The wheel loader against the same equations by SciPy's Radau, while it drives ahead and lifts its load."""

import math
from pathlib import Path

import numpy as np

from circuits import BAR, history
from laws_anew import Arm, Circuit, Link, Oil, Ram, bar, radau, rated, sensing, turned
from nivel.api import load
from nivel.elements.circuits.fluids import GRADES

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "wheel-loader.yaml"
BEGIN, END = 1.5, 2.2
GRADE = GRADES["HVLP 46"].at(333.0)
OIL = Oil(GRADE.density, GRADE.bulk_modulus, GRADE.bulk_modulus_slope)
TANK, CCM, RPM = 1 * BAR, 1e-6 / (2 * math.pi), math.pi / 30
ROOMS = {"ahead": 1.5e-3, "astern": 1.5e-3, "feed": 1e-3, "supply": 2e-3}
RAM = Ram(0.110, 0.060, 0.65, 1.0, (0.5e-3, 0.5e-3), 800.0, 0.02, 15e3)
RADIUS, RATIO, MOTOR = 0.6, 20.0, 110 * CCM
ROLLING = 5600 + 500 + 450 + 900 + 0.5 * 500 * 0.6**2 / RADIUS**2  # [kg]
# the arm and its load as one body, from its hinge; x ahead, z up
PARTS = ((450.0, (1.1, -0.55), bar(450.0, math.hypot(2.2, 1.1), 0.25)), (900.0, (2.55, -1.1), bar(900.0, 0.7, 0.7)))
LIFTED = sum(m for m, _, _ in PARTS)
CENTRE = np.average([at for _, at, _ in PARTS], axis=0, weights=[m for m, _, _ in PARTS])
INERTIA = sum(J + m * np.sum((np.array(at) - CENTRE) ** 2) for m, at, J in PARTS)
LINK = Link(LIFTED, INERTIA, tuple(CENTRE))
HINGE, FOOT, EYE = (-0.6, 1.7), (-0.5, 0.75), (0.55, 1.0)
# losses of the drive at speeds, pressures and settings: efficiencies as in the file, the setting first, then pressure, then speed
SPEEDS, PRESSURES, SETTINGS = np.array([1000, 2300]) * RPM, np.array([100, 400]) * BAR, np.array([0.3, 1.0])
VOLUMETRIC = np.reshape([0.88, 0.95, 0.78, 0.90, 0.94, 0.97, 0.88, 0.94], (2, 2, 2))
MECHANICAL = np.reshape([0.80, 0.92, 0.86, 0.95, 0.76, 0.90, 0.84, 0.94], (2, 2, 2))
LEAKS = (1 - VOLUMETRIC) * 71 * CCM * SETTINGS * SPEEDS[:, None, None] / PRESSURES[:, None]
FRICTIONS = SETTINGS * (1 / MECHANICAL - 1)
# of the motor Q = D ω/η and T = η D Δp at 300 bar and 1500 rpm
MOTOR_LEAK = (1 / 0.96 - 1) * MOTOR * 1500 * RPM / (300 * BAR)
MOTOR_DRY, MOTOR_VISCOUS = 0.6 * 0.07, 0.4 * 0.07 * MOTOR * 300 * BAR / (1500 * RPM)
NODES = ("ahead", "astern", "feed", "supply", "a", "b")


def lost(table, speed, pressure, setting):
    """Trilinear between the points of the map, the nearest point outside."""
    for axis, x in ((SPEEDS, speed), (PRESSURES, pressure), (SETTINGS, setting)):
        share = min(max((x - axis[0]) / (axis[1] - axis[0]), 0.0), 1.0)
        table = table[0] + share * (table[1] - table[0])
    return table


def limited(command, limit, displacement, height):
    """A setting that is cut by a torque."""
    return min(command, limit / (displacement * height)) if displacement * height > 0 else command


def rates(t, y):
    """Of the pressures [bar], LS [bar], engine, both settings and a speed, spool and its speed, way, speed, angle and its speed."""
    nodes = Circuit(OIL, **dict(zip(NODES, y[:6] * BAR, strict=True)), tank=TANK)
    ls, engine, swash, swinging, work, u, spooling, _, v, phi, turning = y[6:]
    ls *= BAR
    p = nodes.p
    # the drive
    command = np.interp(t, [0.5, 2, 4], [0, 0.7, 0.7])
    height = nodes.over("ahead", "astern")
    torque = nodes.turn("astern", "ahead", 71 * CCM, swash, engine)
    size, running = math.hypot(height, BAR), (math.hypot(engine, 1.0), math.hypot(swash, 1e-6))
    nodes.restrict("ahead", "astern", 0.0, lost(LEAKS, running[0], size, running[1]))
    torque += lost(FRICTIONS, running[0], size, running[1]) * 71 * CCM * size * engine / math.hypot(engine, 1.0)
    for _ in range(2):  # the cases of pump and motor
        nodes.restrict("ahead", "tank", 0.0, 1e-12)
        nodes.restrict("astern", "tank", 0.0, 1e-12)
    shaft = RATIO * v / RADIUS
    resisting = nodes.turn("ahead", "astern", MOTOR, 1.0, shaft, MOTOR_LEAK) + MOTOR_VISCOUS * shaft
    resisting += MOTOR_DRY * MOTOR * math.hypot(height, BAR) * shaft / math.hypot(shaft, 1.0)
    # its feed
    torque += nodes.turn("tank", "feed", 16 * CCM, 1.0, engine)
    nodes.poppet("feed", "tank", rated(60, 25), 22 * BAR, 8 * BAR)
    for line, other in (("ahead", "astern"), ("astern", "ahead")):
        nodes.poppet("feed", line, rated(60, 3), 0.5 * BAR, 3 * BAR)
        nodes.poppet(line, other, rated(150, 400), 380 * BAR, 30 * BAR)
    nodes.restrict("feed", "tank", 0.65 * 0.25 * math.pi * 0.001**2 * math.sqrt(2 / OIL.at(101325.0)[0]))
    # the lift
    torque += nodes.turn("tank", "supply", 45 * CCM, work, engine, 2e-12)
    nodes.poppet("supply", "tank", rated(120, 250), 250 * BAR, 25 * BAR)
    nodes.spool(u, 0.05, rated(90, 10), "supply", "tank", "a", "b")
    allowed = limited(1.0, 150.0, 45 * CCM, nodes.over("supply", "tank"))
    felt = nodes.felt(u, 0.05, "a", "b", "tank")
    load_signal = 0.5 * (felt + math.hypot(felt, 1e4))
    arm = Arm(HINGE, (LINK,), [phi], [turning])
    length, sliding, (lever,) = arm.ram(0, FOOT, EYE)
    room_a, room_b = RAM.rooms(length - RAM.retracted)
    force = RAM.force(p["a"], p["b"], sliding)
    # chassis and arm: the arm pulls at the chassis with m x_c φ̈ …
    c = turned(phi, CENTRE)
    pull = LIFTED * np.array([-c[1], -c[0] * turning**2])  # of d/dt (m ẋ_c) along the road: -m c_z φ̈ - m c_x φ̇²
    about = INERTIA + LIFTED * float(c @ c)
    M = np.array([[ROLLING, pull[0]], [pull[0], about]])
    h = [-RATIO * resisting / RADIUS - 900.0 * v - pull[1], force * lever - LIFTED * 9.81 * c[0]]
    along, bending = np.linalg.solve(M, h)
    governed = 420 / (0.05 * 2200 * RPM) * (2200 * RPM - engine)
    full = np.interp(engine, np.array([800, 1400, 2000, 2300]) * RPM, [330, 420, 360, 250])
    whole, ring = RAM.areas
    wished = np.interp(t, [1.5, 2, 4], [0, 0.6, 0.6])
    omega, drawn = 16 * math.pi, 6 * math.pi
    return [
        *(nodes.rate(name, room) for name, room in ROOMS.items()),
        nodes.rate("a", room_a, whole * sliding),
        nodes.rate("b", room_b, -ring * sliding),
        (load_signal - ls) / 0.01 / BAR,
        (min(max(governed, -60.0), full) - torque - 15.0) / 1.4,
        swinging,
        drawn**2 * (limited(command, 230.0, 71 * CCM, height) - swash) - 1.6 * drawn * swinging,
        sensing(ls, p["supply"], 20 * BAR, allowed, work),
        spooling,
        omega**2 * (wished - u) - 1.6 * omega * spooling,
        v,
        along,
        turning,
        bending,
    ]


def test_the_loader_moves_as_by_its_equations_written_anew():
    """From a moving state to that of driving and lifting; pressures, settings, speeds and motion within 1e-5 of their ranges."""
    result = load(EXAMPLE).simulate(
        duration=END, integrator="radau", tolerance=1e-9, step=None, output_interval=0.02, verify=False
    )
    first = round(BEGIN / 0.02)
    t = np.asarray(result.time)[first:]
    names = [f"hydraulics.{each}" for each in (
        "ahead.pressure", "astern.pressure", "feed.pressure", "supply.pressure", "ram.pressure_A", "ram.pressure_B",
        "ls.pressure", "diesel.speed")]  # fmt: skip
    names += [f"state.{each}" for each in (
        "drive.setting", "drive.setting_speed", "work.setting", "valve.spool", "valve.spool_speed")]  # fmt: skip
    found = [history(result, name)[first:] for name in names]
    found += [result.array(name)[first:, joint] for joint in (0, 2) for name in ("joint_coordinate", "joint_rate")]
    names += ["way", "speed", "angle", "turning"]
    found = np.array(found)
    found[:7] /= BAR
    exact = radau(rates, found[:, 0], t, max_step=0.05)
    for name, one, other in zip(names, found, exact, strict=True):
        assert np.max(np.abs(one - other)) < 1e-5 * np.ptp(other), name
    assert np.ptp(found[0]) > 50 and np.ptp(found[15]) > 0.03  # noqa: PT018
