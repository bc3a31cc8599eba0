"""The references checked: derivatives, closure, energy, known facts, a second tolerance, a second way."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from references import andrews, four_bar, heavy_top, one_dof, pendulum, slider_crank
from references.solution import Solution

pytestmark = pytest.mark.covering

LINKAGES = pytest.mark.parametrize("machine", [slider_crank, four_bar], ids=["slider-crank", "four-bar"])
DURATION = {slider_crank: 8.0, four_bar: 4.0}
START = {slider_crank: 0.0, four_bar: four_bar.PRINTED_CRANK_ANGLE}
ANGLES = np.linspace(-7.0, 7.0, 57)


@pytest.fixture(scope="module")
def motions():
    return {machine: machine.solve(_times(machine)) for machine in DURATION}


def _times(machine):
    return np.arange(0.0, DURATION[machine] + 0.005, 0.01)


def _time_of(machine, coordinate):
    """Time of the first passage, by quadrature of dt = dφ / φ̇ with ½ m φ̇² = drive Δφ - ΔU: no time integration.

    φ = φ0 + (φ1 - φ0) s² takes the root singularity of the start away.
    """
    linkage, start = machine.LINKAGE, START[machine]
    span = coordinate - start
    potential = one_dof.potential_energy(linkage, np.array([start]))[0]

    def slowness(s):
        at = np.array([start + span * s**2])
        reduced = one_dof.scalar_equation(linkage, at)[0][0]
        kinetic = linkage.drive * span * s**2 - (one_dof.potential_energy(linkage, at)[0] - potential)
        return abs(span) * 2 * s * np.sqrt(reduced / (2 * kinetic))

    return quad(slowness, 0.0, 1.0, epsabs=1e-12, epsrel=1e-11, limit=200)[0]


@LINKAGES
def test_rotations_are_proper(machine):
    _, rotation = machine.pose(ANGLES)
    assert np.allclose(np.swapaxes(rotation, 2, 3) @ rotation, np.eye(3), atol=1e-14)
    assert np.allclose(np.linalg.det(rotation), 1.0, atol=1e-14)


@LINKAGES
def test_hand_derived_rates_equal_the_complex_step(machine):
    step = 1e-30
    position, rotation = machine.pose(ANGLES + 1j * step)
    position_rate, angular = machine.rates(ANGLES)
    assert np.allclose(position_rate, position.imag / step, rtol=0, atol=1e-14)
    # Aᵀ A' = skew(w), w in body axes
    skew = np.swapaxes(rotation.real, 2, 3) @ rotation.imag / step
    assert np.allclose(angular, np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], -1), rtol=0, atol=1e-14)


def test_slider_crank_loop_is_closed():
    position, rotation = slider_crank.pose(ANGLES)
    crank, rod = slider_crank.CRANK, slider_crank.ROD

    def point(body, x):
        return position[:, body] + x * rotation[:, body, :, 0]

    assert np.allclose(point(crank, -0.25), 0.0, atol=1e-14)
    assert np.allclose(rotation[:, crank, :, 2], [1.0, 0.0, 0.0], atol=1e-14)
    assert np.allclose(point(crank, 0.25), point(rod, -0.9), atol=1e-14)
    assert np.allclose(point(rod, 0.9), position[:, slider_crank.SLIDER], atol=1e-14)
    assert np.allclose(rotation[:, rod, 2, 1], 0.0, atol=1e-14)  # rod y ⟂ slider z = Z
    assert np.allclose(position[:, slider_crank.SLIDER, 1:], [0.0, -0.5], atol=1e-14)


def test_slider_crank_starts_as_the_report_says():
    position, rotation = slider_crank.pose(np.zeros(1))
    assert np.allclose(position[0], [[0, 0, -0.25], [0.9, 0, -0.5], [1.8, 0, -0.5]], atol=1e-14)
    # 3-1-3 angles π/2, π/2, -π/2: the columns are -Z, Y, X
    assert np.allclose(rotation[0, 0], [[0, 0, 1], [0, 1, 0], [-1, 0, 0]], atol=1e-14)
    assert np.allclose(rotation[0, 1:], np.eye(3), atol=1e-14)


def test_four_bar_loop_is_closed():
    position, rotation = four_bar.pose(ANGLES)

    def point(body, x):
        return position[:, body] + x * rotation[:, body, :, 0]

    assert np.allclose(point(0, -1.0), 0.0, atol=1e-14)
    assert np.allclose(point(0, 1.0), point(1, -2.0), atol=1e-14)
    assert np.allclose(point(1, 2.0), point(2, 2.0), atol=1e-14)
    assert np.allclose(point(2, -2.0), [2.5, 0.0, 0.0], atol=1e-14)


def test_four_bar_starts_within_the_gap_of_the_printed_data():
    position, rotation = four_bar.pose(np.array([four_bar.PRINTED_CRANK_ANGLE]))
    printed = [[0.5, 0.866025403784, 0], [2.823521413620, 2.553494447797, 0], [3.573521413620, 1.687469044012, 0]]
    angles = np.arctan2(rotation[0, :, 1, 0], rotation[0, :, 0, 0])
    assert np.allclose(position[0], printed, rtol=0, atol=2.5e-4)
    assert np.allclose(angles, [1.047197551197, 0.423245598298, 1.004203159591], rtol=0, atol=2.5e-4)


@LINKAGES
def test_energy_is_conserved(machine, motions):
    motion = motions[machine]
    assert np.max(np.abs(motion.energy_error)) < 1e-10 * np.max(motion.kinetic_energy)


@LINKAGES
def test_a_tighter_tolerance_gives_the_same_motion(machine, motions):
    tight = machine.solve(_times(machine), rtol=3e-14, atol=1e-15)
    assert np.allclose(motions[machine].position, tight.position, rtol=0, atol=1e-9)
    assert np.allclose(motions[machine].rotation, tight.rotation, rtol=0, atol=1e-9)


def test_a_solution_is_the_same_in_whatever_order_it_is_asked_for():
    """y'' = -y: what was computed for later times serves earlier ones."""
    there, early, late = (Solution(lambda _, y: (y[1], -y[0]), 0.0, (0, 1), rtol=1e-12, atol=1e-13) for _ in range(3))
    times, more = np.linspace(0, 1, 11), np.linspace(0, 9, 19)
    early(times), late(more)
    np.testing.assert_array_equal(early(more), there(more))
    np.testing.assert_array_equal(late(times), early(times))
    np.testing.assert_allclose(late(more), [np.sin(more), np.cos(more)], rtol=0, atol=1e-11)
    np.testing.assert_array_equal(there(np.zeros(1)), [[0.0], [1.0]])


@LINKAGES
def test_quadrature_of_the_energy_integral_gives_the_same_times(machine, motions):
    motion = motions[machine]
    assert np.all(motion.rate[1:] < 0)  # the passage is then the only one
    for index in (50, 130, 200, 400):
        assert _time_of(machine, motion.coordinate[index]) == pytest.approx(motion.time[index], abs=1e-8)


@LINKAGES
def test_velocities_and_accelerations_are_time_derivatives(machine):
    step = 1e-3
    motion = machine.solve(np.concatenate([[0.0], 2.0 + step * np.arange(-2, 3)]), rtol=3e-14, atol=1e-15)

    def derivative(values):  # fourth-order central difference at t = 2
        return (values[1] - 8 * values[2] + 8 * values[4] - values[5]) / (12 * step)

    assert np.allclose(derivative(motion.position), motion.velocity[3], rtol=1e-7, atol=1e-7)
    assert np.allclose(derivative(motion.velocity), motion.acceleration[3], rtol=1e-7, atol=1e-6)
    assert np.allclose(derivative(motion.angular_velocity), motion.angular_acceleration[3], rtol=1e-7, atol=1e-6)
    skew = derivative(motion.rotation) @ np.swapaxes(motion.rotation[3], 1, 2)  # A' Aᵀ = skew(ω), global
    omega = np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)
    assert np.allclose(omega, motion.angular_velocity[3], rtol=1e-7, atol=1e-7)


@LINKAGES
def test_euler_parameters_give_the_rotation_and_do_not_jump(machine, motions):
    motion = motions[machine]
    parameters = motion.euler_parameters
    rebuilt = heavy_top.rotation_matrix(parameters.reshape(-1, 4)).reshape(motion.rotation.shape)
    assert np.allclose(rebuilt, motion.rotation, rtol=0, atol=1e-14)
    assert np.all(parameters[0, :, 0] >= 0)
    assert np.max(np.abs(np.diff(parameters, axis=0))) < 0.3


@LINKAGES
def test_reactions_hold_the_whole_machine(machine, motions):
    motion, linkage = motions[machine], machine.LINKAGE
    wrenches = one_dof.reactions(linkage, motion)
    on_machine = np.zeros_like(motion.position[:, 0])
    for joint in linkage.joints:
        if one_dof.GROUND in (joint.first, joint.second):
            sign = 1.0 if joint.second == one_dof.GROUND else -1.0
            on_machine += sign * wrenches[joint.name][0]
    needed = np.einsum("b,nbx->nx", linkage.mass, motion.acceleration - linkage.gravity)
    assert np.allclose(on_machine, needed, rtol=0, atol=1e-10 * np.max(np.abs(needed)))


def test_slider_crank_passes_top_dead_centre_at_1_307_s_with_8_3_joule():
    top = slider_crank.TOP_DEAD_CENTRE
    linkage = slider_crank.LINKAGE
    potential = one_dof.potential_energy(linkage, np.array([0.0, top]))
    # at the top the rod's middle is at R/2 above the guide: 235.62 J - (21 + 71.7) kg · 9.81 m/s² · 0.25 m = 8.27 J
    assert linkage.drive * top - (potential[1] - potential[0]) == pytest.approx(8.27, abs=0.01)
    assert _time_of(slider_crank, top) == pytest.approx(1.307, abs=5e-4)
    motion = slider_crank.solve(np.array([0.0, _time_of(slider_crank, top)]))
    assert motion.coordinate[-1] == pytest.approx(top, abs=1e-8)
    assert motion.kinetic_energy[-1] == pytest.approx(8.27, abs=0.01)


def test_slider_crank_turns_at_1983_degrees_per_second_at_6_s(motions):
    motion = motions[slider_crank]
    assert np.degrees(abs(np.interp(6.0, motion.time, motion.rate))) == pytest.approx(1983, abs=1)


def test_four_bar_crank_and_coupler_are_collinear_at_2_611_s(motions):
    motion = motions[four_bar]
    before, after = motion.coordinate[255], motion.coordinate[265]
    angle = brentq(lambda q: float(four_bar.collinearity(np.array([q]))[0]), after, before, xtol=1e-14)
    assert _time_of(four_bar, angle) == pytest.approx(2.611, abs=5e-4)


def test_four_bar_stays_planar(motions):
    for force, torque in one_dof.reactions(four_bar.LINKAGE, motions[four_bar]).values():
        assert np.max(np.abs(force[:, 2])) < 1e-6
        assert np.max(np.abs(torque)) < 1e-6


def test_four_bar_accepts_an_assembled_crank_angle():
    shifted = four_bar.solve(np.array([0.0, 1.0]), crank_angle=1.0473)
    assert shifted.coordinate[0] == 1.0473
    assert shifted.coordinate[1] != four_bar.solve(np.array([0.0, 1.0])).coordinate[1]


@pytest.fixture(scope="module")
def top():
    return heavy_top.solve(np.linspace(0.0, 2.0, 201))


def test_heavy_top_keeps_energy_spin_and_vertical_momentum(top):
    energy = top.kinetic_energy + top.potential_energy
    assert np.allclose(energy, energy[0], rtol=1e-12)
    assert np.allclose(top.angular_velocity_body[:, 1], 150.0, rtol=1e-13)
    assert np.allclose(top.vertical_momentum, top.vertical_momentum[0], rtol=1e-11)


def test_heavy_top_agrees_with_a_looser_tolerance(top):
    loose = heavy_top.solve(top.time, rtol=1e-11, atol=1e-12)
    assert np.allclose(loose.position, top.position, rtol=0, atol=1e-8)
    assert np.allclose(loose.rotation, top.rotation, rtol=0, atol=1e-8)


def test_heavy_top_nutates_as_the_axisymmetric_equation_says(top):
    # u = height of the axis: u'² = (2/J1)(E' - m g c u)(1 - u²) - ((Lz - Ly u)/J1)², differentiated to remove the sign
    # of the root; Ly = J3 ω̄_y is the spin momentum, Lz the vertical one, E' the energy without the spin.
    j1, j3 = heavy_top.INERTIA_AT_POINT[0], heavy_top.INERTIA_AT_POINT[1]
    weight = heavy_top.MASS * 9.81
    spin = j3 * 150.0
    vertical = top.vertical_momentum[0]
    energy = 0.5 * j1 * 4.61538**2

    def slope(_, state):
        u, rate = state
        square = (2 / j1) * (-weight * (1 - u**2) - 2 * u * (energy - weight * u))
        return [rate, 0.5 * (square + 2 * spin * (vertical - spin * u) / j1**2)]

    # the axis is at Y, horizontal: u = 0, u' = velocity of its tip along Z = ω_x = 0
    result = solve_ivp(slope, (0, 2), [0.0, 0.0], "DOP853", t_eval=top.time, rtol=1e-12, atol=1e-14)
    assert np.allclose(result.y[0], top.position[:, 2], rtol=0, atol=1e-10)


def test_heavy_top_joint_force_and_weight_give_the_change_of_momentum(top):
    # momentum balance over the run: ∫ (F + m g) dt = m Δv; trapezoidal rule on a fine grid
    fine = heavy_top.solve(np.linspace(0.0, 0.2, 2001))
    impulse = np.trapezoid(fine.joint_force + heavy_top.MASS * heavy_top.GRAVITY, fine.time, axis=0)
    change = heavy_top.MASS * (fine.velocity[-1] - fine.velocity[0])
    assert np.allclose(impulse, change, atol=1e-3)


PENDULUMS = pytest.mark.parametrize(
    "swinging",
    [
        pendulum.IFTOMM_A01,
        pendulum.Pendulum(mass=3.0, arm=0.4, inertia=0.7, start_angle=2.9),
        pendulum.Pendulum(mass=0.2, arm=0.1, inertia=1e-3, start_angle=1e-3),
    ],
    ids=["iftomm-a01", "physical", "small"],
)


@PENDULUMS
def test_pendulum_agrees_with_a_time_integration(swinging):
    times = np.linspace(0.0, 3 * swinging.period, 101)

    def slope(_, state):
        return [state[1], -(swinging.frequency**2) * np.sin(state[0])]

    start = [swinging.start_angle, 0.0]
    result = solve_ivp(slope, (0, times[-1]), start, "DOP853", t_eval=times, rtol=1e-12, atol=1e-14)
    swing = pendulum.solve(times, swinging)
    assert np.allclose(swing.angle, result.y[0], rtol=0, atol=1e-9)
    assert np.allclose(swing.rate, result.y[1], rtol=0, atol=1e-9)


@PENDULUMS
def test_pendulum_keeps_energy_and_its_hinge_force_is_newtons(swinging):
    swing = pendulum.solve(np.linspace(0.0, 10.0, 301), swinging)
    energy = swing.kinetic_energy + swing.potential_energy
    assert np.allclose(energy, energy[0], rtol=0, atol=1e-12 * np.max(np.abs(swing.potential_energy)))
    newton = swinging.mass * (swing.acceleration + np.array([0.0, swinging.gravity, 0.0]))
    assert np.allclose(swing.hinge_force, newton, rtol=0, atol=1e-12 * np.max(np.abs(newton)))
    # Euler about the centre of mass: inertia φ'' = (−c outward × hinge force)_z
    outward = swing.position / swinging.arm
    moment = np.cross(-swinging.arm * outward, swing.hinge_force)[:, 2]
    assert np.allclose(moment, swinging.inertia * swing.angle_acceleration, atol=1e-12 * np.max(np.abs(newton)))


def test_iftomm_a01_starts_at_minus_one_zero_and_has_the_known_period():
    swing = pendulum.solve(np.array([0.0, pendulum.IFTOMM_A01.period]))
    assert np.allclose(swing.position, [[-1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], atol=1e-12)
    # T = 4 K(sin 45°) √(l/g), K = Γ(1/4)² / (4 √π) = 1.854074677301372
    assert pendulum.IFTOMM_A01.period == pytest.approx(4 * 1.854074677301372 / np.sqrt(9.81), rel=1e-14)


def test_iftomm_a01_rod_carries_three_weights_at_the_bottom():
    # from the horizontal: φ'² = 2 g / l at the bottom, N = m (l φ'² + g) = 3 m g, at a quarter period
    swing = pendulum.solve(np.array([0.0, pendulum.IFTOMM_A01.period / 4]))
    assert swing.rod_force[0] == pytest.approx(0.0, abs=1e-12)
    assert swing.rod_force[1] == pytest.approx(3 * 9.81, rel=1e-12)


def test_andrews_squeezer_meets_its_published_end_values():
    found = andrews.solve(np.array([0.0, 0.03]), spring=True)
    np.testing.assert_allclose(found.q[-1], andrews.PUBLISHED, rtol=1e-9)
    assert np.abs(andrews.point(andrews.LOOPS, found.q[-1])[0]).max() < 1e-12
