"""Contacts and stops under error control: steps end where a surface begins or ceases to touch, so bounces are as exact as the tolerance."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from nivel.analysis.run import history
from references import impact
from simulating import G, simulate, slide, solid

pytestmark = pytest.mark.covering

MASS, RADIUS, HEIGHT = 0.4, 0.05, 0.5
ADAPTIVE = pytest.mark.parametrize("integrator", ["dopri5", "dop853", "adams", "gear"])
EXPLICIT = pytest.mark.parametrize("integrator", ["dopri5", "dop853"])


def bouncing(stiffness, exponent, restitution=1.0):
    """A ball over a floor, with events at its tops and where it touches."""
    hit = {"stiffness": stiffness, "exponent": exponent, "restitution": restitution}
    return {
        "gravity": [0, 0, -G],
        "bodies": {
            "ball": {"shape": {"type": "sphere", "radius": RADIUS}, "mass": MASS, "position": [0, 0, RADIUS + HEIGHT]}
        },
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"hit": {"type": "contact", "body": "ball", "plane": "floor", **hit}},
        "events": {"touch": {"when": f"ball.z - {RADIUS}", "direction": "falling"}},
    }


def elastic_duration(stiffness, exponent, speed):
    """T = 2 ∫ dδ/v over 0 … δmax, ½ m v² = ½ m v₀² + m g δ - K δⁿ⁺¹/(n + 1); with δ = δmax (1 - s²) the integrand is smooth."""

    def square(depth):
        return speed**2 + 2 * G * depth - 2 * stiffness * depth ** (exponent + 1) / (MASS * (exponent + 1))

    deepest = brentq(square, 1e-9, 0.1, xtol=1e-17)
    return (
        2
        * quad(lambda s: 2 * s * deepest / np.sqrt(square(deepest * (1 - s * s))), 1e-9, 1, epsabs=1e-13, epsrel=1e-12)[
            0
        ]
    )


@ADAPTIVE
@pytest.mark.parametrize(("exponent", "stiffness"), [(1.0, 1e5), (1.5, 1e7)])
def test_elastic_ball_bounces_at_the_times_of_the_closed_form(exponent, stiffness, integrator):
    """t_n = t₁ + (n - 1)(2 t₁ + T) with t₁ = √(2 H/g); each bounce magnifies no error. Ten times the tolerance over six bounces."""
    if integrator == "gear" and exponent == 1.5:
        tolerance, allowed = 1e-6, 1e-4
    else:
        tolerance, allowed = 1e-8, 5e-7
    r = simulate(bouncing(stiffness, exponent), duration=4.0, step=1e-2, integrator=integrator, tolerance=tolerance)
    first = np.sqrt(2 * HEIGHT / G)
    found = np.array([event.time for event in r.events])
    expected = first + np.arange(6) * (2 * first + elastic_duration(stiffness, exponent, np.sqrt(2 * G * HEIGHT)))
    np.testing.assert_allclose(found, expected, atol=allowed)
    assert np.abs(r.array("energy_error")).max() < allowed * MASS * G * HEIGHT * 10


@EXPLICIT
def test_location_needs_far_fewer_evaluations_for_the_same_error(integrator, monkeypatch):
    """A linear spring: smooth on either side, with a kink where it begins."""
    first, stiffness = np.sqrt(2 * HEIGHT / G), 1e5
    expected = first + np.arange(6) * (2 * first + elastic_duration(stiffness, 1.0, np.sqrt(2 * G * HEIGHT)))

    def run(tolerance):
        r = simulate(bouncing(stiffness, 1.0), duration=4.0, step=1e-2, integrator=integrator, tolerance=tolerance)
        return r.timing["evaluations"], np.abs(np.array([event.time for event in r.events]) - expected).max()

    evaluations, error = run(1e-8)
    watch = history._watch

    def unfollowed(system, *, chosen):
        watch(system, chosen=chosen)
        system.record.watched.followed[:] = 0
        return len(system.record.watched.event)

    monkeypatch.setattr(history, "_watch", unfollowed)
    without = [run(tolerance) for tolerance in (1e-8, 1e-9, 1e-10, 1e-11)]
    as_exact = [spent for spent, its in without if its <= error]
    assert not as_exact or min(as_exact) > 1.5 * evaluations, (evaluations, error, without)


@EXPLICIT
@pytest.mark.parametrize(("exponent", "stiffness", "bound"), [(1.0, 1e5, 1e-8), (1.5, 1e6, 1e-6), (2.0, 1e8, 1e-6)])
def test_rebound_is_the_restitution_to_the_tolerance(exponent, stiffness, bound, integrator):
    """No gravity: e v after a contact, exactly (`references.impact`), and the duration of the contact.

    Only the linear law has a smooth continuation beyond the surface; the last step of a contact sees a second derivative of δⁿ that jumps
    (n = 2) or is infinite (n = 1.5), which costs a hundred times the tolerance.
    """
    e, speed, gap = 0.6, 1.2, 0.01
    sections = bouncing(stiffness, exponent, e)
    sections["gravity"] = [0, 0, 0]
    sections["bodies"]["ball"] |= {"position": [0, 0, RADIUS + gap], "velocity": [0, 0, -speed]}
    sections["events"] = {"surface": {"when": f"ball.z - {RADIUS}"}}
    r = simulate(sections, duration=0.1, step=1e-3, integrator=integrator, tolerance=1e-9)
    assert r.array("ball.velocity.z")[-1] == pytest.approx(e * speed, rel=bound)
    touch, leave = (event.time for event in r.events)
    assert touch == pytest.approx(gap / speed, abs=1e-12)
    assert leave - touch == pytest.approx(impact.damped_duration(MASS, stiffness, exponent, speed, e), rel=bound)


@EXPLICIT
@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
def test_block_between_two_stops_keeps_the_restitution(coordinates, integrator):
    """e v, then e² v, then e³ v, each exactly; nothing else acts."""
    e = 0.7
    sections = {
        "bodies": {"block": solid(MASS, 0.01, velocity=[0.8, 0, 0])},
        "joints": {"rail": slide("ground", "block")},
        "forces": {
            "buffer": {
                "type": "stop",
                "coordinate": "rail",
                "lower": -0.01,
                "upper": 0.02,
                "stiffness": 4e4,
                "restitution": e,
            }
        },
        "events": {"middle": {"when": "rail.displacement - 0.005"}},
        "simulation": {"coordinates": coordinates},
    }
    r = simulate(sections, duration=0.3, step=1e-3, integrator=integrator, tolerance=1e-9)
    rate, place = r.array("rail.displacement.rate"), r.array("rail.displacement")
    free = rate[(place > -0.01) & (place < 0.02)]
    powers = np.round(np.log(np.abs(free) / 0.8) / np.log(e))
    assert set(powers) >= {0, 1, 2, 3}
    np.testing.assert_allclose(free, 0.8 * (-e) ** powers, rtol=1e-7)


@EXPLICIT
def test_contact_that_begins_and_ends_within_what_would_be_one_step_is_found(integrator):
    """Two spheres that meet head on, in free flight over a long time: a step could leap over the whole collision."""
    R, v, e = 0.05, 3.0, 0.5
    sphere = {"shape": {"type": "sphere", "radius": R}, "mass": MASS}
    sections = {
        "bodies": {"a": {**sphere, "velocity": [v, 0, 0]}, "b": {**sphere, "position": [1.0, 0, 0]}},
        "forces": {"hit": {"type": "contact", "bodies": ["a", "b"], "stiffness": 1e7, "restitution": e}},
    }
    r = simulate(sections, duration=10.0, step=1.0, output_interval=1.0, integrator=integrator, tolerance=1e-8)
    speeds = r.array("velocity")[-1, :, 0]
    np.testing.assert_allclose(speeds, [v * (1 - e) / 2, v * (1 + e) / 2], rtol=1e-6)


@EXPLICIT
def test_body_that_starts_in_contact_stays_at_its_static_depth(integrator):
    """Depth (m g/K)^(1/n): the surface is known to touch from the first evaluation on."""
    depth = (MASS * G / 1e6) ** (1 / 1.5)
    sections = bouncing(1e6, 1.5, 0.5)
    sections["bodies"]["ball"]["position"] = [0, 0, RADIUS - depth]
    r = simulate(sections, duration=0.5, step=1e-3, integrator=integrator, tolerance=1e-8)
    np.testing.assert_allclose(r.array("ball.position.z"), RADIUS - depth, atol=1e-10)
    assert r.events == ()


@EXPLICIT
def test_ball_that_starts_at_the_surface_is_held(integrator):
    """At the overlap zero it is apart, and touches at once."""
    sections = bouncing(1e6, 1.5, 0.5)
    sections["bodies"]["ball"]["position"] = [0, 0, RADIUS]
    r = simulate(sections, duration=0.2, step=1e-3, integrator=integrator, tolerance=1e-8)
    assert r.array("ball.position.z").min() > RADIUS - 3 * (MASS * G / 1e6) ** (1 / 1.5)
    assert np.abs(r.array("energy_error")).max() < 1e-7


@EXPLICIT
def test_dropped_box_comes_to_rest_on_its_corners(integrator):
    """Four corners touch at once; the centre ends at the static depth (m g/(4 K))^(1/n) below the half height."""
    K = 1e6
    sections = bouncing(K, 1.5, 0.1)
    sections["bodies"] = {
        "ball": {"shape": {"type": "box", "size": [0.2, 0.3, 0.1]}, "mass": 3.0, "position": [0, 0, 0.051]}
    }
    r = simulate(sections, duration=0.5, step=1e-3, integrator=integrator, tolerance=1e-7)
    depth = (3.0 * G / (4 * K)) ** (1 / 1.5)
    assert r.array("ball.position.z")[-1] == pytest.approx(0.05 - depth, abs=0.02 * depth)


def test_located_contacts_do_not_depend_on_the_chunks():
    from running import run
    from simulating import machine

    record = machine(bouncing(1e7, 1.5, 0.8)).record
    settings = {"duration": 1.5, "step": 1e-2, "output_interval": 1e-2, "integrator": "dopri5", "tolerance": 1e-7}
    whole = run(record, chunk_steps=10_000, **settings)
    parts = run(record, chunk_steps=1, **settings)
    assert np.array_equal(whole.frames, parts.frames)
    assert whole.finished.events == parts.finished.events


@pytest.mark.parametrize(("integrator", "bound"), [("dop853", 1e-9), ("dopri5", 1e-8), ("adams", 1e-8), ("gear", 1e-6)])
def test_event_times_follow_the_tolerance(integrator, bound):
    """The pendulum of `test_events` through its level, over three seconds."""
    import test_events as pendulums

    sections = pendulums.pendulum(level=pendulums.LEVEL)
    settings = {"duration": 3.0, "step": 1e-2, "tolerance": 1e-8 if integrator == "gear" else 1e-10}
    r = simulate(sections, integrator=integrator, **settings)
    expected = pendulums.passing(0.5)
    expected = expected[expected < 3.0]
    np.testing.assert_allclose([event.time for event in r.events], expected, atol=bound)
