"""Surfaces that move over their bodies, against closed forms: boxes on belts, pucks on turntables; and what contacts say of themselves."""

import numpy as np
import pytest

from nivel.errors import ModelError
from simulating import G, simulate

pytestmark = pytest.mark.covering

MASS, STIFFNESS = 2.0, 1e6
SIZE = [0.3, 0.2, 0.1]
FEW = pytest.mark.parametrize(("integrator", "coordinates"), [("rk4", "absolute"), ("radau", "relative")])


def on_floor(size=SIZE, velocity=(0, 0, 0), position=(0, 0), **contact):
    """A box on the plane z = 0, X along the belt; it begins with the overlap that carries it."""
    overlap = MASS * G / (4 * STIFFNESS)
    body = {"mass": MASS, "position": [*position, size[2] / 2 - overlap], "shape": {"type": "box", "size": list(size)}}
    return {
        "gravity": [0, 0, -G],
        "bodies": {"box": {**body, "velocity": list(velocity)}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]}},
        "forces": {
            "touch": {
                **{"type": "contact", "body": "box", "plane": "floor", "stiffness": STIFFNESS, "exponent": 1},
                **{"restitution": 0.2, "friction": 0.3, **contact},
            }
        },
    }


@FEW
def test_a_box_on_a_belt_slides_for_v_by_mu_g(integrator, coordinates):
    """It slides for v/(μ g) and then rests on the belt; ½ m v² becomes heat, and the belt gives m v²."""
    v, mu = 0.6, 0.3
    r = simulate(
        on_floor(friction=mu, surface_velocity=[v, 0, 0]),
        **{
            "integrator": integrator,
            "coordinates": coordinates,
            "step": 2e-4,
            "duration": 0.3,
            "output_interval": 1e-3,
        },
    )
    ends, t = v / (mu * G), r.time
    # the friction at the floor tilts the box by its overlap
    np.testing.assert_allclose(r.array("box.velocity.x"), np.minimum(mu * G * t, v), atol=2e-3)
    assert r.array("box.velocity.x")[-1] == pytest.approx(v, abs=1e-9)
    sticks = r.array("force.touch.sticks")
    assert not sticks[(t > 0) & (t < ends - 5e-3)].any()
    assert sticks[t > ends + 5e-3].all()
    assert r.array("dissipated_energy")[-1] == pytest.approx(0.5 * MASS * v * v, rel=1e-4)
    assert r.array("external_work")[-1] == pytest.approx(MASS * v * v, rel=1e-4)
    assert np.abs(r.array("energy_error")).max() < 1e-5 * MASS * v * v
    middle = (t > 0.02) & (t < 0.18)
    np.testing.assert_allclose(r.array("force.touch.friction_x")[middle], mu * MASS * G, rtol=1e-6)
    np.testing.assert_allclose(r.array("force.touch.surface_power")[middle], mu * MASS * G * v, rtol=1e-6)
    slip = v - r.array("box.velocity.x")
    np.testing.assert_allclose(r.array("force.touch.friction_power")[middle], (mu * MASS * G * slip)[middle], atol=2e-2)
    np.testing.assert_allclose(r.array("force.touch.slip_speed")[middle], slip[middle], atol=4e-3)


def test_a_belt_that_starts_softly_carries_its_box_without_slip():
    """ẍ = v̇ of the belt, whose rate is known: the box follows without lag while v̇ < μ g."""
    v = "0.5*time^2"  # [m/s], v̇ up to 0.5 < 0.3 g
    r = simulate(on_floor(surface_velocity=[v, 0, 0]), integrator="rk4", step=2e-4, duration=0.5, output_interval=0.02)
    np.testing.assert_allclose(r.array("box.velocity.x"), 0.5 * r.time**2, atol=2e-5)
    assert r.array("force.touch.slip_speed").max() < 1e-9
    assert r.array("dissipated_energy")[-1] < 1e-8


def test_smooth_friction_counts_the_power_of_the_belt():
    """With the law of `coulomb` the heat is that of the speed against the belt, and the energy balance holds."""
    more = {"friction_model": "coulomb", "friction_transition_speed": 1e-3, "surface_velocity": [0.6, 0, 0]}
    r = simulate(on_floor(**more), integrator="rk4", step=1e-4, duration=0.3, output_interval=0.02)
    assert r.array("dissipated_energy")[-1] == pytest.approx(0.5 * MASS * 0.36, rel=1e-3)
    assert r.array("external_work")[-1] == pytest.approx(MASS * 0.36, rel=1e-3)
    assert np.abs(r.array("energy_error")).max() < 1e-5


@FEW
def test_a_puck_on_a_turntable_slides_when_friction_cannot_hold_it(integrator, coordinates):
    """ω = α t: it turns with the table until (α r)² + (ω² r)² = (μ g)²; then it slides outwards."""
    alpha, radius, mu = 4.0, 0.3, 0.3
    slides = ((mu * G / radius) ** 2 - alpha**2) ** 0.25 / alpha
    sections = on_floor((0.04, 0.04, 0.02), (0, 0, 0), (radius, 0), friction=mu, surface_spin=f"{alpha}*time")
    r = simulate(
        sections,
        **{"integrator": integrator, "coordinates": coordinates, "step": 2e-4, "duration": 1.2 * slides},
        output_interval=2e-3,
    )
    t, place = r.time, r.array("box.position")
    away = np.hypot(place[:, 0], place[:, 1])
    held = t < slides - 5e-3
    assert np.abs(away[held] - radius).max() < 1e-5
    angle = np.unwrap(np.arctan2(place[:, 1], place[:, 0]))
    np.testing.assert_allclose(angle[held], 0.5 * alpha * t[held] ** 2, atol=1e-5)
    assert r.array("force.touch.sticks")[held & (t > 0)].all()
    assert not r.array("force.touch.sticks")[t > slides + 5e-3].any()
    assert away[-1] > radius + 1e-3


def test_a_crate_on_the_belt_of_another_body():
    """Two solids: the second one is the conveyor, whose belt runs at v along its x axis, here turned by 30°."""
    v, mu, turn = 0.5, 0.4, np.radians(30.0)
    overlap = MASS * G / (1e8 * 0.04)
    table = {"position": [0, 0, -0.05], "orientation": {"axis": [0, 0, 1], "angle": turn}}
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "belt": {**table, "shape": {"type": "box", "size": [2, 2, 0.1]}, "density": 700},
            "crate": {
                "mass": MASS,
                "position": [0, 0, 0.1 - overlap],
                "shape": {"type": "box", "size": [0.2, 0.2, 0.2]},
            },
        },
        "joints": {"held": {"type": "fixed", "bodies": ["ground", "belt"], "point": [0, 0, 0]}},
        "forces": {
            "touch": {
                **{"type": "contact", "bodies": ["crate", "belt"], "foundation_modulus": 1e8, "damping": 50},
                **{"friction": mu, "surface_velocity": [v, 0, 0]},
            }
        },
    }
    r = simulate(sections, integrator="rk4", step=2e-4, duration=0.4, output_interval=2e-3)
    along = r.array("crate.velocity") @ [np.cos(turn), np.sin(turn), 0]
    np.testing.assert_allclose(along, np.minimum(mu * G * r.time, v), atol=6e-3)
    assert r.array("force.touch.slip_speed")[-1] < 1e-6
    assert np.abs(r.array("energy_error")).max() < 1e-4 * MASS * v * v
    assert r.array("dissipated_energy")[-1] == pytest.approx(0.5 * MASS * v * v, rel=2e-2)
    np.testing.assert_allclose(r.array("force.touch.normal_z")[1:], 1.0, atol=1e-6)
    np.testing.assert_allclose(r.array("force.touch.z")[1:], 0.0, atol=1e-4)
    place = np.array([r.array(f"force.touch.{a}")[-1] for a in "xy"])
    np.testing.assert_allclose(place, r.array("crate.position")[-1, :2], atol=2e-3)


def test_a_contact_says_where_and_how_it_touches():
    """A box at rest on a slope of 20°: the normal force m g cos α passes below its centre, where it and friction m g sin α meet."""
    slope = np.radians(20.0)
    sections = on_floor(friction=0.6)
    sections["gravity"] = [G * np.sin(slope), 0, -G * np.cos(slope)]
    r = simulate(sections, integrator="rk4", step=2e-4, duration=1.0, output_interval=0.5)
    out = {
        name: r.array(f"force.touch.{name}")[-1]
        for name in ("x", "y", "z", "normal_z", "friction_x", "friction_y", "sticks")
    }
    assert out["x"] - r.array("box.position.x")[-1] == pytest.approx(0.05 * np.tan(slope), rel=1e-3)
    assert out["friction_x"] == pytest.approx(-MASS * G * np.sin(slope), rel=1e-5)
    assert out["normal_z"] == 1.0
    assert out["sticks"] == 1.0
    assert abs(out["y"]) < 1e-9 > abs(out["friction_y"])
    assert r.array("force.touch.friction_power")[-1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("contact", "said"),
    [
        ({"friction": 0, "surface_velocity": [1, 0, 0]}, "acts by `friction`"),
        ({"surface_velocity": ["1 m", 0, 0]}, "a velocity"),
    ],
)
def test_a_surface_that_cannot_move_anything_is_refused(contact, said):
    with pytest.raises(ModelError, match=said):
        simulate(on_floor(**contact))


def test_numbers_of_a_contact_apart_are_zero():
    sections = on_floor(friction=0.3)
    sections["bodies"]["box"]["position"] = [0, 0, 1.0]
    r = simulate(sections, integrator="rk4", step=1e-3, duration=0.02)
    assert r.array("force.touch.normal_z")[-1] == 0.0
    # the ball about the box stands for its corners while it is far
    assert r.array("force.touch.depth")[0] == pytest.approx(-(1.0 - np.linalg.norm(SIZE) / 2))


def test_the_work_of_friction_is_the_state_of_a_sample():
    """A block that stops: ½ m v², but for half a sample of the power at its start, μ m g v/2 times the sample's time."""
    contact = {
        "type": "contact",
        "body": "block",
        "plane": "floor",
        "stiffness": 1e6,
        "exponent": 1,
        "restitution": 0.3,
    }
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "block": {
                **{"mass": 2, "inertia": [0.1, 0.1, 0.1], "shape": {"type": "box", "size": [1, 1, 0.02]}},
                **{"position": [0, 0, 0.01 - 2 * G / 4e6], "velocity": [1, 0, 0]},
            }
        },
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"slides": {**contact, "friction": 0.4}},
        "control": {"heating": {"type": "signal", "value": "slides.friction_power", "sample_time": 1e-3}},
        "states": {"heat": {"rate": "heating.value"}},
    }
    r = simulate(sections, integrator="rk4", step=1e-4, duration=0.5)
    lag = 0.4 * 2 * G * 1e-3 / 2
    assert r.array("state.heat")[-1] == pytest.approx(1.0 + lag, abs=2e-4)
    assert r.array("dissipated_energy")[-1] == pytest.approx(1.0, abs=1e-6)
