"""Flexible bodies in independent coordinates: at equal states all is as in absolute ones, and so are motions. Lagrange equations are
refused."""

from importlib import import_module

import numpy as np
import pytest

from nivel import Friction, SimulationSettings
from nivel.analysis.plan.plan import plan_run
from nivel.errors import ModelError
from nivel.kernels.core.status import OK
from observing import assert_same_frame, observed, of_absolute
from preparing import prepare
from running import reference_run, run
from tree_machines import MACHINES, beam, hinge, machine, write_beams

pytestmark = pytest.mark.covering

TIME = 0.1
INDEPENDENT = {"formulation": "newton-euler", "coordinates": "independent"}
EACH = pytest.mark.parametrize("name", MACHINES)


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    return write_beams(tmp_path_factory.mktemp("formulations"))


def independent_of(record):
    settings = record.simulation.replace(**INDEPENDENT)
    return prepare(record.replace(simulation=settings), "newton-euler", "independent")


def absolute_of(record):
    settings = SimulationSettings(formulation="newton-euler", coordinates="absolute")
    return prepare(record.replace(simulation=settings), "newton-euler", "absolute")


def moving(prepared, rng):
    """A state in motion, bent, on its constraints."""
    motion = prepared.motion
    system, y = motion.system, prepared.start.copy()
    positions, states = system.positions, len(system.record.elements.state)
    n = len(y) - positions - states - 2
    units = np.array(system.map.units)
    y[:positions] += np.where(units[:positions] == "kg^0.5 m", 0.01, 0.01) * rng.uniform(-1, 1, positions)
    y[positions : positions + n] += np.where(units[positions : positions + n] == "kg^0.5 m/s", 0.3, 1.0) * rng.uniform(
        -1, 1, n
    )
    system.record.control.stabilise[2:] = 1e-14
    correct = import_module(prepared.path.correction).correct
    for _ in range(6):
        assert correct(motion.handle.address, TIME, y) == OK
    assert motion.evaluate(TIME, y)[0] == OK
    constraints = system.record.constraints
    assert np.abs(constraints.C / constraints.scale).max(initial=0.0) < 1e-12
    assert np.abs(constraints.Cdot / constraints.scale).max(initial=0.0) < 1e-11
    return y


@EACH
def test_accelerations_and_reactions_at_equal_states(folder, rng, name):
    """Of bodies and modes, reactions, energies and sensors: the frame as a whole."""
    record = MACHINES[name](folder)
    prepared, absolute = independent_of(record), absolute_of(record)
    states = len(prepared.motion.system.record.elements.state)
    for _ in range(3):
        y = moving(prepared, rng)
        seen = observed(prepared.motion, TIME, y)
        expected = observed(absolute.motion, TIME, of_absolute(seen, states))
        assert expected.status == OK
        assert np.abs(expected.pddot).max() > 1.0
        np.testing.assert_allclose(seen.pddot, expected.pddot, rtol=0, atol=1e-9 * np.abs(expected.pddot).max())
        layouts = prepared.motion.system.layout, absolute.motion.system.layout
        assert_same_frame(layouts[0], seen.frame, expected.frame, other=layouts[1])


@pytest.mark.parametrize("name", ["pendulum", "chain", "flying", "loop"])
def test_motion_is_that_of_absolute_coordinates(folder, name):
    """What is left between them falls with the fourth power of the step."""
    record = MACHINES[name](folder)
    common = {"integrator": "rk4", "duration": 0.02, "output_interval": 0.01}
    differences = []
    for step in (4e-5, 2e-5):
        a, r = (run(record, step=step, **common, **each) for each in ({"coordinates": "absolute"}, INDEPENDENT))
        assert r.finished.outcome == "done"
        differences.append(np.abs(a.modal_rate - r.modal_rate).max() / np.abs(a.modal_rate).max())
        assert np.abs(a.position - r.position).max() < 1e-8
    # until round-off of stiff modes
    assert differences[0] < 1e-5
    assert differences[-1] < max(differences[0] / 10.0, 1e-9)


@EACH
def test_energy_is_kept(folder, name):
    record = MACHINES[name](folder)
    errors = []
    for step in (4e-5, 2e-5):
        r = run(record, integrator="rk4", step=step, duration=0.05, output_interval=0.01, **INDEPENDENT)
        assert r.finished.outcome == "done"
        errors.append(np.abs(r.energy_error).max() / max(r.kinetic_energy.max(), 1e-3))
        assert np.abs(r.constraint_violation).max(initial=0.0) < 1e-9
    assert errors[1] < max(errors[0] / 10.0, 1e-11)
    assert errors[0] < 1e-5


def test_implicit_multistep_method(folder):
    """Gear's method with Newton's iteration on these states, whose matrix is made by differences."""
    record = MACHINES["pendulum"](folder)
    common = {"duration": 0.02, "output_interval": 0.01, "step": 1e-5}
    expected = reference_run(record, coordinates="absolute", integrator="rk4", **common)
    r = run(record, integrator="gear4", corrector={"iteration": "newton"}, **common, **INDEPENDENT)
    assert r.finished.outcome == "done"
    assert np.abs(r.position - expected.position).max() < 1e-7


def test_chosen_steps(folder):
    record = MACHINES["chain"](folder)
    common = {"duration": 0.1, "output_interval": 0.02}
    expected = reference_run(record, integrator="dop853", tolerance=1e-10, coordinates="absolute", **common)
    r = run(record, integrator="dop853", tolerance=1e-9, **common, **INDEPENDENT)
    assert r.finished.outcome == "done"
    assert np.abs(r.position - expected.position).max() < 1e-6


def rubbing(folder):
    """A loop with friction in its shaft, loaded by the shaft's reaction."""
    record = MACHINES["loop"](folder)
    rub = Friction(
        name="rub", model="coulomb", coordinate="shaft.angle", coefficient=0.3, radius=0.05, transition_speed=0.01
    )
    return record.replace(forces=(rub,))


def test_friction_at_equal_states(folder, rng):
    record = rubbing(folder)
    prepared, absolute = independent_of(record), absolute_of(record)
    seen = observed(prepared.motion, TIME, moving(prepared, rng))
    expected = observed(absolute.motion, TIME, of_absolute(seen, 0))
    assert abs(expected.frame[-2 * len(expected.p) - 3 :]).max() > 0.0
    layouts = prepared.motion.system.layout, absolute.motion.system.layout
    assert_same_frame(layouts[0], seen.frame, expected.frame, tolerance=1e-7, other=layouts[1])


def test_start_from_equilibrium(folder):
    """A bent beam at rest stays where it is."""
    record = machine(
        "clamped",
        [beam(folder, "a", (0, 0, 0)), beam(folder, "b", (1, 0, 0))],
        [hinge("w", "ground", "a", 0.0, kind="fixed", axis=None), hinge("e", "a", "b", 1.0, kind="fixed", axis=None)],
    )
    r = run(record, start="equilibrium", integrator="rk4", step=1e-5, duration=0.01, **INDEPENDENT)
    assert np.abs(r.modal_coordinate[0]).max() > 1e-4
    assert np.abs(r.modal_coordinate - r.modal_coordinate[0]).max() < 1e-8 * np.abs(r.modal_coordinate[0]).max()
    assert np.abs(r.position - r.position[0]).max() < 1e-10


@EACH
def test_modes_are_independent(folder, rng, name):
    """All of them where the rigid machine determines its dependent velocities; B spans what the constraints allow."""
    prepared = independent_of(MACHINES[name](folder))
    system = prepared.motion.system
    partition, rank = system.record.partition, int(system.record.control.rank[0])
    moving(prepared, rng)
    assert np.all(partition.column[:rank] < 6 * system.body_count)
    B, constraints = partition.B, system.record.constraints
    n = B.shape[1]
    assert B.shape[0] == n - rank
    # H keeps the Cholesky factor of Bᵀ M B; M B is kept too
    L = np.tril(partition.H)
    np.testing.assert_allclose(L @ L.T, partition.MB @ B.T, rtol=0, atol=1e-10 * np.abs(partition.MB @ B.T).max())
    # the motion of every independent velocity alone leaves Ċ as it is
    y = moving(prepared, rng)
    at = system.positions
    still = y.copy()
    still[at : at + n] = 0.0
    prepared.motion.evaluate(TIME, still)
    before = constraints.Cdot.copy()
    for row in B.copy():
        still[at : at + n] = row
        prepared.motion.evaluate(TIME, still)
        np.testing.assert_allclose(constraints.Cdot, before, rtol=0, atol=1e-10 * max(np.abs(row).max(), 1.0))


def test_independent_coordinates_close_positions_and_velocities_to_round_off(folder):
    record = MACHINES["loop"](folder)
    r = run(record, integrator="rk4", step=2e-5, duration=0.1, output_interval=0.01, **INDEPENDENT)
    assert r.finished.outcome == "done"
    assert np.abs(r.constraint_violation).max() < 1e-12
    assert np.abs(r.constraint_rate_violation).max() < 1e-11 * max(np.abs(r.velocity).max(), 1.0)


def test_partition_changes_on_the_way(folder):
    """A double pendulum of flexible bars that swings round: the first choice of independent velocities does not last."""
    bars = [beam(folder, name, (k, 0, 0), file="beam", modes=2) for k, name in enumerate("ab")]
    record = machine(
        "double", bars, [hinge("r", "ground", "a", 0.0, axis=(0, 0, 1)), hinge("e", "a", "b", 1.0, axis=(0, 0, 1))]
    )
    common = {"integrator": "rk4", "step": 1e-4, "duration": 1.5, "output_interval": 0.05}
    expected = reference_run(record, coordinates="absolute", **common)
    r = run(record, **common, **INDEPENDENT)
    assert r.finished.timing["partitions"] > 0
    assert np.abs(r.position - expected.position).max() < 1e-4
    assert np.abs(r.energy_error).max() < 1e-5 * r.kinetic_energy.max()


def double_pendulum(folder, modes):
    bars = [beam(folder, name, (k, 0, 0), file="beam", modes=modes) for k, name in enumerate("ab")]
    hinges = [hinge("r", "ground", "a", 0.0, axis=(0, 0, 1)), hinge("e", "a", "b", 1.0, axis=(0, 0, 1))]
    return machine("double", bars, hinges)


@pytest.mark.parametrize("integrator", ["newmark", "generalised-alpha", "ros2"])
def test_implicit_methods_have_order_two(folder, integrator):
    """Positions and velocities, modes included in what moves them; the first mode of a bar has some 100 periods a second."""
    record = double_pendulum(folder, 1)
    common = {"duration": 0.1, "output_interval": 0.01}
    fine = reference_run(record, integrator="rk4", step=2e-5, coordinates="absolute", **common)
    errors = []
    for step in (2e-4, 1e-4, 5e-5):
        r = run(record, integrator=integrator, step=step, **common, **INDEPENDENT)
        assert r.finished.outcome == "done"
        assert np.abs(r.constraint_violation).max() < 1e-10
        assert np.abs(r.constraint_rate_violation).max() < 1e-10
        names = ("position", "velocity", "modal_coordinate")
        errors.append([np.abs(getattr(r, name) - getattr(fine, name)).max() for name in names])
    assert np.all(np.abs(np.log2(np.array(errors)[:-1] / errors[1:]) - 2.0) < 0.3)


@pytest.mark.parametrize("integrator", ["radau", "bdf"])
def test_implicit_methods_meet_their_tolerance(folder, integrator):
    record = MACHINES["loop"](folder)
    common = {"duration": 0.05, "output_interval": 0.005}
    fine = reference_run(record, integrator="rk4", step=1e-5, coordinates="absolute", **common)
    r = run(record, integrator=integrator, tolerance=1e-6, **common, **INDEPENDENT)
    assert r.finished.outcome == "done"
    assert np.abs(r.position - fine.position).max() < 10 * 1e-6 * r.prepared.motion.system.size
    assert np.abs(r.constraint_violation).max() < 1e-10


@pytest.mark.parametrize(
    "settings", [{"integrator": "generalised-alpha", "step": 2e-4}, {"integrator": "radau", "tolerance": 1e-6}]
)
def test_implicit_methods_pass_changes_of_the_partition(folder, settings):
    record = double_pendulum(folder, 2)
    common = {"duration": 1.5, "output_interval": 0.05}
    expected = reference_run(record, integrator="rk4", step=1e-4, coordinates="absolute", **common)
    r = run(record, **settings, **common, **INDEPENDENT)
    assert r.finished.timing["partitions"] > 0
    assert np.abs(r.constraint_violation).max() < 1e-10
    assert np.abs(r.position - expected.position).max() < 2e-3


def test_unknown_interfaces_are_told(folder):
    record = MACHINES["pendulum"](folder)
    away = record.replace(joints=(hinge("root", "ground", "a", 0.3),))
    with pytest.raises(ModelError, match="no interface"):
        run(away, **INDEPENDENT)


@pytest.mark.parametrize("rotations", ["euler-parameters", "euler-angles", "rotation-vector"])
def test_lagrange_is_refused_with_what_to_take(folder, rotations):
    record = MACHINES["chain"](folder)
    settings = record.simulation.replace(formulation="lagrange", coordinates="absolute", rotations=rotations)
    words = r"simulation\.formulation.*flexible bodies \(.*\): take `formulation: newton-euler`"
    with pytest.raises(ModelError, match=words):
        prepare(record.replace(simulation=settings), "lagrange", "absolute")
    with pytest.raises(ModelError, match=words):
        plan_run(record.replace(simulation=settings))
