"""Nodes between springs that have no mass, or next to none: they are where the springs balance."""

import numpy as np
import pytest
from scipy.optimize import fsolve

from nivel.errors import ModelError
from simulating import machine, simulate, slide, solid

pytestmark = pytest.mark.covering

MASS, STIFFNESS = 2.0, np.array([4e3, 6e3, 5e3])
ANCHORS = np.array([[-0.6, 0.8, 0.0], [0.6, 0.8, 0.0]])
G = 9.81


def three_springs(node, position):
    """A weight on a rail hangs by a spring from a node that two springs hold from the ceiling."""
    free = [0.9, 0.95, 0.5]
    springs = {
        f"s{k}": {"type": "spring-damper", "bodies": [first, second], "points": points, "stiffness": STIFFNESS[k], "free_length": free[k]}
        for k, (first, second, points) in enumerate(
            [("ground", "node", [ANCHORS[0], position]), ("ground", "node", [ANCHORS[1], position]),
             ("node", "weight", [position, [0, -0.6, 0]])]
        )
    }  # fmt: skip
    return {
        "gravity": [0, -G, 0],
        "bodies": {"node": {**node, "position": position}, "weight": solid(MASS, position=[0, -0.6, 0])},
        "joints": {"rail": slide("ground", "weight", (0, 1, 0), point=[0, -0.6, 0])},
        "forces": springs,
    }


def balanced(height, stiffness=STIFFNESS, free=(0.9, 0.95, 0.5)):
    """Where the forces of three springs on a point vanish, with the weight at (0, height); and the pull on the weight."""
    ends = np.vstack([ANCHORS[:, :2], [0.0, height]])

    def pulls(p):
        way = ends - p
        length = np.linalg.norm(way, axis=1)
        return (stiffness * (length - np.asarray(free)) / length)[:, None] * way

    p = fsolve(lambda p: pulls(p).sum(axis=0), [0.0, 0.0], xtol=1e-13)
    return p, -pulls(p)[2]


def test_a_node_of_a_milligram_is_where_its_springs_balance():
    result = simulate(
        three_springs({"point_mass": True, "mass": 1e-6}, [0.0, 0.0, 0.0]), start="equilibrium", duration=0.1
    )
    assert result.settings["went_on"]["integrator"] == "radau"
    node = result.array("node.position")[-1]
    height = result.array("weight.position")[-1, 1]
    p, pull = balanced(height)
    np.testing.assert_allclose(node[:2], p, atol=1e-7)
    assert pull[1] == pytest.approx(MASS * G, rel=1e-6)


def test_it_follows_its_springs_while_the_weight_moves():
    """A weight that is pushed: the node stays where the springs balance, and the steps are those of the weight, not of the node."""
    sections = three_springs({"point_mass": True, "mass": 1e-6}, [0.0, 0.0, 0.0])
    sections["forces"]["push"] = {"type": "motor", "coordinate": "rail", "effort": "15*step(time, 0.05, 0, 0.15, 1)"}
    result = simulate(sections, start="equilibrium", duration=0.4)
    nodes, weights = result.array("node.position"), result.array("weight.position")
    assert np.ptp(weights[:, 1]) > 2e-3
    for k in range(0, len(result.time), 100):
        p, _ = balanced(weights[k, 1])
        np.testing.assert_allclose(nodes[k, :2], p, atol=2e-6)
    assert result.timing["steps"] < 1000  # the node vibrates some 5000 times


def test_without_mass_the_message_says_what_to_write():
    with pytest.raises(ModelError, match=r"`type: spring-series`.*`type: spring-node`"):
        simulate(three_springs({"point_mass": True, "mass": 0}, [0.0, 0.0, 0.0]), duration=0.1)


def hung(force, **more):
    """A weight on a vertical rail below the ceiling, held by `force`."""
    return {
        "gravity": [0, -G, 0],
        "bodies": {"weight": solid(MASS, position=[0, -0.6, 0])},
        "joints": {"rail": slide("ground", "weight", (0, 1, 0), point=[0, -0.6, 0], **more)},
        "forces": {"held": force},
    }


IN_SERIES = {"type": "spring-series", "bodies": ["ground", "weight"], "points": [[0, 0, 0], [0, -0.6, 0]]}
METHODS = pytest.mark.parametrize("integrator", ["dopri5", "generalised-alpha", "radau", "rk4"])


@METHODS
def test_springs_in_series_are_one(integrator):
    """1/k = Σ 1/k_i: y = -m g/k (1 - cos ω t), ω² = k/m; the parts share the length by their stiffnesses."""
    parts, free = np.array([400.0, 600.0, 1200.0]), np.array([0.1, 0.2, 0.3])
    force = {**IN_SERIES, "stiffness": parts, "free_length": free}
    steps = {"tolerance": 1e-9} if integrator in ("dopri5", "radau") else {"step": 2e-4}
    result = simulate(hung(force), duration=0.5, output_interval=0.05, integrator=integrator, **steps)
    k = 1.0 / np.sum(1.0 / parts)
    drop = MASS * G / k * (1.0 - np.cos(np.sqrt(k / MASS) * result.time))
    # of second order: (ω h)² ω t/24 and less
    np.testing.assert_allclose(result.array("rail.displacement"), -drop, atol=2e-6)
    np.testing.assert_allclose(result.array("force.held.magnitude"), k * drop, atol=1e-3)
    for i in range(3):
        np.testing.assert_allclose(result.array(f"force.held.length_{i + 1}"), free[i] + k * drop / parts[i], atol=2e-6)
    assert np.abs(result.array("energy_error")).max() < 1e-4


@METHODS
def test_a_spring_and_a_damper_in_series_relax(integrator):
    """Maxwell's element held at a length: T = k x₀ exp(-k t/c)."""
    k, c, x0 = 500.0, 40.0, 0.02
    force = {**IN_SERIES, "stiffness": [k, 0], "damping": [0, c], "free_length": [0.3 - x0, 0.3]}
    sections = hung(force)
    sections["drivers"] = {"hold": {"coordinate": "rail.displacement", "value": 0}}
    steps = {"tolerance": 1e-9} if integrator in ("dopri5", "radau") else {"step": 1e-3}
    result = simulate(sections, duration=0.3, output_interval=0.05, integrator=integrator, **steps)
    relaxed = k * x0 * np.exp(-k * result.time / c)
    # of second order: (k h/c)² k t/(12 c)
    np.testing.assert_allclose(result.array("force.held.magnitude"), relaxed, atol=2e-4 * k * x0)
    np.testing.assert_allclose(result.array("force.held.length_1"), 0.3 - x0 + relaxed / k, atol=2e-4 * x0)
    stored = 0.5 * k * x0**2
    lost = stored * (1.0 - np.exp(-2.0 * k * result.time / c))
    np.testing.assert_allclose(result.array("dissipated_energy"), lost, atol=1e-3 * stored)


def test_a_standard_linear_solid_creeps():
    """A spring k₁ before a spring k₂ beside a damper c: under the weight it stretches by m g (1/k₁ + (1 - exp(-k₂ t/c))/k₂).

    With the mass, x₁ = T/k₁ and c ẋ₂ + k₂ x₂ = T: from rest in equilibrium of the outer spring it follows slowly; here at the end.
    """
    k1, k2, c = 4e3, 2e3, 100.0
    force = {**IN_SERIES, "stiffness": [k1, k2], "damping": [0, c], "free_length": [0.3, 0.3]}
    result = simulate(hung(force), duration=3.0, output_interval=0.5, integrator="radau", tolerance=1e-8)
    assert result.array("rail.displacement")[-1] == pytest.approx(-MASS * G * (1 / k1 + 1 / k2), rel=1e-5)
    assert result.array("force.held.length_2")[-1] == pytest.approx(0.3 + MASS * G / k2, rel=1e-5)


def test_a_rope_and_a_spring_in_series_are_slack_together():
    """A weight that is thrown up flies freely: y = v t - g t²/2, until the way back."""
    force = {**IN_SERIES, "stiffness": [3e3, 5e3], "free_length": [0.25, 0.35], "only_pulls": True}
    thrown = hung(force, start_rates={"displacement": 1.0})
    result = simulate(thrown, duration=0.19, output_interval=0.01, integrator="dopri5", tolerance=1e-9)
    np.testing.assert_allclose(result.array("rail.displacement"), result.time - 0.5 * G * result.time**2, atol=1e-9)
    assert np.all(result.array("force.held.magnitude") == 0.0)


def star(**more):
    """`three_springs` with a node that has no mass."""
    sections = three_springs({"point_mass": True, "mass": 1.0}, [0.0, 0.0, 0.0])
    del sections["bodies"]["node"]
    sections["forces"] = {
        "star": {
            "type": "spring-node",
            "node": [0.0, 0.1, 0.0],
            "bodies": ["ground", "ground", "weight"],
            "points": [*ANCHORS, [0, -0.6, 0]],
            "stiffness": STIFFNESS,
            "free_length": [0.9, 0.95, 0.5],
            **more,
        }
    }
    return sections


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@METHODS
def test_three_springs_meet_in_a_node_without_mass(coordinates, integrator):
    """The node is where the springs balance at every instant, and the weight feels the pull there; nothing is lost."""
    steps = {"tolerance": 1e-9} if integrator in ("dopri5", "radau") else {"step": 2e-4}
    settings = {"duration": 0.1, "output_interval": 0.01, "coordinates": coordinates, "integrator": integrator}
    result = simulate(star(), **settings, **steps)
    moved = result.array("weight.position")[:, 1]
    assert np.ptp(moved) > 5e-3
    for k in range(len(result.time)):
        p, pull = balanced(moved[k])
        node = [float(result.array(f"force.star.{axis}")[k]) for axis in "xyz"]
        np.testing.assert_allclose(node, [*p, 0.0], atol=1e-11)
        assert MASS * (result.array("weight.acceleration")[k, 1] + G) == pytest.approx(pull[1], rel=1e-8)
    assert np.abs(result.array("energy_error")).max() < 1e-4


def test_the_star_hangs_where_statics_says():
    result = machine(star()).statics()
    height = result.array("weight.position")[-1, 1]
    _, pull = balanced(height)
    assert pull[1] == pytest.approx(MASS * G, rel=1e-9)


@pytest.mark.compiles
def test_a_node_between_springs_that_push_has_exact_slopes():
    """Out of the plane the springs push it away, so its energy is at a saddle: its slopes are those of the balance all the same."""
    free = (1.1, 1.15, 0.7)
    names = ["forces.star.stiffness.0", "forces.star.free_length.2"]
    outputs, run = ["force.star.x", "force.star.y"], {"duration": 1e-5, "step": 1e-5, "integrator": "rk4"}
    found = machine(star(free_length=list(free))).gradient(outputs, names, **run)
    for name, change in zip(names, (np.array([4.0, 0.0, 0.0]), np.array([0.0, 0.0, 1e-3])), strict=True):
        at = [
            balanced(-0.6, STIFFNESS + sign * change, free)[0]
            if "stiffness" in name
            else balanced(-0.6, STIFFNESS, np.array(free) + sign * change)[0]
            for sign in (-1.0, 1.0)
        ]
        slope = np.subtract(at[1], at[0]) / (2.0 * change.max())
        np.testing.assert_allclose([float(found[f"d(force.star.{axis})/d({name})"]) for axis in "xy"], slope, rtol=1e-4)


def test_a_star_of_ropes_lets_one_go_slack():
    """With the third anchor far below its free length only two ropes pull: the node is on the line between their ends."""
    sections = star(only_pulls=True, free_length=[0.9, 9.0, 0.5])
    result = machine(sections).statics()
    node = np.array([float(result.array(f"force.star.{axis}")[-1]) for axis in "xyz"])
    weight, anchor = result.array("weight.position")[-1], ANCHORS[0]
    assert np.linalg.norm(np.cross(node - anchor, weight - anchor)) < 1e-9
    tensions = [float(result.array(f"force.star.tension_{k}")[-1]) for k in (1, 2, 3)]
    assert tensions[1] == 0.0
    assert tensions[0] == pytest.approx(tensions[2], rel=1e-10)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"stiffness": [1e3]}, "2 to 6 parts in series"),
        ({"stiffness": [1e3, 0]}, "neither stiffness nor damping"),
        ({"free_length": [0.1]}, "one number for each of the 2 parts"),
        ({"damping": [1, 1], "only_pulls": True}, "every part has a damper"),
    ],
    ids=["one", "nothing", "lengths", "slack"],
)
def test_what_cannot_be_in_series_is_told(change, said):
    with pytest.raises(ModelError, match=said):
        machine(hung({**IN_SERIES, "stiffness": [1e3, 2e3], "free_length": [0.3, 0.3], **change}))


def test_two_springs_are_no_node():
    with pytest.raises(ModelError, match="two are a `spring-series`"):
        machine(star(stiffness=[1, 2], free_length=[1, 2]))
