"""Every joint, between two bodies and against the ground: Jacobian, acceleration term, free motions, work."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import machines
from lanes import FULL
from nivel import Body, Joint, MachineRecord
from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations, moved
from nivel.analysis.assembly.redundancy import analyse
from nivel.elements.joints import JOINTS
from nivel.kernels.algebra.spatial import multiply
from nivel.kernels.bodies.constraint import combine, constraint_rows
from nivel.kernels.bodies.coordinate import measure
from nivel.kernels.bodies.marker import move_markers, place_markers
from nivel.kernels.bodies.rigid import place_body
from nivel.kernels.bodies.rolling import CONTACT, rolling
from nivel.system.system import parameter_rates
from running import run

pytestmark = pytest.mark.covering

KINDS = pytest.mark.parametrize("kind", machines.KINDS)
GROUND = pytest.mark.parametrize("ground", [False, True], ids=["two-bodies", "ground"])
H = 1e-30


@pytest.fixture
def joint(kind, ground, rng):
    machine = machines.pair(kind, rng, ground=ground)
    motion = equations(machine, "newton-euler")
    state = assemble(machine, motion).y
    return motion, state


def complex_rows(motion, q, velocity, angular_velocity_b):
    """C and Ċ of the joint rows for complex positions and velocities: the kernels themselves, on complex numbers."""
    record = motion.system.record

    def widen(part):
        return type(part)(*[a.astype(complex) if a.dtype == float else a for a in part])

    parts = ("bodies", "markers", "coordinates", "constraints", "friction")
    record = record._replace(**{name: widen(getattr(record, name)) for name in parts})
    bodies, markers, rows = record.bodies, record.markers, record.constraints
    for b in range(len(bodies.mass)):
        place_body(bodies, b, q[7 * b : 7 * b + 7])
        bodies.Rdot[b] = velocity[b]
        bodies.omega_b[b] = angular_velocity_b[b]
        multiply(bodies.A[b], bodies.omega_b[b], bodies.omega[b])
    place_markers(bodies, markers)
    move_markers(bodies, markers)
    constraint_rows(bodies, markers, rows)
    for k in range(len(record.coordinates.value)):
        kernel = rolling if record.coordinates.what[k, 0] >= CONTACT else measure
        found = kernel(bodies, markers, record.coordinates, k)
        record.coordinates.value[k], record.coordinates.rate[k], record.coordinates.bias[k] = found
    getattr(combine, "py_func", combine)(None, rows, record.coordinates, record.friction, 0.0)
    return rows.C, rows.Cdot


def aside(motion, state, rng):
    """A state near the assembled one that violates the joint at both levels: derivatives must be right there, too."""
    count = motion.system.body_count
    q = moved(state[: 7 * count], rng.uniform(-0.2, 0.2, 6 * count))
    return q, rng.uniform(-2, 2, (count, 3)), rng.uniform(-3, 3, (count, 3))


@pytest.mark.plain
@KINDS
@GROUND
def test_jacobian_is_the_complex_step_derivative(joint, rng):
    motion, state = joint
    count = motion.system.body_count
    q, velocity, omega = aside(motion, state, rng)
    motion.evaluate(0.0, motion.system.state(q, velocity, omega))
    J = motion.jacobian()
    # all columns, or of the default tests their sums in random directions
    for direction in np.eye(6 * count) if FULL else rng.uniform(-1, 1, (3, 6 * count)):
        change = direction.reshape(count, 6)
        tangent = np.zeros((count, 7))
        tangent[:, :3] = change[:, :3]
        tangent[:, 3:] = parameter_rates(q.reshape(-1, 7)[:, 3:], change[:, 3:])
        C, _ = complex_rows(motion, q + 1j * H * tangent.ravel(), velocity.astype(complex), omega.astype(complex))
        np.testing.assert_allclose(J @ direction, C.imag / H, atol=1e-11)


@pytest.mark.plain
@KINDS
@GROUND
def test_rates_and_acceleration_term_are_derivatives_along_a_motion(joint, rng):
    motion, state = joint
    count = motion.system.body_count
    q, velocity, omega = aside(motion, state, rng)
    motion.evaluate(0.0, motion.system.state(q, velocity, omega))
    J, record = motion.jacobian(), motion.system.record
    Cdot, gamma = record.constraints.Cdot.copy(), record.constraints.gamma.copy()
    acceleration = rng.uniform(-5, 5, (count, 6))
    qdot = np.hstack([velocity, parameter_rates(q.reshape(-1, 7)[:, 3:], omega)]).ravel()
    C_ahead, Cdot_ahead = complex_rows(
        motion, q + 1j * H * qdot, velocity + 1j * H * acceleration[:, :3], omega + 1j * H * acceleration[:, 3:]
    )
    np.testing.assert_allclose(Cdot, J @ np.hstack([velocity, omega]).ravel(), atol=1e-11)
    np.testing.assert_allclose(Cdot, C_ahead.imag / H, atol=1e-11)
    np.testing.assert_allclose(J @ acceleration.ravel() - gamma, Cdot_ahead.imag / H, atol=1e-10)


@KINDS
@GROUND
def test_stated_number_of_free_motions(kind, ground, joint):
    motion, state = joint
    redundancy = analyse(motion, 0.0, state)
    facts = machines.composition(kind)
    assert redundancy.degrees_of_freedom == facts.free + (0 if ground else 6)
    assert redundancy.redundant_rows == ()


@KINDS
@GROUND
@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_constraint_forces_do_no_work_and_hold_the_joint(kind, ground, formulation, rng):
    machine = machines.pair(kind, rng, ground=ground)
    motion = equations(machine, formulation)
    state = assemble(machine, motion).y
    assert motion.holds(0.0, state)
    record = motion.system.record
    count = motion.system.body_count
    v = np.hstack([record.bodies.Rdot[:count], record.bodies.omega_b[:count]]).ravel()
    lam = record.constraints.lam[: motion.system.machine_rows]
    J = motion.jacobian()
    power = (J.T @ lam) @ v
    assert abs(power) <= 1e-12 * np.abs(J.T @ lam).max() * (1 + np.abs(v).max())
    vdot = np.hstack([record.bodies.Rddot[:count], record.bodies.alpha_b[:count]]).ravel()
    np.testing.assert_allclose(J @ vdot, record.constraints.gamma[: len(J)], atol=1e-9)


@KINDS
def test_names_of_rows_and_coordinates(kind, rng):
    system = equations(machines.pair(kind, rng), "newton-euler").system
    facts = machines.composition(kind)
    named = tuple(f"j.{coordinate.name}" for coordinate in facts.coordinates)
    assert system.rows == tuple(f"j.{name}" for name in facts.rows)
    assert system.layout.coordinates["joint_coordinate"] == named


@pytest.mark.parametrize("kind", [kind for kind in machines.KINDS if machines.composition(kind).coordinates])
@GROUND
def test_joint_coordinates_start_at_zero_and_are_the_integrals_of_their_rates(kind, ground, rng):
    machine = machines.pair(kind, rng, ground=ground)
    result = run(machine, duration=0.2, step=1e-3, output_interval=1e-3)
    if "points" not in JOINTS[machine.joints[0].type].place:
        np.testing.assert_allclose(result.joint_coordinate[0], 0.0, atol=1e-12)
    if machine.joints[0].type not in ("distance", "spherical-spherical"):
        assert np.abs(result.joint_rate[0]).min() > 1e-3
    for k in range(result.joint_coordinate.shape[1]):
        spline = CubicSpline(result.time, result.joint_coordinate[:, k])
        np.testing.assert_allclose(spline(result.time[5:-5], 1), result.joint_rate[5:-5, k], atol=1e-5)


@pytest.mark.parametrize(
    ("kind", "options", "spin", "expected"),
    [
        ("revolute", {"axis": (0, 0, 1)}, (0, 0, 2.0), [2.0]),
        ("cylindrical", {"axis": (0, 0, 1)}, (0, 0, 2.0), [2.0, 0.0]),
        # the cross turns about its arm on the ground, x; the second body turns about its own arm, y
        ("universal", {"axes": ((1, 0, 0), (0, 1, 0))}, (2.0, 0, 0), [2.0, 0.0]),
        ("universal", {"axes": ((1, 0, 0), (0, 1, 0))}, (0, 3.0, 0), [0.0, 3.0]),
    ],
)
def test_positive_joint_angles_turn_the_second_body_right_handed(kind, options, spin, expected):
    body = Body(name="a", mass=1, inertia=(1, 1, 1), angular_velocity=spin)
    joint = Joint(name="j", type=kind, bodies=("ground", "a"), point=(0, 0, 0), **options)
    result = run(MachineRecord(name="m", bodies=(body,), joints=(joint,)), duration=1e-3)
    np.testing.assert_allclose(result.joint_rate[0], expected, atol=1e-12)


@pytest.mark.parametrize("kind", ["cylindrical", "translational"])
def test_positive_displacement_moves_the_second_body_along_the_first_axis(kind):
    body = Body(name="a", mass=1, inertia=(1, 1, 1), velocity=(0, 0, 3.0))
    joint = Joint(name="j", type=kind, bodies=("ground", "a"), point=(1, 0, 0), axis=(0, 0, 2))
    result = run(MachineRecord(name="m", bodies=(body,), joints=(joint,)), duration=0.1)
    np.testing.assert_allclose(result.joint_coordinate[:, -1], 3.0 * result.time, atol=1e-12)
