"""The bodies of a machine as numbers: their masses, poses and velocities as given, and the size of the machine that they make."""

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.kernels.record.record import Bodies, Markers
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.core.placement import initial_velocity
from nivel.machine.machine_record import MachineRecord
from nivel.system.flexible import flexible_mass
from nivel.system.tables import Array, zeros

# [m] a tenth of a light year: squares and products of longer machines leave the range of numbers
LARGEST = 1e15
# A moment of inertia below this share of the largest one of a node that bends is round-off.
ROUND_OFF = 1e-13
# a moment of inertia that is none, as a share of the largest
TINY = 1e-12


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
        raise ModelError(Fault.at("bodies", message))
    return size


def _refuse_lost_inertia(machine: MachineRecord, mass: Array, centre: Array, inertia: Array) -> None:
    """Refuse bodies whose smallest moment of inertia is nothing but round-off of the largest one, or of mass times the square of the way
    from the frame to the centre of mass.

    mass : (B,). centre : (B, 3) in the body frame. inertia : (B, 3, 3) about it. Raises ModelError with each body, or with the beam of
    which it is a node.
    """
    if not len(inertia):
        return
    moments = np.linalg.eigvalsh(inertia)
    owners = {name: beam for beam in machine.beams for name in beam.node_names}
    faults: dict[str, Fault] = {}
    about_frame = mass * np.einsum("bi,bi->b", centre, centre)
    lost = about_frame * ROUND_OFF > moments[:, 0]  # which is less than any across the way
    lost[lost] = [about_frame[k] * ROUND_OFF > _across(centre[k], inertia[k]) for k in np.flatnonzero(lost)]
    for k, body in enumerate(machine.bodies):
        beam, least = owners.get(body.name), float(moments[k, 0] / moments[k, 2])
        if beam is not None and beam.shares_mass and least < -ROUND_OFF:
            continue  # a node of a curved beam, see `_positive`
        if beam is not None and not least > ROUND_OFF:
            message = (
                f"the beam is {beam.line.length:.3g} m long, and too thin for that: of the moments of inertia of its nodes the smallest is "
                f"{least:.1g} of the largest one, which is round-off. Look for a slip of a unit in `to` or in the section, or write "
                f"`model: geometrically-exact`"
            )
            faults.setdefault(beam.name, Fault.at(f"beams.{beam.name}", message))
        elif beam is None and not least > 0.0:
            message = f"its moments of inertia are {', '.join(f'{J:.3g}' for J in moments[k])} kg m²; all have to be greater than zero"
            faults.setdefault(body.name, Fault.at(f"bodies.{body.name}", message))
        elif lost[k]:
            owner = f"bodies.{body.name}" if beam is None else f"beams.{beam.name}"
            message = (
                f"its centre of mass is {np.linalg.norm(centre[k]):.3g} m from its frame: its moment of inertia {moments[k, 0]:.3g} kg m² "
                f"is round-off beside the {about_frame[k]:.3g} kg m² of its mass there. Look for a slip of a unit in the mass, the inertia "
                f"or the centre of mass, or put the frame nearer to it"
            )
            faults.setdefault(body.name, Fault.at(owner, message))
    if faults:
        raise ModelError(list(faults.values()))


def _across(centre: Array, inertia: Array) -> float:
    """The smallest moment of inertia about an axis across the way to the centre of mass [kg m²]."""
    away = np.linalg.svd(centre[None])[2][1:]
    return float(np.linalg.eigvalsh(away @ inertia @ away.T)[0])


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
    _refuse_lost_inertia(machine, mass, centre, inertia)
    whitener = np.linalg.inv(np.linalg.cholesky(_positive(inertia)))
    square = np.einsum("bi,bi->b", centre, centre)
    steiner = square[:, None, None] * np.eye(3) - np.einsum("bi,bj->bij", centre, centre)
    A = np.zeros((count + 1, 3, 3))
    A[:] = np.eye(3)
    theta = np.zeros((count + 1, 4))
    theta[:, 0] = 1.0

    return Bodies(
        mass=mass,
        centre_b=centre,
        inertia_b=inertia,
        inertia_origin_b=np.ascontiguousarray(inertia + mass[:, None, None] * steiner),
        whitener_b=whitener.astype(float, copy=False),
        inverse_root_mass=1.0 / np.sqrt(mass),
        gravity=np.array(machine.gravity, dtype=float),
        theta=theta,
        A=A,
        wrench=np.zeros((count + 1, 6)),
        **zeros("R Rdot omega omega_b c Rddot alpha_b", count + 1, 3),
    )


def _positive(inertia: Array) -> Array:
    """The same (B, 3, 3) with all moments positive. A node of a curved beam may have a negative one by itself: what it has in common with
    its neighbours makes the mass of the beam positive, and nothing divides by its own."""
    moments, axes = np.linalg.eigh(inertia)
    raised = axes * np.maximum(np.abs(moments), TINY * moments[:, 2:])[:, None] @ np.swapaxes(axes, 1, 2)
    return np.where(moments[:, :1, None] > 0.0, inertia, raised)
