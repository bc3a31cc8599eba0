"""Implicit methods with exact tangents in the Lagrange equations: the unknowns are accelerations of rotation coordinates, which move as
plain positions, and the motion is that of the Newton–Euler equations. Every element: `test_residual_and_tangent`."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import machines
from assembled import TIME, random_states
from lanes import tail
from nivel.analysis.assembly.implicit import find_tangent
from nivel.errors import ModelError
from nivel.kernels.core.status import OK
from preparing import prepare
from references import heavy_top, slider_crank
from running import reference_run, run
from stiff_machines import elastic_crank, rigid_crank
from test_alpha import SECOND_ORDER, errors_against_fine
from test_driver_corners import RAMPS, cart_and_arm, swing
from unknowns import ROTATIONS, at_state, explicit, value_at

pytestmark = pytest.mark.covering

EACH = pytest.mark.parametrize("rotations", ROTATIONS)
FIXED = ("newmark", "hht", "generalised-alpha", "ros2")
# a rotation vector carries no full turn: the crank makes one in 1.66 s, the top in 0.04 s
LASTING = pytest.mark.parametrize("rotations", ["euler-parameters", "euler-angles"])
STEPS = {name: [4e-3, 2e-3, 1e-3] for name in FIXED}


def lagrange(rotations):
    return {"formulation": "lagrange", "rotations": rotations, "coordinates": "absolute"}


def orientations(r):
    return Rotation.from_quat(r.orientation[:, 0], scalar_first=True).as_matrix()


@EACH
@pytest.mark.parametrize(
    "make", [machines.slider_crank, machines.four_bar, machines.heavy_top, lambda: machines.tree(np.random.default_rng(5))]
)  # fmt: skip
def test_accelerations_and_reactions_at_equal_states_are_those_of_newton_euler(make, rotations, rng):
    """The residual is linear in them: [M, C_qᵀ; C_q, 0] is solved for what it lacks at rest."""
    record = make()
    record = record.replace(
        simulation=record.simulation.replace(integrator="generalised-alpha", coordinates="absolute")
    )
    prepared = prepare(record)
    for y in random_states(prepared, rng, 3):
        here = at_state(record, prepared, rotations, y, rng)
        own = here.motion.system.record.residual
        r, _, _, _, gamma = value_at(here, here.y, np.zeros(here.n), np.zeros(here.rows))
        _, matrix = find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)
        x = np.linalg.solve(matrix, -np.concatenate([r, gamma]))
        value_at(here, here.y, x[: here.n], x[here.n :])
        lam = dict(zip((here.motion.system.rows[k] for k in own.row), own.lam, strict=True))
        expected = prepared.absolute
        assert expected.evaluate(TIME, y)[0] == OK
        bodies, system = expected.system.record.bodies, expected.system
        count = system.body_count
        alpha = np.einsum("bij,bj->bi", bodies.A[:count], bodies.alpha_b[:count])
        wanted = np.hstack([alpha, bodies.Rddot[:count]])
        np.testing.assert_allclose(own.acceleration[:count], wanted, rtol=0, atol=1e-9 * np.abs(wanted).max())
        forces = system.record.constraints.lam
        found = [lam.pop(name) for name in system.rows]
        np.testing.assert_allclose(found, forces, rtol=0, atol=1e-9 * np.abs(forces).max(initial=1.0))
        # of the normalisation, which does nothing
        assert all(abs(each) <= 1e-9 * np.abs(forces).max(initial=1.0) for each in lam.values())


def test_parameters_off_the_unit_sphere_are_the_same_motion(rng):
    """A is taken of θ/|θ|: a longer θ that gets longer still needs the accelerations that the explicit evaluation finds."""
    record = machines.four_bar(integrator="generalised-alpha", coordinates="absolute")
    prepared = prepare(record)
    y = next(random_states(prepared, rng, 1))
    here = at_state(record, prepared, "euler-parameters", y, rng)
    longer, v = here.y.copy(), here.positions
    for b in range(here.motion.system.body_count):
        theta, rate = longer[7 * b + 3 : 7 * b + 7], longer[v + 7 * b + 3 : v + 7 * b + 7]
        rate[:] = 1.3 * rate + 0.4 * theta
        theta *= 1.3
    found = explicit(here.motion, longer, here.positions, here.states)
    r, _, _, _, Cddot = value_at(here, longer, found["vdot"], found["lam"])
    assert np.abs(r).max() < 1e-12 * np.abs(found["lam"]).max()
    assert np.abs(Cddot).max() < 1e-11 * np.abs(found["vdot"]).max()


@EACH
@pytest.mark.parametrize("integrator", FIXED)
def test_order_two_in_positions_velocities_and_multipliers(integrator, rotations):
    found = errors_against_fine(
        machines.slider_crank(), integrator, STEPS[integrator], **lagrange(rotations), **SECOND_ORDER.get(integrator, {})
    )  # fmt: skip
    assert np.all(np.abs(np.log2(found[:-1] / found[1:]) - 2.0) < 0.2)


@EACH
@pytest.mark.parametrize("stabilisation", ["none", "baumgarte", "geometric"])
@pytest.mark.parametrize("integrator", ["hht", "generalised-alpha"])
def test_order_two_at_least_with_every_stabilisation(integrator, stabilisation, rotations):
    """As index 3, as index 1 with the feedback, and as stabilised index 2 with the energy."""
    settings = {"stabilisation": stabilisation, **lagrange(rotations), **SECOND_ORDER[integrator]}
    if stabilisation == "baumgarte":
        settings["baumgarte"] = {"alpha": 100.0, "beta": 100.0}
    found = errors_against_fine(machines.four_bar(), integrator, STEPS[integrator], **settings)
    assert np.all(np.log2(found[:-1] / found[1:]) > 1.75)


@EACH
def test_the_motion_converges_to_that_of_newton_euler(rotations):
    differences = []
    for step in (4e-3, 2e-3, 1e-3):
        common = {"integrator": "generalised-alpha", "step": step, "duration": 0.4, "output_interval": 0.02}
        a = run(machines.slider_crank(), coordinates="absolute", **common)
        b = run(machines.slider_crank(), **common, **lagrange(rotations))
        differences.append(np.abs(a.position - b.position).max())
    assert np.all(np.log2(np.array(differences[:-1]) / differences[1:]) > 1.8)
    assert differences[-1] < 4e-7


@LASTING
@pytest.mark.parametrize("make", [machines.slider_crank, machines.four_bar])
def test_positions_velocities_and_the_normalisation_hold_at_every_step(make, rotations):
    """Rows of the normalisation, |θ|² - 1 and its rate, are among them."""
    r = run(make(), integrator="generalised-alpha", step=1e-3, **lagrange(rotations))
    assert r.finished.outcome == "done"
    assert any("euler_parameters" in row for row in r.prepared.motion.system.rows) == (rotations == "euler-parameters")
    assert np.abs(r.constraint_violation).max() <= 1e-9
    assert np.abs(r.constraint_rate_violation).max() <= 1e-9
    assert np.abs(np.linalg.norm(r.orientation, axis=2) - 1.0).max() <= 1e-9
    # that of newton-euler within a tenth: order two in the step
    plain = run(make(), integrator="generalised-alpha", step=1e-3, coordinates="absolute")
    errors = [np.abs(each.energy_error).max() / each.kinetic_energy.max() for each in (r, plain)]
    assert abs(errors[0] - errors[1]) < 0.1 * errors[1]


@LASTING
@pytest.mark.parametrize("integrator", ["generalised-alpha", "ros2"])
def test_heavy_top_converges_with_order_two(integrator, rotations):
    """150 rad/s; in Euler angles about an axis of their own."""
    found = []
    for step in (2e-4, 1e-4):
        settings = {"integrator": integrator, "step": step, "duration": 0.2, "output_interval": 0.02}
        r = run(machines.heavy_top(), **settings, **lagrange(rotations))
        found.append(np.abs(orientations(r) - heavy_top.solve(r.time).rotation).max())
    assert found[0] < 0.02
    assert abs(np.log2(found[0] / found[1]) - 2.0) < 0.2


def test_rotation_vectors_of_the_heavy_top_converge_with_order_two():
    found = []
    for step in (4e-4, 2e-4, 1e-4):
        settings = {"integrator": "generalised-alpha", "step": step, "duration": 0.03, "output_interval": 0.006}
        r = run(machines.heavy_top(), **settings, **lagrange("rotation-vector"))
        found.append(np.abs(orientations(r) - heavy_top.solve(r.time).rotation).max())
    assert np.all(np.abs(np.log2(np.array(found[:-1]) / found[1:]) - 2.0) < 0.1)


@EACH
@pytest.mark.parametrize("integrator", ["radau", "bdf"])
@pytest.mark.parametrize("tolerance", tail([1e-4, 1e-6, 1e-8], [1e-6]))
def test_tolerance_is_met(integrator, tolerance, rotations):
    common = {"integrator": integrator, "tolerance": tolerance, **lagrange(rotations)}
    r = run(machines.slider_crank(), duration=1.0, output_interval=0.05, **common)
    assert (
        np.abs(r.position - slider_crank.solve(r.time).position).max() < 10 * tolerance * r.prepared.motion.system.size
    )
    assert np.abs(r.constraint_violation).max() <= 1e-9
    duration = 0.03 if rotations == "rotation-vector" else 0.2
    r = run(machines.heavy_top(), duration=duration, output_interval=duration / 5, **common)
    assert np.abs(orientations(r) - heavy_top.solve(r.time).rotation).max() < 10 * tolerance


@EACH
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_chosen_steps_meet_the_tolerance(tolerance, rotations):
    """Frames stand inside steps."""
    settings = {"integrator": "generalised-alpha", "step_control": "error", "duration": 1.0, "output_interval": 0.013}
    r = run(machines.slider_crank(), tolerance=tolerance, **settings, **lagrange(rotations))
    assert (
        np.abs(r.position - slider_crank.solve(r.time).position).max() < 10 * tolerance * r.prepared.motion.system.size
    )


@EACH
@pytest.mark.parametrize("integrator", ["radau", "bdf", "newmark", "ros2"])
@pytest.mark.parametrize("make", [machines.bennett, lambda: machines.four_bar("revolute", "revolute")])
def test_redundant_joints(make, integrator, rotations):
    common = {"duration": 0.2, "output_interval": 0.02}
    fine = reference_run(make(), integrator="dop853", tolerance=1e-10, coordinates="absolute", **common)
    settings = {"step": 2e-4} if integrator in FIXED else {"tolerance": 1e-7}
    r = run(make(), integrator=integrator, **common, **settings, **lagrange(rotations))
    assert np.abs(r.position - fine.position).max() < 1e-6
    assert np.abs(r.joint_force - fine.joint_force).max() < 1e-5 * np.abs(fine.joint_force).max()
    assert np.abs(r.constraint_violation).max() <= 1e-9


@EACH
def test_impulses_at_corners_of_drivers_keep_order_two(rotations):
    """The least change of velocities in the mass metric, M Δv + C_qᵀ μ = 0, for rates of rotation coordinates."""
    errors = []
    for step in (1e-2, 5e-3, 2.5e-3):
        r = run(cart_and_arm(), step=step, output_interval=0.1, **lagrange(rotations))
        angle, rate = swing(r.time, r.joint_rate[0, 1])
        motion = np.interp(r.time, RAMPS.times, RAMPS.values)
        np.testing.assert_allclose(r.joint_coordinate[:, 0], motion, rtol=0, atol=1e-12)
        errors.append([np.abs(r.joint_coordinate[:, 1] - angle).max(), np.abs(r.joint_rate[:, 1] - rate).max()])
    assert np.all(np.abs(np.log2(np.array(errors[:-1]) / errors[1:]) - 2.0) < 0.3)


@LASTING
@pytest.mark.parametrize(
    "settings", [{"integrator": "generalised-alpha", "step": 1e-3}, {"integrator": "radau", "tolerance": 1e-5}]
)
def test_a_stiff_spring_is_stepped_over(settings, rotations):
    """1e9 N/m along the rod of a slider-crank, at a step of a hundred periods of its vibration."""
    r = run(elastic_crank(1e9), duration=1.0, **settings, **lagrange(rotations))
    angle = rigid_crank(r.time)
    expected = np.transpose((0.1 * np.cos(angle), 0.1 * np.sin(angle)))
    assert np.abs(r.position[:, 0, :2] - expected).max() < 1e-4
    assert r.finished.timing["steps"] <= 1000


@pytest.mark.parametrize(
    ("integrator", "settings"),
    [
        ("generalised-alpha", {"step": 1e-3}),
        ("generalised-alpha", {"step_control": "error", "tolerance": 1e-3}),
        ("ros2", {"step": 1e-3}),
        ("radau", {"tolerance": 1e-6}),
        ("bdf", {"tolerance": 1e-6}),
    ],
)
def test_a_run_stops_before_a_singular_position_and_says_so(integrator, settings):
    """sin(ψ/2)/(ψ/2) = 0.05 at ψ = 5.982 rad, as for explicit methods."""
    r = run(
        machines.slider_crank(), integrator=integrator, output_interval=1e-3, **settings, **lagrange("rotation-vector")
    )
    assert r.finished.outcome == "failed"
    message, advice, time = r.finished.failure
    assert "rotation coordinates of crank come to a singular position" in message
    assert "euler-parameters" in advice
    angle = np.abs(np.interp(time, r.time, r.joint_coordinate[:, 0]) - r.joint_coordinate[0, 0])
    assert angle == pytest.approx(5.98196, abs=0.01)


@EACH
@pytest.mark.parametrize("integrator", ["generalised-alpha", "ros2", "radau", "bdf"])
def test_chunks_change_nothing(integrator, rotations):
    settings = {"integrator": integrator, "duration": 0.1, **lagrange(rotations)}
    whole, pieces = (run(machines.slider_crank(), chunk_steps=each, **settings) for each in (10_000, 3))
    assert np.array_equal(whole.frames, pieces.frames)


@EACH
def test_full_newton_converges_in_as_few_iterations_as_on_the_group(rotations):
    """As index 3 quadratically: two iterations a step at 1 ms, and none more than of newton-euler."""
    settings = {"integrator": "generalised-alpha", "step": 1e-3, "duration": 0.4, "stabilisation": "none"}
    runs = [
        run(machines.slider_crank(), corrector={"matrix": "full"}, **settings, **each)
        for each in ({"coordinates": "absolute"}, lagrange(rotations))
    ]
    counts = [each.finished.timing["iterations"] / each.finished.timing["steps"] for each in runs]
    assert counts[1] < 1.1 * counts[0]
    assert counts[1] < 2.5


def test_energy_momentum_balances_no_rates_of_rotation_coordinates():
    with pytest.raises(ModelError, match="not for rates of rotation coordinates"):
        run(machines.slider_crank(), integrator="energy-momentum", stabilisation="none", formulation="lagrange")
