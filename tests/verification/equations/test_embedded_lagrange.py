"""Embedding of the Lagrange equations (report 44, eqs. 78–89): independent rates of (R, θ), of which the normalisation is a constraint."""

import numpy as np
import pytest

import machines
import nivel
from assembled import TIME, random_states
from lanes import tail
from nivel.errors import ModelError
from nivel.kernels.core.status import OK
from nivel.system.elimination.partition import PARAMETERS, velocities_named
from preparing import prepare
from running import run
from simulating import hinge, simulate, solid
from test_independent import MACHINES

EACH = pytest.mark.parametrize(
    "name", tail(MACHINES, ["slider-crank", "four-bar", "four-bar of revolutes", "heavy-top", "tree"])
)


def states(name, rng, count=3):
    """(equations by multipliers, by embedding, y of both) at assembled states of a machine."""
    machine = MACHINES[name]()
    machine = machine.with_simulation(machine.simulation.replace(integrator="rk4"))
    given = prepare(machine, "newton-euler", "absolute")
    whole, embedded = (prepare(machine, "lagrange", coordinates) for coordinates in ("absolute", "independent"))
    system, first = given.absolute.system, given.absolute.system.positions
    for y in random_states(given, rng, count):
        v = y[first : first + 6 * system.body_count].reshape(-1, 6)
        start = whole.motion.system.state(y[:first], v[:, :3], v[:, 3:])
        start[14 * system.body_count :] = y[13 * system.body_count :]
        yield whole.motion, embedded.motion, start


@EACH
def test_accelerations_and_multipliers_are_those_with_multipliers(name, rng):
    for whole, embedded, y in states(name, rng):
        (status, rate), (other, own) = whole.evaluate(TIME, y), embedded.evaluate(TIME, y)
        assert (status, other) == (OK, OK)
        lam, found = (each.system.record.constraints.lam for each in (whole, embedded))
        np.testing.assert_allclose(own, rate, atol=1e-9 * (1 + np.abs(rate).max()))
        np.testing.assert_allclose(found, lam, atol=1e-9 * (1 + np.abs(lam).max(initial=0)))


@EACH
def test_rates_by_b_keep_all_constraints(name, rng):
    """Ċ is affine in q̇: that of B u is that of rest, for as many u as there are freedoms; B has the identity in the independent rows."""
    for _, motion, y in states(name, rng, 1):
        system = motion.system
        if system.frictions:
            pytest.skip("frictions are evaluated by multipliers")
        motion.evaluate(TIME, y)
        partition, rank, first = system.record.partition, int(system.record.control.rank[0]), 7 * system.body_count
        B, column = partition.B.copy(), partition.column[rank:].astype(int)
        assert B.shape == (7 * system.body_count - rank, 7 * system.body_count)
        np.testing.assert_array_equal(B[:, column], np.eye(len(B)))
        rates = []
        for u in (np.zeros(len(B)), rng.uniform(-1, 1, len(B)) / partition.unit[column]):
            y[first : 2 * first] = u @ B
            motion.evaluate(TIME, y)
            rates.append(system.record.constraints.Cdot / system.record.constraints.scale)
        np.testing.assert_allclose(rates[1], rates[0], atol=1e-9 * (1 + np.abs(u @ B).max()))


@EACH
def test_dependent_coordinates_are_solved_and_independent_ones_stay(name, rng):
    for _, motion, y in states(name, rng, 1):
        system, count = motion.system, 7 * motion.system.body_count
        motion.evaluate(TIME, y)
        off = y.copy()
        off[:count] += 1e-4 * rng.standard_normal(count) * system.record.partition.unit
        off[count : 2 * count] += 1e-3 * rng.standard_normal(count) * system.record.partition.unit
        kept = off.copy()
        assert motion.kernels.normalise_state(motion.handle.address, TIME, kept) == OK
        motion.evaluate(TIME, kept)
        constraints, rank = system.record.constraints, int(system.record.control.rank[0])
        assert np.all(np.abs(constraints.C) <= 2e-12 * constraints.scale)
        assert np.all(np.abs(constraints.Cdot) <= 1e-12 * (np.abs(kept[count:]).max() + 1) * constraints.scale)
        free = system.record.partition.column[rank:].astype(int)
        np.testing.assert_array_equal(kept[count + free], off[count + free])
        np.testing.assert_array_equal(kept[free], off[free])


def simulated(record, **settings):
    return nivel.Machine.from_record(record).simulate(verify=False, **settings)


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (machines.slider_crank, "crank.theta_1"),
        (machines.slider_crank, "rod.theta_3"),
        (machines.four_bar, "crank.theta_3"),
        (machines.four_bar, "coupler.theta_3"),
    ],
)
def test_machines_of_the_report_turn_round_with_chosen_coordinates(make, named):
    """Past positions in which what was chosen stands still, and others take its place; a run by multipliers with an eighth of the step
    is the reference, and the error falls with the order of RK4."""
    common = {"formulation": "lagrange", "integrator": "rk4", "duration": 2.8, "output_interval": 0.02}
    reference = simulated(make(), step=5e-4, **common, coordinates="absolute").array("position")
    errors = []
    for step in (4e-3, 2e-3):
        r = simulated(
            make(), step=step, **common, coordinates="independent", independent=(named,), stabilisation="none"
        )
        assert float(np.abs(r.array("constraint_violation")).max()) < 1e-11
        errors.append(float(np.abs(r.array("position") - reference).max()))
    assert r.timing["partitions"] > 0 or named == "crank.theta_3"
    assert errors[1] < errors[0] / 8
    assert errors[1] < 2e-4


def test_what_cannot_be_is_refused_in_words():
    lagrange = {"formulation": "lagrange", "coordinates": "independent"}
    with pytest.raises(ModelError, match=r"rod\.about_z"):
        run(machines.slider_crank(), **lagrange, independent=("rod.about_z",), integrator="rk4")
    with pytest.raises(ModelError, match="needs a residual"):
        run(machines.slider_crank(), **lagrange, integrator="radau")
    assert velocities_named(("b.theta_0",), ("a", "b"), PARAMETERS) == [10]


def test_friction_is_that_with_multipliers():
    """A wheel that dry friction stops."""
    sections = {
        "bodies": {"wheel": solid(1.0, 0.5)},
        "joints": {"axle": {**hinge("ground", "wheel"), "start_rates": {"angle": 4.0}}},
        "forces": {"brake": {"type": "brake", "coordinate": "axle", "capacity": 2.0}},
    }
    r = simulate(sections, formulation="lagrange", coordinates="independent", integrator="rk4", step=1e-3, duration=1.5)
    assert r.array("axle.angle")[-1] == pytest.approx(4.0**2 / (2 * 2.0 / 0.5), abs=1e-5)  # 2 a τ² with τ of a step
