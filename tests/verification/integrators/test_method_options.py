"""Options of methods for single rows: feedback and penalties of a joint, tolerances, independent velocities, and iterations a step."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
import yaml

import machines
import nivel
from nivel.analysis.plan.settings import complete
from nivel.analysis.run.dynamics import march, start_loop
from nivel.errors import ModelError
from nivel.kernels.core.status import OK
from nivel.machine.settings.run import SimulationSettings
from preparing import prepare
from running import Frames, run

# of the slider-crank, all joints apart; others have what all have
ROWS = {"crank_pivot": (3.0, 5.0), "ball": (7.0, 4.0), "ball.s.y": (11.0, 13.0)}
OTHERS = (2.0, 1.5)


def prepared_with(machine, **settings):
    """The machine, prepared and with the feedback of its settings."""
    record = machine.replace(simulation=machine.simulation.replace(**settings))
    asked = complete(record.simulation)
    prepared = prepare(record, asked.formulation, asked.coordinates)
    start_loop(prepared, asked)
    return prepared


def disturbed(prepared, rng):
    """The start with joints that are open, at positions and at velocities."""
    y = prepared.start.copy()
    return y + rng.uniform(-1e-2, 1e-2, len(y))


def wanted(system, pairs=ROWS, others=OTHERS):
    """(K, 2) numbers of each row: of the row itself, or of its joint."""
    out = np.tile(others, (len(system.rows), 1)).astype(float)
    for k, row in enumerate(system.rows):
        for name in sorted(pairs, key=len):
            if row == name or row.startswith(f"{name}."):
                out[k] = pairs[name]
    return out


def feedback_at(prepared, y):
    """C_q v̇ - γ (K,), the violations C and Ċ, and λ, at the state y."""
    motion = prepared.motion
    status, rate = motion.evaluate(0.0, y)
    assert status == OK
    system, constraints = motion.system, motion.system.record.constraints
    first = system.positions
    vdot = rate[first : first + motion.jacobian().shape[1]]
    over = motion.jacobian() @ vdot - constraints.gamma[: len(system.rows)]
    return over, constraints.C.copy(), constraints.Cdot.copy(), constraints.lam.copy()


def joint_names():
    return {row.split(".")[0] for row in prepare(machines.slider_crank()).motion.system.rows}


def test_each_row_is_fed_back_by_its_own_numbers(rng):
    """C̈ + 2 α Ċ + β² C = 0 with the α and β of each row."""
    first, second, *_ = sorted(joint_names())
    pairs = {first: (3.0, 5.0), second: (7.0, 4.0)}
    own = {name: {"alpha": a, "beta": b} for name, (a, b) in pairs.items()}
    prepared = prepared_with(
        machines.slider_crank(), coordinates="absolute", stabilisation="baumgarte",
        baumgarte={"alpha": OTHERS[0], "beta": OTHERS[1], "rows": own},
    )  # fmt: skip
    over, C, Cdot, _ = feedback_at(prepared, disturbed(prepared, rng))
    alpha, beta = wanted(prepared.motion.system, pairs).T
    np.testing.assert_allclose(over, -2.0 * alpha * Cdot - beta**2 * C, rtol=1e-8, atol=1e-9 * np.abs(over).max())


@pytest.mark.parametrize("formulation", ["penalty"])
def test_each_row_has_its_own_penalty(formulation, rng):
    """λ = α (C̈ + 2 Ω μ Ċ + Ω² C) with the α, Ω and μ of each row; a row goes before its joint."""
    system = prepare(machines.slider_crank()).motion.system
    joint = system.rows[0].split(".")[0]
    rows = {joint: {"alpha": 3e8, "omega": 4.0}, system.rows[1]: {"alpha": 5e8, "omega": 6.0, "mu": 0.5}}
    prepared = prepared_with(
        machines.slider_crank(), coordinates="absolute", stabilisation="none", formulation=formulation,
        penalty={"alpha": 1e8, "omega": 2.0, "mu": 2.0, "rows": rows},
    )  # fmt: skip
    over, C, Cdot, lam = feedback_at(prepared, disturbed(prepared, rng))
    alpha, omega, mu = (np.full(len(C), each) for each in (1e8, 2.0, 2.0))
    of_joint = np.array([row.startswith(f"{joint}.") for row in system.rows])
    alpha[of_joint], omega[of_joint] = 3e8, 4.0
    alpha[1], omega[1], mu[1] = 5e8, 6.0, 0.5
    np.testing.assert_allclose(
        lam, alpha * (over + 2 * omega * mu * Cdot + omega**2 * C), rtol=1e-5, atol=1e-6 * np.abs(lam).max()
    )


def test_violations_of_each_row_decay_by_its_own_coefficients(rng):
    """An open start closes as C̈ + 2 α Ċ + β² C = 0 says, each row by itself: roots -α ± √(α² - β²) of what the row has at the start."""
    pairs = {"hinge": (6.0, 9.0), "pin": (25.0, 15.0), "pin.s.y": (4.0, 20.0)}
    settings = {
        "coordinates": "absolute",
        "stabilisation": "baumgarte",
        "duration": 0.5,
        "output_interval": 0.01,
        "integrator": "rk4",
    }
    own = {name: {"alpha": alpha, "beta": beta} for name, (alpha, beta) in pairs.items()}
    feedback = {"alpha": OTHERS[0], "beta": OTHERS[1], "rows": own}
    prepared = prepared_with(machines.slider_crank(), baumgarte=feedback, **settings)
    start = disturbed(prepared, rng)
    prepared.motion.kernels.normalise_state(prepared.motion.handle.address, 0.0, start)
    _, C, Cdot, _ = feedback_at(prepared, start)
    record = machines.slider_crank()
    asked = complete(record.simulation.replace(baumgarte=feedback, step=5e-4, **settings))
    sink = Frames()
    march(replace(prepared, start=start), asked, [sink])
    frames = np.vstack(sink.blocks)
    layout = prepared.motion.system.layout
    (columns,) = (each.columns for each in layout.variables if each.name == "constraint_violation")
    t, violation = frames[:, :1], frames[:, columns]
    alpha, beta = wanted(prepared.motion.system, pairs).T
    root = np.sqrt(alpha**2 - beta**2 + 0j)
    slow, fast = -alpha + root, -alpha - root
    expected = ((Cdot - fast * C) * np.exp(slow * t) - (Cdot - slow * C) * np.exp(fast * t)) / (slow - fast)
    assert np.abs(violation[0]).max() > 1e-3
    np.testing.assert_allclose(violation, expected.real, atol=1e-7)


def test_own_numbers_hold_a_joint_together_where_the_others_drift():
    """The row with the greater β stays nearer to closed, with explicit and implicit methods alike."""
    settings = {
        "duration": 4.0,
        "step": 2e-3,
        "output_interval": 0.05,
        "coordinates": "absolute",
        "stabilisation": "baumgarte",
    }
    base = run(machines.slider_crank(), baumgarte={"alpha": 1, "beta": 1}, **settings)
    system = base.prepared.motion.system
    worst = int(np.argmax(np.abs(base.constraint_violation).max(axis=0)))
    joint = system.rows[worst].split(".")[0]
    held = run(
        machines.slider_crank(),
        baumgarte={"alpha": 1, "beta": 1, "rows": {joint: {"alpha": 40, "beta": 40}}},
        **settings,
    )
    assert np.abs(held.constraint_violation[:, worst]).max() < 0.1 * np.abs(base.constraint_violation[:, worst]).max()


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"stabilisation": "baumgarte", "baumgarte": {"rows": {"pin": {"alpha": 1, "beta": 1}}}},
         "baumgarte.rows.pin: the constraint `pin` is not known"),
        ({"stabilisation": "none", "formulation": "penalty", "penalty": {"rows": {"nobody": {"factor": 1e6}}}},
         "penalty.rows.nobody: the constraint `nobody` is not known"),
        ({"penalty": {"rows": {"pivot": {"factor": 1e6, "alpha": 1e6}}}}, "`penalty.rows.pivot` takes `factor` or `alpha`"),
        ({"stabilisation": "baumgarte", "baumgarte": {"alpha": 3}}, "takes `alpha` and `beta`, both or none"),
        ({"coordinates": "relative", "stabilisation": "baumgarte", "baumgarte": {"rows": {"pivot": {"alpha": 1, "beta": 1}}}},
         "`pivot` is no constraint in relative coordinates"),
        ({"coordinates": "relative", "independent": ["rod.about_z"]}, "`independent` needs `coordinates: independent`; it is `relative`"),
        ({"cut": ["pivot"], "independent": ["rod.about_z"]}, "`independent` and `cut` are for different coordinates"),
        ({"coordinates": "independent", "independent": ["rod.about_q"]}, "the velocity `about_q` is not known"),
        ({"coordinates": "independent", "independent": ["rods.about_z"]}, "the body `rods` is not known"),
        ({"coordinates": "independent", "independent": ["rod.about_z", "rod.x"]}, "2 velocities are named, and the machine has 1 degree"),
        ({"coordinates": "independent", "independent": ["rod.z"]}, "`rod.z` follows from the constraints"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_said(settings, said):
    with pytest.raises(ModelError, match=said):
        pendulum(**settings).simulate(verify=False)


def test_velocities_that_are_named_make_coordinates_independent():
    """Without `coordinates` they had no effect, and nothing said so."""
    machine = pendulum(independent=["rod.about_z"])
    assert machine.simulate(verify=False).settings["coordinates"] == "independent"
    assert machine.simulate(verify=False, coordinates="absolute").settings["coordinates"] == "absolute"


def pendulum(**settings):
    """A rod of 1 m on a pivot, about z."""
    rod = nivel.Body(name="rod", mass=2.0, inertia=(0.01, 0.2, 0.2), position=(0.5, 0.0, 0.0))
    pivot = nivel.Joint(name="pivot", type="revolute", bodies=("ground", "rod"), point=(0, 0, 0), axis=(0, 0, 1))
    given = {"duration": 0.5, "step": 1e-3, "integrator": "rk4", **settings}
    return nivel.Machine("pendulum", gravity=(0, -9.81, 0), bodies=[rod], joints=[pivot]).with_settings(given)


def test_velocities_that_the_user_chooses_are_the_unknowns():
    """The rod's speed along y in place of its angular velocity, which is chosen without; the motion is the same."""
    for name, place in {"rod.y": 1, "rod.about_z": 5, "rod.x": 0}.items():
        chosen = SimulationSettings(coordinates="independent", independent=[name])
        tilted = pendulum().with_values({"bodies.rod.position": [0.3, 0.4, 0.0]}) if name == "rod.x" else pendulum()
        record = tilted.record.replace(simulation=chosen)
        prepared = prepare(record, "newton-euler", "independent")
        assert prepared.motion.system.record.partition.column[-1] == place
    usual = pendulum(coordinates="absolute").simulate(verify=False).array("position")
    for name in ("rod.y", "rod.about_z"):
        found = pendulum(coordinates="independent", independent=[name]).simulate(verify=False)
        np.testing.assert_allclose(found.array("position"), usual, atol=1e-9)


def test_a_dead_point_of_a_chosen_velocity_is_passed_by_another():
    """Where the rod hangs down its speed along y is zero whatever its angular velocity is: the partition is chosen anew."""
    found = pendulum(
        coordinates="independent", independent=["rod.y"], duration=2.0, step=1e-4, output_interval=0.01
    ).simulate(verify=False)
    assert found.timing["partitions"] >= 1
    y = found.array("position")[:, 0, 1]
    assert y.min() == pytest.approx(-0.5, abs=1e-3)
    assert np.abs(found.array("energy_error")).max() < 1e-9


def test_a_coarser_tolerance_takes_fewer_iterations():
    """The augmented Lagrangian leaves C_q v̇ - γ open by its tolerance, not less."""
    left, iterations = {}, {}
    for tolerance in (1e-2, 1e-6, 1e-12):
        prepared = prepared_with(
            machines.slider_crank(), coordinates="absolute", formulation="augmented-lagrangian",
            penalty={"factor": 30.0, "tolerance": tolerance, "iterations": 1000},
        )  # fmt: skip
        over, *_ = feedback_at(prepared, prepared.start)
        left[tolerance] = np.abs(over).max()
        iterations[tolerance] = int(prepared.motion.system.record.control.iterations[1])
    assert left[1e-2] > 10 * left[1e-6] > 100 * left[1e-12]
    assert 0 < iterations[1e-2] < iterations[1e-6] < iterations[1e-12]


def test_iterations_of_every_step_are_in_the_result(tmp_path):
    """Gear's corrector in steps of 10 ms: the sum is the count of the run, and a single step iterates as often as it is told to."""
    machine = pendulum(integrator="gear4", step=1e-2, output_interval=1e-2, duration=1.0)
    result = machine.simulate(out=tmp_path / "run.nc", verify=False)
    found = nivel.Result.open(tmp_path / "run.nc").iterations
    assert found.steps.sum() == result.timing["steps"] == 100
    assert found.total.sum() == result.timing["iterations"]
    np.testing.assert_array_equal(found.steps, 1.0)  # so each is that of a step, as in figure 23 of report 44
    np.testing.assert_array_equal(found.most, found.total)
    mean, most = found.at(result.time)
    np.testing.assert_array_equal(mean[1:], found.total)
    np.testing.assert_array_equal(mean[1:], most[1:])
    assert math.isnan(mean[0])
    assert pendulum().simulate(verify=False).iterations is None
    assert "Iterations per step" in result.report(tmp_path / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("settings", "key"),
    [
        ({"integrator": "dopri5", "stabilisation": "baumgarte"}, "baumgarte"),
        ({"integrator": "ros2", "stabilisation": "baumgarte"}, "baumgarte"),
        ({"integrator": "dopri5", "stabilisation": "none", "formulation": "penalty"}, "penalty"),
    ],
)
def test_the_line_that_is_proposed_is_taken(settings, key):
    """Coefficients that depend on the step are asked for where steps are chosen, by a line with units."""
    given = {**settings, "coordinates": "absolute", "duration": 0.01}
    with pytest.raises(ModelError, match=rf"`{key}: ") as caught:
        pendulum(**given).simulate(verify=False)
    line = re.search(rf"`({key}: \{{.*?\}})`", str(caught.value))[1]
    assert pendulum(**given, **yaml.safe_load(line)).simulate(verify=False).outcome == "done"
