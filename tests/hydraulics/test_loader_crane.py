"""The loader crane against the same equations by SciPy's Radau, while it lifts, folds and slews at once."""

import math
from pathlib import Path

import numpy as np

from circuits import BAR, PA, history
from laws_anew import Arm, Circuit, Link, Oil, Ram, higher, radau, rated, sensing, step, turned
from nivel.api import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "loader-crane.yaml"
BEGIN, END = 0.25, 0.38
# the lift goes down, its counterbalance valve open; the jib folds out through the check valve of its own
WISHES = {"lift": -0.6, "jib": -0.4, "slew": 0.5}
COMMANDS = {
    f"hydraulics.{each}_valve.command": {"of": "time", "times": [0, 0.2, 0.5], "values": [0, 0, WISHES[each]]}
    for each in WISHES
}
OIL, TANK, CCM = Oil(), 2 * BAR, 1e-6 / (2 * math.pi)
LIFT = Ram(0.100, 0.056, 0.55, 0.82, (0.1e-3, 0.3e-3), 800.0, 0.01, 2e4)
JIB = Ram(0.090, 0.050, 0.55, 0.87, (0.3e-3, 0.3e-3), 800.0, 0.01, 2e4)
EYES = (((0.170, 0.386), (0.214, 1.326)), ((1.66, 1.646), (2.61, 1.646)))
HINGE, ELBOW = np.array([-0.090, 1.426]), np.array([2.79, 1.426])
# link, mass, centre (x, z) of the unturned arm, moments of inertia along the arm, in its plane and across
PARTS = (
    (0, 150.0, np.add(HINGE, [1.23, 0.05]), 2.0, 67.0, 67.0),
    (1, 160.0, np.add(ELBOW, [0.42, 0.10]), 2.0, 90.0, 90.0),
    (1, 60.0, np.add(ELBOW, [1.32, 0.10]), 1.0, 20.0, 20.0),
    (1, 250.0, np.array([4.91, 1.126]), 4.0, 4.0, 4.0),
)
COLUMN = 40.0
K, KC = rated(40, 7), rated(60, 3)
NODES = (
    "supply", "lift_gap", "lift_line", "lift_a", "lift_b", "jib_gap", "jib_line", "jib_a", "jib_b", "slew_gap", "slew_a",
    "slew_b",
)  # fmt: skip
SMALL = 5e-6
PORTS = {
    "lift": ("lift_line", "lift_b"),
    "jib": ("jib_a", "jib_line"),
    "slew": ("slew_a", "slew_b"),
}  # A and B of a valve


def link(k, joint, tip):
    parts = [each for each in PARTS if each[0] == k]
    mass = sum(each[1] for each in parts)
    centre = sum(each[1] * each[2] for each in parts) / mass
    inertia = sum(each[4] + each[1] * np.sum((each[2] - centre) ** 2) for each in parts)
    return Link(mass, inertia, tuple(centre - joint), tip)


LINKS = (link(0, HINGE, tuple(ELBOW - HINGE)), link(1, ELBOW, (0.0, 0.0)))


def about_column(arm):
    """Moment of inertia about the axis of the column, and its slopes with the angles of the arm."""
    whole, slopes = COLUMN, np.zeros(2)
    for k, mass, rest, along, _, across in PARTS:
        place, _, J = arm.point(k, rest)
        c, s = turned(arm.angle[k], (1.0, 0.0))
        whole += mass * place[0] ** 2 + along * s * s + across * c * c
        slopes += 2 * mass * place[0] * J[0] + 2 * (along - across) * s * c * (np.arange(2) <= k)
    return whole, slopes


def rates(t, y):
    """Of the pressures [bar], LS [bar], compensators, counterbalance valves, setting, spools and speeds, angles of
    the arm, and speeds of column and arm."""
    nodes = Circuit(OIL, **dict(zip(NODES, y[:12] * BAR, strict=True)), tank=TANK)
    p, ls = nodes.p, y[12] * BAR
    compensators, holding, setting, u, spooling, q, w = y[13:16], y[16:18], y[18], y[19:22], y[22:25], y[25:27], y[27:]
    nodes.turn("tank", "supply", 28 * CCM, setting, 50 * math.pi, 2e-12)
    nodes.poppet("supply", "tank", rated(60, 230), 230 * BAR, 25 * BAR)
    highest, moved = 0.0, []
    for (name, (a, b)), position, own in zip(PORTS.items(), u, compensators, strict=True):
        gap = f"{name}_gap"
        nodes.restrict("supply", gap, KC * own)
        moved.append((step((7 * BAR + ls - p[gap]) / (6 * BAR) + 0.5) - own) / 0.01)
        nodes.spool(position, 0.05, K, gap, "tank", a, b)
        if name != "slew":
            floating = 1 - step(math.hypot(position, 1e-6) / 0.05)
            nodes.restrict(a, "tank", K * floating)
            nodes.restrict(b, "tank", K * floating)
        highest = higher(highest, nodes.felt(position, 0.05, a, b, "tank"))
    opened = []
    for own, (loaded, line, pilot) in zip(
        holding, (("lift_a", "lift_line", "lift_b"), ("jib_b", "jib_line", "jib_a")), strict=True
    ):
        nodes.restrict(loaded, line, rated(60, 7) * own)
        nodes.poppet(line, loaded, rated(60, 5), 0.5 * BAR, 4 * BAR)
        opened.append((step((p[loaded] + 3 * p[pilot] - 4 * PA - 180 * BAR) / (80 * BAR)) - own) / 0.01)
    shaft = nodes.turn("slew_a", "slew_b", 160 * CCM, 1.0, 30 * w[0])
    nodes.poppet("slew_a", "slew_b", rated(60, 100), 100 * BAR, 20 * BAR)
    nodes.poppet("slew_b", "slew_a", rated(60, 100), 100 * BAR, 20 * BAR)
    arm = Arm(HINGE, LINKS, q, w[1:])
    slewed, slopes = about_column(arm)
    effort, chambers = 0.5 * slopes * w[0] ** 2, []
    for k, (name, ram) in enumerate((("lift", LIFT), ("jib", JIB))):
        length, v, lever = arm.ram(k, *EYES[k])
        a, b = f"{name}_a", f"{name}_b"
        effort += ram.force(p[a], p[b], v) * lever
        room_a, room_b = ram.rooms(length - ram.retracted)
        chambers.append((nodes.rate(a, room_a, ram.areas[0] * v), nodes.rate(b, room_b, -ram.areas[1] * v)))
    small = {name: nodes.rate(name, SMALL) for name in NODES if name.endswith(("gap", "line"))}
    wished = np.array(list(WISHES.values())) * min(max((t - 0.2) / 0.3, 0.0), 1.0)
    omega = 16 * math.pi
    return [
        nodes.rate("supply", 1e-3),
        small["lift_gap"],
        small["lift_line"],
        *chambers[0],
        small["jib_gap"],
        small["jib_line"],
        *chambers[1],
        small["slew_gap"],
        nodes.rate("slew_a", 0.3e-3),
        nodes.rate("slew_b", 0.3e-3),
        (highest - ls) / 0.01 / BAR,
        *moved,
        *opened,
        sensing(ls, p["supply"], 20 * BAR, math.inf, setting),
        *spooling,
        *(omega**2 * (wished - u) - 1.6 * omega * spooling),
        *w[1:],
        (-30 * shaft - float(slopes @ w[1:]) * w[0]) / slewed,
        *arm.accelerate(effort),
    ]


def test_the_crane_moves_as_by_its_equations_written_anew():
    """While all valves open: pressures, positions of valves, setting and motion within 1e-5 of their ranges."""
    result = load(EXAMPLE, COMMANDS).simulate(
        duration=END, integrator="radau", tolerance=1e-9, step=None, output_interval=0.01, verify=False
    )
    first = round(BEGIN / 0.01)
    t = np.asarray(result.time)[first:]
    names = [f"hydraulics.{each}" for each in (
        "supply.pressure", "lift_gap.pressure", "lift_line.pressure", "lift.pressure_A", "lift.pressure_B",
        "jib_gap.pressure", "jib_line.pressure", "jib.pressure_A", "jib.pressure_B", "slew_gap.pressure",
        "slew_A.pressure", "slew_B.pressure", "ls.pressure", "lift_compensator.position", "jib_compensator.position",
        "slew_compensator.position", "lift_hold.position", "jib_hold.position", "pump.setting")]  # fmt: skip
    names += [f"state.{each}_valve.{what}" for what in ("spool", "spool_speed") for each in PORTS]
    found = [history(result, each)[first:] for each in names]
    found += [*result.array("joint_coordinate")[first:, 1:].T, *result.array("joint_rate")[first:].T]
    names += ["luffing", "folding", "rate of slewing", "rate of luffing", "rate of folding"]
    found = np.array(found)
    found[:13] /= BAR
    exact = radau(rates, found[:, 0], t, rtol=1e-6, atol=1e-7, max_step=0.05)
    for name, one, other in zip(names, found, exact, strict=True):
        assert np.max(np.abs(one - other)) < 1e-5 * (np.ptp(other) or 1.0), name
    assert np.ptp(found[16]) > 0.2  # of the counterbalance valve of the lift
    assert np.all(np.ptp(found[-3:], axis=1) > 5e-3)
