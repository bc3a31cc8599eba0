"""Coordinate partitioning: B spans the motions that the constraints allow, the equations are those of the other coordinates, and
no partition can be told from another by its results."""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import machines
import nivel
from assembled import TIME, mass_matrix, random_states
from example_files import RIGID, rigid_example
from nivel.analysis.assembly.equations import change_between, moved
from nivel.analysis.plan.settings import complete
from nivel.analysis.run.dynamics import march
from nivel.errors import ModelError, SolveError
from nivel.files.reader import parse_machine
from nivel.integrate.catalogue import INTEGRATORS
from nivel.kernels.core.status import OK
from preparing import prepare
from running import Frames, run
from simulating import simulate

pytestmark = pytest.mark.covering

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
MACHINES = {
    "slider-crank": machines.slider_crank,
    "four-bar": machines.four_bar,
    "four-bar of revolutes": lambda: machines.four_bar("revolute", "revolute"),
    "heavy-top": machines.heavy_top,
    "tree": lambda: machines.tree(np.random.default_rng(5)),
    **{kind: (lambda kind=kind: machines.pair(kind, np.random.default_rng(7))) for kind in machines.BETWEEN_BODIES},
    **{path.name: (lambda path=path: nivel.load(path, allow_code=True).record) for path in RIGID},
}
EACH = pytest.mark.parametrize("name", MACHINES)


def solved(motion, y):
    """(ẏ, λ) at y."""
    status, rate = motion.evaluate(TIME, y)
    assert status == OK
    return rate, motion.system.record.constraints.lam.copy()


@EACH
def test_accelerations_and_multipliers_are_those_of_absolute_coordinates(name, rng):
    prepared = prepare(MACHINES[name](), "newton-euler", "independent")
    for y in random_states(prepared, rng):
        rate, lam = solved(prepared.absolute, y)
        own_rate, own_lam = solved(prepared.motion, y)
        np.testing.assert_allclose(own_rate, rate, atol=1e-9 * (1 + np.abs(rate).max()))
        np.testing.assert_allclose(own_lam, lam, atol=1e-9 * (1 + np.abs(lam).max(initial=0)))


@EACH
def test_b_spans_the_null_space_of_the_jacobian(name, rng):
    """C_q B = 0 with as many columns as there are freedoms, and the identity in the independent rows: full rank."""
    prepared = prepare(MACHINES[name](), "newton-euler", "independent")
    system = prepared.motion.system
    if system.frictions:
        pytest.skip("frictions are evaluated in absolute coordinates")
    partition, rank = system.record.partition, int(system.record.control.rank[0])
    for y in random_states(prepared, rng):
        solved(prepared.motion, y)
        B = partition.B.T
        assert B.shape == (6 * system.body_count, 6 * system.body_count - rank)
        np.testing.assert_array_equal(B[partition.column[rank:]], np.eye(B.shape[1]))
        if B.shape[1] and len(system.rows):
            # lengths in units of the machine's length
            J, scaled = prepared.motion.jacobian() * partition.unit, B / partition.unit[:, None]
            scaled *= partition.unit[partition.column[rank:]]
            np.testing.assert_allclose(J @ scaled, 0, atol=1e-12 * np.abs(J).max() * np.abs(scaled).max())


@EACH
def test_reduced_mass_matrix_is_that_of_the_kinetic_energy(name, rng):
    """∂²T/∂u² = Bᵀ M B for v = B u, symmetric and positive definite; the kernel keeps its Cholesky factor."""
    prepared = prepare(MACHINES[name](), "newton-euler", "independent")
    if prepared.motion.system.frictions:
        pytest.skip("frictions are evaluated in absolute coordinates")
    partition = prepared.motion.system.record.partition
    for y in random_states(prepared, rng):
        solved(prepared.motion, y)
        expected = partition.B @ mass_matrix(prepared.motion.system) @ partition.B.T
        L = np.tril(partition.H)
        np.testing.assert_allclose(L @ L.T, expected, rtol=1e-10, atol=1e-12 * np.abs(expected).max(initial=1))
        assert np.all(np.diag(L) > 0.0)


@pytest.mark.parametrize("name", ["slider-crank", "four-bar", "four-bar of revolutes", "tree"])
def test_no_partition_can_be_told_from_another(name, rng):
    """Every column that moves with the chosen independent one may take its place: same accelerations, same multipliers."""
    prepared = prepare(MACHINES[name](), "newton-euler", "independent")
    partition, rank = prepared.motion.system.record.partition, int(prepared.motion.system.record.control.rank[0])
    y = next(random_states(prepared, rng))
    rate, lam = solved(prepared.motion, y)
    chosen, B, unit = partition.column.copy(), partition.B.copy(), partition.unit
    tried = 0
    for k in range(rank):
        share = B[0, chosen[k]] * unit[chosen[rank]] / unit[chosen[k]]
        if not 0.2 < abs(share) < 5.0:
            continue
        partition.column[:] = chosen
        partition.column[[k, rank]] = chosen[[rank, k]]
        other_rate, other_lam = solved(prepared.motion, y)
        assert partition.choices[0] == 1
        assert partition.column[rank] == chosen[k]
        np.testing.assert_allclose(other_rate, rate, atol=1e-10 * np.abs(rate).max())
        np.testing.assert_allclose(other_lam, lam, atol=1e-10 * np.abs(lam).max())
        tried += 1
    assert tried > 0


@EACH
def test_dependent_coordinates_are_solved_and_independent_ones_stay(name, rng):
    prepared = prepare(MACHINES[name](), "newton-euler", "independent")
    motion, system = prepared.motion, prepared.motion.system
    partition, rank = system.record.partition, int(system.record.control.rank[0])
    constraints, nq = system.record.constraints, system.positions
    for y in random_states(prepared, rng, 1):
        motion.evaluate(TIME, y)
        off = y.copy()
        change = 1e-4 * rng.standard_normal(6 * system.body_count) * partition.unit
        off[:nq] = moved(y[:nq], change)
        off[nq : nq + len(change)] += 1e-3 * rng.standard_normal(len(change)) * partition.unit
        kept = off.copy()
        assert motion.kernels.normalise_state(motion.handle.address, TIME, kept) == OK
        motion.evaluate(TIME, kept)
        assert np.all(np.abs(constraints.C) <= 2e-12 * constraints.scale)  # rows left out are closed as the start is
        speed = np.abs(kept[nq : nq + len(change)]).max() + 1
        assert np.all(np.abs(constraints.Cdot) <= 1e-12 * speed * constraints.scale)
        free = partition.column[rank:].astype(int)
        np.testing.assert_array_equal(kept[nq + free], off[nq + free])
        # several tangent steps; their turns commute but for the square of the change
        moves = change_between(off[:nq], kept[:nq]).ravel() / partition.unit
        np.testing.assert_allclose(moves[free], 0, atol=1e-5 * np.abs(moves).max(initial=0) + 1e-12)


def make_independent(prepared, y, body, component):
    """Choose at y, then put one velocity (0 … 5 of a body) in the place of the independent one."""
    motion = prepared.motion
    motion.evaluate(0.0, y)
    column = motion.system.record.partition.column
    place = int(np.flatnonzero(column == 6 * motion.system.bodies.index(body) + component)[0])
    column[[place, -1]] = column[[-1, place]]


def marched(prepared, y, step, count):
    """States of `count` RK4 steps from y, written here (Kutta's formula), each then normalised; rates and multipliers at them;
    partitions counted until then."""
    motion, y = prepared.motion, y.copy()
    record = motion.system.record
    states, rates, partitions = [], [], []
    for _ in range(count):
        k1 = motion.evaluate(0.0, y)[1]
        states.append(y.copy())
        rates.append(np.concatenate([k1, record.constraints.lam]))
        partitions.append(int(record.partition.choices[0]))
        k2 = motion.evaluate(0.0, y + step / 2 * k1)[1]
        k3 = motion.evaluate(0.0, y + step / 2 * k2)[1]
        k4 = motion.evaluate(0.0, y + step * k3)[1]
        y += step / 6 * (k1 + 2 * (k2 + k3) + k4)
        assert motion.kernels.normalise_state(motion.handle.address, 0.0, y) == OK
    return np.array(states), np.array(rates), np.array(partitions)


@pytest.mark.parametrize(
    ("machine", "body", "component", "steps"),
    # the rod turns back where the crank's pin is at its side, the rocker where crank and coupler are in line
    [(machines.slider_crank, "rod", 5, 1900), (machines.four_bar, "rocker", 5, 2700)],
)
def test_partition_changes_in_a_full_turn_without_a_jump(machine, body, component, steps):
    """A choice that will fail on the way is given up in time: states, accelerations and multipliers stay those of a run that keeps the
    crank's angle, but for the error of the method, which falls with its order."""
    differences = []
    for halvings in range(2):
        reference, other = (prepare(machine(), "newton-euler", "independent") for _ in range(2))
        step = 1e-3 / 2**halvings
        a, rates_a, partitions_a = marched(reference, reference.start, step, steps * 2**halvings)
        make_independent(other, other.start, body, component)
        b, rates_b, partitions_b = marched(other, other.start, step, steps * 2**halvings)
        turn = a[:, 3:7] @ a[0, 3:7]  # cosine of half the angle that the crank has turned
        assert turn.min() < -0.9999
        assert np.all(partitions_a == 1)
        assert partitions_b[50] == 1
        assert partitions_b[-1] > 1
        errors = [np.abs(x - y).max() / np.abs(x).max() for x, y in ((a, b), (rates_a, rates_b))]
        differences.append(max(errors))
    assert differences[0] < 1e-5
    assert differences[1] < differences[0] / 8


def triple_rocker():
    """Four bars of which none turns round (0.8 + 1.5 > 1.0 + 1.1): each of them stands still somewhere while the others move."""
    a, d = np.array([0.0, -1.0, 0.0]), np.array([1.5, 0.0, 0.0])
    # coupler of 0.8 and right bar of 1.1 from the tip of the left bar and the right pivot
    gap = d - a
    length = np.linalg.norm(gap)
    along = (0.8**2 - 1.1**2 + length**2) / (2 * length)
    tip = a + along / length * gap + np.sqrt(0.8**2 - along**2) / length * np.array([gap[1], -gap[0], 0.0])

    def bar(p, q):
        return {
            "shape": {"type": "box", "from": list(p), "to": list(q), "width": 0.05, "height": 0.05},
            "density": 1000,
        }

    hinge = {"type": "revolute", "axis": [0, 0, 1]}
    return {
        "gravity": [0, -9.81, 0],
        "bodies": {"left": bar((0, 0, 0), a), "coupler": bar(a, tip), "right": bar(d, tip)},
        "joints": {
            "first": {**hinge, "bodies": ["ground", "left"], "point": [0, 0, 0], "start_rates": {"angle": 9.0}},
            "near": {"type": "spherical", "bodies": ["left", "coupler"], "point": list(a)},
            "far": {"type": "cylindrical", "bodies": ["coupler", "right"], "point": list(tip), "axis": [0, 0, 1]},
            "last": {**hinge, "bodies": ["ground", "right"], "point": list(d)},
        },
    }


def test_rockers_change_the_partition_by_themselves_and_keep_their_energy():
    runs = {c: simulate(triple_rocker(), duration=2.0, step=2e-4, coordinates=c) for c in ("absolute", "independent")}
    a, b = runs["absolute"], runs["independent"]
    assert b.timing["partitions"] > 0
    assert a.timing["partitions"] == 0
    for name in ("position", "velocity", "acceleration", "joint_force"):
        scale = np.abs(a.array(name)).max()
        np.testing.assert_allclose(b.array(name), a.array(name), atol=1e-6 * scale)
    assert np.abs(b.array("energy_error")).max() < 1e-7 * np.abs(b.array("kinetic_energy")).max()


@pytest.mark.parametrize("stabilisation", ["none", "direct", "geometric"])
@pytest.mark.parametrize("integrator", [name for name, facts in INTEGRATORS.items() if not facts.residual])
def test_constraints_hold_to_round_off_in_every_frame(integrator, stabilisation):
    r = run(
        machines.slider_crank(), duration=0.5, step=1e-3, integrator=integrator,
        coordinates="independent", stabilisation=stabilisation,
    )  # fmt: skip
    assert r.finished.outcome == "done"
    scale = r.prepared.motion.system.record.constraints.scale
    assert np.all(np.abs(r.constraint_violation) <= 1e-12 * scale)
    speed = max(1.0, np.abs(r.velocity).max(), np.abs(r.angular_velocity).max())
    assert np.all(np.abs(r.constraint_rate_violation) <= 1e-12 * speed * scale)


@pytest.mark.parametrize(
    ("machine", "step"), [(machines.slider_crank, 4e-3), (machines.four_bar, 4e-3), (machines.heavy_top, 1e-3)]
)
def test_rk4_converges_with_order_four(machine, step):
    def end(step):
        r = run(machine(), duration=0.4, step=step, coordinates="independent", stabilisation="none")
        return np.concatenate([r.position[-1], r.orientation[-1], r.velocity[-1], r.angular_velocity[-1]], axis=None)

    values = [end(step / 2**halvings) for halvings in range(4)]
    differences = [np.abs(a - b).max() for a, b in pairwise(values)]
    slopes = np.log2(np.array(differences[:-1]) / differences[1:])
    assert np.all(slopes > 3.7)


@pytest.mark.parametrize("name", ["rssr", "watt-six-bar", "cam"])
def test_drivers_are_followed_exactly(name):
    """Time-dependent constraints: positions, velocities and reactions are those of absolute coordinates."""
    machine = nivel.load(rigid_example(name), allow_code=True)
    a, b = (machine.simulate(coordinates=c) for c in ("absolute", "independent"))
    for variable in ("position", "velocity", "acceleration", "joint_force"):
        scale = np.abs(a.array(variable)).max()
        np.testing.assert_allclose(b.array(variable), a.array(variable), atol=1e-8 * scale)
    assert b.timing["partitions"] == 0


def test_redundant_machine_has_the_reactions_of_absolute_coordinates():
    """Three rows too many: the motion, the unique reactions, and the least ones of those that are not unique."""
    machine = nivel.load(EXAMPLES / "mechanisms" / "four-bar-revolutes.yaml")
    a, b = (machine.simulate(coordinates=c, duration=0.3) for c in ("absolute", "independent"))
    assert len(b.trust.redundant_rows) == 3
    for variable in ("position", "velocity", "acceleration", "joint_force", "joint_torque"):
        scale = np.abs(a.array(variable)).max()
        np.testing.assert_allclose(b.array(variable), a.array(variable), atol=1e-7 * scale)


def test_friction_is_that_of_absolute_coordinates():
    machine = nivel.load(EXAMPLES / "contact" / "friction-brake.yaml")
    a, b = (machine.simulate(coordinates=c, duration=0.5) for c in ("absolute", "independent"))
    np.testing.assert_allclose(b.array("position"), a.array("position"), atol=1e-9)
    np.testing.assert_allclose(b.array("dissipated_energy"), a.array("dissipated_energy"), atol=1e-9, rtol=1e-9)


def test_result_is_bit_identical_for_every_chunk_length():
    settings = {"duration": 0.3, "coordinates": "independent"}
    frames = [run(machines.slider_crank(), chunk_steps=k, **settings).frames for k in (1, 7, None)]
    np.testing.assert_array_equal(frames[0], frames[1])
    np.testing.assert_array_equal(frames[0], frames[2])


def test_second_run_of_the_same_numbers_chooses_again():
    machine = parse_machine(json.dumps({"format": 1, **triple_rocker()}))
    settings = complete(machine.simulation.replace(coordinates="independent"))
    prepared = prepare(machine, "newton-euler", "independent")
    sinks = [Frames(), Frames()]
    finished = [march(prepared, settings, [sink]) for sink in sinks]
    assert finished[0].timing["partitions"] == finished[1].timing["partitions"] > 0
    np.testing.assert_array_equal(np.vstack(sinks[0].blocks), np.vstack(sinks[1].blocks))


@pytest.mark.parametrize(
    "settings",
    [
        {"stabilisation": "baumgarte"},
        {"formulation": "penalty"},
        {"formulation": "augmented-lagrangian"},
    ],
)
def test_methods_that_feed_violations_back_are_refused_with_the_reason(settings):
    with pytest.raises(ModelError, match="independent"):
        run(machines.slider_crank(), coordinates="independent", **settings)


def test_step_to_where_the_machine_cannot_be_is_named():
    """A step so long that the crank's pin leaves the reach of the rod."""
    with pytest.raises(SolveError, match="position that the machine does not have") as caught:
        simulate(triple_rocker(), duration=2.0, step=0.2, coordinates="independent", integrator="rk4")
    assert "too large" in caught.value.advice
