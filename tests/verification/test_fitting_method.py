"""The method of a machine that names none: by its fastest rate at the start, of what may touch, and of what it becomes on the way."""

import numpy as np
import pytest

from simulating import G, machine, simulate, slide, solid

SHORT = {"duration": 0.2}
STIFF = {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": 1e8, "damping": 1e5}
PAD = {"type": "contact", "body": "ball", "plane": "floor", "stiffness": 1e8, "restitution": 0.5}


def block(force, **start):
    """A block of 2 kg on a rail along x, with a force on its displacement."""
    return {
        "bodies": {"block": solid(2.0)},
        "joints": {"rail": slide("ground", "block", **start)},
        "forces": {"spring": force},
    }


def falling_ball():
    return {
        "gravity": [0, 0, -G],
        "bodies": {"ball": {"mass": 1, "shape": {"type": "sphere", "radius": 0.05}, "position": [0, 0, 0.2]}},
        "markers": {"floor": {"body": "ground"}},
        "forces": {"pad": PAD},
    }


def test_a_stiff_spring_is_stepped_over():
    """2 kg, 1e8 N/m and 1e5 N s/m: rates of 2.04e3/s and 4.9e4/s; the slow one decays as exp(-1020 t) - from the closed form."""
    r = simulate(block(STIFF, start={"displacement": 1e-3}), **SHORT)
    assert r.settings["integrator"] == "radau"
    assert (
        "spring has a rate of 4.9e+04/s, for which steps of rk4 would have to be below 2e-05 s" in r.settings["reason"]
    )
    fast, slow = np.roots([2.0, 1e5, 1e8])
    expected = 1e-3 * (fast * np.exp(slow * r.time) - slow * np.exp(fast * r.time)) / (fast - slow)
    np.testing.assert_allclose(r.array("rail.displacement"), expected, atol=1e-8)


@pytest.mark.parametrize("named", ["rk4", "heun"])
def test_a_method_that_is_named_is_taken(named):
    sections = block({**STIFF, "stiffness": 1e3, "damping": 0.0}, start={"displacement": 1e-3})
    r = simulate(sections, integrator=named, **SHORT)
    assert (r.settings["integrator"], "reason" in r.settings) == (named, False)


def test_where_nothing_is_fast_the_method_is_explicit():
    r = simulate(block({**STIFF, "stiffness": 1e3, "damping": 0.0}, start={"displacement": 1e-3}), **SHORT)
    assert r.settings["integrator"] == "rk4"
    assert r.settings["reason"] == "nothing is faster than 22/s (spring), which steps of 0.001 s follow"


def test_a_contact_counts_before_it_touches():
    """The ball bounces from 0.15 m to a quarter of the height; with steps that follow its impact the method stays explicit."""
    r = machine(falling_ball()).simulate(duration=0.5, verify=True)
    assert r.settings["integrator"] == "radau"
    assert r.trust.verdict == "green"
    height = r.array("ball.position.z")[r.time > 0.25].max() - 0.05
    assert height == pytest.approx(0.25 * 0.15, rel=2e-2)  # restitution by a damper holds to some percent
    fine = machine(falling_ball() | {"simulation": {"step": "20 us"}}).check()
    assert fine.settings.integrator == "rk4"
    assert "method: radau, because the contact pad has a rate of" in str(machine(falling_ball()).check())


def test_a_beam_has_the_method_of_vibrations():
    beam = {
        "from": [0, 0, 0],
        "to": [1, 0, 0],
        "up": [0, 0, 1],
        "elements": 2,
        "section": {"type": "circle", "radius": 0.01},
    }
    steel = {"youngs_modulus": 2e11, "poisson_ratio": 0.3, "density": 7850}
    sections = {
        "beams": {"rod": {**beam, "material": steel}},
        "joints": {"clamp": {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}},
    }
    found = machine(sections).check()
    assert found.settings.integrator == "generalised-alpha"
    assert "an element of the beam rod" in found.reason


def test_a_machine_that_becomes_fast_begins_anew():
    """The stiffness grows a thousand times, to 1e9 N/m, where steps of 1 ms let an explicit method grow without bound."""
    grows = {
        "type": "motor",
        "coordinate": "rail",
        "effort": "-(1e3 + 1e9*step(time, 0.05, 0, 0.1, 1))*rail.displacement",
    }
    sections = block(grows, start={"displacement": 1e-3})
    r = simulate(sections, **SHORT)
    assert r.settings["integrator"] == "radau"
    assert "(at t = 0." in r.settings["reason"]
    same = simulate(sections, integrator="radau", **SHORT)
    np.testing.assert_array_equal(r.array("rail.displacement"), same.array("rail.displacement"))


def test_steps_of_one_cost_where_a_machine_is_stepped():
    sections = block(STIFF, start={"displacement": 1e-3})
    sim = machine(sections).start(record=True)
    sim.advance(0.1)
    assert sim.result().settings["integrator"] == "ros2"
    assert sim["rail.displacement"] == pytest.approx(0.0, abs=1e-6)


def test_a_slack_rope_counts_before_it_is_taut():
    """2 kg fall by 0.5 m into a rope of 1e8 N/m, are stopped within π/7071 s, and rise again as they fell."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"load": solid(2.0, position=[0, 0, -0.5])},
        "joints": {"rail": slide("ground", "load", axis=[0, 0, 1], point=[0, 0, -0.5])},
        "forces": {
            "rope": {"type": "rope", "bodies": ["ground", "load"], "points": [[0, 0, 0], [0, 0, -0.5]], "length": 1, "stiffness": 1e8}
        },
    }  # fmt: skip
    r = simulate(sections, duration=0.6)
    assert r.settings["integrator"] == "radau"
    assert r.settings["reason"].startswith("rope has a rate of ")
    back = 2.0 * np.sqrt(2.0 * 0.5 / G) - r.time[-1]
    assert r.array("load.position.z")[-1] == pytest.approx(-0.5 - 0.5 * G * back**2, abs=1e-3)
    sections["forces"]["rope"]["stiffness"] = 1e4
    assert machine(sections).check().settings.integrator == "rk4"


def test_a_fast_rotor_is_resolved():
    sections = {
        "bodies": {"rotor": solid(1.0, angular_velocity=[0, 0, 6000.0])},
        "joints": {"axle": {"type": "revolute", "bodies": ["ground", "rotor"], "point": [0, 0, 0], "axis": [0, 0, 1]}},
    }
    r = machine(sections).simulate(duration=0.05, verify=True)
    assert r.settings["integrator"] == "radau"
    assert r.settings["reason"].startswith("the turning of rotor has a rate of 6e+03/s")
    assert r.trust.verdict == "green"
    assert r.array("axle.angle")[-1] == pytest.approx(300.0, rel=1e-9)


def test_a_rotor_that_becomes_fast_begins_anew():
    sections = {
        "bodies": {"rotor": solid(1.0, inertia=[1e-3, 1e-3, 1e-3])},
        "joints": {"axle": {"type": "revolute", "bodies": ["ground", "rotor"], "point": [0, 0, 0], "axis": [0, 0, 1]}},
        "forces": {"drive": {"type": "motor", "coordinate": "axle", "effort": 100}},
    }
    r = simulate(sections, duration=0.1)
    assert r.settings["integrator"] == "radau"
    assert "the turning of rotor (at t = 0." in r.settings["reason"]
    assert r.array("axle.angle")[-1] == pytest.approx(0.5 * 1e5 * 0.1**2, rel=1e-6)


def test_a_slow_machine_is_not_stepped_ten_million_times():
    """1000 kg on 1e-3 N/m: ω = 1e-3/s; over 1e4 s x = x₀ exp(-ζωt) (cos ωd t + ζ/√(1-ζ²) sin ωd t)."""
    soft = {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": 1e-3, "damping": 1e-2}
    sections = block(soft, start={"displacement": 0.1})
    sections["bodies"]["block"]["mass"] = 1000.0
    r = simulate(sections, duration=1e4)
    assert r.settings["integrator"] == "dopri5"
    assert "for which 1e+07 steps of rk4 are too many" in r.settings["reason"]
    zeta = 5e-3
    damped = 1e-3 * np.sqrt(1 - zeta**2)
    expected = 0.1 * np.exp(-zeta * 1e-3 * r.time)
    expected *= np.cos(damped * r.time) + zeta / np.sqrt(1 - zeta**2) * np.sin(damped * r.time)
    np.testing.assert_allclose(r.array("rail.displacement"), expected, atol=1e-6)
    assert simulate(sections, duration=1.0, step=1e-3).settings["integrator"] == "rk4"
