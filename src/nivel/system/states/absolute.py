"""q = (R, θ), v = (Ṙ, ω̄): as assembled; coordinate partitioning chooses the independent ones among v."""

import numpy as np

from nivel.kernels.bodies.coordinate import ROTATION
from nivel.kernels.record.record import EULER_ANGLES, ROTATION_VECTOR, Rotations
from nivel.lazy import replace
from nivel.machine.core.orientation import (
    conjugate,
    euler_parameters_from_matrix,
    matrix_from_euler_parameters,
    product,
)
from nivel.machine.core.placement import frame_from_axes
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.build import build
from nivel.system.elimination.partition import PARAMETERS, partition, velocities_named
from nivel.system.system import Array, Equations, StateMap, System
from nivel.system.tables import index_array


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The same numbers, prepared for `rank` independent rows."""
    del machine, settings
    return absolute.known_rank(rank), y.copy()


def arrange_independent(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The same numbers with the arrays of a partition; the equations choose it at the first state that they are given."""
    del machine
    system = absolute.known_rank(rank)
    wanted = velocities_named(settings.independent, system.bodies)
    arrays = partition(system.body_count, len(system.rows), rank, system.size, wanted=wanted)
    return replace(system, record=system.record._replace(partition=arrays)), y.copy()


# q = (R, θ), v = q̇: seven velocities a body and one normalisation row; partitioning chooses the independent ones among v.


def arrange_parameters(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations in Euler parameters."""
    del settings
    system = build(machine, Equations(7, normalisation=True))
    system.record.constraints.offset[:] = absolute.record.constraints.offset
    count = absolute.body_count
    v = y[7 * count : 13 * count].reshape(count, 6)
    return system.known_rank(rank + count), system.state(y[: 7 * count], v[:, :3], v[:, 3:])


def arrange_independent_parameters(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations with the arrays of a partition; the equations choose it at the first state that they are given."""
    system, start = arrange_parameters(machine, absolute, y, rank, settings)
    count, rows = system.body_count, len(system.rows)
    wanted = velocities_named(settings.independent, system.bodies, PARAMETERS)
    arrays = partition(count, rows, rank + count, system.size, wanted=wanted, turns=4)
    return replace(system, record=system.record._replace(partition=arrays)), start


# q = (R, φ), v = q̇ with three rotation coordinates φ a body: A = A(space) A(φ) A(body).


def arranged(
    system: System, y: Array, kind: int, start: Array, body: Array, phi: Array, rates: Array
) -> tuple[System, Array]:
    """The numbers of `system` (six velocities a body) and its state y in coordinates φ of this kind.

    start : (B, 4) Euler parameters of A(φ) at the start; body : (B, 4) those of the body axes in the axes that φ turns.
    phi, rates : (B, 3) φ [rad] and φ̇ at the start. The space axes follow from the orientations in y.
    """
    count = system.body_count
    q, v = y[: 7 * count].reshape(count, 7), y[7 * count : 13 * count].reshape(count, 6)
    space = product(product(q[:, 3:], conjugate(body)), conjugate(start))
    turned = np.array([matrix_from_euler_parameters(theta) for theta in conjugate(body)]).reshape(count, 3, 3)
    rotations = Rotations(
        kind=np.array([kind], dtype=np.uint32),
        space=np.ascontiguousarray(space),
        body=np.ascontiguousarray(body),
        turned_b=turned,
        theta=np.zeros((count, 4)),
        G=np.zeros((count, 3, 3)),
        bias=np.zeros((count, 3)),
        regularity=np.zeros(count),
    )
    n = 6 * count
    units = ["m", "m", "m", "1", "1", "1"] * count
    units += ["m/s", "m/s", "m/s", "1/s", "1/s", "1/s"] * count + [""] * (len(y) - 13 * count)
    plain = index_array([(i, n + i) for i in range(n)], 2)
    system = replace(
        system,
        record=system.record._replace(rotations=rotations),
        state_map=StateMap(plain, index_array([], 2), tuple(units)),
    )
    state = [np.hstack([q[:, :3], phi]).ravel(), np.hstack([v[:, :3], rates]).ravel(), y[13 * count :]]
    return system, np.concatenate(state)


# Rotation vectors from the orientation at the start: ψ = 0 there, so every body may turn by nearly a full turn in any direction.
#
# A rotation vector of the orientation itself (|ψ| ≤ π at the start) would leave as little as half a turn.


def arrange_rotation_vectors(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations in rotation vectors; ψ̇ = ω̄ at the start."""
    del machine, settings
    count = absolute.body_count
    unturned = np.tile((1.0, 0.0, 0.0, 0.0), (count, 1))
    angular_velocity = y[7 * count : 13 * count].reshape(count, 6)[:, 3:]
    start = np.zeros((count, 3))
    return arranged(absolute.known_rank(rank), y, ROTATION_VECTOR, unturned, unturned, start, angular_velocity)


# Euler angles z, x, z (3-1-3) of axes fixed in the body against axes fixed in space, both chosen at the start.
#
# They are singular where the third axis is parallel to the first. The third, about which the body may turn for ever, is the axis about
# which it turns at the start: along its angular velocity, at rest along the axis of its first joint with an angle. The first, about
# which it may precess for ever, is the perpendicular nearest to the vertical. So φ = (0, π/2, 0) at the start, as far from the
# singular position as can be. (Angles of the body axes against the global ones, as in report 44, start at zero in its machines: singular.)

START = (0.0, np.pi / 2.0, 0.0)
# Angular velocities below this share of the machine's largest, and sines of directions taken for parallel.
ROUND_OFF = 1e-9


def arrange_euler_angles(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations in Euler angles."""
    del machine, settings
    count = absolute.body_count
    orientation = y[: 7 * count].reshape(count, 7)[:, 3:]
    angular_velocity = y[7 * count : 13 * count].reshape(count, 6)[:, 3:]
    axes = _axes_of_turning(absolute, angular_velocity)
    body, rates = np.zeros((count, 4)), np.zeros((count, 3))
    for b in range(count):
        up_b = -matrix_from_euler_parameters(orientation[b]).T @ absolute.record.bodies.gravity
        turned_b = _turned_axes(axes[b], up_b)
        body[b] = euler_parameters_from_matrix(turned_b.T)
        # ω̄ = (φ̇₂, φ̇₁, φ̇₃) in the turned axes at the start
        rates[b] = (turned_b.T @ angular_velocity[b])[[1, 0, 2]]
    start = np.tile(np.array([1.0, 1.0, 0.0, 0.0]) / np.sqrt(2.0), (count, 1))
    return arranged(absolute.known_rank(rank), y, EULER_ANGLES, start, body, np.tile(START, (count, 1)), rates)


def _axes_of_turning(system: System, angular_velocity_b: Array) -> Array:
    """(B, 3) body axes about which the bodies turn."""
    axes = np.tile((0.0, 0.0, 1.0), (system.body_count + 1, 1))
    record = system.record
    for kind, first, second, _ in record.coordinates.what[record.joints.coordinate[::-1]]:
        if kind == ROTATION:
            for marker in (first, second):
                axes[record.markers.body[marker]] = record.markers.frame_b[marker][:, 2]
    speed = np.linalg.norm(angular_velocity_b, axis=1)
    turning = speed > ROUND_OFF * speed.max(initial=0.0)
    axes[:-1][turning] = angular_velocity_b[turning]
    return axes[:-1]


def _turned_axes(axis_b: Array, up_b: Array) -> Array:
    """(3, 3), columns: z along `axis_b`, y, the first axis at the start, near `up_b`; in body axes."""
    x = np.cross(up_b, axis_b)
    parallel = np.linalg.norm(x) <= ROUND_OFF * np.linalg.norm(up_b) * np.linalg.norm(axis_b)
    return frame_from_axes(axis_b, None if parallel else x)
