"""Radau IIA of order 5: its order, its tolerance, stiff machines, events and chunks; its linear equations against differences."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import machines
import nivel
from lanes import tail
from nivel import Body, Event, Joint, MachineRecord, Motor, PointForce, SimulationSettings, SpringDamper
from nivel.errors import ModelError
from nivel.integrate.radau.radau_constants import BEND, COLLOCATION, GAMMA, LEFT, LEFT_PAIR, MU, RIGHT, RIGHT_PAIR, C
from references import andrews, four_bar, heavy_top, pendulum, slider_crank
from running import reference_run, run
from stiff_machines import double_pendulum
from test_mechanisms import EXAMPLES
from test_stiff import closed_form, overdamped

pytestmark = pytest.mark.covering

COORDINATES = pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
TOLERANCES = [1e-4, 1e-6, 1e-8, 1e-10]
ASKED = pytest.mark.parametrize("tolerance", tail(TOLERANCES, [1e-4, 1e-8]))


def solved(machine, **settings):
    result = run(machine, integrator="radau", **settings)
    assert result.finished.outcome == "done", result.finished.failure
    return result


def steps(result):
    return result.finished.timing["steps"]


def swinging():
    return MachineRecord(
        name="pendulum",
        gravity=(0, -9.81, 0),
        bodies=(Body(name="bob", mass=1, inertia=(0.01, 0.02, 0.02), position=(-1, 0, 0)),),
        joints=(Joint(name="pivot", type="revolute", bodies=("ground", "bob"), point=(0, 0, 0), axis=(0, 0, 1)),),
        simulation=SimulationSettings(duration=5.0, output_interval=0.05),
    )


def error_of_pendulum(result):
    expected = pendulum.solve(result.time, pendulum.Pendulum(inertia=0.02))
    return np.abs(result.position[:, 0] - expected.position).max()


def error_of_slider_crank(result):
    expected = slider_crank.solve(result.time)
    return np.abs(result.position - expected.position).max() / result.prepared.motion.system.size


# -- constants


def test_stages_integrate_polynomials_of_degree_two_and_the_end_of_degree_four():
    """Z = h A F with A = right/μ left, both eigenvectors of the pair: collocation at three nodes, and order 5 at the end."""
    A = np.outer(RIGHT, LEFT) / GAMMA + 2 * np.real(np.outer(RIGHT_PAIR, LEFT_PAIR) / MU)
    for k in range(3):
        np.testing.assert_allclose(A @ C**k, C ** (k + 1) / (k + 1), rtol=0, atol=1e-14)
    for k in range(5):
        np.testing.assert_allclose(A[2] @ C**k, 1 / (k + 1), rtol=0, atol=1e-14)


def test_polynomial_passes_through_the_stages_and_its_bend_is_flat_at_the_nodes():
    for k in range(3):
        np.testing.assert_allclose(COLLOCATION @ C ** (k + 1), np.eye(3)[k], rtol=0, atol=1e-13)
    slopes = [np.sum(np.arange(1, 5) * BEND * theta ** np.arange(4)) for theta in (0.0, *C)]
    np.testing.assert_allclose(slopes, [1, 0, 0, 0], rtol=0, atol=1e-13)
    assert abs(np.sum(BEND)) < 1e-14


# -- order and tolerance


@pytest.mark.parametrize(
    ("machine", "error", "coordinates"),
    [(swinging, error_of_pendulum, "absolute"), (machines.slider_crank, error_of_slider_crank, "relative")],
)
def test_error_falls_with_the_fifth_power_of_the_step(machine, error, coordinates):
    """Steps chosen for smaller and smaller tolerances: error ~ (1/steps)^5, at frames inside steps too."""
    results = [
        solved(machine(), tolerance=tolerance, coordinates=coordinates, duration=2.0, output_interval=0.013)
        for tolerance in (1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
    ]
    order = -np.polyfit(np.log([steps(each) for each in results]), np.log([error(each) for each in results]), 1)[0]
    assert 4.5 < order < 5.6


@ASKED
@COORDINATES
def test_slider_crank(tolerance, coordinates):
    """2 s, through its first top dead centre; frames inside steps too."""
    result = solved(
        machines.slider_crank(), tolerance=tolerance, coordinates=coordinates, duration=2.0, output_interval=0.013
    )
    expected = slider_crank.solve(result.time)
    assert error_of_slider_crank(result) < 10 * tolerance
    assert np.abs(result.external_work - expected.work).max() < 10 * tolerance * result.kinetic_energy.max()
    assert np.abs(result.energy_error).max() < 10 * tolerance * result.kinetic_energy.max()
    assert np.abs(result.constraint_violation).max() < 1e-12


@cache
def closing_angle():
    x, y, _ = run(machines.four_bar(), duration=1e-3).position[0, 0]
    return np.arctan2(y, x)


@ASKED
@COORDINATES
def test_four_bar(tolerance, coordinates):
    result = solved(machines.four_bar(), tolerance=tolerance, coordinates=coordinates, output_interval=0.05)
    expected = four_bar.solve(result.time, crank_angle=closing_angle())
    assert np.abs(result.position - expected.position).max() < 10 * tolerance * result.prepared.motion.system.size


@ASKED
@COORDINATES
def test_heavy_top(tolerance, coordinates):
    """A fifth of a second at 150 rad/s: the turning of the axes by the angular velocity is part of the derivatives."""
    result = solved(
        machines.heavy_top(), tolerance=tolerance, coordinates=coordinates, duration=0.2, output_interval=0.01
    )
    found = Rotation.from_quat(result.orientation[:, 0], scalar_first=True).as_matrix()
    assert np.abs(found - heavy_top.solve(result.time).rotation).max() < 10 * tolerance
    assert result.finished.timing["factorisations"] < 5


@ASKED
@COORDINATES
def test_pendulum(tolerance, coordinates):
    result = solved(swinging(), tolerance=tolerance, coordinates=coordinates)
    assert error_of_pendulum(result) < 10 * tolerance
    assert np.abs(result.energy_error).max() < 20 * tolerance * result.kinetic_energy.max()


@cache
def squeezed():
    return andrews.solve(np.array([0.0, 0.03]), spring=True).q[-1]


@ASKED
@COORDINATES
def test_andrews_squeezer(tolerance, coordinates):
    """30 ms, q of the IVP test set at the end."""
    machine = nivel.load(EXAMPLES / "mechanisms" / "andrews-squeezer.yaml").record
    result = solved(machine, tolerance=tolerance, coordinates=coordinates, step=1e-4, output_interval=1e-4)
    A = Rotation.from_quat(result.orientation.reshape(-1, 4), scalar_first=True).as_matrix()
    A = A.reshape(len(result.time), -1, 3, 3)
    names = list(result.prepared.motion.system.bodies)
    first = [names.index(f"K{k}") for k in range(1, 8)]
    k1, k2, k3, k4, k5, k6, k7 = np.unwrap(np.arctan2(A[:, first, 1, 0], A[:, first, 0, 0]), axis=0)[-1]
    q = np.array([k1, k2 - k1, k3, k4 - k5, k5, k6 - k7, k7])
    assert np.abs(q - squeezed()).max() < 10 * tolerance


# -- stiff machines


@COORDINATES
@pytest.mark.parametrize("tolerance", tail([1e-4, 1e-6, 1e-8], [1e-6]))
def test_overdamped_block_follows_its_closed_form(tolerance, coordinates):
    """Rates of -1e5/s and -0.5/s: from the step of the first to that of the second within some tens of steps."""
    result = solved(overdamped(), tolerance=tolerance, coordinates=coordinates)
    assert np.abs(result.position[:, 0, 0] - closed_form(result.time)).max() < 10 * tolerance
    assert steps(result) < 400
    assert result.finished.timing["rejected"] < 20


@COORDINATES
@pytest.mark.parametrize("tolerance", [1e-5, 1e-6, 1e-7])
@pytest.mark.parametrize("damping", [0.0, 1.0])
def test_spring_a_million_times_stiffer_costs_no_more_than_twice_the_steps(tolerance, coordinates, damping):
    """The damping grows with the root of the stiffness, so that both vibrations fade alike."""
    settings = {"tolerance": tolerance, "coordinates": coordinates}
    soft = solved(double_pendulum(10.0, damping), **settings)
    stiff = solved(double_pendulum(1e7, 1e3 * damping), **settings)
    assert steps(stiff) < 2 * steps(soft)
    # and it moves as the one link that it is, whose centre is the elbow
    inertia = 2 * (0.08 + 0.25)
    rigid = pendulum.Pendulum(mass=2, arm=1, inertia=inertia)

    def rates(t, state):
        return [state[1], -rigid.mass * rigid.gravity * rigid.arm / rigid.inertia_at_hinge * np.sin(state[0])]

    angle = solve_ivp(rates, (0, 5), [0, 4], "DOP853", rtol=1e-11, atol=1e-12, t_eval=stiff.time).y[0]
    expected = 0.5 * np.column_stack([np.sin(angle), -np.cos(angle)])
    # the elbow bends by moment/stiffness
    assert np.abs(stiff.position[:, 0, :2] - expected).max() < 10 * tolerance * 2 + 1e-5


def van_der_pol(stiffness):
    """ẍ = μ (1 - x²) ẋ - x of a motor on a rail, from (2, 0)."""
    x, v = "rail.displacement", "rail.displacement_rate"
    return MachineRecord(
        name="van-der-pol",
        bodies=(Body(name="block", mass=1, inertia=(1, 1, 1), position=(2, 0, 0)),),
        joints=(Joint(name="rail", type="translational", bodies=("ground", "block"), point=(0, 0, 0), axis=(1, 0, 0)),),
        forces=(
            Motor(
                name="motor",
                coordinate="rail",
                effort=f"{stiffness}*(1 - ({x} + 2)**2)*{v} - ({x} + 2)",
            ),
        ),
        simulation=SimulationSettings(duration=2 * stiffness, step=1e-3, output_interval=stiffness / 20),
    )


@cache
def jumps():
    """Its solution by scipy."""

    def rates(t, y):
        return [y[1], 1000 * (1 - y[0] ** 2) * y[1] - y[0]]

    return solve_ivp(rates, (0, 2000), [2, 0], "Radau", rtol=1e-10, atol=1e-12, dense_output=True).sol


@COORDINATES
def test_van_der_pol_with_a_motor(coordinates):
    """μ = 1000 for 2000 s (Hairer, Wanner 1996, eq. IV.1.5'): slow motion along ẋ = x/(μ (1 - x²)) between two jumps."""
    result = solved(van_der_pol(1000.0), tolerance=1e-6, coordinates=coordinates)
    expected = jumps()(result.time)[0]
    # jumps magnify errors of their time: compare before and well after the one at 807 s
    calm = np.abs(result.time - 807) > 60
    assert np.abs(result.position[calm, 0, 0] - expected[calm]).max() < 2e-5
    assert steps(result) < 1500


def test_spring_that_turns_meets_the_tolerance():
    """A bob on a spring of 1e7 N/m with damping: the stiff direction turns with it. The closed form is that of the rigid pendulum, from
    which it is away by m (2 g + …)/k = 3e-6 m."""
    machine = swinging().replace(
        joints=(),
        forces=(
            SpringDamper(
                name="rod",
                bodies=("ground", "bob"),
                points=((0, 0, 0), (-1, 0, 0)),
                stiffness=1e7,
                damping=100,
                free_length=1.0,
            ),
        ),
    )
    result = solved(machine, tolerance=1e-5, duration=2.0)
    expected = pendulum.solve(result.time, pendulum.Pendulum(inertia=0.0))
    assert np.abs(result.position[:, 0] - expected.position).max() < 10 * 1e-5 + 1e-5


def tumbling(stiffness):
    """A body that turns about all its axes, held beside its centre of mass by a spring, which starts with neither a speed nor an
    acceleration along itself: L̈ = d · r̈ + v²/L = 0 for its end at r = L d, its tension T in r̈ = g - T d/m + ω̇ × u + ω × (ω × u)."""
    mass, inertia, gravity = 1.0, np.array([0.01, 0.02, 0.025]), np.array([0, -9.81, 0])
    end, u, omega = np.array([0.9, 0.05, 0.1]), np.array([-0.1, 0.05, 0.1]), np.array([4.0, -3.0, 5.0])
    length = np.linalg.norm(end)
    d = end / length
    speed = np.cross([1.0, -2.0, 3.0], d)

    def acceleration(tension):
        turning = (np.cross(u, -tension * d) - np.cross(omega, inertia * omega)) / inertia
        along = gravity - tension * d / mass + np.cross(turning, u) + np.cross(omega, np.cross(omega, u))
        return d @ along + speed @ speed / length

    tension = acceleration(0.0) / (acceleration(0.0) - acceleration(1.0))
    spring = SpringDamper(
        name="rod",
        bodies=("ground", "stone"),
        points=((0, 0, 0), tuple(end)),
        stiffness=stiffness,
        free_length=length - tension / stiffness,
    )
    stone = Body(
        name="stone",
        mass=mass,
        inertia=tuple(inertia),
        position=tuple(end - u),
        velocity=tuple(speed - np.cross(omega, u)),
        angular_velocity=tuple(omega),
    )
    return MachineRecord(
        name="tumbling",
        gravity=tuple(gravity),
        bodies=(stone,),
        forces=(spring,),
        simulation=SimulationSettings(duration=1.0, output_interval=0.05),
    )


@COORDINATES
def test_stages_of_a_body_that_tumbles_on_a_stiff_spring(coordinates):
    """1e6 N/m against the same motion by an explicit method. Derivatives at the stages bring Newton's iteration to its end in four changes
    in the mean, of which the last shows that it is."""
    result = solved(tumbling(1e6), tolerance=1e-3, coordinates=coordinates)
    expected = reference_run(tumbling(1e6), integrator="dop853", tolerance=1e-9, coordinates=coordinates)
    assert np.abs(result.position - expected.position).max() < 10 * 1e-3 * result.prepared.motion.system.size
    timing = result.finished.timing
    assert steps(result) < 2 * steps(solved(tumbling(1e2), tolerance=1e-3, coordinates=coordinates))
    assert timing["iterations"] < 4 * (timing["steps"] + timing["rejected"])


# -- runs


@COORDINATES
def test_result_is_bit_identical_for_every_chunk(coordinates):
    settings = {"duration": 0.5, "tolerance": 1e-5, "output_interval": 7e-3, "coordinates": coordinates}
    whole = solved(machines.slider_crank(), chunk_steps=10_000, **settings)
    for chunk in (1, 7):
        assert np.array_equal(whole.frames, solved(machines.slider_crank(), chunk_steps=chunk, **settings).frames)


def test_frames_do_not_depend_on_how_many_there_are():
    settings = {"duration": 1.0, "tolerance": 1e-6}
    few = solved(machines.slider_crank(), output_interval=0.5, **settings)
    many = solved(machines.slider_crank(), output_interval=2.5e-3, **settings)
    assert steps(few) == steps(many)
    np.testing.assert_allclose(many.position[::200], few.position, rtol=0, atol=1e-13)


@COORDINATES
@pytest.mark.parametrize("tolerance", [1e-5, 1e-8])
def test_events_inside_steps_are_found(tolerance, coordinates):
    """The pendulum at its lowest point, after a quarter of its period and every half period more."""
    machine = swinging().replace(events=(Event(name="low", when="bob.x"),))
    result = solved(machine, tolerance=tolerance, coordinates=coordinates)
    period = pendulum.Pendulum(inertia=0.02).period
    expected = np.arange(0.25 * period, 5.0, 0.5 * period)
    assert steps(result) < 1000
    np.testing.assert_allclose([each.time for each in result.finished.events], expected, rtol=0, atol=10 * tolerance)


def test_step_ends_at_a_jump_of_a_force():
    """Which is no number there, and known as a corner: nothing is rejected."""
    machine = MachineRecord(
        name="pushed",
        bodies=(Body(name="stone", mass=2, inertia=(1, 1, 1)),),
        forces=(PointForce(name="push", body="stone", vector=("2 - 2*(time - 0.3)/abs(time - 0.3)", 0, 0)),),
        simulation=SimulationSettings(duration=1.0),
    )
    result = solved(machine, tolerance=1e-8, output_interval=0.5)
    assert abs(result.position[-1, 0, 0] - (0.09 + 0.6 * 0.7)) < 1e-7
    assert result.finished.timing["rejected"] == 0


def test_steps_end_at_corners_of_tables():
    """A push of 2, 6, 6 and 0 N at 0, 0.3, 0.5 and 1 s: between corners the position is a cubic, which the method has exactly, so steps are
    as long as they may grow."""
    machine = MachineRecord(
        name="pushed",
        bodies=(Body(name="stone", mass=2, inertia=(1, 1, 1)),),
        forces=(
            PointForce(
                name="push",
                body="stone",
                vector=({"times": [0, 0.3, 0.5, 1.0], "values": [2, 6, 6, 0]}, 0, 0),
            ),
        ),
        simulation=SimulationSettings(duration=1.0),
    )
    result = solved(machine, tolerance=1e-4, output_interval=0.05)
    t = result.time
    # twice the integral of the force over the mass: of each ramp of slope a after its begin at b, a (t - b)³/6
    ramps = [(0.0, 4 / 0.3), (0.3, -4 / 0.3), (0.5, -12.0)]
    expected = (t**2 + sum(slope * np.maximum(t - begin, 0) ** 3 / 6 for begin, slope in ramps)) / 2
    np.testing.assert_allclose(result.position[:, 0, 0], expected, rtol=0, atol=1e-10)
    assert steps(result) < 60


@pytest.mark.parametrize("stabilisation", ["none", "direct", "geometric"])
def test_stabilisations(stabilisation):
    settings = {"duration": 1.0, "output_interval": 0.1, "tolerance": 1e-7, "stabilisation": stabilisation}
    assert error_of_slider_crank(solved(machines.slider_crank(), **settings)) < 10 * 1e-7


@pytest.mark.parametrize(
    ("settings", "reason"),
    [
        ({"coordinates": "independent", "formulation": "penalty"}, "there is no violation to feed back"),
        ({"stabilisation": "baumgarte"}, "take direct, or own coefficients"),
    ],
)
def test_what_has_no_exact_derivatives_is_refused(settings, reason):
    with pytest.raises(ModelError, match=reason):
        run(machines.slider_crank(), integrator="radau", **settings)
