"""Structure of the tangent where forces have a potential, and where nothing moves; see also `test_residual_and_tangent`."""

import numpy as np

import linked
from nivel.analysis.assembly.implicit import evaluate_residual, find_tangent
from nivel.system.tables import index_array
from simulating import G, solid
from tangent_zoo import residual_of
from unknowns import SHARES, TIME, moving


def springs():
    """A tree of joints with two freedoms at most, so that positions are coordinates; springs of all kinds that store energy."""
    kinds = ("revolute", "universal", "cylindrical", "translational", "screw", "planar")
    bodies, joints, _ = linked.chain(6, kinds)
    joints["j4"]["pitch"] = 0.3
    table = {"deflections": [-0.5, 0.0, 0.3, 3.0], "forces": [-60, -4, 7, 90]}
    ends = [{"body": "b1", "position": [0.1, 0, 0.1]}, {"body": "b4", "position": [0, 0.2, 0.1]}]
    forces = {
        "linear": {"type": "spring-damper", "markers": ends, "stiffness": 80, "free_length": 0.3, "preload": 4},
        "table": {
            "type": "spring-damper",
            "markers": [{"body": "ground"}, ends[1]],
            "free_length": 0.5,
            "table": table,
        },
        "mount": {
            "type": "bushing",
            "markers": [{"body": "b0"}, {"body": "b3", "orientation": {"axis": [1, 2, 0], "angle": 1.2}}],
            "stiffness": [40, 60, 80, 5, 8, 6],
            "damping": [0.0] * 6,
        },
        "coil": {"type": "joint-spring-damper", "coordinate": "j0", "stiffness": 4.0, "free_value": 0.1},
        "weight": {"type": "force", "body": "b5", "position": [0.1, 0, 0.2], "vector": [3, -2, 5]},
    }
    return linked.record({"gravity": [1, -G, 2], "bodies": bodies, "joints": joints, "forces": forces})


def test_stiffness_of_what_has_a_potential_is_symmetric(rng):
    """K = ∂²V/∂q² in joint coordinates, at rest: v = 0, v̇ = 0, not in equilibrium."""
    here = next(moving(springs(), "relative", rng))
    here.y[here.positions : here.positions + here.n] = 0.0
    here.vdot[:] = 0.0
    residual_of(here)
    _, M = find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)
    _, both = find_tangent(here.motion, TIME, 1.0, 1e-20, 1e-20)
    K = both - M
    np.testing.assert_allclose(K, K.T, atol=1e-12 * np.abs(K).max())
    assert np.abs(K).max() > 10.0


def test_bodies_that_are_all_fixed_have_an_empty_matrix(rng):
    bodies = {"a": solid(), "b": solid(position=[1, 0, 0])}
    joints = {name: {"type": "fixed", "bodies": ["ground", name], "point": [0, 0, 0]} for name in bodies}
    here = next(moving(linked.record({"bodies": bodies, "joints": joints}), "relative", rng))
    record = residual_of(here)
    assert here.motion.system.record.residual.acceleration.shape == (3, 6)
    assert evaluate_residual(here.motion, TIME) == 0
    assert find_tangent(here.motion, TIME, *SHARES)[1].shape == (0, 0)
    assert index_array([], 1).size == len(record.newton.group)
