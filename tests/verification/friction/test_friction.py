"""Friction in joints: sliding, sticking, bristles, loads by the joint's own reaction that friction itself changes."""

import numpy as np
import pytest
from scipy.optimize import brentq

from references import stick_slip
from references.rubbing import RubbingPendulum, TwoSliders
from simulating import G, hinge, simulate, slide, solid, wheel

pytestmark = pytest.mark.covering

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
MASS, MU = 1.5, 0.3


def sled(friction, speed=0.0, forces=None, gravity=(0, -G, 0), axis=(1, 0, 0)):
    """A block on a rail along `axis`, rubbing."""
    axis = np.array(axis, dtype=float)
    return {
        "gravity": list(gravity),
        "bodies": {"block": solid(MASS, 0.01, velocity=speed * axis / np.linalg.norm(axis))},
        "joints": {"rail": slide("ground", "block", tuple(axis))},
        "forces": {
            "rub": {"type": "friction", "coordinate": "rail.displacement", "coefficient": MU, **friction},
            **(forces or {}),
        },
    }


@FORMULATIONS
@pytest.mark.parametrize("load", ["reaction", "normal_load"])
def test_block_slides_to_rest(load, formulation):
    """sinh(v/v_t) = sinh(v0/v_t) exp(-μ g t/v_t); h μ g/v_t = 0.006 keeps RK4 below 1e-9."""
    transition = 0.05
    friction = {"model": "coulomb", "transition_speed": transition}
    if load == "normal_load":
        friction["normal_load"] = MASS * G
    r = simulate(sled(friction, 1.2), duration=0.8, step=1e-4, output_interval=0.01, formulation=formulation)
    v = stick_slip.sliding_to_rest(r.time, MU * G, transition, 1.2)
    np.testing.assert_allclose(r.array("rail.displacement.rate"), v, atol=1e-9)
    np.testing.assert_allclose(r.array("force.rub.normal_load"), MASS * G, rtol=1e-12)
    np.testing.assert_allclose(r.array("force.rub.power"), -MU * MASS * G * np.tanh(v / transition) * v, atol=1e-8)
    np.testing.assert_allclose(r.array("dissipated_energy"), 0.5 * MASS * (1.44 - v**2), atol=1e-8)


@FORMULATIONS
def test_block_slides_down_an_incline_and_viscous_friction_limits_it(formulation):
    """m v̇ = m g (sin α - μ cos α) - b v from rest with stiction of one coefficient: v = v_end (1 - exp(-b t/m))."""
    slope, b = np.radians(40), 4.0
    gravity = (G * np.sin(slope), -G * np.cos(slope), 0)
    sections = sled({"model": "stiction", "viscous": b}, gravity=gravity)
    r = simulate(sections, duration=1.5, step=1e-3, formulation=formulation)
    end = MASS * G * (np.sin(slope) - MU * np.cos(slope)) / b
    np.testing.assert_allclose(r.array("rail.displacement.rate"), end * (1 - np.exp(-b / MASS * r.time)), atol=1e-9)


@FORMULATIONS
def test_block_brakes_and_stays(formulation):
    """μ_s = μ_d: v = v0 - μ g t until it stops at v0²/(2 μ g), and there it stays. Below μ g τ the speed dies out as
    exp(-t/τ), τ = 2 h, instead of in a straight line: μ g τ²/2 further."""
    errors = []
    for step in (1e-3, 5e-4, 2.5e-4):
        r = simulate(sled({"model": "stiction"}, 1.2), duration=1.0, step=step, formulation=formulation)
        stop = 1.2 / (MU * G)
        moving = r.time < stop - 2 * step
        np.testing.assert_allclose(r.array("rail.displacement.rate")[moving], 1.2 - MU * G * r.time[moving], atol=1e-10)
        errors.append(abs(r.array("rail.displacement")[-1] - 1.44 / (2 * MU * G)))
        assert abs(r.array("rail.displacement.rate")[-1]) < 1e-12
        assert errors[-1] < 2.5 * MU * G * step**2


@FORMULATIONS
def test_load_below_the_static_limit_is_held_without_creep(formulation):
    """An incline of 16 degrees with μ_s = 0.3 > tan: 10 s, and it has not moved by a nanometre."""
    slope = np.radians(16)
    gravity = (G * np.sin(slope), -G * np.cos(slope), 0)
    r = simulate(
        sled({"model": "stiction"}, gravity=gravity),
        duration=10.0,
        step=1e-3,
        output_interval=0.1,
        formulation=formulation,
    )
    assert np.tan(slope) < MU
    assert np.abs(r.array("rail.displacement")).max() < 1e-9
    assert np.abs(r.array("rail.displacement.rate")).max() < 1e-9


@FORMULATIONS
def test_changing_load_below_the_static_limit_is_held_without_creep(formulation):
    """A force to and fro of 0.95 μ N. A thousandth of what the effort changes by in a step h is left as acceleration, and
    its speed dies out within τ = 2 h: the place follows the load by 1e-3 h τ F/m at most, and nothing adds up."""
    force, step = 0.95 * MU * MASS * G, 1e-3
    shake = {"shake": {"type": "force", "body": "block", "vector": [f"{force}*sin(2*pi*time)", 0, 0]}}
    r = simulate(
        sled({"model": "stiction"}, forces=shake),
        duration=10.0,
        step=step,
        output_interval=0.1,
        formulation=formulation,
    )
    way = r.array("rail.displacement")
    assert np.abs(way).max() < 1e-3 * step * 2 * step * force / MASS
    assert np.abs(way[::10]).max() < 1e-12 * len(way)  # after every whole period


@FORMULATIONS
def test_block_breaks_away_at_the_static_limit(formulation):
    """Under a force that grows as 2 N/s it holds until μ_s N, then m v̇ = 2 t - μ N: v = (t - t0)²/m.

    The step in which it breaks away is known to h: (t - t0) h/m.
    """
    pull = {"pull": {"type": "force", "body": "block", "vector": ["2*time", 0, 0]}}
    r = simulate(sled({"model": "stiction"}, forces=pull), duration=3.0, step=5e-4, formulation=formulation)
    t0 = MU * MASS * G / 2
    before, after = r.time < t0 - 1e-3, r.time > t0 + 1e-3
    assert np.abs(r.array("rail.displacement")[before]).max() < 1e-3 * 5e-4 * 1e-3 * MU * G
    expected = (r.time[after] - t0) ** 2 / MASS
    np.testing.assert_allclose(r.array("rail.displacement.rate")[after], expected, atol=1e-6)


def drawn(friction, speed, stiffness):
    """A carriage driven along X at `speed` draws the block by a spring. Slack at the start."""
    sections = sled(friction)
    sections["bodies"]["carriage"] = solid(1.0, 0.01, position=[0.3, 0, 0], velocity=[speed, 0, 0])
    sections["joints"]["track"] = slide("ground", "carriage")
    sections["drivers"] = {"winch": {"coordinate": "track.displacement", "value": f"{speed}*time"}}
    sections["forces"]["rope"] = {
        "type": "spring-damper",
        "markers": [{"body": "block"}, {"body": "carriage"}],
        "stiffness": stiffness,
        "free_length": 0.3,
    }
    return sections


STRIBECK = 0.01
DRAWN = stick_slip.Drawn(
    mass=MASS, stiffness=600.0, speed=0.05, load=MASS * G, static=0.4, kinetic=0.25, stribeck=STRIBECK
)


@FORMULATIONS
def test_stick_slip_against_the_piecewise_solution(formulation):
    """Several cycles with Stribeck's curve, the reference with an event at every rest. The method is of order one at
    least: each change between sticking and slipping falls somewhere within a step."""
    friction = {"model": "stiction", "coefficient": 0.25, "static_coefficient": 0.4, "stribeck_speed": STRIBECK}
    steps, errors = [1e-3, 5e-4, 2.5e-4, 1.25e-4], []
    for step in steps:
        r = simulate(
            drawn(friction, DRAWN.speed, DRAWN.stiffness),
            duration=2.0,
            step=step,
            output_interval=0.01,
            formulation=formulation,
        )
        way, rests = DRAWN.integrated(r.time)
        assert len(rests) >= 4
        errors.append(np.abs(r.array("rail.displacement") - way).max())
    # one cycle moves it by 2 cm
    assert errors[-1] < 1e-4
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 0.7, errors


@pytest.mark.parametrize("stribeck", [0, 1e-5])
def test_stick_slip_closed_form_with_a_sharp_curve(stribeck):
    """Stribeck's speed of 1e-5 m/s is none for the block, and 0 is none: first slip, rest and second slip at their closed times."""
    sharp = stick_slip.Drawn(**{**DRAWN.__dict__, "stribeck": 0.0})
    friction = {"model": "stiction", "coefficient": 0.25, "static_coefficient": 0.4, "stribeck_speed": stribeck}
    r = simulate(drawn(friction, sharp.speed, sharp.stiffness), duration=1.0, step=1e-4, output_interval=1e-3)
    assert 2 * sharp.slip_duration + sharp.first_slip + sharp.stick_duration < 1.0
    np.testing.assert_allclose(r.array("rail.displacement"), sharp.closed_form(r.time), atol=3e-4)
    resting = (r.time > sharp.first_slip + sharp.slip_duration + 5e-3) & (
        r.time < sharp.first_slip + sharp.slip_duration + sharp.stick_duration - 5e-3
    )
    assert np.abs(r.array("rail.displacement.rate")[resting]).max() < 1e-9


@pytest.mark.parametrize("stribeck", [0, 1e-6])
def test_the_time_of_coming_to_rest_after_an_abrupt_fall_of_friction_converges(stribeck):
    """The tension k s = μ_d N + (μ_s - μ_d) N cos ωτ + (v/ω) k sin ωτ after breaking away gives the block's speed v - ṡ, which an event
    sees fall to 1 mm/s. The switch from rest to slip falls somewhere in a step: order one."""
    pull, load = DRAWN, DRAWN.load
    omega = np.sqrt(pull.stiffness / MASS)
    more = (pull.static - pull.kinetic) * load / pull.stiffness

    def speed(tau):
        return pull.speed * (1.0 - np.cos(omega * tau)) + more * omega * np.sin(omega * tau)

    begin = pull.static * load / (pull.stiffness * pull.speed)
    rest = 2.0 * (np.pi - np.arctan(more * omega / pull.speed)) / omega
    exact = begin + brentq(lambda tau: speed(tau) - 1e-3, 0.5 * rest, rest)
    friction = {"model": "stiction", "coefficient": 0.25, "static_coefficient": 0.4, "stribeck_speed": stribeck}
    slow = {"slow": {"when": "rail.displacement_rate - 1 mm/s", "direction": "falling", "stop": True}}
    sections = {**drawn(friction, pull.speed, pull.stiffness), "events": slow}
    errors = []
    for step in (2e-3, 5e-4, 1.25e-4):
        r = simulate(sections, duration=2.0, step=step, output_interval=0.01)
        assert r.stopped_by == "slow"
        errors.append(abs(r.events[-1].time - exact))
    assert errors[0] < 1e-2
    assert errors[1] < errors[0] / 2
    assert errors[2] < errors[1] / 2


@FORMULATIONS
@pytest.mark.parametrize("pull", ["3*sin(6*time)", "8*min(1, time/0.3)"])
def test_bristles_of_lugre(pull, formulation):
    """Pre-sliding to and fro, and break-away, against the scalar equations. Sliding at 0.9 m/s the bristles relax at
    σ0 v/μ = 3.6e4/s, which RK4 follows with a step of 5e-5 s."""
    sigma0, sigma1, static, stribeck = 1e4, 60.0, 0.4, 0.02
    friction = {
        "model": "lugre",
        "coefficient": 0.25,
        "static_coefficient": static,
        "stribeck_speed": stribeck,
        "bristle_stiffness": sigma0,
        "bristle_damping": sigma1,
    }
    force = {"pull": {"type": "force", "body": "block", "vector": [pull, 0, 0]}}
    sections = sled(friction, forces=force)
    r = simulate(sections, duration=0.6, step=5e-5, output_interval=0.01, formulation=formulation)

    def pulling(t):
        return 3 * np.sin(6 * t) if "sin" in pull else 8 * min(1, t / 0.3)

    x, v, _ = stick_slip.bristle(r.time, MASS, MASS * G, (static, 0.25, stribeck), (sigma0, sigma1), pulling)
    scale = np.abs(x).max()
    assert (scale > 0.1) == ("min" in pull)  # slides away, or stays within its bristles
    np.testing.assert_allclose(r.array("rail.displacement"), x, atol=1e-5 * scale)
    np.testing.assert_allclose(r.array("rail.displacement.rate"), v, atol=1e-4 * np.abs(v).max())


# --- loads by the joint's own reaction ---
PIN = RubbingPendulum(mass=2.0, arm=0.4, inertia=2.0 * 0.16 + 0.02, coefficient=0.3, radius=0.03)


THICK = RubbingPendulum(**{**PIN.__dict__, "radius": 0.1})


def rubbing_pendulum(friction, start):
    return {
        "gravity": [0, -G, 0],
        "bodies": {
            "bar": solid(
                PIN.mass,
                (0.02, 1e-3, 0.02),
                position=[PIN.arm * np.sin(start), -PIN.arm * np.cos(start), 0],
                orientation={"axis": [0, 0, 1], "angle": start},
            )
        },
        "joints": {
            "pin": {
                "type": "revolute",
                "markers": [{"body": "ground"}, {"body": "bar", "position": [0, PIN.arm, 0]}],
            }
        },
        "forces": {
            "rub": {
                "type": "friction",
                "coordinate": "pin.angle",
                "coefficient": PIN.coefficient,
                "radius": PIN.radius,
                **friction,
            }
        },
    }


@FORMULATIONS
def test_pendulum_on_a_thick_pin_with_regularised_friction(formulation):
    """The load depends on the acceleration, and this on the friction; the reference solves that at every evaluation."""
    sections = rubbing_pendulum({"model": "coulomb", "transition_speed": 5e-3}, 1.2)
    r = simulate(sections, duration=3.0, step=5e-4, output_interval=0.05, formulation=formulation)
    np.testing.assert_allclose(r.array("pin.angle"), PIN.regularised(r.time, 1.2, 5e-3), atol=1e-7)
    # the load that the friction reports is the reaction across the pin
    force = r.array("pin.force")
    np.testing.assert_allclose(r.array("force.rub.normal_load"), np.hypot(force[:, 0], force[:, 1]), rtol=1e-9)


@FORMULATIONS
def test_pendulum_on_a_thick_pin_comes_to_rest_aside(formulation):
    """Dry friction from reversal to reversal; order one in the step because of the reversals. It sticks off the vertical,
    within μ r/l, and hangs there."""
    times = np.linspace(0, 6, 121)
    expected, turns = THICK.dry(times, 1.2)
    rest = expected[-1]
    assert len(turns) > 4
    assert 5e-3 < abs(rest) < THICK.coefficient * THICK.radius / THICK.arm
    assert np.all(expected[-10:] == rest)
    steps, errors = [1e-3, 5e-4, 2.5e-4], []
    for step in steps:
        r = simulate(
            rubbing_pendulum({"model": "stiction", "radius": THICK.radius}, 1.2),
            duration=6.0,
            step=step,
            output_interval=0.05,
            formulation=formulation,
        )
        errors.append(np.abs(r.array("pin.angle") - expected).max())
    assert errors[-1] < 1e-3
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 0.9, errors
    assert np.abs(np.diff(r.array("pin.angle")[-10:])).max() < 1e-9


PAIR = TwoSliders(mass_a=1.0, mass_b=2.0, length=1.0, coefficient=0.4, transition=0.02)


def two_sliders(angle, push, friction, pair=PAIR):
    """A on the X rail, B on the Y rail, a massless rod between; the push on A goes towards the corner."""
    c, s = pair.length * np.cos(angle), pair.length * np.sin(angle)
    rub = {"type": "friction", "coefficient": pair.coefficient, **friction}
    return {
        "gravity": [0, -G, 0],
        "bodies": {
            "a": solid(pair.mass_a, 0.01, position=[c, 0, 0]),
            "b": solid(pair.mass_b, 0.01, position=[0, s, 0]),
        },
        "joints": {
            "floor": slide("ground", "a", (1, 0, 0), point=[c, 0, 0]),
            "wall": slide("ground", "b", (0, 1, 0), point=[0, s, 0]),
            "rod": {"type": "spherical-spherical", "bodies": ["a", "b"], "points": [[c, 0, 0], [0, s, 0]]},
        },
        "forces": {
            "push": {"type": "force", "body": "a", "vector": [push, 0, 0]},
            "rub_a": {**rub, "coordinate": "floor.displacement"},
            "rub_b": {**rub, "coordinate": "wall.displacement"},
        },
    }


@FORMULATIONS
def test_friction_of_two_sliders_loads_itself(formulation):
    """The rod's force, hence both loads, grow with the friction they cause; from near the locking angle upwards."""
    friction = {"model": "coulomb", "transition_speed": PAIR.transition}
    start = np.arctan(PAIR.coefficient) + 0.1
    r = simulate(
        two_sliders(start, "-300*(1 - exp(-5*time))", friction),
        duration=0.5,
        step=2e-4,
        output_interval=0.01,
        formulation=formulation,
    )
    angle, rod = PAIR.motion(r.time, start, lambda t: 300 * (1 - np.exp(-5 * t)))
    assert angle[-1] - start > 0.3
    assert angle.max() < 1.5
    x, y = r.array("a.position.x"), r.array("b.position.y")
    np.testing.assert_allclose(np.arctan2(y, x), angle, atol=1e-6)
    # load on the wall: S cos θ; on the floor: weight and S sin θ
    np.testing.assert_allclose(r.array("force.rub_b.normal_load"), np.abs(rod * np.cos(angle)), atol=1e-3)
    np.testing.assert_allclose(
        r.array("force.rub_a.normal_load"), np.abs(PAIR.mass_a * G + rod * np.sin(angle)), atol=1e-3
    )


@pytest.mark.parametrize(("beyond", "moves"), [(-0.05, False), (0.1, True)])
def test_self_locking_is_where_the_tangent_is_the_coefficient(beyond, moves):
    """Pushed by a force that grows to 200 weights: below tan θ = μ no force lifts B, above it one does. At first, while
    the push is small, B may slip down."""
    angle = np.arctan(PAIR.coefficient) + beyond
    sections = two_sliders(angle, "-2000*time", {"model": "stiction"})
    r = simulate(sections, duration=0.2 if moves else 1.0, step=5e-4)
    height = r.array("b.position.y")
    rise = height[-1] - height.min()
    if moves:
        assert rise > 0.01
    else:
        assert rise < 1e-7


def test_bending_moment_loads_a_short_guide():
    """A push above the guide at height h: the bearing of length l feels 2 P h/l besides the weight.

    Block weightless here (no gravity): v̇ = (P - μ 2 P h/l)/m; with 2 μ h >= l the drawer jams.
    """
    P, h, span = 10.0, 0.2, 0.5

    def run(length, model):
        push = {"push": {"type": "force", "body": "block", "position": [0, h, 0], "vector": [P, 0, 0]}}
        friction = {"model": model, "bearing_length": length}
        return simulate(sled(friction, forces=push, gravity=(0, 0, 0)), duration=0.5, step=1e-3)

    r = run(span, "stiction")
    np.testing.assert_allclose(
        r.array("rail.displacement.rate"), (P - MU * 2 * P * h / span) / MASS * r.time, rtol=1e-8, atol=1e-8
    )
    np.testing.assert_allclose(r.array("force.rub.normal_load")[1:], 2 * P * h / span, rtol=1e-9)
    jammed = run(2 * MU * h * 0.95, "stiction")
    assert np.abs(jammed.array("rail.displacement")).max() < 1e-9


def test_torque_about_the_axis_loads_a_spline():
    """A torque T about the slide's axis is carried at the radius r: load T/r, besides the weight."""
    T, radius = 4.0, 0.05
    twist = {"twist": {"type": "torque", "body": "block", "vector": [T, 0, 0]}}
    friction = {"model": "stiction", "radius": radius}
    r = simulate(sled(friction, 3.0, forces=twist), duration=0.05, step=1e-3)
    load = MASS * G + T / radius
    np.testing.assert_allclose(r.array("force.rub.normal_load"), load, rtol=1e-9)
    np.testing.assert_allclose(r.array("rail.displacement.rate"), 3.0 - MU * load / MASS * r.time, rtol=1e-9)


@pytest.mark.parametrize("down", [-1.0, 1.0])
def test_collar_and_preload_of_a_pin(down):
    """A wheel on a vertical pin: its weight rubs at the collar, whichever side it lies on, a preload at the pin.
    J φ̈ = -μ (r P + R m g), load P + m g R/r at the radius r."""
    J, m, radius, collar, preload = 0.02, 1.0, 0.01, 0.03, 20.0
    sections = {
        "gravity": [0, 0, down * G],
        "bodies": {"disk": wheel(J, angular_velocity=[0, 0, 50.0])},
        "joints": {"pin": hinge("ground", "disk")},
        "forces": {
            "rub": {
                "type": "friction",
                "coordinate": "pin",
                "model": "stiction",
                "coefficient": MU,
                "radius": radius,
                "collar_radius": collar,
                "preload": preload,
            }
        },
    }
    r = simulate(sections, duration=1.0, step=1e-3)
    load = preload + m * G * collar / radius
    np.testing.assert_allclose(r.array("force.rub.normal_load"), load, rtol=1e-10)
    np.testing.assert_allclose(r.array("pin.angle.rate"), 50 - MU * radius * load / J * r.time, rtol=1e-9)


@FORMULATIONS
def test_friction_that_a_driver_overcomes_is_the_drivers_effort(formulation):
    """Block drawn at 0.4 m/s by a driver: effort μ N; power of the driver = heat."""
    sections = sled({"model": "coulomb", "transition_speed": 0.01}, 0.4)
    sections["drivers"] = {"winch": {"coordinate": "rail.displacement", "value": "0.4*time"}}
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    effort = MU * MASS * G * np.tanh(0.4 / 0.01)
    np.testing.assert_allclose(r.array("driver.winch.effort"), effort, rtol=1e-9)
    np.testing.assert_allclose(r.array("dissipated_energy"), effort * 0.4 * r.time, atol=1e-9)
    np.testing.assert_allclose(r.array("energy_error"), 0, atol=1e-9)


def test_driven_normal_load_of_friction_in_a_loop():
    """A wedge of joints: block on an inclined rail pushed level by P has N = m g cos α + P sin α (no friction in it), and
    moves up at g … : m v̇ = P cos α - m g sin α - μ N."""
    slope, P = np.radians(25), 30.0
    axis = (np.cos(slope), np.sin(slope), 0)
    push = {"push": {"type": "force", "body": "block", "vector": [P, 0, 0]}}
    r = simulate(sled({"model": "stiction"}, forces=push, axis=axis), duration=0.5, step=1e-3)
    load = MASS * G * np.cos(slope) + P * np.sin(slope)
    a = (P * np.cos(slope) - MASS * G * np.sin(slope) - MU * load) / MASS
    assert a > 0
    np.testing.assert_allclose(r.array("rail.displacement"), 0.5 * a * r.time**2, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("bodies", [("ground", "block"), ("block", "ground")])
def test_bending_moment_is_taken_about_the_bearing_that_slides(bodies):
    """A slider far out on its rail: the moment of its weight about itself is zero wherever the rail begins."""
    sections = sled({"model": "stiction", "bearing_length": 0.1}, 3.0)
    rail = next(iter(sections["joints"].values()))
    rail["bodies"] = list(bodies)
    r = simulate(sections, duration=0.5, step=1e-3)
    load = r.array("force.rub.normal_load")
    np.testing.assert_allclose(load, MASS * G, rtol=1e-9)
