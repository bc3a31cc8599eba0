"""Newton's iteration of newmark, hht and generalised-alpha: when its matrix is made anew, and where round-off ends it."""

import numpy as np
import pytest

import machines
from nivel import Body, Joint, MachineRecord, PointForce, SimulationSettings
from nivel.errors import ModelError
from running import run

INTEGRATORS = pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha"])


def iterations_a_step(matrix, tolerance):
    r = run(
        machines.slider_crank(), integrator="generalised-alpha", stabilisation="none", coordinates="relative", step=1e-2, duration=2.0,
        corrector={"matrix": matrix, "tolerance": tolerance},
    )  # fmt: skip
    assert r.finished.outcome == "done"
    return r.finished.timing["iterations"] / r.finished.timing["steps"]


def test_with_a_new_matrix_every_time_digits_double():
    """Twice as many digits take at most one iteration more; with a contraction they would take as many again."""
    few, twice, four_times = (iterations_a_step("full", tolerance) for tolerance in (1e-3, 1e-6, 1e-12))
    assert twice <= few + 1.0
    assert four_times <= twice + 1.0
    assert iterations_a_step("kept", 1e-12) > 1.5 * iterations_a_step("full", 1e-12)


@pytest.mark.parametrize("stabilisation", ["direct", "none"])
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@INTEGRATORS
def test_both_policies_find_the_same_motion(integrator, coordinates, stabilisation):
    if integrator == "newmark" and stabilisation == "none":
        pytest.skip("refused: undamped")
    settings = {"integrator": integrator, "coordinates": coordinates, "stabilisation": stabilisation}
    kept, full = (
        run(machines.four_bar(), step=2e-3, duration=0.5, corrector={"matrix": matrix}, **settings)
        for matrix in ("kept", "full")
    )
    size = kept.prepared.motion.system.size
    # as stabilised index 2 positions are closed along the columns of the matrix that there is: another direction of a small correction
    assert np.abs(kept.position - full.position).max() < (1e-7 if stabilisation == "none" else 1e-5) * size
    timing = full.finished.timing
    assert timing["factorisations"] == timing["iterations"]
    assert timing["factorisations"] > 3 * kept.finished.timing["factorisations"]
    assert timing["iterations"] <= kept.finished.timing["iterations"]


@pytest.mark.parametrize(
    ("integrator", "why"),
    [
        ("bdf", "chooses steps"),
        ("radau", "chooses steps"),
        ("gear", "chooses steps"),
        ("ros2", "does not iterate"),
        ("am3", "by differences"),
        ("gear2", "by differences"),
    ],
)
def test_a_new_matrix_every_time_is_refused_where_the_method_has_its_own_policy(integrator, why):
    with pytest.raises(ModelError, match=why) as caught:
        run(machines.four_bar(), integrator=integrator, corrector={"matrix": "full"})
    assert caught.value.faults[0].path == "simulation.corrector.matrix"


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("tolerance", [1e-10, 1e-13])
def test_index_three_ends_at_the_round_off_of_its_constraints(coordinates, tolerance):
    """The crank makes thirty turns: velocities follow from positions over a step, and those are known to some 1e-14. The whole motion is
    that of a tolerance which is always reached, and constraints hold to round-off."""
    settings = {
        "integrator": "generalised-alpha", "stabilisation": "none", "coordinates": coordinates, "step": 1e-3,
        "output_interval": 0.1,
    }  # fmt: skip
    r = run(machines.slider_crank(), corrector={"tolerance": tolerance}, **settings)
    assert r.finished.outcome == "done"
    assert np.abs(r.constraint_violation).max() < 1e-11
    reached = run(machines.slider_crank(), corrector={"tolerance": 1e-9}, **settings)
    assert np.abs(r.position - reached.position).max() < 1e-4


def rough(amplitude, per_metre):
    """A weight on a string, with a force that is rough far below its tolerance: its Newton iteration has nowhere to go."""
    return MachineRecord(
        name="rough",
        gravity=(0.0, -9.81, 0.0),
        bodies=(Body(name="bob", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(0.5, 0.0, 0.0)),),
        joints=(Joint(name="pin", type="revolute", bodies=("ground", "bob"), point=(0, 0, 0), axis=(0, 0, 1)),),
        forces=(
            PointForce(name="hash", body="bob", vector=(f"{amplitude}*sin({per_metre}*sin(pin.angle))", 0.0, 0.0)),
        ),
        simulation=SimulationSettings(duration=1.0, step=1e-3, integrator="generalised-alpha", stabilisation="none"),
    )


def test_what_round_off_of_the_constraints_does_not_explain_is_not_accepted():
    r = run(rough(1.0, 1e9), coordinates="absolute")
    assert r.finished.outcome == "failed"


@pytest.mark.parametrize("most", [1, 2])
def test_too_few_iterations_are_no_solution(most):
    r = run(
        machines.slider_crank(), integrator="generalised-alpha", stabilisation="none", step=5e-3,
        corrector={"most_iterations": most, "tolerance": 1e-13},
    )  # fmt: skip
    assert r.finished.outcome == "failed"
