"""Both excavators against the same equations by SciPy's Radau, from sample to sample of their control while they dig."""

import math
from pathlib import Path

import numpy as np
import pytest

from circuits import BAR, history
from laws_anew import Arm, Circuit, Link, Oil, Ram, bar, higher, radau, rated, rising, sensing
from nivel.api import load

EXAMPLES = Path(__file__).parents[2] / "examples" / "hydraulics"
PERIOD, CCM = 0.01, 1e-6 / (2 * math.pi)
NAMES = ("boom", "stick", "bucket")
RAMS = {
    "boom": Ram(0.120, 0.080, 0.9, 1.75, None, 1e3, 0.01, 4e3),
    "stick": Ram(0.110, 0.075, 0.7, 1.90, None, 1e3, 0.01, 4e3),
    "bucket": Ram(0.090, 0.060, 0.9, 2.40, None, 1e3, 0.01, 4e3),
}
EYES = (((0.6, 0.9), (2.2, 2.2)), ((2.0, 2.9), (3.9, 3.8)), ((4.3, 3.5), (5.5, 1.0)))
JOINTS = ((0.0, 1.5), (4.2, 3.2), (5.8, 1.4))
BOXES = (
    (1400.0, (0, 1.5), (4.2, 3.2), 0.6),
    (700.0, (3.9, 3.8), (5.8, 1.4), 0.4),
    (500.0, (5.6, 1.5), (5.3, 0.6), 0.7),
)


def chain():
    links = []
    for k, (mass, one, other, height) in enumerate(BOXES):
        middle, length = 0.5 * np.add(one, other), math.dist(one, other)
        tip = np.subtract(JOINTS[k + 1], JOINTS[k]) if k < 2 else (0.0, 0.0)
        links.append(Link(mass, bar(mass, length, height), tuple(middle - JOINTS[k]), tuple(tip)))
    along = np.subtract(BOXES[2][2], BOXES[2][1])
    return links, 0.5 * np.add(*BOXES[2][1:3]) + 0.47 * along / math.hypot(*along)


LINKS, TEETH = chain()
K = rated(100, 8)
OVERLAP, OMEGA, OIL = 0.03, 24 * math.pi, Oil()


def ways(t):
    """Strokes that are asked for."""
    boom = 0.312 - 0.20 * rising(t, 0.3, 1.6) + 0.30 * rising(t, 3.2, 5)
    bucket = 0.373 + 0.25 * rising(t, 2.2, 3.6) - 0.30 * rising(t, 4.7, 5.9)
    return boom, 0.202 + 0.35 * rising(t, 1.4, 3.4), bucket


def dug(t):
    """The soil of the excavator with two pumps, of what it is at most."""
    return rising(t, 1.8, 2.4) - rising(t, 3.0, 3.5)


def soil_of_two(t, arm):
    return np.array([40e3, 15e3]) * dug(t)


def soil_of_one(_, arm):
    place, speed, _ = arm.point(2, TEETH)
    return -20e3 * rising(-place[1], 0.0, 0.2) * speed


def feed_by_two(nodes, y, spools):
    """Rates of both LS signals, the engine and both settings. Pumps, relief valves and the torque of the engine."""
    ls, engine, settings = y[:2] * BAR, y[2], y[3:]
    loads = {name: nodes.felt(u, OVERLAP, f"{name}_A", f"{name}_B", "tank") for name, u in spools.items()}
    signals = higher(higher(0.0, loads["boom"]), loads["bucket"]), higher(0.0, loads["stick"])
    mean = 0.5 * (nodes.over("first", "tank") + nodes.over("second", "tank"))
    share = min(1.0, 160 / (71 * CCM * mean))
    torque, moved = 20.0, []
    for line, setting, signal in zip(("first", "second"), settings, ls, strict=True):
        torque += nodes.turn("tank", line, 71 * CCM, setting, engine, 4e-12)
        nodes.poppet(line, "tank", rated(280, 300), 300 * BAR, 30 * BAR)
        moved.append(sensing(signal, nodes.p[line], 25 * BAR, share, setting))
    asked = 1900 * math.pi / 30
    full = np.interp(engine * 30 / math.pi, [800, 1400, 1900, 2000], [380, 450, 400, 350])
    governed = min(450 / (0.05 * asked) * (asked - engine), full)
    return [
        *((one - own) / 0.01 / BAR for one, own in zip(signals, ls, strict=True)),
        (governed - torque) / 1.6,
        *moved,
    ]


def feed_by_one(nodes, y, spools):
    """Rates of the LS signal and the setting. The pump and its relief valve."""
    highest = 0.0
    for name, u in spools.items():
        highest = higher(highest, nodes.felt(u, OVERLAP, f"{name}_A", f"{name}_B", "tank"))
    nodes.turn("tank", "supply", 140 * CCM, y[1], 60 * math.pi, 4e-12)
    nodes.poppet("supply", "tank", rated(280, 300), 300 * BAR, 30 * BAR)
    return [(highest / BAR - y[0]) / 0.01, sensing(y[0] * BAR, nodes.p["supply"], 25 * BAR, math.inf, y[1])]


EXCAVATORS = {
    "excavator": {
        "tank": 2 * BAR, "lines": dict.fromkeys(NAMES, "supply"), "feed": feed_by_one, "soil": soil_of_one,
        "makeup": ("bucket_A",), "states": ("ls.pressure", "pump.setting"),
    },
    "two-pump-excavator": {
        "tank": 3 * BAR, "lines": {"boom": "first", "stick": "second", "bucket": "first"}, "feed": feed_by_two,
        "soil": soil_of_two, "makeup": ("boom_A", "boom_B", "stick_A", "stick_B", "bucket_A"),
        "states": ("ls_first.pressure", "ls_second.pressure", "diesel.speed", "pump_first.setting", "pump_second.setting"),
    },
}  # fmt: skip


def rates(t, y, example, commands):
    """Of the pressures of lines and chambers [bar], what the pumps have, spools and their speeds, angles and their speeds."""
    lines = list(dict.fromkeys(example["lines"].values()))
    chambers = [f"{name}_{side}" for name in NAMES for side in "AB"]
    count, own = len(lines) + 6, len(example["states"])
    nodes = Circuit(OIL, **dict(zip([*lines, *chambers], y[:count] * BAR, strict=True)), tank=example["tank"])
    rest = y[count + own :]
    u, spooling, q, w = rest[:3], rest[3:6], rest[6:9], rest[9:]
    arm = Arm(JOINTS[0], LINKS, q, w)
    for name, position in zip(NAMES, u, strict=True):
        nodes.spool(position, OVERLAP, K, example["lines"][name], "tank", f"{name}_A", f"{name}_B")
    for chamber in example["makeup"]:
        nodes.poppet("tank", chamber, rated(140, 3), 0.1 * BAR, 0.5 * BAR)
    fed = example["feed"](nodes, y[count : count + own], dict(zip(NAMES, u, strict=True)))
    effort = arm.point(2, TEETH)[2].T @ example["soil"](t, arm)
    pressed = []
    for k, (name, ram) in enumerate(RAMS.items()):
        length, v, lever = arm.ram(k, *EYES[k])
        a, b = f"{name}_A", f"{name}_B"
        effort += ram.force(nodes.p[a], nodes.p[b], v) * lever
        for chamber, room, area in zip((a, b), ram.rooms(length - ram.retracted), ram.areas, strict=True):
            pressed.append(nodes.rate(chamber, room, area * v if chamber == a else -area * v))
    turning = OMEGA**2 * (commands - u) - 1.6 * OMEGA * spooling
    sizes = [nodes.rate(line, 2e-3) for line in lines]
    return [*sizes, *pressed, *fed, *spooling, *turning, *w, *arm.accelerate(effort)]


def commanded(t, q):
    strokes = [
        Arm(JOINTS[0], LINKS, q, 0 * q).ram(k, *EYES[k])[0] - RAMS[name].retracted for k, name in enumerate(NAMES)
    ]
    return np.clip(12 * (np.array(ways(t)) - strokes), -1, 1)


@pytest.mark.parametrize(("name", "begin", "end"), [("excavator", 2.4, 2.55), ("two-pump-excavator", 2.4, 2.55)])
def test_an_excavator_digs_as_by_its_equations_written_anew(name, begin, end):
    """Pressures, settings, spools, speed of the engine and motion of the arm within 1e-5 of their ranges."""
    example = EXCAVATORS[name]
    result = load(EXAMPLES / f"{name}.yaml").simulate(
        duration=end, integrator="radau", tolerance=1e-9, step=None, output_interval=PERIOD, verify=False
    )
    first = round(begin / PERIOD)
    lines = list(dict.fromkeys(example["lines"].values()))
    names = [f"hydraulics.{line}.pressure" for line in lines]
    names += [f"hydraulics.{each}_ram.pressure_{side}" for each in NAMES for side in "AB"]
    names += [f"state.{each}" for each in example["states"]]
    names += [f"state.{each}_valve.{what}" for what in ("spool", "spool_speed") for each in NAMES]
    found = [history(result, each)[first:] for each in names]
    found += [*result.array("joint_coordinate")[first:].T, *result.array("joint_rate")[first:].T]
    names += [f"{what} of {each}" for what in ("angle", "speed") for each in ("foot", "elbow", "wrist")]
    found = np.array(found)
    pressures = ["pressure" in each for each in names]
    found[pressures] /= BAR
    y, exact = found[:, 0], [found[:, 0]]
    for t in np.asarray(result.time)[first:-1]:
        commands = commanded(t, y[-6:-3])
        y = radau(lambda t, y, u=commands: rates(t, y, example, u), y, [t, t + PERIOD])[:, -1]
        exact.append(y)
    exact = np.array(exact).T
    for each, one, other in zip(names, found, exact, strict=True):
        assert np.max(np.abs(one - other)) < 1e-5 * np.ptp(other), each
    arm = Arm(JOINTS[0], LINKS, y[-6:-3], y[-3:])
    assert math.hypot(*example["soil"](end, arm)) > 2e3
