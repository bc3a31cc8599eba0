"""Contact of convex hulls with planes: a prism is the box that it is, and a mesh rests on the corners of its hull."""

import numpy as np
import pytest

from nivel.errors import ModelError
from nivel.machine.bodies.surface import surface_text
from simulating import G, simulate

SIDE, MASS = 0.04, 0.5
HALF = SIDE / 2
SQUARE = [[-HALF, -HALF], [HALF, -HALF], [HALF, HALF], [-HALF, HALF]]
OCTAHEDRON = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]) * 0.05
FACES = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]


def die(shape, **more):
    """A body above a plane that is tilted by a tenth about x."""
    return {
        "gravity": [0, 0, -G],
        "bodies": {"die": {"shape": shape, "mass": MASS, **more}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0.1, 1]}},
        "forces": {
            "hit": {
                **{"type": "contact", "body": "die", "plane": "floor", "stiffness": 1e5, "restitution": 0.5},
                **{"friction": 0.3, "friction_model": "coulomb", "friction_transition_speed": 0.01},
            }
        },
    }


def mesh(points, faces):
    return {"type": "mesh", "surface": surface_text(points, np.array(faces))}


def test_a_prism_bounces_as_the_box_that_it_is():
    """Corners of a hull and of a box are found by different formulas."""
    thrown = {"position": [0, 0, 0.06], "velocity": [0.2, 0.1, -0.3], "angular_velocity": [3, -2, 1]}
    box = die({"type": "box", "size": [SIDE] * 3}, **thrown)
    prism = die({"type": "extrusion", "outline": SQUARE, "length": SIDE}, **thrown)
    runs = [simulate(machine, duration=0.3, step=2e-4) for machine in (box, prism)]
    assert runs[0].array("force.hit.depth").max() > 1e-4  # it did touch
    for name in ("die.position", "force.hit.magnitude"):
        np.testing.assert_allclose(*(run.array(name) for run in runs), atol=1e-9)


def test_a_mesh_rests_on_three_corners_of_its_hull():
    """3 K δⁿ = m g for an octahedron that lies on a face; corners inside the hull do not touch."""
    normal = np.ones(3) / np.sqrt(3)
    inside = np.append(OCTAHEDRON, [0.2 * normal * 0.05], axis=0)
    # a dent in the upper face: its three triangles meet inside
    dented = mesh(inside, [*FACES[1:], [0, 2, 6], [2, 4, 6], [4, 0, 6]])
    down = {"axis": [1, -1, 0], "angle": float(np.pi - np.arccos(normal[2]))}  # (1, 1, 1) points down
    machine = die(dented, orientation=down, position=[0, 0, 0.05 / np.sqrt(3) + 1e-4])
    machine["markers"]["floor"]["axis"] = [0, 0, 1]
    machine["forces"]["hit"]["restitution"] = 0.05
    r = simulate(machine, duration=0.6, step=2e-4)
    assert r.array("force.hit.normal_force")[-1] == pytest.approx(MASS * G, rel=1e-3)
    assert r.array("force.hit.depth")[-1] == pytest.approx((MASS * G / 3e5) ** (2 / 3), rel=0.05)


def test_a_mesh_of_too_many_corners_is_refused_with_what_to_do():
    angle = np.linspace(0, 2 * np.pi, 1002, endpoint=False)
    rim = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(angle))])
    points = np.vstack([rim, [[0, 0, 1], [0, 0, -1]]])
    n = len(rim)
    faces = [[k, (k + 1) % n, n] for k in range(n)] + [[(k + 1) % n, k, n + 1] for k in range(n)]
    with pytest.raises(ModelError, match="hull of the mesh has 1004 corners, and at most 1000"):
        simulate(die(mesh(points, faces), position=[0, 0, 2]), duration=0.01, step=1e-3)
