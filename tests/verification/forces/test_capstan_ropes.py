"""Ropes with friction on wheels: T₂ = T₁ exp(μ φ) where they slip, rest below it, wheels that roll with them, in all kinds of methods."""

import math

import numpy as np
import pytest

from nivel.errors import ModelError
from simulating import G, hinge, simulate, solid, wheel

pytestmark = pytest.mark.covering

METHODS = pytest.mark.parametrize(
    "method",
    [
        {"integrator": "rk4", "step": "0.5 ms", "coordinates": "absolute"},
        {"integrator": "dopri5", "coordinates": "relative"},
        {"integrator": "generalised-alpha", "step": "0.5 ms", "coordinates": "absolute"},
        {"integrator": "ros2", "step": "0.5 ms", "coordinates": "relative"},
    ],
    ids=["explicit", "chosen", "implicit", "fixed cost"],
)
R, MU = 0.1, 0.2
RATIO = math.exp(MU * math.pi)


def loads(left, right, turning=0.0, **rope):
    """Two loads on a rope over a wheel, with damping so large that what swings as they are let go is gone soon. turning : moment of inertia
    of the wheel [kg m²]; zero: it is fixed."""
    bodies = {"left": solid(left, position=[-R, 0, -1]), "right": solid(right, position=[R, 0, -1])}
    joints = {
        name: {"type": "translational", "bodies": ["ground", name], "point": [x, 0, -1], "axis": [0, 0, 1]}
        for name, x in (("left", -R), ("right", R))
    }
    over = "ground"
    if turning:
        bodies["sheave"], over = wheel(turning) | {"inertia": [turning] * 3}, "sheave"
        joints["axle"] = hinge("ground", "sheave") | {"axis": [0, 1, 0]}
    # as it hangs: the whole weight of the lighter one, which both parts have at the start
    parts = 2.0 + math.pi * R
    hangs = min(left, right) * G / 4e5
    return {
        "gravity": [0, 0, -G],
        "bodies": bodies,
        "joints": joints,
        "forces": {
            "rope": {"type": "rope", "bodies": ["left", over, "right"], "points": [[-R, 0, -1], [0, 0, 0], [R, 0, -1]],
                     "radii": [0, R, 0], "axis": [0, 1, 0], "stiffness": 4e5, "damping": 1500, "length": parts - hangs,
                     "friction": MU, **rope},
        },
    }  # fmt: skip


@METHODS
def test_it_slips_with_the_ratio_of_euler_and_eytelwein(method):
    # m₁ g - T₁ = m₁ a, T₂ - m₂ g = m₂ a, T₁ = exp(μ π) T₂
    result = simulate(loads(10.0, 3.0), **method, duration=0.3, output_interval="5 ms")
    a = G * (10.0 - RATIO * 3.0) / (10.0 + RATIO * 3.0)
    late = result.time > 0.1
    first, last = result.array("force.rope.magnitude"), result.array("force.rope.last_tension")
    assert first[late] == pytest.approx(RATIO * last[late], rel=1e-6)
    within = 1e-3
    assert first[late] == pytest.approx(10.0 * (G - a), rel=within)
    speed = result.array("left.velocity.z")
    assert np.polyfit(result.time[late], speed[late], 1)[0] == pytest.approx(-a, rel=within)
    assert np.abs(result.array("energy_error")).max() < 2 * within * result.array("dissipated_energy")[-1]


@METHODS
def test_below_it_rests_without_creep(method):
    # 5 N against 3: below the ratio of 1.87, so that both keep their own tension
    result = simulate(loads(5.0, 3.0), **method, duration=1.0, output_interval="10 ms")
    height = result.array("left.position.z")
    assert np.ptp(height[result.time > 0.5]) < 1e-9
    assert result.array("force.rope.magnitude")[-1] == pytest.approx(5.0 * G, rel=1e-6)
    assert result.array("force.rope.last_tension")[-1] == pytest.approx(3.0 * G, rel=1e-6)


@METHODS
def test_a_sheave_rolls_with_the_rope(method):
    # (m₁ - m₂) g = (m₁ + m₂ + J/r²) a, and the sheave turns as fast as the rope runs
    result = simulate(loads(5.0, 4.0, turning=0.05), **method, duration=0.3, output_interval="5 ms")
    a = G / (9.0 + 0.05 / R**2)
    late = result.time > 0.1
    assert np.polyfit(result.time[late], result.array("left.velocity.z")[late], 1)[0] == pytest.approx(-a, rel=2e-3)
    turned, run = result.array("axle.angle"), result.array("right.position.z")
    assert run[-1] + 1 == pytest.approx(-R * turned[-1], abs=2e-4)
    assert np.abs(result.array("energy_error")).max() < 1e-3 * result.array("kinetic_energy")[-1]


def test_a_sheave_that_is_held_by_a_brake_lets_the_rope_slip():
    sections = loads(10.0, 3.0, turning=0.05)
    sections["forces"]["brake"] = {"type": "brake", "coordinate": "axle", "capacity": 100}
    result = simulate(sections, integrator="dopri5", duration=0.3)
    first, last = result.array("force.rope.magnitude")[-1], result.array("force.rope.last_tension")[-1]
    assert first == pytest.approx(RATIO * last, rel=1e-6)
    assert result.array("force.brake.magnitude")[-1] == pytest.approx(R * (first - last), rel=1e-4)
    assert abs(result.array("axle.angle")[-1]) < 1e-6


def test_over_two_posts_the_ratios_multiply():
    # a quarter turn on each of two posts, of which the rope slips on both
    sections = loads(10.0, 3.0)
    sections["bodies"]["right"]["position"] = [R + 1, 0, -1]
    sections["joints"]["right"]["point"] = [R + 1, 0, -1]
    rope = sections["forces"]["rope"]
    rope |= {"bodies": ["left", "ground", "ground", "right"], "points": [[-R, 0, -1], [0, 0, 0], [1, 0, 0], [R + 1, 0, -1]],
             "radii": [0, R, R, 0], "length": 3.0 + math.pi * R}  # fmt: skip
    result = simulate(sections, integrator="dopri5", duration=0.2)
    first, last = result.array("force.rope.magnitude")[-1], result.array("force.rope.last_tension")[-1]
    assert first / last == pytest.approx(RATIO, rel=1e-6)


def test_what_does_not_go_with_friction_is_said():
    with pytest.raises(ModelError, match="belongs to a wheel between the ends"):
        simulate(loads(1.0, 1.0, radii=[R, 0, 0]))


def turned(sections, degrees):
    """The same machine, turned about Y."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

    def at(vector):
        return [c * vector[0] + s * vector[2], vector[1], c * vector[2] - s * vector[0]]

    sections["gravity"] = at(sections["gravity"])
    for body in sections["bodies"].values():
        body["position"] = at(body["position"])
    for joint in sections["joints"].values():
        joint |= {"point": at(joint["point"]), "axis": at(joint["axis"])}
    rope = sections["forces"]["rope"]
    rope["points"] = [at(point) for point in rope["points"]]
    return sections


@pytest.mark.parametrize("degrees", [45, 90, 180, 225])
def test_the_ratio_does_not_depend_on_the_direction_of_gravity(degrees):
    result = simulate(turned(loads(10.0, 3.0), degrees), integrator="dopri5", duration=0.1)
    first, last = result.array("force.rope.magnitude")[-1], result.array("force.rope.last_tension")[-1]
    assert first == pytest.approx(RATIO * last, rel=1e-6)


@pytest.mark.parametrize("sense", [1, -1])
def test_whole_turns_on_a_post_add_to_the_arc(sense):
    # two turns and a half: T₁ = exp(5 π μ) T₂; from the other side the same
    ratio = math.exp(5 * math.pi * MU)
    sections = loads(1.2 * 3.0 * ratio, 3.0, wound=[0, 2, 0], length=None)
    if sense < 0:
        sections["forces"]["rope"]["radii"] = [0, -R, 0]
        for name, x in (("left", R), ("right", -R)):
            sections["bodies"][name]["position"] = sections["joints"][name]["point"] = [x, 0, -1]
        sections["forces"]["rope"]["points"] = [[R, 0, -1], [0, 0, 0], [-R, 0, -1]]
    del sections["forces"]["rope"]["length"]
    result = simulate(sections, integrator="dopri5", duration=0.1)
    first, last = result.array("force.rope.magnitude")[-1], result.array("force.rope.last_tension")[-1]
    assert first == pytest.approx(ratio * last, rel=1e-6)


def test_what_slips_takes_power_by_the_damped_tension():
    # tensions that grow while the rope slips: elastic ones alone would leave 1e-3 of the loss open
    sections = loads(5.0, 5.0)
    sections["forces"]["pull"] = {"type": "force", "body": "left", "vector": [0, 0, "-400*time"]}
    result = simulate(sections, integrator="dopri5", tolerance=1e-9, duration=0.4)
    assert np.abs(result.array("energy_error")).max() < 1e-6 * result.array("dissipated_energy")[-1]


@pytest.mark.parametrize(
    ("wound", "part"),
    [
        ([0, 2, 0, 0], "turns at both ends, or one number for each of the 3 points, are needed"),
        ([0, 1.5, 0], "a wheel between the ends has whole turns on top of the arc"),
        ([1, 1, 0], "at this end there is no drum"),
    ],
)
def test_turns_that_do_not_go_are_told(wound, part):
    with pytest.raises(ModelError, match=part):
        simulate(loads(1.0, 1.0, wound=wound))
