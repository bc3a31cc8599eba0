"""Laws of users, as expressions and in Python, against the elements that are built in."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from simulating import G, hinge, simulate, slide, solid, wheel

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}

LAWS = '''
import math

import numpy as np

STIFFNESS = 150.0


def tension(length, rate, free_length, damping):
    return STIFFNESS*(length - free_length) + damping*rate


def drag(speed, factor):
    """Quadratic, against the motion."""
    return -factor*abs(speed)*speed


def gust(time, x):
    """Rises smoothly from 0.5 s on, and then pulls the cart back."""
    if time < 0.5:
        return 0.0
    return _smooth(time - 0.5)*(5.0*np.sin(6.0*time) - 40.0*x)


def _smooth(s):
    return s*s*(3.0 - 2.0*s)


def pulses(time):
    total = 0.0
    for k in range(1, 4):
        total += math.exp(-((time - 0.3*k)/0.05)**2)
    return total
'''


def law(function, *arguments):
    return {"source": LAWS, "function": function, "arguments": list(arguments)}


def spring_pendulum(spring):
    return {
        "gravity": [0, -G, 0],
        "bodies": {"bob": solid(1.0, 0.01, position=[0.5, 0.1, 0.2], velocity=[0, 0, 1])},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "bodies": ["ground", "bob"],
                "points": [[0, 0, 0], [0.5, 0.1, 0.2]],
                **spring,
            }
        },
    }


@FORMULATIONS
@pytest.mark.parametrize(
    "spring",
    [{"law": "150*(length - 0.4) + 2*rate"}, {"law": law("tension", "length", "rate", 0.4, 2.0)}],
    ids=["expression", "python"],
)
def test_law_is_the_built_in_spring(spring, formulation):
    built_in = spring_pendulum({"stiffness": 150.0, "free_length": 0.4, "damping": 2.0})
    a = simulate(built_in, duration=2.0, step=1e-3, formulation=formulation)
    b = simulate(spring_pendulum(spring), duration=2.0, step=1e-3, formulation=formulation)
    np.testing.assert_allclose(b.array("bob.position"), a.array("bob.position"), atol=1e-12)
    np.testing.assert_allclose(b.array("bob.orientation"), a.array("bob.orientation"), atol=1e-12)
    np.testing.assert_allclose(
        b.array("force.spring.magnitude"), a.array("force.spring.magnitude"), rtol=1e-10, atol=1e-10
    )
    # what is stored and dissipated there is the work of the law here
    np.testing.assert_allclose(b.array("energy_error"), a.array("energy_error"), atol=1e-7)


@FORMULATIONS
def test_law_of_joint_coordinates_is_the_built_in_joint_spring(formulation):
    def run(forces):
        sections = {
            "bodies": {"disk": wheel(0.02, angular_velocity=[0, 0, 10.0])},
            "joints": {"hub": hinge("ground", "disk")},
            "forces": forces,
        }
        return simulate(sections, duration=2.0, step=1e-3, formulation=formulation).array("hub.angle")

    where = {"type": "joint-spring-damper", "coordinate": "hub.angle"}
    expected = run({"s": {**where, "stiffness": 0.8, "damping": 0.01}})
    torque = {"type": "torque", "body": "disk", "vector": [0, 0, "-0.8*hub.angle - 0.01*hub.angle_rate"]}
    motor = {"type": "motor", "coordinate": "hub", "effort": "-0.8*hub.angle - 0.01*hub.angle_rate"}
    local = {**where, "law": "0.8*value + 0.01*rate"}
    for force in (torque, motor, local):
        np.testing.assert_allclose(run({"s": force}), expected, atol=1e-12)


MARKED = {
    "gravity": [0, -G, 0],
    "bodies": {"body": solid(1.3, 0.02, position=[0.2, 0.1, 0], velocity=[1.0, 2.0, -0.5], angular_velocity=[1, 2, 3])},
    "markers": {"point": {"body": "body", "position": [0, 0, 0]}, "tip": {"body": "body", "position": [0.1, 0, 0.05]}},
}


@FORMULATIONS
def test_signals_of_a_marker_make_springs_and_drag(formulation):
    """A force of the place and the velocity of the centre of mass: ẍ = (-40 x - 0.3 ẋ |…)…, integrated here."""
    vector = ["-40*point.x - 0.3*point.vx", "-25*(point.y - 0.1) - 0.2*point.vy", "-10*point.z - 0.1*body.vz"]
    sections = MARKED | {"forces": {"field": {"type": "force", "marker": "point", "vector": vector}}}
    r = simulate(sections, duration=2.0, step=1e-3, formulation=formulation)

    def slope(_t, y):
        x, y_, z, vx, vy, vz = y
        force = np.array([-40 * x - 0.3 * vx, -25 * (y_ - 0.1) - 0.2 * vy, -10 * z - 0.1 * vz])
        return np.concatenate([y[3:], force / 1.3 + [0, -G, 0]])

    found = solve_ivp(slope, (0, 2), [0.2, 0.1, 0, 1.0, 2.0, -0.5], t_eval=r.time, **TIGHT)
    np.testing.assert_allclose(r.array("body.position"), found.y[:3].T, atol=5e-9)
    np.testing.assert_allclose(r.array("energy_error"), 0, atol=1e-7)


@FORMULATIONS
def test_angular_velocity_signals_brake_a_free_body(formulation):
    """Torque -c ω in global axes on a body of equal moments: every component decays as exp(-c t/J)."""
    vector = [f"-0.05*tip.w{axis}" for axis in "xyz"]
    sections = MARKED | {"forces": {"brake": {"type": "torque", "body": "body", "vector": vector}}}
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    expected = np.outer(np.exp(-0.05 / 0.02 * r.time), [1, 2, 3])
    np.testing.assert_allclose(r.array("body.angular_velocity"), expected, atol=1e-10)


def test_python_law_with_branches_loops_and_signals():
    """Quadratic drag, a gust that begins later, and pulses of time."""
    sections = {
        "bodies": {"cart": solid(2.0, 0.01, velocity=[3.0, 0, 0])},
        "joints": {"rail": slide("ground", "cart")},
        "forces": {
            "air": {
                "type": "force",
                "body": "cart",
                "vector": [law("drag", "rail.displacement_rate", 0.8), 0, 0],
            },
            "wind": {"type": "force", "body": "cart", "vector": [law("gust", "time", "cart.x"), 0, 0]},
            "kicks": {"type": "force", "body": "cart", "vector": [law("pulses", "time"), 0, 0]},
        },
    }
    r = simulate(sections, duration=1.5, step=1e-3)

    def slope(t, y):
        force = -0.8 * abs(y[1]) * y[1] + sum(np.exp(-(((t - 0.3 * k) / 0.05) ** 2)) for k in (1, 2, 3))
        if t >= 0.5:
            force += (t - 0.5) ** 2 * (4 - 2 * t) * (5 * np.sin(6 * t) - 40 * y[0])
        return [y[1], force / 2.0]

    found = solve_ivp(slope, (0, 1.5), [0, 3.0], t_eval=r.time, max_step=1e-2, **TIGHT)
    # the gust's second derivative jumps, at a step of the grid
    np.testing.assert_allclose(r.array("rail.displacement"), found.y[0], atol=1e-8)


def test_table_of_a_signal():
    """A spring whose characteristic is a table of the displacement, and a brake by a table of the speed."""
    points = [-2.0, -0.5, 0.5, 2.0]
    spring = {"of": "rail.displacement", "points": points, "values": [6.0, 1.0, -1.0, -6.0]}
    sections = {
        "bodies": {"cart": solid(2.0, 0.01, velocity=[3.0, 0, 0])},
        "joints": {"rail": slide("ground", "cart")},
        "forces": {"pull": {"type": "force", "body": "cart", "vector": [spring, 0, 0]}},
    }
    r = simulate(sections, duration=3.0, step=5e-4, output_interval=0.01)
    found = solve_ivp(
        lambda _t, y: [y[1], np.interp(y[0], points, [6.0, 1.0, -1.0, -6.0]) / 2.0],
        (0, 3),
        [0, 3.0],
        t_eval=r.time,
        max_step=1e-3,
        **TIGHT,
    )
    assert found.y[0].max() > 2.0  # beyond the end, where the last value holds
    np.testing.assert_allclose(r.array("rail.displacement"), found.y[0], atol=1e-6)


def test_cubic_table_of_time_is_the_natural_spline():
    from scipy.interpolate import CubicSpline

    times, values = [0, 0.2, 0.5, 0.6, 1.0], [0, 3.0, -1.0, 2.0, 0.5]
    table = {"times": times, "values": values, "interpolation": "cubic"}
    sections = {
        "bodies": {"cart": solid(2.0, 0.01)},
        "forces": {"pull": {"type": "force", "body": "cart", "vector": [table, 0, 0]}},
    }
    r = simulate(sections, duration=1.2, step=1e-2)
    expected = CubicSpline(times, values, bc_type="natural")(np.minimum(r.time, 1.0)) / 2.0
    np.testing.assert_allclose(r.array("cart.acceleration.x"), expected, atol=1e-13)


def test_signals_of_sensors():
    """A spring made of the distance sensor's value and rate along X."""
    forces = {
        "pull": {
            "type": "force",
            "body": "cart",
            "vector": ["-100*(gap.distance - 0.5) - 3*gap.rate", 0, 0],
        }
    }
    sections = {
        "bodies": {"cart": solid(2.0, 0.01, position=[0.6, 0, 0])},
        "joints": {"rail": slide("ground", "cart")},
        "sensors": {"gap": {"distance": [{"body": "ground"}, {"body": "cart"}]}},
    }
    spring = {
        "pull": {
            "type": "spring-damper",
            "markers": [{"body": "ground"}, {"body": "cart"}],
            "stiffness": 100.0,
            "free_length": 0.5,
            "damping": 3.0,
        }
    }
    a = simulate(sections | {"forces": forces}, duration=1.0, step=1e-3)
    b = simulate(sections | {"forces": spring}, duration=1.0, step=1e-3)
    np.testing.assert_allclose(a.array("cart.position"), b.array("cart.position"), atol=1e-12)
