"""Implicit methods in independent coordinates: the formulas of the method hold for the independent velocities and for what these move, all
other positions, velocities and accelerations are those that C = 0, Ċ = 0 and C̈ = 0 leave, and the forces balance."""

import ctypes
from importlib import import_module

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import machines
from assembled import TIME, random_states
from nivel.analysis.assembly.equations import moved
from nivel.analysis.assembly.implicit import evaluate_residual, find_tangent
from nivel.analysis.plan.settings import complete
from nivel.analysis.run.dynamics import march
from nivel.errors import ModelError, SolveError
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import DEPENDENT
from preparing import prepare
from references import slider_crank
from running import Frames, reference_run, run
from simulating import machine as machine_of
from test_independent import triple_rocker
from test_shifted_parts import sled

pytestmark = pytest.mark.covering

ALPHA = {"newmark": {}, "hht": {"hht": {"alpha": 0.1}}, "generalised-alpha": {}}
EACH_ALPHA = pytest.mark.parametrize("integrator", ALPHA)
MACHINES = {
    "slider-crank": machines.slider_crank,
    "four-bar": machines.four_bar,
    "four-bar of revolutes": lambda: machines.four_bar("revolute", "revolute"),
    "heavy-top": machines.heavy_top,
    "bennett": machines.bennett,
    "tree": lambda: machines.tree(np.random.default_rng(5)),
    "triple rocker": lambda: machine_of(triple_rocker()).record,
}
EACH = pytest.mark.parametrize("name", MACHINES)


def equipped(machine, integrator="newmark", **settings):
    """The machine prepared for the integrator in independent coordinates."""
    chosen = {"integrator": integrator, "coordinates": "independent", **settings}
    record = machine.replace(simulation=machine.simulation.replace(**chosen))
    return prepare(record, "newton-euler", "independent"), complete(record.simulation)


def depend(motion, t):
    """Status of the hook that finds what depends on the independent entries of `residual.y` and `vdot`."""
    hook = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_uint64, ctypes.c_int64, ctypes.c_double)
    return hook(int(motion.system.record.hooks.address[DEPENDENT]))(int(motion.handle.address), 0, t)


def split(motion):
    """(numbers of the independent velocities, of all velocities, of the multipliers, first velocity in y)."""
    record = motion.system.record
    n, rank = len(record.residual.vdot), int(record.control.rank[0])
    return record.partition.column[rank:].astype(int), n, len(record.residual.row), motion.system.positions


@EACH
def test_what_depends_closes_all_constraints_and_the_independent_entries_stay(name, rng):
    prepared, _ = equipped(MACHINES[name]())
    motion = prepared.motion
    residual, unit = motion.system.record.residual, motion.system.record.partition.unit
    for y in random_states(prepared, rng, 2):
        motion.evaluate(TIME, y)
        free, n, rows, nq = split(motion)
        y[:nq] = moved(y[:nq], 1e-5 * rng.standard_normal(n) * unit)
        y[nq : nq + n] += 1e-3 * rng.standard_normal(n) * unit
        vdot = rng.standard_normal(n)
        residual.y[:], residual.vdot[:], residual.lam[:] = y, vdot, 0.0
        assert depend(motion, TIME) == OK
        np.testing.assert_array_equal(residual.y[nq + free], y[nq + free])
        np.testing.assert_array_equal(residual.vdot[free], vdot[free])
        assert evaluate_residual(motion, TIME) == OK
        C, Cdot, Cddot = np.split(residual.value[-3 * rows :], 3) if rows else 3 * [np.zeros(0)]
        speed, pace = (1.0 + np.abs(each).max() for each in (residual.y[nq : nq + n], residual.vdot))
        assert np.abs(C).max(initial=0.0) < 1e-11
        assert np.abs(Cdot).max(initial=0.0) < 1e-12 * speed
        assert np.abs(Cddot).max(initial=0.0) < 1e-12 * (pace + speed**2)


@pytest.mark.parametrize("name", ["slider-crank", "four-bar", "four-bar of revolutes", "tree"])
def test_the_end_of_a_step_solves_the_equations_of_motion_and_all_constraints(name):
    """M v̇ + C_qᵀ λ = Q, C = 0, Ċ = 0, C̈ = 0 at once, of what the iteration of the last step ended with."""
    prepared, settings = equipped(MACHINES[name](), duration=0.05, corrector={"tolerance": 1e-13})
    assert march(prepared, settings, [Frames()]).outcome == "done"
    motion = prepared.motion
    residual, (_, n, rows, _) = motion.system.record.residual, split(motion)
    value = []
    for lam in (residual.lam.copy(), 0.0 * residual.lam):
        residual.lam[:] = lam
        assert evaluate_residual(motion, 0.05) == OK
        value.append(residual.value.copy())
    assert np.abs(value[0][:n]).max() < 1e-8 * np.abs(value[1][:n]).max()
    assert np.abs(value[0][-3 * rows : -rows]).max() < 1e-12
    assert np.abs(value[0][-rows:]).max() < 1e-9 * np.abs(residual.vdot).max()


@pytest.mark.parametrize("name", ["slider-crank", "four-bar", "tree"])
def test_formulas_of_newmark_hold_for_the_independent_velocities(name):
    """v₁ = v₀ + h/2 (a₀ + a₁) and a change of position of h v₀ + h²/4 (a₀ + a₁), of bodies as a rotation vector in their axes."""
    h = 1e-3
    record = MACHINES[name]()
    settings = {"corrector": {"tolerance": 1e-13, "matrix": "full"}, "duration": 0.2, "step": h, "output_interval": h}
    r = run(record, integrator="newmark", coordinates="independent", **settings)
    assert r.finished.timing["partitions"] == 0
    free, *_ = split(r.prepared.motion)
    A = Rotation.from_quat(r.orientation.reshape(-1, 4), scalar_first=True)
    turned = A.as_matrix().reshape(len(r.time), -1, 3, 3)
    omega, alpha = (np.einsum("tbji,tbj->tbi", turned, each) for each in (r.angular_velocity, r.angular_acceleration))
    v, a = (
        np.concatenate(each, axis=2).reshape(len(r.time), -1) for each in ((r.velocity, omega), (r.acceleration, alpha))
    )
    speed = v[:-1] + 0.5 * h * (a[:-1] + a[1:])
    change = h * v[:-1] + 0.25 * h**2 * (a[:-1] + a[1:])
    np.testing.assert_allclose(v[1:, free], speed[:, free], rtol=0, atol=1e-11 * (1.0 + np.abs(v).max()))
    # from where the formula puts each body to where it is, in its own axes
    psi = change.reshape(len(r.time) - 1, -1, 6)
    formula = turned[:-1] @ Rotation.from_rotvec(psi[..., 3:].reshape(-1, 3)).as_matrix().reshape(turned[1:].shape)
    left = np.einsum("tbji,tbjk->tbik", formula, turned[1:]).reshape(-1, 3, 3)
    turn = Rotation.from_matrix(left).as_rotvec().reshape(psi[..., 3:].shape)
    moves = np.concatenate([np.diff(r.position, axis=0) - psi[..., :3], turn], axis=2).reshape(len(r.time) - 1, -1)
    np.testing.assert_allclose(moves[:, free], 0.0, atol=1e-13)
    dependent = np.setdiff1d(np.arange(v.shape[1]), free)
    if name != "tree":
        # and for the others they do not
        assert np.abs(moves[:, dependent]).max() > 1e-9


@EACH_ALPHA
def test_order_two_in_positions_velocities_and_multipliers_of_the_four_bar(integrator):
    common = {"duration": 0.4, "output_interval": 0.02}
    fine = reference_run(machines.four_bar(), integrator="dop853", tolerance=1e-11, coordinates="relative", **common)
    found = []
    for step in (4e-3, 2e-3, 1e-3):
        r = run(
            machines.four_bar(),
            integrator=integrator,
            step=step,
            coordinates="independent",
            **common,
            **ALPHA[integrator],
        )
        assert np.abs(r.constraint_violation).max() <= 1e-10
        assert np.abs(r.constraint_rate_violation).max() <= 1e-10
        found.append(
            [np.abs(getattr(r, name) - getattr(fine, name)).max() for name in ("position", "velocity", "joint_force")]
        )
    assert np.all(np.abs(np.log2(np.array(found)[:-1] / found[1:]) - 2.0) < 0.2)


@EACH_ALPHA
def test_changes_of_the_partition_keep_order_two_and_close_everything(integrator):
    """Four bars of which none turns round: each of them stands still somewhere while the others move."""
    record = machine_of(triple_rocker()).record
    common = {"duration": 0.6, "output_interval": 0.02}
    fine = reference_run(record, integrator="dop853", tolerance=1e-11, coordinates="absolute", **common)
    errors = []
    for step in (1e-3, 5e-4, 2.5e-4):
        r = run(record, integrator=integrator, step=step, coordinates="independent", **common, **ALPHA[integrator])
        assert r.finished.timing["partitions"] > 0
        assert np.abs(r.constraint_violation).max() <= 1e-10
        assert np.abs(r.constraint_rate_violation).max() <= 1e-10
        errors.append(
            [np.abs(getattr(r, name) - getattr(fine, name)).max() for name in ("position", "velocity", "joint_force")]
        )
    assert np.all(np.abs(np.log2(np.array(errors)[:-1] / errors[1:]) - 2.0) < 0.4)


@pytest.mark.parametrize("integrator", ["radau", "bdf"])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
def test_tolerance_is_met_through_changes_of_the_partition(integrator, tolerance):
    record = machine_of(triple_rocker()).record
    common = {"duration": 0.6, "output_interval": 0.02}
    fine = reference_run(record, integrator="dop853", tolerance=1e-11, coordinates="absolute", **common)
    r = run(record, integrator=integrator, tolerance=tolerance, coordinates="independent", **common)
    assert r.finished.timing["partitions"] > 0
    assert np.abs(r.position - fine.position).max() < 10 * tolerance * r.prepared.motion.system.size
    assert np.abs(r.constraint_violation).max() <= 1e-10
    assert np.abs(r.constraint_rate_violation).max() <= 1e-10


def test_the_slider_crank_passes_its_dead_points_at_a_coarse_step():
    r = run(machines.slider_crank(), integrator="generalised-alpha", step=1e-2, coordinates="independent")
    assert r.finished.outcome == "done"
    expected = slider_crank.solve(r.time)
    assert np.abs(r.position - expected.position).max() < 0.15
    assert np.abs(r.energy_error).max() < 0.02 * r.kinetic_energy.max()
    assert np.abs(r.constraint_violation).max() <= 1e-10


@pytest.mark.parametrize("name", ["slider-crank", "four-bar"])
def test_contraction_of_the_iteration_is_of_the_order_of_the_step_squared(name, rng):
    """Of a change of the independent accelerations, the iteration with the exact tangent [M + c_v D + c_q K, C_qᵀ; ∂C̈/∂v̇, 0] leaves what
    positions and velocities that depend on them do not follow of the formulas."""
    prepared, _ = equipped(MACHINES[name]())
    motion, record = prepared.motion, prepared.motion.system.record
    residual = record.residual
    y = next(random_states(prepared, rng, 1))
    status, rate = motion.evaluate(TIME, y)
    assert status == OK
    free, n, rows, nq = split(motion)
    vdot, lam = rate[nq : nq + n].copy(), record.constraints.lam[residual.row].copy()
    shares = []
    for h in (4e-3, 2e-3, 1e-3):
        cq, cv = 0.25 * h * h, 0.5 * h

        def value(change, along, cq=cq, cv=cv):
            """The residual where accelerations have changed; along : with all that depends on the independent ones."""
            residual.y[:], residual.vdot[:], residual.lam[:] = y, vdot + change, lam
            residual.y[:nq] = moved(y[:nq], cq * change)
            residual.y[nq : nq + n] += cv * change
            assert not along or depend(motion, TIME) == OK
            assert evaluate_residual(motion, TIME) == OK
            return residual.value.copy()

        def slope(j, along, value=value):
            e = 0.01 * np.eye(n)[j]
            return (value(e, along) - value(-e, along)) / 0.02

        G = np.transpose([slope(j, False)[-rows:] for j in range(n)])
        residual.y[:], residual.vdot[:], residual.lam[:] = y, vdot, lam
        record.newton.change[:] = 0.0
        status, matrix = find_tangent(motion, TIME, cq, cv, h)
        assert status == OK
        matrix[n:, :n] = G
        right = np.transpose([np.append(slope(j, True)[:n], np.zeros(rows)) for j in free])
        left = np.eye(len(free)) - np.linalg.solve(matrix, right)[free]
        shares.append(np.abs(np.linalg.eigvals(left)).max())
    assert shares[-1] < 1e-3
    assert np.all(np.array(shares[:-1]) / shares[1:] > 3.5)


def test_with_a_new_matrix_for_every_iteration_two_make_a_step():
    corrector = {"matrix": "full", "tolerance": 1e-10}
    settings = {"coordinates": "independent", "step": 1e-3, "duration": 0.4, "corrector": corrector}
    for machine in (machines.slider_crank(), machines.four_bar()):
        timing = run(machine, integrator="newmark", **settings).finished.timing
        assert timing["iterations"] <= 2.1 * timing["steps"]


@pytest.mark.parametrize("integrator", ["newmark", "radau", "bdf", "ros2"])
@pytest.mark.parametrize("machine", [machines.bennett, lambda: machines.four_bar("revolute", "revolute")])
def test_redundant_joints(machine, integrator):
    """Motion, and the reactions of least length, are those of an explicit method."""
    record = machine()
    common = {"duration": 0.2, "output_interval": 0.02, "coordinates": "independent"}
    fine = reference_run(record, integrator="dop853", tolerance=1e-10, **common)
    settings = {"step": 2e-4} if integrator in ("newmark", "ros2") else {"tolerance": 1e-7}
    r = run(record, integrator=integrator, **common, **settings)
    assert np.abs(r.position - fine.position).max() < 1e-5
    assert np.abs(r.joint_force - fine.joint_force).max() < 1e-4 * (1.0 + np.abs(fine.joint_force).max())


@pytest.mark.parametrize("integrator", ["newmark", "radau", "bdf", "ros2"])
def test_friction_loaded_by_reactions(integrator):
    """A sled on bristles, against an explicit method in absolute coordinates."""
    common = {"duration": 0.3, "output_interval": 0.03}
    fine = reference_run(sled(), integrator="dop853", tolerance=1e-10, coordinates="absolute", **common)
    settings = {"step": 1e-4} if integrator in ("newmark", "ros2") else {"tolerance": 1e-7}
    r = run(sled(), integrator=integrator, coordinates="independent", **common, **settings)
    assert r.dissipated_energy[-1] > 1e-3
    assert np.abs(r.position - fine.position).max() < 1e-7
    assert np.abs(r.dissipated_energy - fine.dissipated_energy).max() < 1e-6


@pytest.mark.parametrize("stabilisation", ["none", "direct", "geometric"])
def test_stabilisations_differ_by_the_energy_alone(stabilisation):
    """With none and direct the same numbers: all constraints are solved either way. With geometric the energy is kept."""
    settings = {"integrator": "newmark", "coordinates": "independent", "duration": 0.5, "step": 1e-3}
    r = run(machines.slider_crank(), stabilisation=stabilisation, **settings)
    assert r.finished.outcome == "done"
    if stabilisation == "geometric":
        assert np.abs(r.energy_error).max() < 1e-9 * r.kinetic_energy.max()
    else:
        np.testing.assert_array_equal(r.frames, run(machines.slider_crank(), stabilisation="direct", **settings).frames)


@pytest.mark.parametrize("integrator", ["generalised-alpha", "radau", "bdf", "ros2"])
def test_chunks_change_nothing(integrator):
    settings = {"integrator": integrator, "coordinates": "independent", "duration": 0.1}
    whole = run(machines.slider_crank(), **settings)
    assert np.array_equal(whole.frames, run(machines.slider_crank(), chunk_steps=3, **settings).frames)


def test_a_step_to_where_the_machine_cannot_be_names_joint_and_coordinate():
    with pytest.raises(
        SolveError, match=r"no solution within a step of 0.2 s|position that the machine does not have"
    ) as caught:
        machine_of(triple_rocker()).simulate(duration=2.0, step=0.2, coordinates="independent", integrator="newmark")
    assert "coordinate" in str(caught.value)
    assert "joint" in str(caught.value)


def test_what_stays_refused_says_why():
    for integrator, settings, words in (
        ("energy-momentum", {"stabilisation": "none"}, "balances the momenta of each body"),
        ("newmark", {"stabilisation": "baumgarte"}, "there is no violation to feed back"),
        ("radau", {"formulation": "penalty"}, "there is no violation to feed back"),
    ):
        with pytest.raises(ModelError, match=words):
            run(machines.slider_crank(), integrator=integrator, coordinates="independent", **settings)


def test_dependent_coordinates_are_compiled_for_methods_that_ask_for_them_alone():
    assert not equipped(machines.slider_crank(), "radau")[0].motion.system.record.hooks.address[DEPENDENT]
    module = import_module("nivel.motion.independent")
    address = equipped(machines.slider_crank())[0].motion.system.record.hooks.address[DEPENDENT]
    assert int(address) == module.depend.address
