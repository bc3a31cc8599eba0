"""The bodies of a machine as numbers: their masses, poses and velocities as given, and the size of the machine that they make."""

from __future__ import annotations

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.kernels.record.record import Bodies, Markers
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.core.placement import initial_velocity
from nivel.machine.machine_record import MachineRecord
from nivel.system.flexible import flexible_mass
from nivel.system.tables import Array

# [m] a tenth of a light year: squares and products of longer machines leave the range of numbers
LARGEST = 1e15


def given_poses(machine: MachineRecord) -> Array:
    """Positions and Euler parameters (B, 7) as given."""
    return np.array([np.concatenate(machine.poses[body.name]) for body in machine.bodies], dtype=float).reshape(-1, 7)


def given_velocities(records: tuple[Body, ...]) -> tuple[Array, Array]:
    """Ṙ (B, 3) and ω̄ (B, 3) as given."""
    given = [initial_velocity(body) for body in records]
    velocity = np.array([v for v, _ in given], dtype=float).reshape(-1, 3)
    return velocity, np.array([w for _, w in given], dtype=float).reshape(-1, 3)


def machine_size(poses: Array, markers: Markers) -> float:
    """Twice the largest distance of a frame from their mean, or the largest of a point from its frame [m]; 1 m where all is at one point.

    It does not depend on how the machine is turned. Raises ModelError above LARGEST.
    """
    with np.errstate(over="ignore"):
        spread = (
            2.0 * float(np.linalg.norm(poses[:, :3] - poses[:, :3].mean(axis=0), axis=1).max()) if len(poses) else 0.0
        )
        reach = float(np.linalg.norm(markers.position_b, axis=1).max(initial=0.0))
    size = max(spread, reach) or 1.0
    if not size <= LARGEST:
        message = (
            f"the machine is {size:.3g} m long, the limit is {LARGEST:.0e} m: look for a slip in a position or a unit"
        )
        raise ModelError(Fault("", 0, 0, "bodies", message))
    return size


def body_tables(machine: MachineRecord, size: float) -> Bodies:
    """Numbers of all bodies and, behind them, of the ground; the inertia of point masses is that of the machine's size [m]."""
    count = len(machine.bodies)
    properties = [mass_properties(body) if body.flexible is None else flexible_mass(body) for body in machine.bodies]
    mass = np.array([p.mass for p in properties], dtype=float)
    centre = np.array([p.centre_of_mass for p in properties], dtype=float).reshape(count, 3)
    inertia = np.array([p.inertia for p in properties], dtype=float).reshape(count, 3, 3)
    for k, body in enumerate(machine.bodies):
        if body.point_mass:
            # nothing turns a point mass and it turns nothing: any inertia will do
            inertia[k] = mass[k] * size**2 * np.eye(3)
    whitener = np.array([np.linalg.inv(np.linalg.cholesky(J)) for J in inertia], dtype=np.float64).reshape(count, 3, 3)
    square = np.einsum("bi,bi->b", centre, centre)
    steiner = square[:, None, None] * np.eye(3) - np.einsum("bi,bj->bij", centre, centre)
    A = np.zeros((count + 1, 3, 3))
    A[:] = np.eye(3)
    theta = np.zeros((count + 1, 4))
    theta[:, 0] = 1.0

    def vectors() -> Array:
        return np.zeros((count + 1, 3))

    return Bodies(
        mass=mass,
        centre_b=centre,
        inertia_b=inertia,
        inertia_origin_b=np.ascontiguousarray(inertia + mass[:, None, None] * steiner),
        whitener_b=whitener,
        inverse_root_mass=1.0 / np.sqrt(mass),
        gravity=np.array(machine.gravity, dtype=float),
        R=vectors(),
        theta=theta,
        A=A,
        Rdot=vectors(),
        omega=vectors(),
        omega_b=vectors(),
        c=vectors(),
        wrench=np.zeros((count + 1, 6)),
        Rddot=vectors(),
        alpha_b=vectors(),
    )
