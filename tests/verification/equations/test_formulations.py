"""*lagrange* and *newton-euler* against each other and against the textbook equations written here in NumPy."""

import numpy as np
import pytest

import machines
from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from preparing import prepare

pytestmark = pytest.mark.covering

MACHINES = {
    "slider-crank": machines.slider_crank,
    "four-bar": machines.four_bar,
    "heavy-top": machines.heavy_top,
    "tree": lambda: machines.tree(np.random.default_rng(5)),
    **{kind: (lambda kind=kind: machines.pair(kind, np.random.default_rng(7))) for kind in machines.BETWEEN_BODIES},
}
EACH = pytest.mark.parametrize("name", MACHINES)


def solved(machine, formulation, spin=None):
    """(accelerations (B, 6), multipliers of joint rows, motion) at the assembled state, joints turning."""
    motion = equations(machine, formulation)
    state = assemble(machine, motion).y
    system = motion.system
    count = system.body_count
    record = system.record
    motion.evaluate(0.0, state)
    J = motion.jacobian()
    # a velocity the joints allow, the same for both formulations: a random one projected
    random = np.random.default_rng(1).uniform(-2, 2, 6 * count)
    v = (random - np.linalg.lstsq(J, J @ random, rcond=1e-12)[0]).reshape(count, 6)
    state = system.state(state[: 7 * count], v[:, :3], v[:, 3:])
    assert motion.holds(0.3, state)
    vdot = np.hstack([record.bodies.Rddot[:count], record.bodies.alpha_b[:count]])
    return vdot, record.constraints.lam[: system.machine_rows].copy(), motion


@EACH
def test_lagrange_and_newton_euler_agree(name):
    machine = MACHINES[name]()
    a, lam_a, _ = solved(machine, "newton-euler")
    b, lam_b, _ = solved(machine, "lagrange")
    np.testing.assert_allclose(a, b, atol=1e-10 * (1 + np.abs(a).max()))
    np.testing.assert_allclose(lam_a, lam_b, atol=1e-10 * (1 + np.abs(lam_a).max(initial=0.0)))


@EACH
def test_accelerations_solve_the_saddle_point_system_about_the_frame_origin(name):
    """[M C_qᵀ; C_q 0] [v̇; λ] = [Q; γ] with M = [m 1, -m c̃ A; ·, J̄_O] assembled here, NumPy's pivoted LU."""
    vdot, lam, motion = solved(MACHINES[name](), "newton-euler")
    record = motion.system.record
    bodies = record.bodies
    count, rows = motion.system.body_count, motion.system.machine_rows
    M, Q = np.zeros((6 * count, 6 * count)), np.zeros(6 * count)
    for b in range(count):
        A, m, c_b, w_b = bodies.A[b], bodies.mass[b], bodies.centre_b[b], bodies.omega_b[b]
        skew = np.cross(np.eye(3), c_b)  # c̃: skew @ x = c × x
        J_O = bodies.inertia_b[b] - m * skew @ skew
        at = slice(6 * b, 6 * b + 3), slice(6 * b + 3, 6 * b + 6)
        M[at[0], at[0]] = m * np.eye(3)
        M[at[0], at[1]] = -m * A @ skew
        M[at[1], at[0]] = M[at[0], at[1]].T
        M[at[1], at[1]] = J_O
        Q[at[0]] = bodies.wrench[b, :3] - m * A @ np.cross(w_b, np.cross(w_b, c_b))
        Q[at[1]] = A.T @ bodies.wrench[b, 3:] - np.cross(w_b, J_O @ w_b)
    J = motion.jacobian()
    K = np.block([[M, J.T], [J, np.zeros((rows, rows))]])
    expected = np.linalg.solve(K, np.concatenate([Q, record.constraints.gamma[:rows]]))
    scale = 1 + np.abs(expected).max()
    np.testing.assert_allclose(vdot.ravel(), expected[: 6 * count], atol=1e-10 * scale)
    np.testing.assert_allclose(lam, expected[6 * count :], atol=1e-10 * scale)


def test_a_free_body_off_its_centre_of_mass_obeys_newton_and_euler(rng):
    """No joint: the centre of mass falls with g, the angular momentum about it stays."""
    body = machines.random_body("stone", rng)
    from nivel import MachineRecord

    machine = MachineRecord(name="stone", bodies=(body,), gravity=(0, 0, -9.81))
    for formulation in ("newton-euler", "lagrange"):
        prepared = prepare(machine, formulation)
        assert prepared.redundancy.degrees_of_freedom == 6
        motion = prepared.motion
        assert motion.holds(0.0, prepared.assembly.y)
        b = motion.system.record.bodies
        A, w_b, al_b, c_b = b.A[0], b.omega_b[0], b.alpha_b[0], b.centre_b[0]
        centre = b.Rddot[0] + A @ (np.cross(al_b, c_b) + np.cross(w_b, np.cross(w_b, c_b)))
        np.testing.assert_allclose(centre, (0, 0, -9.81), atol=1e-11)
        np.testing.assert_allclose(b.inertia_b[0] @ al_b + np.cross(w_b, b.inertia_b[0] @ w_b), 0, atol=1e-11)
