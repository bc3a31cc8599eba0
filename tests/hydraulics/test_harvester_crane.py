"""The crane of the harvester with its tip control against the same equations by SciPy's Radau, while both sections are open."""

import math
from pathlib import Path

import numpy as np

from circuits import BAR, PA, history
from laws_anew import Arm, Circuit, Link, Oil, Ram, higher, radau, ramp, rated, rising, sensing, step
from nivel.api import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "harvester-crane.yaml"
BEGIN, END = 3.0, 3.14
OIL, TANK, CCM, DEGREE = Oil(), 3 * BAR, 1e-6 / (2 * math.pi), math.pi / 180
HINGE, ELBOW, HEAD = np.array([0.0, 1.8]), np.array([2.2498, 4.4812]), np.array([4.8479, 2.9812])
KNEE = np.array([1.9034, 4.6812])
BOOM, JIB = math.dist(HINGE, ELBOW), math.dist(KNEE, HEAD)
JIB_CENTRE = 0.5 * (KNEE + HEAD)
CENTRE = (200 * JIB_CENTRE + 600 * HEAD) / 800
TURNED = 200 / 12 * (3 * 0.09**2 + JIB**2) + 200 * math.dist(JIB_CENTRE, CENTRE) ** 2
TURNED += 0.4 * 600 * 0.3**2 + 600 * math.dist(HEAD, CENTRE) ** 2
LINKS = (
    Link(350.0, 350 / 12 * (3 * 0.12**2 + BOOM**2), tuple(0.5 * (ELBOW - HINGE)), tuple(ELBOW - HINGE)),
    Link(800.0, TURNED, tuple(CENTRE - ELBOW)),
)
RAMS = {
    "lift": Ram(0.110, 0.064, 0.75, 1.3, (0.4e-3, 0.4e-3), 600.0, 0.02, 25e3),
    "jib": Ram(0.090, 0.050, 0.65, 1.0, (0.4e-3, 0.4e-3), 600.0, 0.02, 25e3),
}
EYES = (((0.35, 0.9), (0.77135, 2.71925)), ((1.0941, 3.4928), (1.9034, 4.6812)))
PORTS = {"lift": ("lift_line", "lift_b"), "jib": ("jib_a", "jib_line")}  # A and B of a section
HELD = (("lift_a", "lift_line", "lift_b"), ("jib_b", "jib_line", "jib_a"))  # L, V and X of a counterbalance valve
NODES = ("supply", *(f"{name}_{end}" for name in PORTS for end in ("m", "c", "line", "a", "b")))
K, BACK = rated(42, 18), rated(80, 18)


def part(t, begin, end):
    return min(max((t - begin) / (end - begin), 0.0), 1.0)


def wishes(t, arm, q, strokes):
    """Positions of both spools that the tip control asks for."""

    def along(begin, end):
        return 0.45 * step(part(t, begin, end))

    def speed(begin, end):
        x = part(t, begin, end)
        return 6 * 0.45 / (end - begin) * x * (1 - x)

    (x, z), _, _ = arm.point(1, HEAD)
    vx = speed(0.2, 2.2) - speed(2.6, 5) + 4 * (HEAD[0] + along(0.2, 2.2) - along(2.6, 5) - x)
    vz = 4 * (HEAD[1] - z)
    boom = 50 * DEGREE + q[0]
    jib = boom - 80 * DEGREE + q[1]
    bend = 3.5 * 3 * math.sin(jib - boom)
    boom_rate = 3 * (vx * math.cos(jib) + vz * math.sin(jib)) / bend
    across, above = 3.5 * math.cos(boom) + 3 * math.cos(jib), 3.5 * math.sin(boom) + 3 * math.sin(jib)
    jib_rate = -(vx * across + vz * above) / bend
    lift = 0.96566 * 1.2 * math.sin(boom + 68.749 * DEGREE) / (1.3 + strokes[0]) * boom_rate
    reach = -1.52069 * 0.4 * math.sin(70.54 * DEGREE - q[1]) / (1 + strokes[1]) * jib_rate
    out = []
    for v, whole, rod in ((lift, 0.0095033, 0.0032170), (reach, 0.0063617, 0.0019635)):
        litres = 6e4 * v * (whole - rod * (1 - rising(v, 0, 0.001)))
        out.append(math.tanh(litres / 2) * (0.05 + 0.95 * abs(litres) / 42))
    return np.clip(out, -1, 1)


def rates(t, y):
    """Of the pressures and LS [bar], setting, compensators, counterbalance valves, spools and speeds, angles and speeds."""
    nodes = Circuit(OIL, **dict(zip(NODES, y[:11] * BAR, strict=True)), tank=TANK)
    p, ls, setting = nodes.p, y[11] * BAR, y[12]
    compensators, holding, u, spooling, q, w = (y[k : k + 2] for k in range(13, 25, 2))
    nodes.turn("tank", "supply", 28 * CCM, setting, 50 * math.pi, 2e-12)
    nodes.poppet("supply", "tank", rated(60, 230), 230 * BAR, 25 * BAR)
    nodes.poppet("tank", "lift_b", rated(80, 2), 0.2 * BAR, 3 * BAR)
    highest, moved, opened = 0.0, [], []
    for (name, (a, b)), position, own in zip(PORTS.items(), u, compensators, strict=True):
        m, c = f"{name}_m", f"{name}_c"
        nodes.restrict(m, c, 2 * K * own)
        moved.append((step((p[m] - ls - 1 * BAR) / (3 * BAR) + 0.5) - own) / 0.01)
        for sign, fed, drained in ((1, a, b), (-1, b, a)):
            opening = ramp(sign * min(max(position, -1.0), 1.0) - 0.05) / (0.95 - 0.01)
            nodes.restrict("supply", m, K * opening)
            nodes.restrict(c, fed, 4 * K * opening)
            nodes.restrict(drained, "tank", BACK * opening)
        highest = higher(highest, nodes.felt(position, 0.05, a, b, "tank"))
    for own, (loaded, line, pilot) in zip(holding, HELD, strict=True):
        nodes.restrict(loaded, line, rated(80, 20) * own)
        nodes.poppet(line, loaded, rated(80, 4), 0.5 * BAR, 16 * BAR)
        opened.append((step((p[loaded] + 1.5 * p[pilot] - 2.5 * PA - 200 * BAR) / (200 * BAR)) - own) / 0.02)
    arm = Arm(HINGE, LINKS, q, w)
    effort, pressed, strokes = np.zeros(2), {}, []
    for k, (name, ram) in enumerate(RAMS.items()):
        length, v, lever = arm.ram(k, *EYES[k])
        a, b = f"{name}_a", f"{name}_b"
        effort += ram.force(p[a], p[b], v) * lever
        strokes.append(length - ram.retracted)
        room_a, room_b = ram.rooms(strokes[k])
        pressed[a], pressed[b] = nodes.rate(a, room_a, ram.areas[0] * v), nodes.rate(b, room_b, -ram.areas[1] * v)
    rooms = {"supply": 1e-3, "m": 30e-6, "c": 30e-6, "line": 50e-6}
    omega = 24 * math.pi
    return [
        *(pressed[name] if name in pressed else nodes.rate(name, rooms[name.split("_")[-1]]) for name in NODES),
        (highest - ls) / 0.01 / BAR,
        sensing(ls, p["supply"], 20 * BAR, math.inf, setting, response=0.06),
        *moved,
        *opened,
        *spooling,
        *(omega**2 * (wishes(t, arm, q, strokes) - u) - 1.6 * omega * spooling),
        *w,
        *arm.accelerate(effort),
    ]


def test_the_harvester_moves_as_by_its_equations_written_anew():
    """On the way back, both sections open: pressures, positions of valves and motion within 1e-5 of their ranges."""
    result = load(EXAMPLE).simulate(
        duration=END, integrator="radau", tolerance=1e-9, step=None, output_interval=0.01, verify=False
    )
    first = round(BEGIN / 0.01)
    names = ["hydraulics.supply.pressure"]
    for section, line, ram in (("lift_section", "lift_line", "lift"), ("jib_section", "reach_line", "reach")):
        names += [f"hydraulics.{each}" for each in (
            f"{section}.pressure_M", f"{section}.pressure_C", f"{line}.pressure", f"{ram}.pressure_A", f"{ram}.pressure_B"
        )]  # fmt: skip
    names += ["hydraulics.ls.pressure", "state.pump.setting"]
    names += [f"state.{each}_section.compensator_position" for each in PORTS]
    names += [f"state.{each}_hold.position" for each in ("lift", "reach")]
    names += [f"state.{each}_section.{what}" for what in ("spool", "spool_speed") for each in PORTS]
    found = [history(result, each)[first:] for each in names]
    found += [*result.array("joint_coordinate")[first:].T, *result.array("joint_rate")[first:].T]
    names += [f"{what} of {each}" for what in ("angle", "speed") for each in ("luffing", "folding")]
    found = np.array(found)
    found[:12] /= BAR
    exact = radau(rates, found[:, 0], np.asarray(result.time)[first:], rtol=1e-6, atol=1e-7)
    for name, one, other in zip(names, found, exact, strict=True):
        assert np.max(np.abs(one - other)) < 1e-5 * max(np.ptp(other), 1e-3), name
