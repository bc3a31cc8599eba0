"""Drivers whose speed jumps: straight lines of a table, a table that ends on the way."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from nivel import Body, Driver, Joint, MachineRecord, SimulationSettings, Table
from nivel.analysis.plan.plan import plan_run
from nivel.errors import ModelError
from running import run
from simulating import simulate
from test_drivers import CRANK, crank_pose, crank_rates, scalar_equation, slider_crank

G, LENGTH, MASS, INERTIA, CART = 9.81, 0.5, 2.0, 0.2, 3.0
ABOUT_PIVOT = INERTIA + MASS * LENGTH**2
# corners at no multiple of any step below, and one at a multiple of all that is none in round-off; the last one is the end of the table
RAMPS = Table((0.0, 0.3, 0.5037, 0.8013), (0.0, 0.3, -0.1, 0.1))
INTEGRATORS = pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha"])
COORDINATES = pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])


def cart_and_arm(table=RAMPS, **settings):
    """A cart driven along x, and an arm that hangs on it and swings freely."""
    return MachineRecord(
        name="cart and arm",
        gravity=(0.0, -G, 0.0),
        bodies=(
            Body(name="cart", mass=CART, inertia=(1, 1, 1)),
            Body(name="arm", mass=MASS, inertia=(0.1, 0.1, INERTIA), position=(0.0, -LENGTH, 0.0)),
        ),
        joints=(
            Joint(name="rail", type="translational", bodies=("ground", "cart"), point=(0, 0, 0), axis=(1, 0, 0)),
            Joint(name="pivot", type="revolute", bodies=("cart", "arm"), point=(0, 0, 0), axis=(0, 0, 1)),
        ),
        drivers=(Driver(name="ramp", coordinate="rail", value=table),),
        simulation=SimulationSettings(**({"duration": 1.0, "integrator": "newmark"} | settings)),
    )


def swing(times, start_rate, table=RAMPS):
    """Angle and rate of the arm by an explicit method from corner to corner. Where the cart's speed jumps by Δ, the pivot's impulse has no
    moment about the pivot: (J + m l²) Δφ̇ = -m l cos φ Δ. At a corner, the rate beyond it."""
    edges = [*[t for t in table.times if 0.0 < t < times[-1]], times[-1]]
    slope = np.append(np.diff(table.values) / np.diff(table.times), 0.0)
    out, begin, state = np.zeros((len(times), 2)), 0.0, np.array([0.0, start_rate])
    for k, edge in enumerate(edges):
        solution = solve_ivp(
            lambda t, y: [y[1], -MASS * G * LENGTH * np.sin(y[0]) / ABOUT_PIVOT],
            (begin, edge), state, method="DOP853", dense_output=True, rtol=1e-12, atol=1e-13,
        )  # fmt: skip
        here = (times >= begin - 1e-12) & (times <= edge + 1e-12)
        out[here] = solution.sol(times[here]).T
        begin, state = edge, solution.y[:, -1].copy()
        if k < len(edges) - 1:
            state[1] -= MASS * LENGTH * np.cos(state[0]) * (slope[k + 1] - slope[k]) / ABOUT_PIVOT
    return out.T


@COORDINATES
@INTEGRATORS
def test_impulses_at_corners_that_fall_on_no_step_keep_order_two(integrator, coordinates):
    errors = []
    for step in (2e-2, 1e-2, 5e-3):
        r = run(cart_and_arm(), integrator=integrator, coordinates=coordinates, step=step, output_interval=0.1)
        assert r.finished.outcome == "done"
        angle, rate = swing(r.time, r.joint_rate[0, 1])
        np.testing.assert_allclose(
            r.joint_coordinate[:, 0], np.interp(r.time, RAMPS.times, RAMPS.values), rtol=0, atol=1e-12
        )
        errors.append([np.abs(r.joint_coordinate[:, 1] - angle).max(), np.abs(r.joint_rate[:, 1] - rate).max()])
    assert np.all(np.abs(np.log2(np.array(errors[:-1]) / errors[1:]) - 2.0) < 0.3)
    assert errors[-1][1] < 1e-3


@COORDINATES
def test_chosen_steps_meet_the_tolerance_across_jumps(coordinates):
    """Frames stand inside steps, also inside those that end at a corner."""
    tolerance = 1e-5
    r = run(
        cart_and_arm(), step_control="error", tolerance=tolerance, output_interval=0.0037, coordinates=coordinates,
    )  # fmt: skip
    angle, rate = swing(r.time, r.joint_rate[0, 1])
    assert np.abs(r.joint_coordinate[:, 1] - angle).max() < 10 * tolerance
    assert np.abs(r.joint_rate[:, 1] - rate).max() < 10 * tolerance * np.abs(rate).max()
    assert r.finished.timing["steps"] < 2500


def test_accelerations_are_those_of_the_accepted_state():
    """Undamped, what one step gets wrong of v̇ along the constraints would alternate for ever, and ask for ever shorter steps."""
    r = run(cart_and_arm(), step_control="error", tolerance=1e-6, duration=0.7, coordinates="absolute")
    assert r.finished.outcome == "done"
    assert r.finished.timing["steps"] < 5000


@COORDINATES
@INTEGRATORS
def test_energy_and_the_work_of_the_driver_balance_across_jumps(integrator, coordinates):
    """The impulse of the driver times the mean of the speeds before and after it; what is left is the integral of its power, of order 2."""
    found = []
    for step in (1e-2, 5e-3):
        r = run(cart_and_arm(), integrator=integrator, coordinates=coordinates, step=step, output_interval=0.1)
        found.append(np.abs(r.energy_error).max())
    # jumps of two metres a second move 5 kg: several joules each
    assert found[1] < 5e-4
    assert abs(np.log2(found[0] / found[1]) - 2.0) < 0.5


@COORDINATES
def test_undamped_newmark_does_not_ring_after_a_corner(coordinates):
    """What alternates from step to step shows in second differences of the error; the multipliers that it would start with never settle."""
    r = run(cart_and_arm(), step=5e-3, output_interval=5e-3, coordinates=coordinates)
    error = r.joint_rate[:, 1] - swing(r.time, r.joint_rate[0, 1])[1]
    late = error[r.time > 0.8013 + 5e-3]
    assert np.abs(np.diff(late, 2)).max() < 0.02 * np.abs(late).max()
    # reaction of the pivot beyond the last corner, where the cart stands still: along the arm m (l φ̇² + g cos φ)
    angle, rate = r.joint_coordinate[-1, 1], r.joint_rate[-1, 1]
    along = MASS * (LENGTH * rate**2 + G * np.cos(angle))
    across = MASS * G * np.sin(angle) * (1.0 - MASS * LENGTH**2 / ABOUT_PIVOT)
    assert abs(np.linalg.norm(r.joint_force[-1, 1]) - np.hypot(along, across)) < 1e-9 * along


@pytest.mark.parametrize("step_control", ["own", "error"])
def test_tables_that_begin_late_and_end_early_hold(step_control):
    table = Table((0.2, 0.6), (0.0, 0.4))
    r = run(cart_and_arm(table), step=1e-2, output_interval=1e-2, step_control=step_control, tolerance=1e-5)
    assert r.finished.outcome == "done"
    np.testing.assert_allclose(r.joint_coordinate[:, 0], np.interp(r.time, table.times, table.values), atol=1e-12)
    expected = np.where((r.time > 0.195) & (r.time < 0.595), 1.0, 0.0)
    np.testing.assert_allclose(r.joint_rate[:, 0], expected, atol=1e-9)
    assert np.abs(r.joint_rate[r.time < 0.195, 1]).max() < 1e-9
    # at rest and hanging straight down, the arm takes m l/(J + m l²) of the cart's speed
    k = int(np.flatnonzero(r.time > 0.195)[0])
    assert abs(r.joint_rate[k, 1] + MASS * LENGTH / ABOUT_PIVOT) < 1e-9


def test_the_last_frame_of_a_run_that_ends_with_its_table_has_the_last_speed():
    r = run(cart_and_arm(Table((0.0, 0.4, 1.0), (0.0, 0.4, 0.1))), step=1e-2)
    assert abs(r.joint_rate[-1, 0] + 0.5) < 1e-12


def test_a_corner_at_the_end_of_the_run_shows_what_follows():
    for step_control in ("own", "error"):
        r = run(cart_and_arm(Table((0.0, 1.0, 2.0), (0.0, 0.4, 0.1))), step=1e-2, step_control=step_control)
        assert r.finished.outcome == "done"
        assert abs(r.joint_rate[-1, 0] + 0.3) < 1e-12
        assert abs(r.joint_rate[-2, 0] - 0.4) < 1e-12


@COORDINATES
def test_a_closed_loop_without_freedom_jumps_as_its_geometry_says(coordinates):
    """A crank that turns by straight lines: speeds of all bodies from the geometry, and T jumps by the work of the driver's impulse."""
    table = {"times": [0, 0.2513, 0.5], "values": [0.3, 1.8, 0.9]}
    r = simulate(
        slider_crank({"coordinate": "shaft.angle", "value": table}, 0.3), duration=0.8, step=2e-3, output_interval=0.02,
        integrator="generalised-alpha", coordinates=coordinates,
    )  # fmt: skip
    t = r.time
    angle = np.interp(t, table["times"], table["values"])
    rate = np.where(t < 0.2513, 1.5 / 0.2513, np.where(t < 0.499, -0.9 / (0.5 - 0.2513), 0.0))
    np.testing.assert_allclose(r.array("position"), crank_pose(angle)[0], atol=1e-9)
    np.testing.assert_allclose(r.array("velocity"), crank_rates(angle)[0] * rate[:, None, None], atol=1e-8)
    reduced, _, _ = scalar_equation(CRANK, angle)
    np.testing.assert_allclose(r.array("kinetic_energy"), 0.5 * reduced * rate**2, atol=1e-8)
    # the work of the driver's effort by the trapezoidal rule, an error of h²/12 times the change of the slope of its power: the effort of
    # independent coordinates is that of the state, those of index 2 are means over steps
    share = 3e-4 if coordinates == "independent" else 1e-4
    assert np.abs(r.array("energy_error")).max() < share * r.array("kinetic_energy").max()


@pytest.mark.parametrize("integrator", ["rk4", "dopri5", "bdf", "radau", "ros2", "gear"])
def test_other_integrators_refuse_jumps_and_say_where_they_are(integrator):
    record = cart_and_arm(Table((0.0, 0.3, 0.5037, 1.0), (0.0, 0.3, -0.1, 0.1)))
    record = record.replace(simulation=record.simulation.replace(integrator=integrator))
    message = rf"jumps at 0\.3, 0\.5037 s, and `integrator: {integrator}` would lose"
    with pytest.raises(ModelError, match=message) as caught:
        plan_run(record)
    assert caught.value.faults[0].path == "drivers.ramp.value"
    assert "generalised-alpha" in caught.value.faults[0].message


def test_a_straight_line_has_no_corner_for_anyone():
    r = run(cart_and_arm(Table((0.0, 0.4, 1.0), (0.0, 0.2, 0.5))), integrator="rk4", step=1e-2)
    np.testing.assert_allclose(r.joint_coordinate[:, 0], 0.5 * r.time, atol=1e-12)
