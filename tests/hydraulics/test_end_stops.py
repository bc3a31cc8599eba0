"""End stops: levers of the demos held until cylinders are at their ends, and a piston that hits its stop, at steps for real time.

A cylinder at rest at its end has the pressure at which the relief valve takes the whole flow of the pump, the other chamber that of the
tank, and an overlap of (force of the pressures - force of the load)/stiffness with its stop.
"""

import math
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import brentq

import nivel
from circuits import BAR, PA, density, history
from lanes import tail
from nivel.demos import demo_file
from simulating import machine

pytestmark = pytest.mark.covering

G, STIFFNESS = 9.81, 2e8
# A load that swings takes long to come to rest. Contacts without friction and dampers of heavy bodies are soft beside 2 ms, so all steps
# are those with derivatives by hand; the slower form has cases of its own.
CALM = {
    "loader-crane": {
        "forces.swing_x.damping": 1000, "forces.swing_y.damping": 1000,
        "bodies.extension.inertia": [20, 20, 20], "forces.landing.friction": 0,
        "markers.yard.position": [0, 0, -20],
    },
    "excavator": {"forces.digging.friction": 0, "markers.yard.position": [0, 0, -20]},
}  # fmt: skip


class Held(NamedTuple):
    """A lever that is held, and the end to which it brings a cylinder."""

    demo: str
    lever: str
    value: float
    cylinder: str
    end: int
    duration: float


HELD = [
    Held("loader-crane", "extension_lever", 1, "extend", 1, 11.0),
    Held("loader-crane", "extension_lever", -1, "extend", 0, 4.0),
    Held("loader-crane", "lift_lever", 1, "lift", 1, 12.0),
    Held("loader-crane", "lift_lever", -1, "lift", 0, 12.0),
    Held("loader-crane", "jib_lever", -1, "jib", 1, 12.0),
    Held("loader-crane", "jib_lever", 1, "jib", 0, 12.0),
    Held("excavator", "boom_lever", 1, "lift", 1, 12.0),
    Held("excavator", "boom_lever", -1, "lift", 0, 12.0),
    Held("excavator", "stick_lever", 1, "crowd", 0, 12.0),
    Held("excavator", "stick_lever", -1, "crowd", 1, 12.0),
    Held("excavator", "bucket_lever", 1, "curl", 0, 12.0),
    Held("excavator", "bucket_lever", -1, "curl", 1, 12.0),
]  # fmt: skip
STEPS = [0.25e-3, 0.5e-3, 1e-3, 2e-3]
CASES = [(held, step) for step in STEPS for held in HELD]
DEFAULT = [(held, 1e-3) for held in HELD] + [(HELD[k], step) for k in (1, 9) for step in (0.5e-3, 2e-3)]


@cache
def loaded(demo):
    return nivel.load(demo_file(demo), CALM[demo])


def held_for(held, duration, **settings):
    settings = {"integrator": "extrapolated-euler", "output_interval": 4e-3, **settings}
    return loaded(held.demo).simulate(duration=duration, inputs={held.lever: held.value}, **settings)


@cache
def run(held, step):
    return held_for(held, held.duration, step=step)


def items(result):
    return {item.name: item for item in result.trust.items}


def pressure_of_relief(demo):
    """ρ_in D ω - ρ̄ C (p - p_T) = ρ̄ K S((p - p_T - opens_at)/range) √(p - p_T): where the pump delivers all through the relief valve."""
    circuit = {component.name: component for component in loaded(demo).record.hydraulics}
    pump, relief, low = circuit["pump"], circuit["relief"], circuit["tank"].pressure

    def left(p):
        over = p - low
        t = min(max((over - relief.opens_at) / relief.opening_range, 0.0), 1.0)
        through = relief.flow / math.sqrt(relief.pressure_drop) * t * t * (3.0 - 2.0 * t) * math.sqrt(over)
        mean = 0.5 * (density(p) + density(low))
        return density(low) * pump.displacement * pump.speed - mean * (pump.leakage * over + through)

    return brentq(left, relief.opens_at, 2.0 * relief.opens_at)


class Placed:
    """Points and weights of a machine at the end of a run, in the plane x, z."""

    def __init__(self, demo, result):
        self.bodies = {body.name: body for body in loaded(demo).record.bodies}
        self.places = {name: k for k, name in enumerate(self.bodies)}
        self.position, self.theta = result.array("position")[-1], result.array("orientation")[-1]
        self.first, self.first_theta = result.array("position")[0], result.array("orientation")[0]

    def turned(self, theta, x):
        e0, e = theta[0], theta[1:]
        return x + 2.0 * np.cross(e, np.cross(e, x) + e0 * x)

    def at(self, body, point):
        """Where the point of a body is now that was at `point` at the start."""
        k = self.places[body]
        inverse = self.first_theta[k] * np.array([1.0, -1.0, -1.0, -1.0])
        return self.position[k] + self.turned(self.theta[k], self.turned(inverse, np.array(point) - self.first[k]))

    def weight(self, body):
        """(centre of mass, weight)."""
        record, k = self.bodies[body], self.places[body]
        centre = np.array(record.centre_of_mass or [0.0, 0.0, 0.0], dtype=float)
        return self.position[k] + self.turned(self.theta[k], centre), np.array([0.0, 0.0, -record.mass * G])

    def moment(self, pivot, *forces):
        """About the axis y, of (point, force)."""
        return sum(np.cross(point - pivot, force)[1] for point, force in forces)


def force_of_load(held, result):
    """The thrust [N] of the cylinder that carries the weights of what it moves, by moments about the pivot."""
    placed = Placed(held.demo, result)
    joints = {joint.name: joint for joint in loaded(held.demo).record.joints}
    cylinder = {component.name: component for component in loaded(held.demo).record.hydraulics}[held.cylinder]
    (carrier, moved), (start, end) = cylinder.bodies, cylinder.points
    foot, eye = placed.at(carrier, start), placed.at(moved, end)
    along = (eye - foot) / np.linalg.norm(eye - foot)
    if held.cylinder == "extend":
        return sum(-placed.weight(body)[1] @ along for body in ("extension", "load"))
    pivots = {
        ("loader-crane", "lift"): ("luffing", ["boom", "jib", "extension", "load"]),
        ("loader-crane", "jib"): ("folding", ["jib", "extension", "load"]),
        ("excavator", "lift"): ("foot", ["boom", "stick", "rocker", "bucket"]),
        ("excavator", "crowd"): ("elbow", ["stick", "rocker", "bucket"]),
        ("excavator", "curl"): ("pivot", ["rocker"]),
    }
    joint, bodies = pivots[held.demo, held.cylinder]
    pivot = placed.at(moved, joints[joint].point)
    load = placed.moment(pivot, *(placed.weight(body) for body in bodies))
    if held.cylinder == "curl":  # the link between rocker and bucket carries along its own line alone
        on_rocker, on_bucket = (
            placed.at(*each) for each in zip(("rocker", "bucket"), joints["link"].points, strict=True)
        )
        wrist, line = placed.at("bucket", joints["wrist"].point), (on_rocker - on_bucket)
        tension = placed.moment(wrist, placed.weight("bucket")) / placed.moment(wrist, (on_bucket, line))
        load += placed.moment(pivot, (on_rocker, tension * line))
    return -load / placed.moment(pivot, (eye, along))


@pytest.mark.parametrize("case", tail(CASES, DEFAULT))
def test_a_cylinder_at_its_end_rests_at_the_closed_form(case):
    held, step = case
    result = run(held, step)
    cylinder = {component.name: component for component in loaded(held.demo).record.hydraulics}[held.cylinder]
    names = ("position", "speed", "pressure_A", "pressure_B")
    position, speed, in_A, in_B = (history(result, f"hydraulics.{held.cylinder}.{name}") for name in names)
    high = pressure_of_relief(held.demo)
    assert (in_A[-1], in_B[-1]) == pytest.approx((high, 2 * BAR) if held.end == 1 else (2 * BAR, high), rel=1e-3)
    whole, ring = 0.25 * math.pi * cylinder.piston**2, 0.25 * math.pi * (cylinder.piston**2 - cylinder.rod**2)
    thrust = (in_A[-1] - PA) * whole - (in_B[-1] - PA) * ring
    overlap = position[-1] - cylinder.stroke if held.end == 1 else -position[-1]
    # the jib has its dead centre just above the lower end: there its load carries all of the thrust, and no stop
    stop = (1 if held.end == 1 else -1) * STIFFNESS * max(overlap, 0.0)
    assert stop == pytest.approx(thrust - force_of_load(held, result), abs=5e-3 * abs(thrust))
    assert overlap > (-1e-3 if held.cylinder == "jib" else 0.0)
    assert np.max(np.abs(speed[-100:])) < (1e-4 if overlap > 0.0 else 5e-4)
    assert items(result)["energy"].fraction < 3e-4 * max(1.0, step / 1e-3) ** 2
    assert items(result)["hydraulics"].fraction < 2e-3


@pytest.mark.parametrize("case", tail(CASES, DEFAULT[::2]))
def test_steps_at_an_end_cost_as_much_as_others(case):
    """Evaluations and divided steps from shortly before the end is met, beside those of the way to it."""
    held, step = case
    result = run(held, step)
    position = history(result, f"hydraulics.{held.cylinder}.position")
    stroke = {component.name: component for component in loaded(held.demo).record.hydraulics}[held.cylinder].stroke
    at_end = position > stroke if held.end == 1 else position < 0.0
    before = held_for(held, result.time[np.flatnonzero(at_end)[0] - 5], step=step).timing
    whole = result.timing
    steps = whole["steps"] - before["steps"]
    assert steps * step > 0.5
    assert whole["rejected"] - before["rejected"] <= 5
    cost = (whole["evaluations"] - before["evaluations"]) / steps
    assert cost < 1.05 * before["evaluations"] / before["steps"]


# not the jib that stops short of its lower end, at its dead centre, where its place hangs on every pressure
@pytest.mark.parametrize("held", tail([each for each in HELD if (each.cylinder, each.end) != ("jib", 0)], [HELD[1]]))
def test_a_cylinder_comes_to_its_end_as_by_radau(held):
    """The jib on its way up needs steps of 0.5 ms: 1 ms leave 3.0e-4 m and 4.2 bar, half of them less than half of that."""
    exact = held_for(held, held.duration, integrator="radau", tolerance=1e-6)
    jib = held.cylinder == "jib"
    found = run(held, 5e-4 if jib else 1e-3)

    def distance(result, name):
        ours, theirs = (history(each, f"hydraulics.{held.cylinder}.{name}") for each in (result, exact))
        return np.sqrt(np.mean((ours - theirs) ** 2)), abs(ours[-1] - theirs[-1])

    for name, allowed in (("position", 2e-4), ("pressure_A", 2 * BAR), ("pressure_B", 2 * BAR)):
        mean, last = distance(found, name)
        assert mean < allowed, name
        assert last < 1e-2 * allowed, name
        if jib:
            assert mean < 0.5 * distance(run(held, 1e-3), name)[0], name


def ram(mass, gap, coordinates="relative", push="20 bar", **more):
    """A mass on a piston between two pressures behind wide orifices, which meets its stop after `gap`."""
    wide = {"type": "orifice", "flow": "200 L/min", "pressure_drop": "5 bar"}
    place = 1.5 - gap
    return machine({
        "gravity": [0, 0, 0],
        "bodies": {"head": {"mass": mass, "inertia": [1, 1, 1], "position": [place, 0, 0], "velocity": [0.2, 0, 0]}},
        "joints": {"rail": {"type": "translational", "bodies": ["ground", "head"], "point": [0, 0, 0], "axis": [1, 0, 0]}},
        "hydraulics": {
            "high": {"type": "tank", "pressure": push},
            "low": {"type": "tank", "pressure": "2 bar"},
            "a": {**wide, "ports": {"A": "high", "B": "ram.A"}},
            "b": {**wide, "ports": {"A": "ram.B", "B": "low"}},
            "ram": {
                "type": "cylinder", "bodies": ["ground", "head"], "points": [[0, 0, 0], [place, 0, 0]], "piston": "60 mm",
                "rod": "40 mm", "stroke": 0.5, "retracted_length": 1.0, "dead_volume_A": "0.2 L", "dead_volume_B": "0.2 L",
                "start_A": push, "start_B": "2 bar", **more,
            },
        },
        "simulation": {"coordinates": coordinates, "integrator": "extrapolated-euler", "step": "1 ms"},
    })  # fmt: skip


def moved(result):
    return (history(result, f"hydraulics.ram.{name}") for name in ("position", "speed"))


HITS = [
    (coordinates, mass, step) for coordinates in ("relative", "absolute") for mass in (20, 100, 1000) for step in STEPS
]


@pytest.mark.parametrize("case", tail(HITS, [each for each in HITS if each[2] >= 1e-3 and each[1] != 1000]))
def test_a_piston_that_hits_its_stop_is_not_thrown_back(case):
    """Whenever within a step it is met, with derivatives by hand and with all tangents: the stop returns 0.2 of a speed."""
    coordinates, mass, step = case
    for part in range(8):
        result = ram(mass, 0.01 + 0.2 * step * part / 8, coordinates).simulate(
            duration=0.3, step=step, output_interval=step
        )
        position, speed = moved(result)
        met = np.flatnonzero(position > 0.5)[0]
        assert -np.min(speed) < 0.25 * np.max(speed[: met + 1])
        assert np.max(np.abs(speed[-5:])) < 1e-9
        thrust = (20 * BAR - PA) * 0.25 * math.pi * 0.06**2 - (2 * BAR - PA) * 0.25 * math.pi * (0.06**2 - 0.04**2)
        assert position[-1] - 0.5 == pytest.approx(thrust / STIFFNESS, rel=1e-6)
        assert result.timing["rejected"] <= 2


def test_a_piston_leaves_its_stop_with_its_restitution():
    """At a step that resolves the contact, of π √(m/K) = 2.2 ms, the speed behind it is 0.2 of that before, beside what the oil adds."""
    result = ram(100, 0.01, push="2 bar").simulate(duration=0.06, step=2e-5, output_interval=2e-5)
    position, speed = moved(result)
    touching = np.flatnonzero(position > 0.5)
    left = touching[np.flatnonzero(np.diff(touching) > 1)[0]] if np.any(np.diff(touching) > 1) else touching[-1]
    assert -speed[left] == pytest.approx(0.2 * speed[touching[0] - 1], rel=0.03)


@pytest.mark.parametrize("step", tail(STEPS, [1e-3]))
@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_a_cushioned_piston_comes_to_its_end_as_by_radau(coordinates, step):
    """From 3.2 m/s: 711 bar in the cushion, and no steps in parts once it is at rest."""
    cushion = {
        "length": "25 mm", "least_opening": 0.02, "flow": "200 L/min", "pressure_drop": "5 bar", "port_volume": "50 cm^3"
    }  # fmt: skip
    built = ram(100, 0.15, coordinates, push="60 bar", cushion_A=cushion, cushion_B=cushion)
    result = built.simulate(duration=0.8, step=step, output_interval=2e-3)
    exact = built.simulate(duration=0.8, integrator="radau", tolerance=1e-7, output_interval=2e-3)
    (position, speed), (place, velocity) = moved(result), moved(exact)
    assert np.max(velocity) > 3.0
    assert np.max(np.abs(position - place)) < 1e-3
    assert position[-1] == pytest.approx(place[-1], abs=1e-8)
    assert np.max(np.abs(speed[-20:])) < 1e-9
    highest = [np.max(history(each, "hydraulics.ram.pressure_B")) for each in (result, exact)]
    assert highest[0] == pytest.approx(highest[1], rel=0.03)
    assert result.timing["rejected"] <= 30


@pytest.mark.parametrize("step", tail(STEPS, [1e-3]))
@pytest.mark.parametrize(("value", "end"), [(1, 24.0), (-1, -15.0)])
def test_the_trolley_of_the_harbour_crane_rests_at_its_stops(value, end, step):
    """The drive pushes with 60 kN against 2 MN/m, while the load swings: on both sides of 30 mm, and as by an adaptive method."""
    crane = nivel.load(demo_file("harbour-crane"))
    settings = {"duration": 20.0, "output_interval": 20e-3, "inputs": {"trolley": value}}
    result, exact = (
        crane.simulate(**settings, **each) for each in ({"step": step}, {"integrator": "dopri5", "tolerance": 1e-8})
    )
    trolley, place = (each.array("joint_coordinate")[:, 1] for each in (result, exact))
    overlap = value * (trolley[-500:] - end)
    assert np.min(overlap) < 0.03 < np.max(overlap)
    assert np.max(np.abs(trolley - place)) < 1e-3
    assert items(result)["energy"].fraction < 1e-4
