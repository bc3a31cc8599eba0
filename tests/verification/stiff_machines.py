"""Machines with springs as stiff as a test wants them."""

from functools import cache

import numpy as np

from nivel import Body, Joint, JointSpringDamper, MachineRecord, PointForce, SimulationSettings, SpringDamper
from nivel.elements.joints.drivers import Driver
from references.solution import Solution

GRAVITY = 9.81


def elastic_pendulum(stiffness, damping=0.0, *, forces=(), drivers=(), **settings):
    """A rod on a hinge, released at the horizontal, and a bob of 1 kg on it 1 m out, held by a spring along the rod.

    Alone, a spring of k [N/m] and the masses in line swing with about √(k/m).
    """
    return MachineRecord(
        name="elastic pendulum",
        gravity=(0, -GRAVITY, 0),
        bodies=(
            Body(name="rod", mass=1, inertia=(0.01, 0.1, 0.1), position=(0.5, 0, 0)),
            Body(name="bob", mass=1, inertia=(0.01, 0.01, 0.01), position=(1, 0, 0)),
        ),
        joints=(
            Joint(name="hinge", type="revolute", bodies=("ground", "rod"), point=(0, 0, 0), axis=(0, 0, 1)),
            Joint(name="rail", type="translational", bodies=("rod", "bob"), point=(1, 0, 0), axis=(1, 0, 0)),
        ),
        forces=(JointSpringDamper(name="spring", coordinate="rail", stiffness=stiffness, damping=damping), *forces),
        drivers=drivers,
        simulation=SimulationSettings(**({"duration": 2.0, "output_interval": 0.05} | settings)),
    )


def rigid_pendulum(times):
    """Angle of the same with a rigid spring, released at the horizontal: φ̈ = -(m_r/2 + m_b) g cos φ/I."""
    from scipy.integrate import solve_ivp

    inertia = 0.1 + 0.25 + 0.01 + 1.0
    solution = solve_ivp(
        lambda t, y: [y[1], -1.5 * GRAVITY * np.cos(y[0]) / inertia],
        (0, times[-1]),
        [0, 0],
        method="DOP853",
        t_eval=times,
        rtol=1e-12,
        atol=1e-12,
    )
    return solution.y[0]


def driven(stiffness, **settings):
    """The same, turned by a motor and pulled by a force that changes with time."""
    return elastic_pendulum(
        stiffness,
        forces=(PointForce(name="pull", body="bob", vector=("30*sin(9*time)", "5*cos(7*time)", 0)),),
        drivers=(Driver(name="motor", coordinate="hinge", value="0.5*sin(4*time)"),),
        **settings,
    )


def swinging_out(times, stiffness):
    """(angle, elongation) of the elastic pendulum, from its Lagrangian: I = 0.36 kg m² + (1 + e)² of the bob, ½ k e²."""
    return _swing(stiffness)(times)[:2]


@cache
def _swing(stiffness):
    def rates(t, y):
        angle, e, turning, rate = y
        inertia = 0.1 + 0.25 + 0.01 + (1.0 + e) ** 2
        moment = -(0.5 + 1.0 + e) * GRAVITY * np.cos(angle) - 2.0 * (1.0 + e) * rate * turning
        return turning, rate, moment / inertia, (1.0 + e) * turning**2 - GRAVITY * np.sin(angle) - stiffness * e

    return Solution(rates, 0.0, np.zeros(4), rtol=1e-11, atol=1e-13)


def elastic_crank(stiffness, **settings):
    """A crank of 0.2 m at 10 rad/s, a slider of 1 kg, and for a connecting rod a spring of 0.5 m, drawn so that the slider begins with
    the acceleration that a rigid rod would give it, -(0.2 m)(10/s)²(1 + 0.2/0.5)."""
    return MachineRecord(
        name="elastic crank",
        gravity=(0, -GRAVITY, 0),
        bodies=(
            Body(
                name="crank",
                mass=1,
                inertia=(0.01, 0.02, 0.02),
                position=(0.1, 0, 0),
                velocity=(0, 1, 0),
                angular_velocity=(0, 0, 10),
            ),
            Body(name="slider", mass=1, inertia=(0.01, 0.01, 0.01), position=(0.7, 0, 0)),
        ),
        joints=(
            Joint(name="main", type="revolute", bodies=("ground", "crank"), point=(0, 0, 0), axis=(0, 0, 1)),
            Joint(name="rail", type="translational", bodies=("ground", "slider"), point=(0, 0, 0), axis=(1, 0, 0)),
        ),
        forces=(
            SpringDamper(
                name="rod",
                bodies=("crank", "slider"),
                points=((0.2, 0, 0), (0.7, 0, 0)),
                stiffness=stiffness,
                free_length=0.5 - 28.0 / stiffness,
            ),
        ),
        simulation=SimulationSettings(**({"duration": 1.0, "output_interval": 0.05} | settings)),
    )


def rigid_crank(times):
    """Angle of the same with a rigid rod, by its energy: φ̇ = √(2 (E - V)/I), I = 0.03 kg m² + (ds/dφ)² of the slider."""
    from scipy.integrate import solve_ivp

    def rate(t, y):
        sine, cosine = np.sin(y[0]), np.cos(y[0])
        slope = -0.2 * sine - 0.04 * sine * cosine / np.sqrt(0.25 - 0.04 * sine**2)
        return [np.sqrt(2.0 * (0.5 * 0.03 * 100.0 - GRAVITY * 0.1 * sine) / (0.03 + slope**2))]

    return solve_ivp(rate, (0, times[-1]), [0], method="DOP853", t_eval=times, rtol=1e-12, atol=1e-12).y[0]


def double_pendulum(stiffness, damping=0.0, **settings):
    """Two links that hang and are pushed, straight, with a spring in the joint between them."""

    def link(name, y):
        return Body(
            name=name,
            mass=1,
            inertia=(0.08, 0.01, 0.08),
            position=(0, y, 0),
            velocity=(-4 * y, 0, 0),
            angular_velocity=(0, 0, 4),
        )

    def hinge(name, first, second, y):
        return Joint(name=name, type="revolute", bodies=(first, second), point=(0, y, 0), axis=(0, 0, 1))

    return MachineRecord(
        name="double-pendulum",
        gravity=(0, -GRAVITY, 0),
        bodies=(link("upper", -0.5), link("lower", -1.5)),
        joints=(hinge("pivot", "ground", "upper", 0), hinge("elbow", "upper", "lower", -1)),
        forces=(JointSpringDamper(name="coil", coordinate="elbow", stiffness=stiffness, damping=damping),),
        simulation=SimulationSettings(**({"duration": 5.0, "output_interval": 0.05} | settings)),
    )


def rigid_double_pendulum(times):
    """Angle of the same with a stiff elbow: 2.66 kg m² about the pivot, 2 kg at 1 m."""
    from scipy.integrate import solve_ivp

    inertia = 2 * 0.08 + 0.25 + 2.25
    return solve_ivp(
        lambda t, y: [y[1], -2 * GRAVITY * np.sin(y[0]) / inertia],
        (0, times[-1]),
        [0, 4],
        method="DOP853",
        t_eval=times,
        rtol=1e-12,
        atol=1e-12,
    ).y[0]


def two_bars(stiffness, **settings):
    """Two bars on hinges 0.8 m apart and a spring between their tips that begins with the force that a rigid rod would: they fall, turn by
    most of a turn, all but stand still, and come back."""
    crank = Body(name="crank", mass=1, inertia=(0.001, 0.01, 0.01), position=(0, 0.15, 0))
    rocker = Body(name="rocker", mass=2.5, inertia=(0.05, 0.003, 0.05), position=(0.7, 0.3, 0))
    tips = ((0, 0.3, 0), (0.6, 0.6, 0))
    return MachineRecord(
        name="two bars",
        gravity=(0, -GRAVITY, 0),
        bodies=(crank, rocker),
        joints=(
            Joint(name="left", type="revolute", bodies=("ground", "crank"), point=(0, 0, 0), axis=(0, 0, 1)),
            Joint(name="right", type="revolute", bodies=("ground", "rocker"), point=(0.8, 0, 0), axis=(0, 0, 1)),
        ),
        forces=(
            SpringDamper(
                name="rod",
                bodies=("crank", "rocker"),
                points=tips,
                stiffness=stiffness,
                free_length=float(np.hypot(0.6, 0.3)),
                preload=-_rod_between_bars(np.zeros(2), np.zeros(2))[1] * float(np.hypot(0.6, 0.3)),
            ),
        ),
        simulation=SimulationSettings(**({"duration": 2.0, "output_interval": 0.05} | settings)),
    )


def _rod_between_bars(angles, rates):
    """Accelerations of the angles of `two_bars` with a rigid rod, and the multiplier of ½ (d·d - L²) = 0, d from tip to tip."""
    (s, S), (c, C) = np.sin(angles), np.cos(angles)
    inertia = np.array([0.01 + 0.15**2, 0.05 + 2.5 * (0.1**2 + 0.3**2)])
    weight = GRAVITY * np.array([0.15 * s, 2.5 * (0.1 * C + 0.3 * S)])
    d = np.array([0.8 - 0.2 * C - 0.6 * S + 0.3 * s, -0.2 * S + 0.6 * C - 0.3 * c])
    along = np.array([[0.3 * c, 0.3 * s], [0.2 * S - 0.6 * C, -0.2 * C - 0.6 * S]])
    turning = np.array([[-0.3 * s, 0.3 * c], [0.2 * C + 0.6 * S, 0.2 * S - 0.6 * C]])
    speed, gradient = rates @ along, along @ d
    asked = -(speed @ speed) - rates**2 @ (turning @ d)
    multiplier = (asked - gradient @ (weight / inertia)) / (gradient @ (gradient / inertia))
    return (weight + gradient * multiplier) / inertia, multiplier


def rigid_two_bars(times):
    """Angles of the crank and the rocker of the same with a rigid rod, rows of the array."""
    from scipy.integrate import solve_ivp

    return solve_ivp(
        lambda t, y: np.append(y[2:], _rod_between_bars(y[:2], y[2:])[0]),
        (0, times[-1]),
        np.zeros(4),
        method="DOP853",
        t_eval=times,
        rtol=1e-12,
        atol=1e-12,
    ).y[:2]


def driven_rocker(stiffness, value="3*(1-cos(2*time))", speed=0.0, **settings):
    """A crank of 0.1 m turned by a driver and a rocker, between their tips a spring of 0.5 m for a coupler, drawn at the start as a rigid
    one would be when the crank turns steadily with this speed [rad/s]: then the rocker has speed² (0.1 m) (1 + 0.1/0.5)/0.4 m."""
    moment = (0.02 + 1.5 * (0.05**2 + 0.2**2)) * 0.3 * speed**2 + 1.5 * GRAVITY * 0.05
    bodies = (
        Body(name="crank", mass=1, inertia=(0.001, 0.01, 0.01)),
        Body(name="rocker", mass=1.5, inertia=(0.02, 0.003, 0.02), position=(0.55, -0.2, 0)),
    )
    hinges = (
        Joint(name="main", type="revolute", bodies=("ground", "crank"), point=(0, 0, 0), axis=(0, 0, 1)),
        Joint(name="pivot", type="revolute", bodies=("ground", "rocker"), point=(0.5, -0.4, 0), axis=(0, 0, 1)),
    )
    coupler = SpringDamper(
        name="coupler",
        bodies=("crank", "rocker"),
        points=((0.1, 0, 0), (0.6, 0, 0)),
        stiffness=stiffness,
        free_length=0.5,
        preload=moment / 0.4,
    )
    return MachineRecord(
        name="driven rocker",
        gravity=(0, -GRAVITY, 0),
        bodies=bodies,
        joints=hinges,
        drivers=(Driver(name="motor", coordinate="main", value=value),),
        forces=(coupler,),
        simulation=SimulationSettings(**({"duration": 2.0, "output_interval": 0.05} | settings)),
    )


def rigid_rocker(crank_angle):
    """Place of the rocker's centre for a rigid coupler: its tip is where circles about the crank's tip and the pivot cross."""
    tip, pivot = 0.1 * np.stack((np.cos(crank_angle), np.sin(crank_angle)), 1), np.array([0.5, -0.4])
    between = pivot - tip
    apart = np.linalg.norm(between, axis=1, keepdims=True)
    along = (apart**2 + 0.5**2 - 0.17) / (2 * apart)
    across = np.sqrt(0.5**2 - along**2)
    unit = between / apart
    end = tip + along * unit + across * np.stack((-unit[:, 1], unit[:, 0]), 1)
    # of the rocker: from its pivot (0.05, 0.2) to the centre, (0.1, 0.4) to the tip
    return 0.5 * (pivot + end)


def propped_arms(stiffness=None, **settings):
    """In space: an upper arm on a universal joint, a lower one hinged to it, and from the ground to the end of that a prop: a spring drawn
    by the 11.9 N that hold it still at the start, or where no stiffness is given a rigid one."""
    bodies = (
        Body(name="upper", mass=3, inertia=(0.01, 0.1, 0.1), position=(0.4, 0, 0)),
        Body(name="lower", mass=1.5, inertia=(0.1, 0.004, 0.1), position=(0.8, 0.35, 0)),
    )
    joints = (
        Joint(
            name="shoulder", type="universal", bodies=("ground", "upper"), point=(0, 0, 0), axes=((0, 1, 0), (0, 0, 1))
        ),
        Joint(name="elbow", type="revolute", bodies=("upper", "lower"), point=(0.8, 0, 0), axis=(0, 0, 1)),
    )
    ends = {"bodies": ("ground", "lower"), "points": ((0.2, 0.6, 0.7), (0.8, 0.6, 0))}
    if stiffness is None:
        joints, forces = (*joints, Joint(name="prop", type="distance", **ends)), ()
    else:
        forces = (
            SpringDamper(
                name="prop", stiffness=stiffness, free_length=np.sqrt(0.85), preload=11.931249011559704, **ends
            ),
        )
    return MachineRecord(
        name="propped arms",
        gravity=(0, 0, -GRAVITY),
        bodies=bodies,
        joints=joints,
        forces=forces,
        simulation=SimulationSettings(**({"duration": 2.0, "output_interval": 0.05} | settings)),
    )


def spatial_crank(stiffness=None, damping=0.0, **settings):
    """A crank on a vertical axis turned by a driver and a rocker on a horizontal one, between their ends a rod: a spring with a damper,
    pressed at the start as a rigid one would be, or where no stiffness is given a rigid one."""
    crank = Body(name="crank", mass=1, inertia=(0.001, 0.002, 0.002), position=(0.06, 0, 0))
    rocker = Body(name="rocker", mass=2, inertia=(0.016, 0.016, 0.001), position=(0.58, 0.2, 0.55))
    joints = (
        Joint(name="shaft", type="revolute", bodies=("ground", "crank"), point=(0, 0, 0), axis=(0, 0, 1)),
        Joint(name="axle", type="revolute", bodies=("ground", "rocker"), point=(0.6, 0.2, 0.4), axis=(0, 1, 0)),
    )
    ends = {"bodies": ("crank", "rocker"), "points": ((0.12, 0, 0), (0.56, 0.2, 0.7))}
    if stiffness is None:
        joints, forces = (*joints, Joint(name="rod", type="distance", **ends)), ()
    else:
        length = np.sqrt(0.44**2 + 0.2**2 + 0.7**2)
        # The crank's end starts with 0.12 m 12 rad/s² along y, and the rocker's, (-0.04, 0, 0.3) m from its axle, has to make way for that:
        # α (0.3 (0.44) + 0.04 (0.7)) = 1.44 (0.2). About the axle there are 0.0618 kg m², and the weight of 2 kg 0.02 m behind it.
        lever = (0.3 * 0.44 + 0.04 * 0.7) / length
        moment = (0.016 + 2 * (0.02**2 + 0.15**2)) * 1.44 * 0.2 / (0.3 * 0.44 + 0.04 * 0.7) + 2 * GRAVITY * 0.02
        forces = (
            SpringDamper(
                name="rod", stiffness=stiffness, damping=damping, free_length=length, preload=-moment / lever, **ends
            ),
        )
    return MachineRecord(
        name="spatial crank",
        gravity=(0, 0, -GRAVITY),
        bodies=(crank, rocker),
        joints=joints,
        drivers=(Driver(name="motor", coordinate="shaft", value="3*(1-cos(2*time))"),),
        forces=forces,
        simulation=SimulationSettings(**({"duration": 2.0, "output_interval": 0.05} | settings)),
    )
