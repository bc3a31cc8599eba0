"""Machines with springs as stiff as a test wants them."""

import numpy as np

from nivel.machine import Body, Joint, JointSpringDamper, MachineRecord, PointForce, SimulationSettings
from nivel.machine.driver import Driver

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
