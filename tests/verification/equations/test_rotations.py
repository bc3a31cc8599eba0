"""Lagrange equations in Euler angles and in rotation vectors against Newton-Euler, the report's equations, and closed forms."""

import numpy as np
import pytest

import machines
from nivel import MachineRecord
from nivel.errors import ModelError
from nivel.machine.settings.run import Baumgarte
from preparing import prepare
from references import slider_crank as slider_crank_reference
from running import run
from simulating import hinge, simulate, slopes, solid, wheel
from simulating import machine as machine_of

pytestmark = pytest.mark.covering

KINDS = ["euler-angles", "rotation-vector"]
EACH_KIND = pytest.mark.parametrize("rotations", KINDS)
MACHINES = {
    "slider-crank": lambda rng: machines.slider_crank(),
    "four-bar": lambda rng: machines.four_bar(),
    "redundant four-bar": lambda rng: machines.four_bar(third="revolute"),
    "heavy-top": lambda rng: machines.heavy_top(),
    "tree": machines.tree,
    "free": lambda rng: MachineRecord(name="free", bodies=(machines.random_body("stone", rng),), gravity=(0, 0, -9.81)),
    **{kind: (lambda rng, kind=kind: machines.pair(kind, rng)) for kind in machines.KINDS},
}
EACH_MACHINE = pytest.mark.parametrize("name", MACHINES)


def prepared_for(machine, rotations):
    settings = machine.simulation.replace(formulation="lagrange", rotations=rotations)
    return prepare(machine.replace(simulation=settings), "lagrange")


def random_state(prepared, rng):
    """A state with other rotation coordinates than those of the start, near it in positions, moving; the joints are open a little."""
    count = prepared.motion.system.body_count
    y = prepared.start.copy()
    q, v = y[: 6 * count].reshape(count, 6), y[6 * count : 12 * count].reshape(count, 6)
    q[:, :3] += rng.uniform(-0.02, 0.02, (count, 3))
    q[:, 3:] += rng.uniform(-0.4, 0.4, (count, 3))
    v[:] = rng.uniform(-2, 2, (count, 6))
    return y


def consistent(prepared, y):
    """The assembled position with the velocities of y as far as the constraints let them be."""
    motion, count = prepared.motion, prepared.motion.system.body_count
    state = np.concatenate([prepared.start[: 6 * count], y[6 * count :]])
    assert motion.holds(0.3, state)
    C_q = motion.jacobian() @ rates_to_velocities(prepared)
    state[6 * count : 12 * count] -= np.linalg.lstsq(C_q, motion.system.record.constraints.Cdot, rcond=1e-10)[0]
    return state


def rates_to_velocities(prepared):
    """T of (Ṙ, ω̄) = T (Ṙ, φ̇) in the state last evaluated."""
    count = prepared.motion.system.body_count
    T = np.eye(6 * count)
    for b in range(count):
        T[6 * b + 3 : 6 * b + 6, 6 * b + 3 : 6 * b + 6] = prepared.motion.system.record.rotations.G[b]
    return T


def same_state(prepared):
    """(R, θ; Ṙ, ω̄) of the state last evaluated."""
    bodies, count = prepared.motion.system.record.bodies, prepared.motion.system.body_count
    q = np.hstack([bodies.R[:count], bodies.theta[:count]])
    return prepared.absolute.system.state(q.ravel(), bodies.Rdot[:count].copy(), bodies.omega_b[:count].copy())


def numbers(motion):
    """What the state last evaluated has left: C, Ċ, λ, accelerations, C_q."""
    record, count = motion.system.record, motion.system.body_count
    rows, bodies = record.constraints, record.bodies
    vdot = np.hstack([bodies.Rddot[:count], bodies.alpha_b[:count]])
    return [array.copy() for array in (rows.C, rows.Cdot, rows.lam, vdot, motion.jacobian())]


@EACH_KIND
@EACH_MACHINE
def test_constraints_accelerations_and_multipliers_are_those_of_newton_euler(name, rotations, rng):
    prepared = prepared_for(MACHINES[name](rng), rotations)
    for _ in range(3):
        y = random_state(prepared, rng)
        if name.startswith("redundant"):  # aside of its constraints they contradict each other
            y = consistent(prepared, y)
        assert prepared.motion.holds(0.3, y)
        found = numbers(prepared.motion)
        assert prepared.absolute.holds(0.3, same_state(prepared))
        for a, b in zip(found, numbers(prepared.absolute), strict=True):
            np.testing.assert_allclose(a, b, atol=1e-9 * (1 + np.abs(b).max(initial=0.0)))


@EACH_KIND
@pytest.mark.parametrize("name", [name for name in MACHINES if not name.startswith("redundant")])
def test_accelerations_solve_the_equations_of_the_report(name, rotations, rng):
    """Eqs. 57–77 with own Ḡ, in q = (R, φ): M from m_RR, m_Rθ, m_θθ, Q_v with Ḡ̇ φ̇, C_q with A Ḡ, NumPy's pivoted LU."""
    prepared = prepared_for(MACHINES[name](rng), rotations)
    motion, count = prepared.motion, prepared.motion.system.body_count
    y = random_state(prepared, rng)
    status, ydot = motion.evaluate(0.3, y)
    assert status == 0
    record = motion.system.record
    bodies, own, constraints = record.bodies, record.rotations, record.constraints
    rows = len(constraints.C)
    M, Q, T = np.zeros((6 * count, 6 * count)), np.zeros(6 * count), np.eye(6 * count)
    for b in range(count):
        A, m, c_b, w_b, G = bodies.A[b], bodies.mass[b], bodies.centre_b[b], bodies.omega_b[b], own.G[b]
        skew, J_O, Gdot_phidot = np.cross(np.eye(3), c_b), bodies.inertia_origin_b[b], own.bias[b]
        R, turn = slice(6 * b, 6 * b + 3), slice(6 * b + 3, 6 * b + 6)
        np.testing.assert_allclose(w_b, G @ y[6 * count :][turn], atol=1e-12)
        M[R, R], M[turn, turn] = m * np.eye(3), G.T @ J_O @ G
        M[R, turn] = -m * A @ skew @ G
        M[turn, R] = M[R, turn].T
        Q[R] = bodies.wrench[b, :3] - m * A @ (np.cross(w_b, np.cross(w_b, c_b)) - skew @ Gdot_phidot)
        Q[turn] = G.T @ (A.T @ bodies.wrench[b, 3:] - np.cross(w_b, J_O @ w_b) - J_O @ Gdot_phidot)
        T[turn, turn] = G
    C_q = motion.jacobian() @ T
    K = np.block([[M, C_q.T], [C_q, np.zeros((rows, rows))]])
    # C_q v̇ = γ with ᾱ = Ḡ φ̈ + Ḡ̇ φ̇
    gamma = constraints.gamma[:rows] - motion.jacobian() @ np.hstack([np.zeros((count, 3)), own.bias]).ravel()
    expected = np.linalg.solve(K, np.concatenate([Q, gamma]))
    np.testing.assert_allclose(ydot[: 6 * count], y[6 * count : 12 * count], rtol=0)
    for found, wanted in (
        (ydot[6 * count : 12 * count], expected[: 6 * count]),
        (constraints.lam, expected[6 * count :]),
    ):
        np.testing.assert_allclose(found, wanted, atol=1e-9 * (1 + np.abs(expected).max()))


@EACH_KIND
@pytest.mark.parametrize("name", ["slider-crank", "four-bar", "tree"])
def test_constraints_change_with_the_coordinates_as_their_jacobian_says(name, rotations, rng):
    """C_q T by central differences of C(q), error of second order: h² = 1e-10."""
    prepared = prepared_for(MACHINES[name](rng), rotations)
    motion, count, h = prepared.motion, prepared.motion.system.body_count, 1e-5
    y = random_state(prepared, rng)
    motion.evaluate(0.0, y)
    record = motion.system.record
    C_q = motion.jacobian() @ rates_to_velocities(prepared)
    for k in range(6 * count):
        sides = []
        for sign in (1.0, -1.0):
            aside = y.copy()
            aside[k] += sign * h
            motion.evaluate(0.0, aside)
            sides.append(record.constraints.C.copy())
        np.testing.assert_allclose((sides[0] - sides[1]) / (2 * h), C_q[:, k], atol=1e-9 * (1 + np.abs(C_q).max()))


@EACH_MACHINE
def test_euler_angles_start_as_far_from_their_singular_position_as_can_be(name, rng):
    """sin φ₂ = 1, at the same orientation, velocities and sign of the Euler parameters as assembled."""
    for rotations in KINDS:
        prepared = prepared_for(MACHINES[name](rng), rotations)
        prepared.motion.evaluate(0.0, prepared.start)
        np.testing.assert_allclose(prepared.motion.system.record.rotations.regularity, 1.0, rtol=1e-15)
        np.testing.assert_allclose(same_state(prepared), prepared.assembly.y, atol=1e-14 * np.abs(prepared.start).max())


@EACH_KIND
def test_state_map_tells_positions_from_rates(rotations):
    prepared = prepared_for(machines.slider_crank(), rotations)
    system = prepared.motion.system
    assert system.positions == 18
    assert len(system.map.turns) == 0
    assert len(system.map.units) == len(prepared.start) == 38
    status, ydot = prepared.motion.evaluate(0.0, prepared.start)
    assert status == 0
    q, v = system.map.plain.T
    np.testing.assert_array_equal(np.sort(q), np.arange(18))
    np.testing.assert_array_equal(ydot[q], prepared.start[v])
    assert [system.map.units[k] for k in (0, 3, 18, 21, 36)] == ["m", "1", "m/s", "1/s", ""]


@EACH_KIND
@pytest.mark.parametrize("stabilisation", ["none", "baumgarte", "direct", "geometric"])
def test_motion_agrees_with_euler_parameters(rotations, stabilisation):
    """Both have errors of order four: 1e-7 at 1 ms. Baumgarte's own coefficients would grow with 1/step, these do not."""
    settings = {"duration": 1.4, "step": 1e-3, "output_interval": 0.02, "formulation": "lagrange"}
    settings["stabilisation"] = stabilisation
    if stabilisation == "baumgarte":
        settings["baumgarte"] = Baumgarte(alpha=50.0, beta=50.0)
    expected = run(machines.slider_crank(), **settings)
    found = run(machines.slider_crank(), rotations=rotations, **settings)
    assert found.finished.outcome == "done"
    for name in ("position", "orientation", "velocity", "angular_velocity", "joint_coordinate"):
        a, b = getattr(found, name), getattr(expected, name)
        np.testing.assert_allclose(a, b, atol=1e-7 * (1 + np.abs(b).max()), err_msg=name)
    if stabilisation in ("direct", "geometric"):
        assert np.abs(found.constraint_violation).max() < 1e-12
        assert np.abs(found.energy_error).max() < 1e-6 * found.kinetic_energy.max()


@EACH_KIND
@pytest.mark.parametrize("stabilisation", ["none", "direct"])
def test_rk4_is_of_order_four(rotations, stabilisation):
    steps, errors = [8e-3, 4e-3, 2e-3, 1e-3], []
    for step in steps:
        result = run(
            machines.slider_crank(),
            duration=1.2,
            step=step,
            output_interval=0.12,
            formulation="lagrange",
            rotations=rotations,
            stabilisation=stabilisation,
        )
        errors.append(np.abs(result.position - slider_crank_reference.solve(result.time).position).max())
    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert abs(slope - 4) < 0.5, errors
    assert errors[-1] < 1e-8


@EACH_KIND
def test_orientation_is_given_by_continuous_euler_parameters(rotations, rng):
    """Between frames θ changes by half the angle turned, never by a sign."""
    stone = MachineRecord(name="free", bodies=(machines.random_body("stone", rng),), gravity=(0, 0, -9.81))
    settings = {"duration": 1.0, "step": 1e-3, "output_interval": 0.01, "formulation": "lagrange"}
    result, expected = run(stone, rotations=rotations, **settings), run(stone, **settings)
    np.testing.assert_allclose(result.orientation, expected.orientation[: len(result.time)], atol=1e-8)


@EACH_KIND
def test_chunks_do_not_change_the_result(rotations):
    settings = {"duration": 0.2, "step": 1e-3, "formulation": "lagrange", "rotations": rotations}
    a = run(machines.slider_crank(), chunk_steps=7, **settings)
    b = run(machines.slider_crank(), chunk_steps=1000, **settings)
    np.testing.assert_array_equal(a.frames, b.frames)


@EACH_KIND
def test_energy_error_is_of_order_four(rotations, rng):
    """A double spherical pendulum: all rotation coordinates move."""
    point = (0.0, 0.0, 0.0)
    bodies = (machines.random_body("a", rng), machines.random_body("b", rng))
    joints = (
        machines.joint_at("base", "spherical", "ground", "a", rng, point=point),
        machines.joint_at("elbow", "spherical", "a", "b", rng, point=(0.5, 0.0, 0.0)),
    )
    chain = MachineRecord(name="chain", bodies=bodies, joints=joints, gravity=(0, 0, -9.81))
    steps = [4e-3, 2e-3, 1e-3]
    errors = []
    for step in steps:
        result = run(chain, duration=0.4, step=step, output_interval=0.04, formulation="lagrange", rotations=rotations)
        assert result.finished.outcome == "done"
        errors.append(np.abs(result.energy_error).max())
    assert np.all(slopes(steps, errors) > 3.6), errors


@EACH_KIND
@pytest.mark.parametrize("integrator", ["rkn4", "abm4", "am4", "gear4"])
def test_every_family_of_integrators_takes_them(rotations, integrator):
    """The slider-crank at 1 ms; Gear's constant of order four is the largest."""
    result = run(
        machines.slider_crank(),
        duration=1.2,
        step=1e-3,
        output_interval=0.05,
        integrator=integrator,
        formulation="lagrange",
        rotations=rotations,
    )
    assert result.finished.outcome == "done"
    expected = slider_crank_reference.solve(result.time)
    assert np.abs(result.position - expected.position).max() < (1e-6 if integrator == "gear4" else 1e-7)


def test_rotations_belong_to_the_lagrange_equations_in_absolute_coordinates():
    for formulation in ("newton-euler", "penalty"):
        sections = {
            "bodies": {"rock": solid()},
            "simulation": {"formulation": formulation, "rotations": "euler-angles"},
        }
        with pytest.raises(ModelError, match="rotation coordinates of `formulation: lagrange`"):
            machine_of(sections).simulate()


@EACH_KIND
def test_forces_that_depend_on_reactions_act_alike(rotations):
    """A double pendulum with friction in its hinge and a spring at its tip: as with Euler parameters."""
    sections = {
        "bodies": {
            "bob": wheel(0.1, position=[0.6, 0, 0]),
            "tip": solid(position=[1.0, 0, 0]),
        },
        "joints": {
            "base": hinge("ground", "bob"),
            "elbow": {"type": "spherical", "bodies": ["bob", "tip"], "point": [0.8, 0, 0]},
        },
        "gravity": [0, -9.81, 0],
        "forces": {
            "rub": {
                "type": "friction",
                "model": "coulomb",
                "transition_speed": 0.1,
                "coordinate": "base.angle",
                "coefficient": 0.1,
                "radius": 0.05,
            },
            "coil": {
                "type": "spring-damper",
                "points": [[0, 0.5, 0], [1.0, 0, 0]],
                "bodies": ["ground", "tip"],
                "stiffness": 50,
                "damping": 1,
                "free_length": 0.5,
            },
        },
    }
    settings = {"duration": 0.4, "step": 1e-3, "output_interval": 0.02, "formulation": "lagrange"}
    expected, found = simulate(sections, **settings), simulate(sections, rotations=rotations, **settings)
    for name in ("position", "joint_force", "dissipated_energy", "force.rub.magnitude"):
        a, b = found.array(name), expected.array(name)
        np.testing.assert_allclose(a, b, atol=1e-7 * (1 + np.abs(b).max()), err_msg=name)
