"""Nodes between springs that have next to no mass: they are where the springs balance."""

import numpy as np
import pytest
from scipy.optimize import fsolve

from nivel.errors import ModelError
from simulating import simulate, slide, solid

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


def balanced(height):
    """Where the forces of three springs on a point vanish, with the weight at (0, height); and the pull on the weight."""
    free = np.array([0.9, 0.95, 0.5])
    ends = np.vstack([ANCHORS[:, :2], [0.0, height]])

    def pulls(p):
        way = ends - p
        length = np.linalg.norm(way, axis=1)
        return (STIFFNESS * (length - free) / length)[:, None] * way

    p = fsolve(lambda p: pulls(p).sum(axis=0), [0.0, 0.0], xtol=1e-13)
    return p, -pulls(p)[2]


def test_a_node_of_a_milligram_is_where_its_springs_balance():
    result = simulate(
        three_springs({"point_mass": True, "mass": 1e-6}, [0.0, 0.0, 0.0]), start="equilibrium", duration=0.1
    )
    assert result.settings["integrator"] == "radau"
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
    with pytest.raises(ModelError, match=r"two springs in series are one.*`\{point_mass: true, mass: 1 mg\}`"):
        simulate(three_springs({"point_mass": True, "mass": 0}, [0.0, 0.0, 0.0]), duration=0.1)
