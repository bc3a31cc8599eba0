"""Planar, point and screw joints against closed forms and independent equations of one degree of freedom."""

import numpy as np
import pytest

from references import guided
from simulating import G, hinge, simulate, solid, turning_error

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
PARTICLES = pytest.mark.parametrize("particle", [True, False], ids=["point-mass", "rigid"])


def ball(particle, mass, position, **more):
    """A point mass, or a rigid body that is free to turn about the point."""
    if particle:
        return {"point_mass": True, "mass": mass, "position": list(position), **more}
    return solid(mass, 0.01 * mass, position=list(position), **more)


@FORMULATIONS
def test_planar_motion_is_a_parabola_and_a_steady_turn(formulation):
    """On a plane at 30 degrees, from above: x = v t, y = w t - ½ g sin 30° t², angle = ω t."""
    tilt, omega = np.radians(30), 4.0
    normal = np.array([0, -np.sin(tilt), np.cos(tilt)])
    up = np.array([0, np.cos(tilt), np.sin(tilt)])
    turned = {"axis": [1, 0, 0], "angle": tilt}
    v = 0.7 * np.array([1, 0, 0]) + 1.5 * up
    machine = {
        "gravity": [0, 0, -G],
        "bodies": {
            "puck": solid(2.0, (0.1, 0.2, 0.15), orientation=turned, velocity=v, angular_velocity=omega * normal)
        },
        "joints": {
            "ice": {
                "type": "planar",
                "bodies": ["ground", "puck"],
                "point": [0, 0, 0],
                "axis": normal,
                "x_axis": [1, 0, 0],
            }
        },
    }
    r = simulate(machine, duration=2.0, step=1e-3, formulation=formulation)
    t = r.time
    np.testing.assert_allclose(r.array("ice.x"), 0.7 * t, atol=1e-11)
    np.testing.assert_allclose(r.array("ice.y"), 1.5 * t - 0.5 * G * np.sin(tilt) * t**2, atol=1e-11)
    np.testing.assert_allclose(r.array("ice.angle"), omega * t, atol=1e-10)
    np.testing.assert_allclose(r.array("ice.angle.rate"), omega, atol=1e-10)
    # the plane carries the weight's normal part; the ground feels it downwards
    np.testing.assert_allclose(r.array("ice.force"), np.tile(-2 * G * np.cos(tilt) * normal, (len(t), 1)), atol=1e-9)


def test_planar_joint_carries_the_moment_of_a_product_of_inertia():
    """Steady turn about Z with ω: the body needs the torque ω × J ω, J turning with it; on the ground its opposite.

    The puck slides: the joint's points part, so the moments are taken about the ground's point at the origin.
    """
    omega = 3.0
    J = np.array([[0.3, 0, 0.05], [0, 0.4, 0.02], [0.05, 0.02, 0.5]])
    machine = {
        "bodies": {"puck": {"mass": 2.0, "inertia": J, "angular_velocity": [0, 0, omega], "velocity": [0.5, 0.2, 0]}},
        "joints": {"ice": {"type": "planar", "bodies": ["ground", "puck"], "point": [0, 0, 0], "axis": [0, 0, 1]}},
    }
    r = simulate(machine, duration=2.0, step=1e-3)
    c, s = np.cos(omega * r.time), np.sin(omega * r.time)
    zero = np.zeros_like(c)
    A = np.moveaxis(np.array([[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]]), -1, 0)
    w = np.array([0, 0, omega])
    needed = np.cross(w, A @ J @ np.swapaxes(A, 1, 2) @ w)
    np.testing.assert_allclose(r.array("ice.torque"), -needed, atol=1e-9)
    np.testing.assert_allclose(r.array("ice.force"), 0, atol=1e-9)


@FORMULATIONS
@PARTICLES
def test_bead_on_a_turning_wire_flies_outwards(particle, formulation):
    """s = s0 cosh ωt; side force 2 m ω ṡ; the driver that keeps the speed spends the torque 2 m ω s ṡ."""
    bead = guided.Bead(0.3, 0.1, 2.0)
    machine = {
        "bodies": {
            "wire": solid(1.0, 0.2, angular_velocity=[0, 0, bead.speed]),
            "bead": ball(particle, bead.mass, [bead.start, 0, 0], velocity=[0, bead.start * bead.speed, 0]),
        },
        "joints": {
            "hub": hinge("ground", "wire"),
            "wire_bead": {
                "type": "point-on-line",
                "bodies": ["wire", "bead"],
                "point": [bead.start, 0, 0],
                "axis": [1, 0, 0],
            },
        },
        "drivers": {"motor": {"coordinate": "hub.angle", "value": "2*time"}},
    }
    r = simulate(machine, duration=1.5, step=1e-3, formulation=formulation)
    t = r.time
    # fourth order: (ω h)⁴/120 per unit of ω t, times cosh 3 = 10
    np.testing.assert_allclose(r.array("wire_bead.displacement"), bead.displacement(t) - bead.start, atol=1e-11)
    np.testing.assert_allclose(r.array("wire_bead.displacement.rate"), bead.rate(t), atol=1e-11)
    # force on the wire, global: against the sense of turning
    c, s = np.cos(2 * t), np.sin(2 * t)
    side = -bead.side_force(t)[:, None] * np.stack([-s, c, 0 * t], axis=1)
    np.testing.assert_allclose(r.array("wire_bead.force"), side, atol=1e-9)
    np.testing.assert_allclose(r.array("driver.motor.effort"), bead.torque(t), atol=1e-9)
    np.testing.assert_allclose(r.array("driver.motor.power"), 2 * bead.torque(t), atol=1e-9)


@FORMULATIONS
def test_rod_slides_down_on_its_end(formulation):
    """One end on a smooth floor: the centre falls straight, the floor's force follows from the fall."""
    m, a, start = 2.0, 0.5, 0.3
    J = m * (2 * a) ** 2 / 12
    end = np.array([-a * np.sin(start), 0, 0])
    machine = {
        "gravity": [0, 0, -G],
        "bodies": {
            "rod": solid(
                m,
                (J, J, 1e-3),
                position=[0, 0, a * np.cos(start)],
                orientation={"axis": [0, 1, 0], "angle": start},
            )
        },
        "joints": {
            "floor": {
                "type": "point-on-plane",
                "bodies": ["ground", "rod"],
                "point": end,
                "axis": [0, 0, 1],
                "x_axis": [1, 0, 0],
            }
        },
    }
    r = simulate(machine, duration=0.6, step=1e-3, formulation=formulation)
    expected = guided.falling_rod(r.time, m, a, J, G, start)
    np.testing.assert_allclose(r.array("rod.position.x"), 0, atol=1e-10)
    np.testing.assert_allclose(r.array("rod.position.z"), a * np.cos(expected.angle), atol=1e-9)
    np.testing.assert_allclose(r.array("floor.x"), -a * np.sin(expected.angle) - end[0], atol=1e-9)
    np.testing.assert_allclose(r.array("floor.y"), 0, atol=1e-10)
    np.testing.assert_allclose(r.array("floor.force.z"), -expected.floor_force, atol=1e-7)
    np.testing.assert_allclose(r.array("floor.force")[:, :2], 0, atol=1e-9)


@FORMULATIONS
@PARTICLES
@pytest.mark.parametrize("kind", ["distance", "spherical-spherical"])
def test_distance_makes_a_spherical_pendulum(particle, kind, formulation):
    length, theta, spin, mass = 0.8, 1.0, 2.0, 2.0
    start = [length * np.sin(theta), 0, -length * np.cos(theta)]
    machine = {
        "gravity": [0, 0, -G],
        "bodies": {"bob": ball(particle, mass, start, velocity=[0, length * np.sin(theta) * spin, 0])},
        "joints": {"rod": {"type": kind, "bodies": ["ground", "bob"], "points": [[0, 0, 0], start]}},
    }
    r = simulate(machine, duration=3.0, step=1e-3, formulation=formulation)
    expected = guided.spherical_pendulum(r.time, mass, length, G, theta, spin)
    np.testing.assert_allclose(r.array("bob.position"), expected.position, atol=1e-9)
    np.testing.assert_allclose(r.array("rod.distance"), length, atol=1e-12)
    # the rod pulls the ground towards the bob
    pull = expected.tension[:, None] * expected.position / length
    np.testing.assert_allclose(r.array("rod.force"), pull, atol=1e-7)


def test_distance_is_given_or_taken_from_the_points():
    """Given 0.5 m for points 0.8 m apart: the assembly brings the bob to 0.5 m."""
    machine = {
        "bodies": {"bob": ball(True, 1.0, [0, 0.8, 0])},
        "joints": {
            "rod": {
                "type": "distance",
                "bodies": ["ground", "bob"],
                "points": [[0, 0, 0], [0, 0.8, 0]],
                "distance": 0.5,
            }
        },
        "assembly": {"largest_gap": 0.5},
    }
    r = simulate(machine, duration=0.01, step=1e-3)
    np.testing.assert_allclose(r.array("bob.position")[0], [0, 0.5, 0], atol=1e-10)


@FORMULATIONS
@pytest.mark.parametrize("pitch", [0.02, -0.3])
def test_nut_on_a_vertical_screw(pitch, formulation):
    """m s̈ + J (2π/p)² s̈ = -m g; the ground carries the weight less inertia, and the torque J φ̈ the other way round."""
    m, J = 1.5, 2e-3
    machine = {
        "gravity": [0, 0, -G],
        "bodies": {"nut": solid(m, (3e-3, 3e-3, J))},
        "joints": {
            "thread": {
                "type": "screw",
                "bodies": ["ground", "nut"],
                "point": [0, 0, 0],
                "axis": [0, 0, 1],
                "pitch": pitch,
            }
        },
    }
    lead = 2 * np.pi / pitch
    a = -m * G / (m + J * lead**2)
    r = simulate(machine, duration=1.0, step=2.5e-4, output_interval=0.01, formulation=formulation)
    t = r.time
    way = 0.5 * a * t**2
    assert abs(lead * way[-1]) > 3 * np.pi  # counts turns
    share = turning_error(lead * a, 2.5e-4)
    np.testing.assert_allclose(r.array("thread.displacement"), way, rtol=share, atol=1e-12)
    np.testing.assert_allclose(r.array("thread.angle"), lead * way, rtol=share, atol=1e-11)
    np.testing.assert_allclose(r.array("thread.angle.rate"), lead * a * t, rtol=share, atol=1e-10)
    np.testing.assert_allclose(r.array("thread.force.z"), -m * (G + a), rtol=1e-9)
    np.testing.assert_allclose(r.array("thread.torque.z"), -J * lead * a, rtol=1e-9)


@FORMULATIONS
def test_screw_between_two_free_bodies_keeps_their_momenta(formulation):
    """A force along the screw drives bolt and nut apart; coaxial on Z. With relative way u and m, J the reduced ones,
    (m_r + J_r (2π/p)²) ü = F. Momentum and angular momentum of the two stay zero."""
    m1, m2, J1, J2, p, F = 1.0, 3.0, 4e-3, 6e-3, 0.1, 5.0
    machine = {
        "bodies": {"bolt": solid(m1, (0.01, 0.01, J1)), "nut": solid(m2, (0.02, 0.02, J2))},
        "joints": {
            "thread": {"type": "screw", "bodies": ["bolt", "nut"], "point": [0, 0, 0], "axis": [0, 0, 1], "pitch": p}
        },
        "forces": {
            "down": {"type": "force", "body": "bolt", "vector": [0, 0, -F]},
            "up": {"type": "force", "body": "nut", "vector": [0, 0, F]},
        },
    }
    r = simulate(machine, duration=1.0, step=1e-3, formulation=formulation)
    m, J = m1 * m2 / (m1 + m2), J1 * J2 / (J1 + J2)
    a = F / (m + J * (2 * np.pi / p) ** 2)
    np.testing.assert_allclose(r.array("thread.displacement"), 0.5 * a * r.time**2, atol=1e-11)
    v, w = r.array("velocity")[:, :, 2], r.array("angular_velocity")[:, :, 2]
    np.testing.assert_allclose(m1 * v[:, 0] + m2 * v[:, 1], 0, atol=1e-11)
    np.testing.assert_allclose(J1 * w[:, 0] + J2 * w[:, 1], 0, atol=1e-10)


def test_joint_starts_where_and_as_fast_as_it_is_told():
    """`start` and `start_rates` of a hinge: the pendulum of the same start by orientation and angular velocity."""

    def pendulum(**more):
        return {
            "gravity": [0, -G, 0],
            "bodies": {"arm": solid(2.0, 0.1, position=[0, -0.5, 0]) | more.get("arm", {})},
            "joints": {"pin": hinge("ground", "arm") | more.get("pin", {})},
            "assembly": {"largest_gap": 2.0},
        }

    told = simulate(pendulum(pin={"start": {"angle": 0.6}, "start_rates": {"angle": 2.0}}), duration=1, step=1e-3)
    place = {
        "position": [0.5 * np.sin(0.6), -0.5 * np.cos(0.6), 0],
        "orientation": {"axis": [0, 0, 1], "angle": 0.6},
        "angular_velocity": [0, 0, 2.0],
        "velocity": [np.cos(0.6), np.sin(0.6), 0],
    }
    placed = simulate(pendulum(arm=place), duration=1, step=1e-3)
    np.testing.assert_allclose(told.array("pin.angle")[0], 0.6, atol=1e-10)
    np.testing.assert_allclose(told.array("pin.angle.rate")[0], 2.0, atol=1e-10)
    np.testing.assert_allclose(told.array("arm.position"), placed.array("arm.position"), atol=1e-9)
