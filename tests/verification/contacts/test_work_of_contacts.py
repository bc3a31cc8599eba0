"""Work of friction of contacts as an output, against closed forms and the energy balance."""

import numpy as np
import pytest

from nivel.errors import ModelError
from simulating import G, machine, simulate

pytestmark = pytest.mark.covering

MASS, STIFFNESS, MU = 2.0, 1e6, 0.3
FLOOR = {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]}
TOUCH = {"stiffness": STIFFNESS, "exponent": 1, "restitution": 1, "friction": MU, "friction_work": True}
SMOOTH = {"friction_model": "coulomb", "friction_transition_speed": 1e-3}


def box(velocity=(1, 0, 0), **contact):
    """A flat box on the plane z = 0."""
    size = [0.3, 0.3, 0.02]
    place = [0, 0, size[2] / 2 - MASS * G / (4 * STIFFNESS)]
    return {
        "gravity": [0, 0, -G],
        "bodies": {
            "box": {"mass": MASS, "position": place, "velocity": list(velocity), "shape": {"type": "box", "size": size}}
        },
        "markers": {"floor": FLOOR},
        "forces": {"touch": {"type": "contact", "body": "box", "plane": "floor", **TOUCH, **contact}},
    }


@pytest.mark.parametrize(
    ("integrator", "coordinates", "law"),
    [
        ("rk4", "absolute", {}),
        ("rk4", "relative", SMOOTH),
        ("dopri5", "relative", {}),
        ("generalised-alpha", "absolute", {}),
        ("radau", "relative", {}),
        ("bdf", "absolute", {}),
        ("extrapolated-euler", "absolute", {}),
        ("energy-momentum", "absolute", SMOOTH),
    ],
)
def test_a_box_that_slides_to_rest_makes_mu_m_g_d(integrator, coordinates, law):
    """W = μ m g d = ½ m v², with the way d to its place of rest; nothing else is lost, so it is the whole of the energy balance."""
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 2e-4, "output_interval": 0.05}
    if integrator == "energy-momentum":
        settings["stabilisation"] = "none"
    r = simulate(box(**law), duration=0.4, **settings)
    work, way = r.array("force.touch.friction_work"), r.array("box.position.x")
    np.testing.assert_allclose(work[-1], MU * MASS * G * (way[-1] - way[0]), rtol=2e-3)
    np.testing.assert_allclose(work[-1], 0.5 * MASS, rtol=2e-3)
    np.testing.assert_allclose(work, r.array("dissipated_energy"), rtol=1e-7, atol=1e-12)
    assert r.variables["force.touch.friction_work"].units == "J"


def test_a_belt_makes_the_heat_that_it_gives_to_a_box():
    """A box is laid on a belt at v: ½ m v² of heat and as much of motion, m v² from the belt."""
    v = 0.6
    sections = box((0, 0, 0), surface_velocity=[v, 0, 0])
    r = simulate(sections, integrator="rk4", step=2e-4, duration=0.4, output_interval=0.05)
    np.testing.assert_allclose(r.array("force.touch.friction_work")[-1], 0.5 * MASS * v**2, rtol=1e-4)
    np.testing.assert_allclose(r.array("external_work")[-1], MASS * v**2, rtol=1e-4)


@pytest.mark.parametrize("kind", ["contact", "contacts"])
def test_a_ball_loses_two_sevenths_until_it_rolls(kind):
    """A sphere that slides at v0 rolls at 5/7 v0: 2/7 of its energy is heat; pressed flat by δ, 1/(1 + m (R - δ)²/I) of it."""
    radius = 0.1
    body = {"mass": MASS, "shape": {"type": "sphere", "radius": radius}, "velocity": [1, 0, 0]}
    overlap = MASS * G / STIFFNESS
    balls = {f"ball_{k}": {**body, "position": [0, k, radius - overlap]} for k in range(2)}
    if kind == "contact":
        forces = {f"touch_{k}": {"type": kind, "body": f"ball_{k}", "plane": "floor", **TOUCH} for k in range(2)}
    else:
        more = {"friction_transition_speed": 1e-3}
        forces = {"touch": {"type": kind, "between": "all", "planes": ["floor"], **TOUCH, **more}}
    sections = {"gravity": [0, 0, -G], "bodies": balls, "markers": {"floor": FLOOR}, "forces": forces}
    r = simulate(sections, integrator="rk4", step=1e-4, duration=0.2, output_interval=0.05)
    work = sum(r.array(f"force.{name}.friction_work")[-1] for name in forces)
    np.testing.assert_allclose(work, MASS / (1 + 2.5 * (1 - overlap / radius) ** 2), rtol=1e-5)
    np.testing.assert_allclose(work, r.array("dissipated_energy")[-1], rtol=1e-9)


def test_two_boxes_that_slide_on_each_other_share_their_heat():
    """A plank is pulled along by a box that slides on it until both have one speed: ½ m M/(m + M) v²."""
    size = {"box": [0.1, 0.1, 0.02], "plank": [1, 0.3, 0.02]}
    heavy, field = 3.0, 1e9
    overlap = MASS * G / (field * 0.01)
    bodies = {
        "box": {"mass": MASS, "position": [-0.2, 0, 0.02 - overlap], "velocity": [1, 0, 0]},
        "plank": {"mass": heavy},
    }
    bodies = {name: {**each, "shape": {"type": "box", "size": size[name]}} for name, each in bodies.items()}
    slide = {"type": "translational", "bodies": ["ground", "plank"], "point": [0, 0, 0], "axis": [1, 0, 0]}
    touch = {"type": "contact", "bodies": ["box", "plank"], "foundation_modulus": field, "damping": 0, "friction": 0.3}
    sections = {
        **{"gravity": [0, 0, -G], "bodies": bodies, "joints": {"rail": slide}},
        "forces": {"touch": {**touch, "friction_work": True}},
    }
    r = simulate(sections, integrator="rk4", step=1e-4, duration=0.3, output_interval=0.05)
    assert r.array("force.touch.sticks")[-1] == 1
    work = r.array("force.touch.friction_work")[-1]
    np.testing.assert_allclose(work, 0.5 * MASS * heavy / (MASS + heavy), rtol=1e-3)
    np.testing.assert_allclose(work, r.array("dissipated_energy")[-1], rtol=1e-9)


def test_an_event_can_ask_for_the_work():
    """The run ends when half of the energy is heat: v = v0/√2."""
    sections = box()
    sections["control"] = {"heat": {"type": "signal", "value": "touch.friction_work", "sample_time": 1e-3}}
    sections["events"] = {"warm": {"when": f"heat.value - {0.25 * MASS}", "stop": True}}
    r = simulate(sections, integrator="rk4", step=2e-4, duration=0.4)
    assert r.array("box.velocity.x")[-1] == pytest.approx(np.sqrt(0.5), abs=5e-3)


def test_what_is_not_asked_for_costs_nothing():
    """Without the key there is no state, no element and no output."""
    r = simulate(box(friction_work=False), integrator="rk4", step=2e-4, duration=0.01)
    assert not [name for name in r.variables if name.endswith("friction_work")]


def test_work_needs_friction():
    with pytest.raises(ModelError, match=r"belongs to `friction`"):
        machine(box(friction=0))
