"""The same machine told in two ways, momenta that inner forces keep, drift without stabilisation, shafts at an angle."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from simulating import G, hinge, simulate, slide, slopes, solid, wheel

pytestmark = pytest.mark.covering

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])

# --- a joint the other way round: coordinates and efforts change their signs, the bodies do not notice ---
REVERSED = {
    "motor": ({"type": "motor", "effort": "0.5*sin(5*time)"}, {"type": "motor", "effort": "-0.5*sin(5*time)"}),
    "speed": (
        {"type": "motor", "speed": 3.0, "gain": 0.2, "limit": 0.4},
        {"type": "motor", "speed": -3.0, "gain": 0.2, "limit": 0.4},
    ),
    "spring": (
        {"type": "joint-spring-damper", "stiffness": 5.0, "damping": 0.05, "free_value": 0.3, "preload": 0.2},
        {"type": "joint-spring-damper", "stiffness": 5.0, "damping": 0.05, "free_value": -0.3, "preload": -0.2},
    ),
    "stop": (
        {"type": "stop", "lower": -0.2, "upper": 0.5, "stiffness": 500.0, "restitution": 0.6},
        {"type": "stop", "lower": -0.5, "upper": 0.2, "stiffness": 500.0, "restitution": 0.6},
    ),
    "coulomb": 2 * ({"type": "friction", "model": "coulomb", "coefficient": 0.3, "transition_speed": 0.01},),
    "stiction": 2 * ({"type": "friction", "model": "stiction", "coefficient": 0.3},),
    "lugre": 2 * ({"type": "friction", "model": "lugre", "coefficient": 0.3, "bristle_stiffness": 500.0},),
    "law": (
        {"type": "joint-spring-damper", "law": "4*value + 2*value^2 + 0.1*rate"},
        {"type": "joint-spring-damper", "law": "4*value - 2*value^2 + 0.1*rate"},
    ),
}


@FORMULATIONS
@pytest.mark.parametrize("kind", ["revolute", "translational"])
@pytest.mark.parametrize("name", REVERSED)
def test_a_reversed_joint_makes_the_same_machine(name, kind, formulation):
    """An arm on a moving base; the joint written from the base to the arm and from the arm to the base."""

    def run(way, element):
        joint = {"type": kind, "bodies": ["base", "arm"][::way], "point": [0.1, 0, 0], "axis": [0.2, 0.3, 1.0]}
        more = {"radius": 0.02} if element["type"] == "friction" and kind == "revolute" else {}
        sections = {
            "gravity": [1.0, -G, 2.0],
            "bodies": {
                "base": solid(2.0, (0.1, 0.12, 0.15), angular_velocity=[0, 0, 1.0]),
                "arm": solid(0.8, (0.02, 0.03, 0.035), position=[0.3, 0.1, 0]),
            },
            "joints": {"ball": {"type": "spherical", "bodies": ["ground", "base"], "point": [0, 0, 0.2]}, "j": joint},
            "forces": {"e": {**element, **more, "coordinate": "j"}},
        }
        return simulate(sections, duration=0.5, step=2e-4, output_interval=0.01, formulation=formulation)

    one, other = run(1, REVERSED[name][0]), run(-1, REVERSED[name][1])
    np.testing.assert_allclose(one.array("position"), other.array("position"), atol=1e-9)
    name = "j.angle" if kind == "revolute" else "j.displacement"
    np.testing.assert_allclose(one.array(name), -other.array(name), atol=1e-9)
    assert np.ptp(one.array(name)) > 1e-3


# --- forces between two free bodies ---
INNER = {
    "spring-damper": {"type": "spring-damper", "stiffness": 80.0, "free_length": 0.3, "damping": 1.0},
    "law": {"type": "spring-damper", "law": "50*(length - 0.3) + 30*(length - 0.3)^3 + 0.5*rate"},
    "pair-force": {"type": "pair-force", "magnitude": "-3/length + 2*sin(4*time)"},
    "bushing": {
        "type": "bushing",
        "stiffness": [40, 60, 80, 0.5, 0.8, 0.6],
        "damping": [1, 2, 1, 0.01, 0.02, 0.01],
    },
}


@FORMULATIONS
@pytest.mark.parametrize("name", INNER)
def test_inner_forces_keep_linear_and_angular_momentum(name, formulation):
    """Eccentric markers, both bodies tumbling."""
    m, J = (1.0, 2.0), np.array([[0.02, 0.03, 0.04], [0.05, 0.03, 0.04]])
    sections = {
        "bodies": {
            "a": solid(m[0], J[0], angular_velocity=[3, -2, 1], velocity=[0.2, 0, 0.1]),
            "b": solid(m[1], J[1], position=[0.5, 0.1, 0], angular_velocity=[-1, 2, 4]),
        },
        "forces": {
            "inner": {
                "markers": [{"body": "a", "position": [0.1, 0.05, 0]}, {"body": "b", "position": [-0.1, 0, 0.1]}],
                **INNER[name],
            }
        },
    }
    r = simulate(sections, duration=1.0, step=5e-4, output_interval=0.02, formulation=formulation)
    linear, angular = momenta(r, m, J)
    np.testing.assert_allclose(linear, np.tile(linear[0], (len(linear), 1)), atol=1e-12)
    # of order four: (ω h)⁵ per radian at 5 rad/s
    np.testing.assert_allclose(angular, np.tile(angular[0], (len(angular), 1)), atol=1e-9)
    assert np.abs(np.diff(r.array("a.velocity"), axis=0)).max() > 1e-2
    assert np.abs(r.array("energy_error")).max() < 1e-7


def momenta(r, m, J):
    """Linear and angular momentum about the origin of two bodies with frames at their centres of mass."""
    R, v, w = r.array("position"), r.array("velocity"), r.array("angular_velocity")
    A = Rotation.from_quat(r.array("orientation").reshape(-1, 4), scalar_first=True).as_matrix().reshape(-1, 2, 3, 3)
    spin = np.einsum("nbij,bj,nbkj,nbk->ni", A, J, A, w)
    return sum(m[b] * v[:, b] for b in (0, 1)), spin + sum(m[b] * np.cross(R[:, b], v[:, b]) for b in (0, 1))


def test_rubbing_spheres_keep_their_momenta():
    """An eccentric hit with spin and friction: it changes spins and directions, not the momenta."""
    m, R = (0.4, 0.9), (0.05, 0.07)
    J = np.array([[0.4 * m[k] * R[k] ** 2] * 3 for k in (0, 1)])
    bodies = {
        "a": {"shape": {"type": "sphere", "radius": R[0]}, "mass": m[0], "velocity": [2, 0, 0]}
        | {"angular_velocity": [0, 30, 20]},
        "b": {"shape": {"type": "sphere", "radius": R[1]}, "mass": m[1], "position": [0.13, 0.05, -0.02]},
    }
    hit = {"type": "contact", "bodies": ["a", "b"], "stiffness": 1e6, "restitution": 0.7, "friction": 0.3}
    sections = {
        "bodies": bodies,
        "forces": {"hit": {**hit, "friction_model": "coulomb", "friction_transition_speed": 0.02}},
    }
    r = simulate(sections, duration=0.03, step=5e-6, output_interval=1e-3)
    linear, angular = momenta(r, m, J)
    np.testing.assert_allclose(linear, np.tile(linear[0], (len(linear), 1)), atol=1e-12)
    np.testing.assert_allclose(angular, np.tile(angular[0], (len(angular), 1)), atol=1e-10)
    assert np.abs(r.array("b.angular_velocity")[-1]).max() > 1.0
    assert np.abs(r.array("energy_error")).max() < 1e-6


# --- bodies that rub on each other ---


@FORMULATIONS
@pytest.mark.parametrize("model", [{"model": "stiction"}, {"model": "coulomb", "transition_speed": 1e-3}])
def test_block_and_plank_come_to_one_speed(model, formulation):
    """A block thrown onto a plank that slides freely: both reach m1 v0/(m1 + m2) after v0/(μ g (1 + m1/m2)), and go on
    together: with stiction as one body, regularised with what slip is left."""
    m1, m2, mu, v0 = 1.0, 3.0, 0.25, 2.0
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"block": solid(m1, 0.01, velocity=[v0, 0, 0]), "plank": solid(m2, 0.1)},
        "joints": {"ice": slide("ground", "plank"), "top": slide("plank", "block")},
        "forces": {"rub": {"type": "friction", "coordinate": "top", "coefficient": mu, **model}},
    }
    step = 1e-4
    r = simulate(sections, duration=1.0, step=step, output_interval=0.01, formulation=formulation)
    t, together = r.time, m1 * v0 / (m1 + m2)
    end = v0 / (mu * G * (1 + m1 / m2))
    before, after = t < end - 0.02, t > end + 0.02
    block, plank = r.array("block.velocity.x"), r.array("plank.velocity.x")
    sharp = model["model"] == "stiction"
    np.testing.assert_allclose(block[before], v0 - mu * G * t[before], atol=1e-9)
    np.testing.assert_allclose(plank[before], mu * G * m1 / m2 * t[before], atol=1e-9)
    np.testing.assert_allclose(block[after], together, atol=1e-9)
    np.testing.assert_allclose(plank[after], together, atol=1e-9)
    loss = 0.5 * m1 * m2 / (m1 + m2) * v0**2
    assert r.array("dissipated_energy")[-1] == pytest.approx(loss, rel=1e-9 if not sharp else 1e-6)


@FORMULATIONS
def test_stuck_block_rides_on_a_shaken_plank(formulation):
    """The plank is driven to and fro below μ g: the block moves with it, to the nanometre."""
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"block": solid(1.0, 0.01), "plank": solid(3.0, 0.1, velocity=[0.3, 0, 0])},
        "joints": {"ice": slide("ground", "plank"), "top": slide("plank", "block")},
        "drivers": {"shaker": {"coordinate": "ice", "value": "0.05*sin(6*time)"}},  # 1.8 m/s² < 2.45 m/s²
        "forces": {"rub": {"type": "friction", "coordinate": "top", "coefficient": 0.25, "model": "stiction"}},
    }
    sections["bodies"]["block"]["velocity"] = [0.3, 0, 0]
    r = simulate(sections, duration=3.0, step=5e-4, output_interval=0.01, formulation=formulation)
    assert np.abs(r.array("top.displacement")).max() < 1e-8
    np.testing.assert_allclose(r.array("block.position.x"), 0.05 * np.sin(6 * r.time), atol=1e-8)


# --- drift without stabilisation: the second derivatives of every row are right ---
JOINTS = {
    "planar": {"type": "planar", "point": [0.2, 0.1, 0], "axis": [0.3, 1, 0.2]},
    "point-on-line": {"type": "point-on-line", "point": [0.2, 0.1, 0], "axis": [0.3, 1, 0.2]},
    "point-on-plane": {"type": "point-on-plane", "point": [0.2, 0.1, 0], "axis": [0.3, 1, 0.2]},
    "screw": {"type": "screw", "point": [0.2, 0.1, 0], "axis": [0.3, 1, 0.2], "pitch": 0.5},
    "distance": {"type": "distance", "points": [[0.1, 0.1, 0], [0.4, -0.1, 0.2]]},
    "revolute-spherical": {
        "type": "revolute-spherical",
        "points": [[0.1, 0.1, 0], [0.4, -0.1, 0.2]],
        "axis": [1, 2, 0],
    },
    "revolute-cylindrical": {
        "type": "revolute-cylindrical",
        "points": [[0.1, 0.1, 0], [0.4, -0.1, 0.2]],
        "axes": [[1, 2, 0], [0, 1, 1]],
    },
    "revolute-cylindrical-parallel": {
        "type": "revolute-cylindrical",
        "points": [[0.1, 0.1, 0], [0.4, -0.1, 0.2]],
        "axes": [[1, 2, 0], [1, 2, 0]],
    },
    "revolute-translational": {
        "type": "revolute-translational",
        "point": [0.2, 0.1, 0],
        "axes": [[1, 2, 0], [0, 0, 1]],
    },
    "rolling": {
        "type": "rolling",
        "points": [[0.2, 0.1, 0], [0.4, 0, 0.1]],
        "axes": [[0.1, -0.9, 0.5], [1, 0.3, 0]],
        "radius": 0.15,
        "rim_radius": 0.02,
    },
}


def two_bodies(joint):
    return {
        "gravity": [0, -G, 0],
        "bodies": {
            "a": solid(1.0, (0.02, 0.05, 0.04), centre_of_mass=[0.03, 0, 0.02], angular_velocity=[2, -1, 3]),
            "b": solid(2.0, (0.05, 0.03, 0.04), position=[0.4, 0, 0.1], velocity=[0, 1, 0.5]),
        },
        "joints": {
            "ball": {"type": "spherical", "bodies": ["ground", "a"], "point": [0, -0.1, 0]},
            "j": {**joint, "bodies": ["a", "b"]},
        },
    }


@FORMULATIONS
@pytest.mark.parametrize("name", JOINTS)
def test_drift_without_stabilisation_is_of_order_four(name, formulation):
    steps, errors = [4e-3, 2e-3, 1e-3], []
    for step in steps:
        methods = {"coordinates": "absolute", "stabilisation": "none", "formulation": formulation}
        r = simulate(two_bodies(JOINTS[name]), duration=0.4, step=step, **methods)
        errors.append(np.abs(r.array("constraint_violation")[-1]).max())
    assert np.all(slopes(steps, errors) > 3.7), errors
    assert errors[-1] < 1e-7


@FORMULATIONS
@pytest.mark.parametrize("name", JOINTS)
def test_joints_move_the_same_with_any_stabilisation(name, formulation):
    """Direct correction, Baumgarte's feedback (stiff by its default coefficients, so of lower order), no stabilisation,
    the other formulation."""
    runs = [
        simulate(two_bodies(JOINTS[name]), duration=0.4, step=2e-4, stabilisation=way, formulation=formulation)
        for way in ("direct", "baumgarte", "none")
    ]
    other = {"newton-euler": "lagrange", "lagrange": "newton-euler"}[formulation]
    runs.append(simulate(two_bodies(JOINTS[name]), duration=0.4, step=2e-4, formulation=other))
    for run, apart in zip(runs[1:], (5e-7, 1e-8, 1e-8), strict=True):
        np.testing.assert_allclose(run.array("position"), runs[0].array("position"), atol=apart)


# driver, and what it drives in closed form
DRIVEN = {
    "angle": {"coordinate": "top.angle", "value": "0.5*sin(6*time) + 2*time"},
    "along": {"marker": "tip", "along": "x", "relative_to": "post", "value": "0.3 + 0.1*sin(6*time)"},
}


@FORMULATIONS
@pytest.mark.parametrize(
    "stabilisation", [{"stabilisation": "none"}, {"stabilisation": "baumgarte", "baumgarte": {"alpha": 20, "beta": 20}}]
)
@pytest.mark.parametrize("name", DRIVEN)
def test_driven_coordinates_drift_with_order_four(name, stabilisation, formulation):
    """A double pendulum with one coordinate driven: with a wrong rate or acceleration the drift would be of order one."""
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {
            "upper": solid(1.0, (0.01, 0.02, 0.02), position=[0.15, 0, 0]),
            "lower": solid(1.5, (0.01, 0.02, 0.02), position=[0.45, 0, 0]),
        },
        "markers": {
            "tip": {"body": "upper", "position": [0.15, 0, 0.1]},
            "post": {"body": "ground"},
        },
        "joints": {"top": hinge("ground", "upper"), "knee": hinge("upper", "lower", (0.3, 0, 0))},
        "drivers": {"d": DRIVEN[name]},
    }
    if name == "along":
        # the upper pendulum starts at 30 degrees so that x = 0.26 m can be driven
        sections["drivers"]["d"] = {**DRIVEN[name], "value": "0.3*cos(0.5) + 0.1*sin(6*time)/6"}
        sections["joints"]["top"]["start"] = {"angle": 0.5}
        sections["assembly"] = {"largest_gap": 1.0}
    steps, errors = [4e-3, 2e-3, 1e-3], []
    for step in steps:
        r = simulate(sections, duration=0.4, step=step, formulation=formulation, **stabilisation)
        row = r.array("constraint_violation")
        errors.append(np.abs(row[-20:]).max())
    assert errors[-1] < 1e-6
    assert slopes(steps, errors).mean() > 3.5, errors


# --- Hooke's joint ---


@FORMULATIONS
def test_cardan_shaft_turns_unevenly(formulation):
    """Input driven at ω, output at the angle β: tan φ2 = tan φ1 cos β (arms as here), ω2 = ω cos β/(1 - sin²β cos²φ1)
    with φ1 counted from where the input's arm lies across the plane of the shafts."""
    beta, omega = np.radians(35), 8.0
    out = [np.cos(beta), np.sin(beta), 0]
    sections = {
        "bodies": {
            "input": solid(1.0, 0.01, angular_velocity=[omega, 0, 0]),
            "output": solid(1.0, 0.02, position=[0.2 * out[0], 0.2 * out[1], 0]),
        },
        "joints": {
            "left": {"type": "revolute", "bodies": ["ground", "input"], "point": [-0.2, 0, 0], "axis": [1, 0, 0]},
            # the cross holds the output's one end: its other end only needs to stay on its line
            "cross": {
                "type": "universal",
                "bodies": ["input", "output"],
                "point": [0, 0, 0],
                "axes": [[0, 0, 1], [-np.sin(beta), np.cos(beta), 0]],
            },
            "right": {
                "type": "point-on-line",
                "bodies": ["ground", "output"],
                "point": [0.4 * out[0], 0.4 * out[1], 0],
                "axis": out,
            },
        },
        "drivers": {"motor": {"coordinate": "left.angle", "value": "8*time"}},
        "sensors": {"turn": {"marker": "m", "quantity": "angular_velocity"}},
        "markers": {"m": {"body": "output"}},
    }
    r = simulate(sections, duration=2.0, step=5e-4, formulation=formulation)
    assert r.trust.redundant_rows == ()
    phi = omega * r.time  # the input's arm is along Z at first: across the plane XY of the shafts
    rate = omega * np.cos(beta) / (1 - np.sin(beta) ** 2 * np.cos(phi + np.pi / 2) ** 2)
    found = np.stack([r.array(f"sensor.turn.{axis}") for axis in "xyz"], axis=1)
    np.testing.assert_allclose(found @ out, rate, atol=1e-8)
    np.testing.assert_allclose(found, np.outer(rate, out), atol=1e-8)


@FORMULATIONS
def test_coupled_arms_of_a_cross(formulation):
    """A linear coupling of the two angles of a universal joint leaves one: angle_2 = -angle_1/2 as it swings."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"flap": solid(1.0, (0.02, 0.03, 0.04), position=[0.2, 0.1, -0.1], centre_of_mass=[0.05, 0, 0])},
        "joints": {
            "cross": {
                "type": "universal",
                "bodies": ["ground", "flap"],
                "point": [0, 0, 0],
                "axes": [[0, 1, 0], [1, 0, 0]],
            }
        },
        "couplings": {"tie": {"type": "linear", "coordinates": ["cross.angle_1", "cross.angle_2"], "factors": [1, 2]}},
    }
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    first, second = r.array("cross.angle_1"), r.array("cross.angle_2")
    assert np.ptp(first) > 0.5
    np.testing.assert_allclose(first + 2 * second, first[0] + 2 * second[0], atol=1e-11)
    assert np.abs(r.array("energy_error")).max() < 1e-7


@FORMULATIONS
def test_wheel_on_two_rims_rolls_down(formulation):
    """A cylinder on an incline, with friction enough: a = 2/3 g sin α; each rim's lowest point touches."""
    mu, slope, radius, mass = 0.5, np.radians(15), 0.06, 1.0
    depth = 1e-5
    sections = {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": {
            "roll": {
                "shape": {"type": "cylinder", "radius": radius, "length": 0.2, "along": "y"},
                "mass": mass,
                "position": [0, 0, radius - depth],
            }
        },
        "markers": {"floor": {"body": "ground"}},
        "forces": {
            "road": {
                "type": "contact",
                "body": "roll",
                "plane": "floor",
                "stiffness": mass * G * np.cos(slope) / 2 / depth**1.5,
                "restitution": 0.5,
                "friction": mu,
                "friction_model": "coulomb",
                "friction_transition_speed": 1e-3,
            }
        },
    }
    r = simulate(sections, duration=0.5, step=2e-5, output_interval=0.02, formulation=formulation)
    expected = 2 / 3 * G * np.sin(slope) * r.time
    np.testing.assert_allclose(r.array("roll.velocity.x"), expected, atol=1e-3)
    np.testing.assert_allclose(r.array("roll.angular_velocity.y") * radius, expected, atol=1e-3)
    np.testing.assert_allclose(r.array("roll.position.y"), 0, atol=1e-9)


def test_wheel_of_a_rack_meets_its_stop():
    """Coupling and stop together: the pinion throws the rack against its end; e of the restitution holds for the reduced
    mass m + J/r²."""
    m, J, radius, e, k = 2.0, 0.03, 0.1, 0.5, 1e5
    sections = {
        "bodies": {"pinion": wheel(J, angular_velocity=[0, 0, 10.0]), "bar": solid(m, 0.1, velocity=[1.0, 0, 0])},
        "joints": {"p": hinge("ground", "pinion"), "s": slide("ground", "bar")},
        "couplings": {"mesh": {"type": "rack", "joints": ["p", "s"], "radius": radius}},
        "forces": {"end": {"type": "stop", "coordinate": "s", "upper": 0.05, "stiffness": k, "restitution": e}},
    }
    r = simulate(sections, duration=0.1, step=1e-5, output_interval=1e-3)
    assert r.array("s.displacement.rate")[-1] == pytest.approx(-e, rel=2e-3)
    # deepest without loss: v √(M/k); the loss makes it less
    assert 0.05 < r.array("s.displacement").max() < 0.05 + np.sqrt((m + J / radius**2) / k)


# joint (between two bodies in spatial motion) or marker, and what is driven of it: at rest at time 0, at most 0.2 off
SPATIAL = {
    "planar": (JOINTS["planar"], {"coordinate": "j.x"}),
    "planar-angle": (JOINTS["planar"], {"coordinate": "j.angle"}),
    "point-on-plane": (JOINTS["point-on-plane"], {"coordinate": "j.y"}),
    "point-on-line": (JOINTS["point-on-line"], {"coordinate": "j"}),
    "screw": (JOINTS["screw"], {"coordinate": "j.angle"}),
    "revolute-spherical": (JOINTS["revolute-spherical"], {"coordinate": "j"}),
    "revolute-translational": (JOINTS["revolute-translational"], {"coordinate": "j.displacement"}),
    "universal": (
        {"type": "universal", "point": [0.2, 0, 0], "axes": [[1, 0, 0], [0, 0, 1]]},
        {"coordinate": "j.angle_1"},
    ),
    "universal-second": (
        {"type": "universal", "point": [0.2, 0, 0], "axes": [[1, 0, 0], [0, 0, 1]]},
        {"coordinate": "j.angle_2"},
    ),
    "cylindrical": ({"type": "cylindrical", "point": [0.2, 0, 0], "axis": [1, 1, 0]}, {"coordinate": "j.displacement"}),
    # the z axes of the two markers do not stay parallel
    "about": ({"type": "spherical", "point": [0.2, 0, 0]}, {"marker": "on_b", "about": "z", "relative_to": "on_a"}),
    "along": ({"type": "spherical", "point": [0.2, 0, 0]}, {"marker": "on_b", "along": "y", "relative_to": "on_a"}),
    "about-ground": ({"type": "spherical", "point": [0.2, 0, 0]}, {"marker": "on_b", "about": "z"}),
    "along-ground": ({"type": "spherical", "point": [0.2, 0, 0]}, {"marker": "on_b", "along": "z"}),
}


@FORMULATIONS
@pytest.mark.parametrize("name", SPATIAL)
def test_drivers_in_space_drift_with_order_four(name, formulation):
    """Only right second derivatives of the driven coordinate keep its rows closed without stabilisation; only right
    efforts close the energy. The start value is measured first, by a sensor."""
    joint, driver = SPATIAL[name]
    sections = two_bodies(joint)
    sections["markers"] = {
        "on_a": {"body": "a", "position": [0.1, 0, 0.05]},
        "on_b": {"body": "b", "position": [0, 0.1, 0.1], "orientation": {"axis": [1, 2, 0], "angle": 0.4}},
    }
    start = starting_value(sections, driver)
    sections["drivers"] = {"d": {**driver, "value": f"{start!r} + 0.1*(1 - cos(7*time))"}}
    steps, drifts, losses = [4e-3, 2e-3, 1e-3], [], []
    for step in steps:
        methods = {"coordinates": "absolute", "stabilisation": "none", "formulation": formulation}
        r = simulate(sections, duration=0.4, step=step, **methods)
        drifts.append(np.abs(r.array("constraint_violation")[-1]).max())
        losses.append(np.abs(r.array("energy_error")).max())
    assert slopes(steps, drifts)[-1] > 3.5, drifts
    assert slopes(steps, losses)[-1] > 3.5, losses
    # the driver works: its power is effort times the given rate
    np.testing.assert_allclose(
        r.array("driver.d.power"), r.array("driver.d.effort") * 0.7 * np.sin(7 * r.time), atol=1e-4
    )
    assert np.ptp(r.array("driver.d.power")) > 0.01


def starting_value(sections, driver):
    """What the driver would hold at the start, by sensors."""
    if "coordinate" in driver:
        sensor, name = {"coordinate": driver["coordinate"], "quantity": "value"}, "sensor.s"
    elif "about" in driver:
        reference = driver.get("relative_to", {"body": "ground"})
        sensor, name = {"angle": [reference, driver["marker"]]}, "sensor.s.angle"
    else:
        seen = {"relative_to": driver["relative_to"]} if "relative_to" in driver else {}
        sensor = {"marker": driver["marker"], "quantity": "position", **seen}
        name = f"sensor.s.{driver['along']}"
    r = simulate({**sections, "sensors": {"s": sensor}}, duration=1e-3, step=1e-3)
    return float(r.array(name)[0])
