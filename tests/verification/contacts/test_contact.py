"""Contacts and stops: restitution, durations, static penetration, rolling, sliding, all in closed form."""

import numpy as np
import pytest

from references import impact
from simulating import G, simulate, slide, solid

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
RADIUS, MASS, SPEED = 0.05, 0.4, 1.2


def ball(radius=RADIUS, mass=MASS, **more):
    """A homogeneous sphere."""
    return {"shape": {"type": "sphere", "radius": radius}, "mass": mass, **more}


def thrown(contact, gap=0.002, speed=SPEED):
    """A ball on its way to a wall at z = 0, from `gap` above it; no gravity."""
    return {
        "bodies": {"ball": ball(position=[0, 0, RADIUS + gap], velocity=[0, 0, -speed])},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"hit": {"type": "contact", "body": "ball", "plane": "floor", **contact}},
    }


@FORMULATIONS
@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.2])
def test_rebound_is_the_restitution_whatever_stiffness_and_exponent(exponent, formulation):
    """ln((1 + a v_i)/(1 - a v_o)) = a (v_i + v_o) with v_o = e v_i: for stiffness and speed a hundredfold apart.

    About 400 steps for a contact; its onset falls within a step, where F has a kink of order n: error of order (h/T)².
    """
    for restitution, stiffness, speed in ((0.3, 2e3, 0.5), (0.7, 2e5, 2.0), (0.95, 2e4, 0.1)):
        time = impact.duration(MASS, stiffness, exponent, speed)
        gap = 0.1 * speed * time
        r = simulate(
            thrown({"stiffness": stiffness, "exponent": exponent, "restitution": restitution}, gap, speed),
            duration=4 * time,
            step=time / 400,
            formulation=formulation,
        )
        rebound = r.array("ball.velocity.z")[-1]
        # the damping of a linear spring begins with a jump
        assert rebound == pytest.approx(restitution * speed, rel=5e-4 if exponent == 1.0 else 1e-4)
        assert np.abs(r.array("energy_error")).max() < 1e-4 * 0.5 * MASS * speed**2
        loss = 0.5 * MASS * speed**2 * (1 - restitution**2)
        assert r.array("dissipated_energy")[-1] == pytest.approx(loss, rel=1e-3)


def test_rebound_converges_with_the_step():
    """A linear spring has the worst onset: its damping force jumps there, where the step cuts it: order one at least."""
    time = impact.duration(MASS, 2e4, 1.5, SPEED)
    steps, errors = [time / n for n in (25, 50, 100, 200, 400)], []
    for step in steps:
        r = simulate(
            thrown({"stiffness": 2e4, "restitution": 0.6}, 0.33 * step), duration=4 * time, step=step, integrator="rk4"
        )
        errors.append(abs(r.array("ball.velocity.z")[-1] - 0.6 * SPEED) / SPEED)
    assert errors[-1] < 1e-4
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 1.0, errors


@pytest.mark.parametrize("exponent", [1.0, 1.5])
def test_impact_without_loss_takes_its_closed_time(exponent):
    """The ball is back at the gap after 2 gap/v + T. Half period π √(m/k) for n = 1, Hertz's 2.943 δmax/v for 3/2."""
    stiffness, gap = 3e4, 0.002
    time = impact.duration(MASS, stiffness, exponent, SPEED)
    if exponent == 1.0:
        assert time == pytest.approx(np.pi * np.sqrt(MASS / stiffness))
    contact = {"stiffness": stiffness, "exponent": exponent, "restitution": 1.0}
    whole = 2 * gap / SPEED + time
    r = simulate(thrown(contact, gap), duration=whole, step=whole / 2000, output_interval=whole / 2000)
    assert r.array("ball.position.z")[-1] - RADIUS == pytest.approx(gap, abs=2e-5 * SPEED * time)
    assert r.array("ball.velocity.z")[-1] == pytest.approx(SPEED, rel=1e-5)
    depth = RADIUS - r.array("ball.position.z").min()
    assert depth == pytest.approx(impact.deepest(MASS, stiffness, exponent, SPEED), rel=1e-5)


def test_damped_impact_takes_the_time_of_its_equation():
    """e = 0.5: back at the gap after gap/v + T + gap/(e v), T from the scalar equation."""
    stiffness, gap, e = 3e4, 0.001, 0.5
    time = impact.damped_duration(MASS, stiffness, 1.5, SPEED, e)
    whole = gap / SPEED + time + gap / (e * SPEED)
    r = simulate(thrown({"stiffness": stiffness, "restitution": e}, gap), duration=whole, step=whole / 4000)
    assert r.array("ball.position.z")[-1] - RADIUS == pytest.approx(gap, abs=1e-4 * SPEED * time)


def test_hertz_stiffness_comes_from_the_materials():
    """A ball on a plane, of steel and rubber-like: static depth (m g/K)^(2/3), K = 4/3 E* √R."""
    materials = [{"youngs_modulus": 1e7, "poisson_ratio": 0.45}, {"youngs_modulus": 210e9, "poisson_ratio": 0.3}]
    K = impact.hertz_stiffness((RADIUS,), (1e7, 210e9), (0.45, 0.3))
    depth = (MASS * G / K) ** (2 / 3)
    sections = thrown({"materials": materials, "restitution": 0.5}, -depth, 0.0) | {"gravity": [0, 0, -G]}
    r = simulate(sections, duration=0.05, step=1e-4)
    np.testing.assert_allclose(r.array("ball.position.z"), RADIUS - depth, atol=1e-10)
    np.testing.assert_allclose(r.array("force.hit.normal_force"), MASS * G, rtol=1e-6)


@FORMULATIONS
@pytest.mark.parametrize("materials", [False, True])
def test_two_spheres_collide_and_keep_their_momentum(materials, formulation):
    """Head on: reduced mass, relative speed e times the one before; each ends with the speeds of an ideal impact."""
    m1, m2, R1, R2, e = 0.4, 1.1, 0.05, 0.08, 0.6
    v1, v2 = 1.5, -0.5
    moduli, ratios = (2e7, 5e7), (0.45, 0.4)
    K = impact.hertz_stiffness((R1, R2), moduli, ratios)
    law = (
        {"materials": [{"youngs_modulus": E, "poisson_ratio": nu} for E, nu in zip(moduli, ratios, strict=True)]}
        if materials
        else {"stiffness": K}
    )
    time = impact.duration(m1 * m2 / (m1 + m2), K, 1.5, v1 - v2)
    gap = 0.1 * (v1 - v2) * time
    direction = np.array([2, -1, 2]) / 3
    sections = {
        "bodies": {
            "a": ball(R1, m1, velocity=v1 * direction, angular_velocity=[1, 2, 3]),
            "b": ball(R2, m2, position=(R1 + R2 + gap) * direction, velocity=v2 * direction),
        },
        "forces": {"hit": {"type": "contact", "bodies": ["a", "b"], "restitution": e, **law}},
    }
    r = simulate(sections, duration=3 * time, step=time / 500, formulation=formulation)
    v = r.array("velocity")[-1] @ direction
    mean = (m1 * v1 + m2 * v2) / (m1 + m2)
    np.testing.assert_allclose(
        v, [mean - e * (v1 - v2) * m2 / (m1 + m2), mean + e * (v1 - v2) * m1 / (m1 + m2)], atol=2e-4
    )
    momentum = m1 * r.array("velocity")[:, 0] + m2 * r.array("velocity")[:, 1]
    np.testing.assert_allclose(momentum, np.tile((m1 + m2) * mean * direction, (len(r.time), 1)), atol=1e-12)
    # smooth: it goes on turning as before
    np.testing.assert_allclose(r.array("a.angular_velocity"), np.tile([1, 2, 3], (len(r.time), 1)), atol=1e-11)


def test_hertz_time_of_two_spheres():
    """e = 1: T follows from the depth reached and the time to be where they came from, reduced mass and radius."""
    m, R, E, nu, v = 0.4, 0.05, 1e7, 0.45, 0.8
    K = impact.hertz_stiffness((R, R), (E, E), (nu, nu))
    time, gap = impact.duration(m / 2, K, 1.5, v), 1e-3
    whole = 2 * gap / v + time
    sections = {
        "bodies": {"a": ball(R, m, velocity=[v, 0, 0]), "b": ball(R, m, position=[2 * R + gap, 0, 0])},
        "forces": {
            "hit": {
                "type": "contact",
                "bodies": ["a", "b"],
                "restitution": 1.0,
                "materials": [{"youngs_modulus": E, "poisson_ratio": nu}] * 2,
            }
        },
    }
    r = simulate(sections, duration=whole, step=whole / 2000)
    apart = r.array("b.position.x") - r.array("a.position.x") - 2 * R
    assert apart[-1] == pytest.approx(gap, abs=2e-5 * v * time)
    assert -apart.min() == pytest.approx(impact.deepest(m / 2, K, 1.5, v), rel=1e-4)


@FORMULATIONS
def test_bouncing_ball_loses_the_same_share_at_every_bounce(formulation):
    """Stiff ground: from height H the n-th top is e^(2n) H, but for the weight's work in the contact, 5e-4 m deep."""
    e, H, stiffness = 0.8, 0.5, 1e9
    sections = thrown({"stiffness": stiffness, "restitution": e}, H, 0.0) | {"gravity": [0, 0, -G]}
    r = simulate(sections, duration=1.9, step=2e-5, output_interval=2e-4, formulation=formulation)
    height = r.array("ball.position.z") - RADIUS
    tops = height[1:-1][(height[1:-1] > height[:-2]) & (height[1:-1] >= height[2:]) & (height[1:-1] > 0.02)]
    assert len(tops) >= 3
    np.testing.assert_allclose(tops[:3], H * e ** (2 * np.arange(1, 4)), atol=5e-4)


def standing(shape, corners, exponent=1.5, stiffness=1e6, **contact):
    """A body that stands on a plane tilted by 0.3 rad about a skew axis, with gravity along the plane's normal."""
    axis = np.array([0.6, 0.8, 0])
    c, s = np.cos(0.3), np.sin(0.3)
    normal = np.array([axis[1] * s, -axis[0] * s, c])
    depth = (3.0 * G / (corners * stiffness)) ** (1 / exponent)
    turned = {"axis": axis, "angle": 0.3}
    sections = {
        "gravity": -G * normal,
        "bodies": {"block": {"shape": shape, "mass": 3.0, "orientation": turned, "position": (0.05 - depth) * normal}},
        "markers": {"floor": {"body": "ground", "orientation": turned}},
        "forces": {
            "hold": {
                "type": "contact",
                "body": "block",
                "plane": "floor",
                "stiffness": stiffness,
                "exponent": exponent,
                "restitution": 0.3,
                **contact,
            }
        },
    }
    return sections, depth, normal


STANDING = {
    "box": ({"type": "box", "size": [0.2, 0.3, 0.1]}, 4),
    "sphere": ({"type": "sphere", "radius": 0.05}, 1),
    "cylinder-on-its-end": ({"type": "cylinder", "radius": 0.08, "length": 0.1, "along": "z"}, 4),
    "cylinder-on-its-side": ({"type": "cylinder", "radius": 0.05, "length": 0.2, "along": "y"}, 2),
}


@FORMULATIONS
@pytest.mark.parametrize("name", STANDING)
def test_body_rests_at_its_static_depth(name, formulation):
    """Points at the plane share the weight: depth (m g/(points K))^(1/n). Put there, it does not move.

    A contact at rest is damped as an approach of 1 cm/s: with e = 0.3 at g 3.1/(1 cm/s) = 3e3/s and thrice that about
    the axes, which takes a step of 2e-4 s.
    """
    shape, corners = STANDING[name]
    sections, depth, normal = standing(shape, corners)
    r = simulate(sections, duration=0.1, step=2e-4, output_interval=1e-3, formulation=formulation)
    np.testing.assert_allclose(r.array("block.position") @ normal, 0.05 - depth, atol=1e-12)
    np.testing.assert_allclose(r.array("force.hold.normal_force"), 3.0 * G, rtol=1e-9)
    np.testing.assert_allclose(r.array("force.hold.depth"), depth, rtol=1e-9)


def test_dropped_box_comes_to_rest_at_its_static_depth():
    """From one millimetre above: after half a second the centre is at the static depth."""
    sections, depth, normal = standing(*STANDING["box"], restitution=0.1)
    sections["bodies"]["block"]["position"] = 0.051 * normal
    r = simulate(sections, duration=0.5, step=1e-5, output_interval=0.01)
    assert r.array("block.position")[-1] @ normal == pytest.approx(0.05 - depth, abs=0.02 * depth)
    assert np.abs(r.array("block.velocity")[-1]).max() < 1e-3


@FORMULATIONS
def test_sliding_ball_begins_to_roll(formulation):
    """v = v0 - μ g t, R ω = 5/2 μ g t: rolling with 5/7 v0 from t = 2 v0/(7 μ g) on.

    The regularised friction is off by less than its transition speed, 1e-3 of v0; the depth, 2e-4 of R, shortens the
    radius on which the ball rolls.
    """
    mu, v0, transition = 0.3, 2.0, 2e-3
    depth = 1e-5
    stiffness = MASS * G / depth**1.5
    contact = {
        "stiffness": stiffness,
        "restitution": 0.5,
        "friction": mu,
        "friction_model": "coulomb",
        "friction_transition_speed": transition,
    }
    sections = thrown(contact, -depth, 0.0) | {"gravity": [0, 0, -G]}
    sections["bodies"]["ball"]["velocity"] = [v0, 0, 0]
    onset = 2 * v0 / (7 * mu * G)
    r = simulate(sections, duration=0.3, step=5e-5, output_interval=5e-3, formulation=formulation)
    t, v = r.time, r.array("ball.velocity.x")
    spin = r.array("ball.angular_velocity.y") * RADIUS
    before, after = t < onset - 0.005, t > onset + 0.01
    assert before.sum() > 20
    assert after.sum() > 10
    np.testing.assert_allclose(v[before], (v0 - mu * G * t)[before], atol=2e-3)
    np.testing.assert_allclose(spin[before], 2.5 * mu * G * t[before], atol=2e-3)
    np.testing.assert_allclose(v[after], 5 / 7 * v0, atol=2e-3)
    np.testing.assert_allclose(spin[after], v[after], atol=1e-3)
    assert np.abs(r.array("energy_error")).max() < 1e-5
    loss = 0.5 * MASS * v0**2 * 2 / 7  # ½ m v0² (1 - 5/7)
    assert r.array("dissipated_energy")[-1] == pytest.approx(loss, rel=2e-3)


@FORMULATIONS
def test_ball_slides_down_a_steep_incline(formulation):
    """Steeper than tan α = 7/2 μ it slides: a = g (sin α - μ cos α), R ω̇ = 5/2 μ g cos α."""
    mu, slope = 0.2, np.radians(50)
    depth = 1e-5
    contact = {
        "stiffness": MASS * G * np.cos(slope) / depth**1.5,
        "restitution": 0.5,
        "friction": mu,
        "friction_model": "coulomb",
        "friction_transition_speed": 1e-4,
    }
    sections = thrown(contact, -depth, 0.0) | {"gravity": [G * np.sin(slope), 0, -G * np.cos(slope)]}
    r = simulate(sections, duration=0.5, step=2e-5, output_interval=0.05, formulation=formulation)
    a = G * (np.sin(slope) - mu * np.cos(slope))
    # the transition takes v_t/a = 2e-5 s; the force acts at the plane, the depth nearer than the radius
    np.testing.assert_allclose(r.array("ball.velocity.x"), a * r.time, atol=2e-4)
    arm = (RADIUS - depth) / RADIUS
    np.testing.assert_allclose(
        r.array("ball.angular_velocity.y") * RADIUS, arm * 2.5 * mu * G * np.cos(slope) * r.time, atol=1e-4
    )


def test_gentle_incline_lets_a_ball_roll():
    """a = 5/7 g sin α; the creep of regularised friction, v_t atanh(2/7 tan α/μ), is below 1e-4 m/s."""
    mu, slope, depth = 0.5, np.radians(20), 1e-5
    contact = {
        "stiffness": MASS * G * np.cos(slope) / depth**1.5,
        "restitution": 0.5,
        "friction": mu,
        "friction_model": "coulomb",
        "friction_transition_speed": 1e-3,
    }
    sections = thrown(contact, -depth, 0.0) | {"gravity": [G * np.sin(slope), 0, -G * np.cos(slope)]}
    r = simulate(sections, duration=0.5, step=5e-5, output_interval=0.05)
    expected = 5 / 7 * G * np.sin(slope) * r.time
    np.testing.assert_allclose(r.array("ball.velocity.x"), expected, atol=1e-3)


@FORMULATIONS
def test_box_slides_down_an_incline(formulation):
    """a = g (sin α - μ cos α). It starts at the tilt at which front and rear corners balance the couple of friction:
    (N_f - N_r) l/2 = μ (N_f + N_r) h/2 for length l and height h."""
    mu, slope, mass, length, height, stiffness = 0.2, np.radians(30), 3.0, 0.4, 0.1, 1e8
    load = mass * G * np.cos(slope)
    share = mu * height / length
    front, rear = (((1 + sign * share) * load / (4 * stiffness)) ** (1 / 1.5) for sign in (1, -1))
    sections = {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": {
            "box": {
                "shape": {"type": "box", "size": [length, 0.2, height]},
                "mass": mass,
                "position": [0, 0, height / 2 - (front + rear) / 2],
                "orientation": {"axis": [0, 1, 0], "angle": (front - rear) / length},
                "velocity": [0.5, 0, 0],
            }
        },
        "markers": {"floor": {"body": "ground"}},
        "forces": {
            "rub": {
                "type": "contact",
                "body": "box",
                "plane": "floor",
                "stiffness": stiffness,
                "restitution": 0.2,
                "friction": mu,
                "friction_model": "coulomb",
                "friction_transition_speed": 1e-3,
            }
        },
    }
    r = simulate(sections, duration=0.5, step=2e-5, output_interval=0.01, formulation=formulation)
    a = G * (np.sin(slope) - mu * np.cos(slope))
    np.testing.assert_allclose(r.array("box.velocity.x"), 0.5 + a * r.time, atol=1e-4)
    np.testing.assert_allclose(r.array("box.position.x"), 0.5 * r.time + 0.5 * a * r.time**2, atol=1e-4)
    np.testing.assert_allclose(r.array("box.angular_velocity"), 0, atol=5e-3)


# --- stops ---


def buffered(stop, speed=0.8, **body):
    return {
        "bodies": {"block": solid(MASS, 0.01, velocity=[speed, 0, 0], **body)},
        "joints": {"rail": slide("ground", "block")},
        "forces": {"buffer": {"type": "stop", "coordinate": "rail.displacement", **stop}},
    }


@FORMULATIONS
@pytest.mark.parametrize("exponent", [1.0, 1.5])
def test_block_between_two_stops(exponent, formulation):
    """Thrown from one stop to the other: e v, then e² v; the speeds between are constant."""
    e, stiffness = 0.7, 4e4
    stop = {"lower": -0.01, "upper": 0.02, "stiffness": stiffness, "exponent": exponent, "restitution": e}
    r = simulate(buffered(stop), duration=0.16, step=1e-5, output_interval=1e-4, formulation=formulation)
    v, x = r.array("rail.displacement.rate"), r.array("rail.displacement")
    free = (x > -0.0099) & (x < 0.0199)
    speeds = []
    for value in v[free]:
        if not speeds or abs(value - speeds[-1]) > 1e-3:
            speeds.append(float(value))
    np.testing.assert_allclose(speeds[:3], [0.8, -0.8 * e, 0.8 * e * e], atol=2e-4)
    assert np.abs(r.array("energy_error")).max() < 1e-5


def test_linear_stop_without_loss_is_half_an_oscillation():
    """x - upper = v √(m/k) sin √(k/m) t in contact."""
    k, v = 4e4, 0.8
    stop = {"upper": 0.0, "stiffness": k, "restitution": 1.0}
    r = simulate(buffered(stop, v), duration=0.008, step=1e-5, output_interval=1e-4)
    omega = np.sqrt(k / MASS)
    inside = r.time < np.pi / omega
    np.testing.assert_allclose(
        r.array("rail.displacement")[inside], v / omega * np.sin(omega * r.time[inside]), atol=1e-7
    )
    assert r.array("rail.displacement.rate")[inside][-1] < -0.5


def test_rebound_from_a_stop_converges_with_the_step():
    """e = 0.6 against a linear stop, whose damping force jumps at touch: between two stops of the time grid, order one."""
    time = np.pi * np.sqrt(MASS / 4e4)
    steps, errors = [time / n for n in (25, 50, 100, 200, 400, 800)], []
    for step in steps:
        stop = {"upper": 0.8 * 0.37 * step, "stiffness": 4e4, "restitution": 0.6}
        r = simulate(buffered(stop), duration=4 * time, step=step, integrator="rk4")
        errors.append(abs(r.array("rail.displacement.rate")[-1] + 0.48))
    assert errors[-1] < 1e-3
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 0.9, errors


def test_pendulum_rests_on_its_stop():
    """Gravity presses a bar on an angular stop: at rest the stop's depth is m g c cos φ/k."""
    m, c, k = 2.0, 0.5, 5e3
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"bar": solid(m, 0.2, position=[c, 0, 0])},
        "joints": {"pin": {"type": "revolute", "bodies": ["ground", "bar"], "point": [0, 0, 0], "axis": [0, 0, 1]}},
        "forces": {
            "peg": {
                "type": "stop",
                "coordinate": "pin",
                "lower": -0.05,
                "stiffness": k,
                "restitution": 0.3,
            },
            # what the stop's restitution leaves at small speeds is taken by a damper
            "oil": {"type": "joint-spring-damper", "coordinate": "pin", "stiffness": 0, "damping": 5.0},
        },
    }
    r = simulate(sections, duration=3.0, step=5e-4, output_interval=0.01)
    angle = r.array("pin.angle")[-1]
    assert k * (-0.05 - angle) == pytest.approx(m * G * c * np.cos(angle), rel=1e-5)
