"""Bodies that lie on ends and corners of others: they rest there under their weight, and tip when the push is that of the closed form."""

import numpy as np
import pytest

from simulating import G, simulate

pytestmark = pytest.mark.covering

DENSITY, POST = 1000.0, 0.06
HOLDS = 0.8  # of the load that tips
CAPSULE = {"type": "capsule", "radius": 0.05, "length": 0.4, "along": "x"}
BOX = {"type": "box", "size": [0.3, 0.2, 0.1]}
CYLINDER = {"type": "cylinder", "radius": 0.1, "length": 0.1, "along": "z"}
SQUARE = [[-POST, -POST], [POST, -POST], [POST, POST], [-POST, POST]]
# lower bodies that are all 0.2 m high, and half as wide along x as POST says
POSTS = {
    "cylinder": {"type": "cylinder", "radius": POST, "length": 0.2, "along": "z"},
    "box": {"type": "box", "size": [2 * POST, 2 * POST, 0.2]},
    "prism": {"type": "extrusion", "outline": SQUARE, "length": 0.2, "along": "z"},
}
HALF = {"capsule": 0.05, "box": 0.05, "cylinder": 0.05}


def on_post(shape, post, load=0.0, arm=0.0):
    """A body in the middle of a post, with a load [N] downwards at `arm` along x that grows for 0.2 s."""
    half = HALF[shape["type"]]
    bodies = {
        "body": {"shape": shape, "density": DENSITY, "position": [0, 0, half - 1e-5]},
        "post": {"shape": POSTS[post], "density": DENSITY, "position": [0, 0, -0.1]},
    }
    touch = {"type": "contact", "bodies": ["body", "post"], "friction": 0.6}
    if shape["type"] == "capsule":
        touch |= {"stiffness": 1e6, "exponent": 1, "restitution": 0.2}
    else:
        touch |= {"foundation_modulus": 3e9, "damping": 100}
    return {
        "gravity": [0, 0, -G],
        "bodies": bodies,
        "joints": {"held": {"type": "fixed", "bodies": ["ground", "post"], "point": [0, 0, 0]}},
        "forces": {
            "touch": touch,
            "load": {
                "type": "force",
                "body": "body",
                "position": [arm, 0, 0],
                "vector": [0, 0, f"-{load}*min(5*time, 1)"],
            },
        },
    }


def weight(shape):
    """m g of a body."""
    match shape["type"]:
        case "box":
            volume = np.prod(shape["size"])
        case "cylinder":
            volume = np.pi * shape["radius"] ** 2 * shape["length"]
        case _:
            volume = np.pi * shape["radius"] ** 2 * (shape["length"] + 4 / 3 * shape["radius"])
    return DENSITY * G * volume


def tilt(r):
    """[rad] of the body against its start, at the frames."""
    return 2 * np.linalg.norm(r.array("body.orientation")[:, 1:], axis=1)


@pytest.mark.parametrize("post", list(POSTS))
@pytest.mark.parametrize("shape", [CAPSULE, BOX, CYLINDER], ids=lambda each: each["type"])
def test_what_is_wider_than_a_post_rests_on_it(shape, post):
    """It neither tips nor turns nor creeps; the contact carries its weight under its middle."""
    r = simulate(on_post(shape, post), integrator="rk4", step=2e-4, duration=0.1, output_interval=0.02)
    assert tilt(r).max() < 1e-9
    assert np.abs(r.array("body.position")[:, :2]).max() < 1e-9
    np.testing.assert_allclose(r.array("force.touch.normal_force")[-1], weight(shape), rtol=1e-4)
    assert abs(r.array("force.touch.x")[-1]) < 1e-9


@pytest.mark.parametrize("post", list(POSTS))
@pytest.mark.parametrize("shape", [CAPSULE, BOX], ids=lambda each: each["type"])
def test_what_lies_on_a_post_tips_at_its_edge(shape, post):
    """A load P at a tips it about the edge at e, where P (a - e) = m g e: less holds, more tips it."""
    arm = 0.14
    tips = weight(shape) * POST / (arm - POST)
    stays, falls = (
        simulate(
            on_post(shape, post, share * tips, arm), integrator="rk4", step=2e-4, duration=0.5, output_interval=0.05
        )
        for share in (HOLDS, 1.1)
    )
    assert tilt(stays)[-1] < 0.01
    assert tilt(falls)[-1] > 0.02
    carried = weight(shape) + HOLDS * tips
    np.testing.assert_allclose(stays.array("force.touch.normal_force")[-1], carried, rtol=1e-2)
    # moment about the middle: the contact stands where both loads have theirs
    np.testing.assert_allclose(stays.array("force.touch.x")[-1], HOLDS * tips * arm / carried, rtol=5e-2)
