"""The references of joints, couplings and forces checked: second ways, conservation, known numbers."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from references import andrews, dyads, guided, impact, kepler, rssr, stick_slip
from references.oscillator import Oscillator
from references.rubbing import RubbingPendulum, TwoSliders

TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}


@pytest.mark.parametrize("damping", [0.0, 0.3, 1.0, 2.5], ids=["undamped", "under", "critical", "over"])
def test_oscillator_agrees_with_a_time_integration(damping):
    plain = Oscillator(1.7, 40.0)
    one = Oscillator(1.7, 40.0, damping * plain.critical_damping)
    times = np.linspace(0, 3, 31)
    found = solve_ivp(
        lambda _t, y: [y[1], -(one.damping * y[1] + one.stiffness * y[0]) / one.mass],
        (0, 3),
        [0.1, -0.4],
        t_eval=times,
        **TIGHT,
    )
    x, v = one.motion(times, 0.1, -0.4)
    np.testing.assert_allclose(x, found.y[0], atol=1e-11)
    np.testing.assert_allclose(v, found.y[1], atol=1e-10)


def test_bead_obeys_its_equation_and_the_torque_is_the_change_of_momentum():
    bead = guided.Bead(0.3, 0.1, 2.0)
    t, h = np.linspace(0, 1, 11), 1e-4
    second = (bead.displacement(t + h) - 2 * bead.displacement(t) + bead.displacement(t - h)) / h**2
    np.testing.assert_allclose(second, 4.0 * bead.displacement(t), atol=1e-6)

    def momentum(t):
        return bead.mass * bead.displacement(t) ** 2 * bead.speed

    np.testing.assert_allclose(bead.torque(t), (momentum(t + h) - momentum(t - h)) / (2 * h), atol=1e-8)


def test_spherical_pendulum_agrees_with_cartesian_coordinates_and_a_multiplier():
    """m r̈ = m g - T r/L with T = m (L v·v/L² ... ): |r| = L twice differentiated gives T/m = (v·v + g·r)/L, g downwards."""
    length, g, mass = 0.8, 9.81, 2.0
    times = np.linspace(0, 3, 31)
    swing = guided.spherical_pendulum(times, mass, length, g, 1.0, 2.0)
    down = np.array([0, 0, -g])

    def slope(_t, y):
        r, v = y[:3], y[3:]
        return np.concatenate([v, down - (v @ v + down @ r) / length**2 * r])

    start = [length * np.sin(1.0), 0, -length * np.cos(1.0), 0, length * np.sin(1.0) * 2.0, 0]
    found = solve_ivp(slope, (0, 3), start, t_eval=times, **TIGHT)
    np.testing.assert_allclose(swing.position, found.y[:3].T, atol=1e-10)
    tension = mass * (np.sum(found.y[3:] ** 2, axis=0) + down @ found.y[:3]) / length
    np.testing.assert_allclose(swing.tension, tension, atol=1e-9)


def test_conical_pendulum_keeps_its_angle():
    theta, length, g = 0.7, 0.8, 9.81
    swing = guided.spherical_pendulum(np.linspace(0, 2, 5), 1.0, length, g, theta, np.sqrt(g / length / np.cos(theta)))
    np.testing.assert_allclose(swing.position[:, 2], -length * np.cos(theta), atol=1e-12)
    np.testing.assert_allclose(swing.tension, g / np.cos(theta), rtol=1e-11)


def test_falling_rod_keeps_its_energy_and_its_floor_carries_its_weight():
    m, a, J, g = 2.0, 0.5, 2.0 * 1.0 / 12, 9.81
    times = np.linspace(0, 0.6, 6001)
    fall = guided.falling_rod(times, m, a, J, g, 0.3)
    kinetic = 0.5 * (J + m * a**2 * np.sin(fall.angle) ** 2) * fall.rate**2
    np.testing.assert_allclose(kinetic + m * g * a * np.cos(fall.angle), m * g * a * np.cos(0.3), rtol=1e-10)
    # momentum: ∫ (N - m g) dt = m ẏ
    velocity = -a * np.sin(fall.angle) * fall.rate
    impulse = np.trapezoid(fall.floor_force - m * g, times)
    assert impulse == pytest.approx(m * velocity[-1], abs=1e-5)


@pytest.mark.parametrize("restitution", [0.05, 0.3, 0.7, 0.95, 0.999])
@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.2])
def test_damping_number_gives_the_restitution_whatever_the_exponent(restitution, exponent):
    _, out, _ = impact.integrated(0.7, 3e4, exponent, 1.3, restitution)
    assert out == pytest.approx(restitution * 1.3, rel=1e-8)
    assert impact.rebound_speed(impact.damping_number(restitution) / 1.3, 1.3) == pytest.approx(out, rel=1e-8)


def test_damping_number_tends_to_three_halves_of_the_loss():
    assert impact.damping_number(0.9999) == pytest.approx(1.5e-4, rel=1e-3)
    assert impact.damping_number(1.0) == 0.0


@pytest.mark.parametrize("exponent", [1.0, 1.5, 3.0])
def test_undamped_impact_takes_the_closed_time(exponent):
    time, out, depth = impact.integrated(0.7, 3e4, exponent, 1.3, 1.0)
    assert time == pytest.approx(impact.duration(0.7, 3e4, exponent, 1.3), rel=1e-8)
    assert depth == pytest.approx(impact.deepest(0.7, 3e4, exponent, 1.3), rel=1e-9)
    assert out == pytest.approx(1.3, rel=1e-9)


def test_impact_durations_are_the_known_ones():
    assert impact.duration(2.0, 800.0, 1.0, 0.3) == pytest.approx(np.pi * np.sqrt(2.0 / 800.0), rel=1e-12)
    # Johnson, Contact Mechanics (1985), section 11.4: T = 2.94 δmax/v
    hertz = impact.duration(2.0, 1e9, 1.5, 0.3) * 0.3 / impact.deepest(2.0, 1e9, 1.5, 0.3)
    assert hertz == pytest.approx(2.94328, abs=1e-5)
    x = quad(lambda u: 2 * u / np.sqrt(1 - (1 - u * u) ** 2.5), 0, 1)[0]  # ∫ dx/√(1 - x^2.5), x = 1 - u²
    assert hertz == pytest.approx(2 * x, rel=1e-8)


def test_hertz_stiffness_of_steel_on_steel():
    """E* = E/(2 (1 - ν²)); two equal spheres have R/2."""
    one = impact.hertz_stiffness((0.01,), (210e9, 210e9), (0.3, 0.3))
    assert one == pytest.approx(4 / 3 * 210e9 / (2 * 0.91) * 0.1, rel=1e-12)
    assert impact.hertz_stiffness((0.01, 0.01), (210e9, 210e9), (0.3, 0.3)) == pytest.approx(one / np.sqrt(2))


def test_orbit_agrees_with_a_time_integration():
    orbit = kepler.Orbit(strength=3.0, reduced_mass=0.6, semi_axis=1.4, eccentricity=0.5)
    times = np.linspace(0, orbit.period, 21)

    def slope(_t, y):
        r = np.hypot(y[0], y[1])
        return [y[2], y[3], *(-3.0 / 0.6 * y[:2] / r**3)]

    start = [orbit.pericentre, 0, 0, orbit.speed_at_pericentre]
    found = solve_ivp(slope, (0, orbit.period), start, t_eval=times, **TIGHT)
    np.testing.assert_allclose(orbit.position(times), found.y[:2].T, atol=1e-9)


def test_sliding_to_rest_agrees_with_a_time_integration():
    times = np.linspace(0, 1, 21)
    found = solve_ivp(lambda _t, v: -3.0 * np.tanh(v / 0.05), (0, 1), [2.0], "DOP853", t_eval=times, rtol=1e-12)
    np.testing.assert_allclose(stick_slip.sliding_to_rest(times, 3.0, 0.05, 2.0), found.y[0], atol=1e-7)


DRAWN = stick_slip.Drawn(mass=1.5, stiffness=600.0, speed=0.05, load=14.7, static=0.4, kinetic=0.25)


def test_stick_slip_closed_form_agrees_with_its_integration():
    times = np.linspace(0, 4, 401)
    way, rests = DRAWN.integrated(times)
    np.testing.assert_allclose(way, DRAWN.closed_form(times), atol=1e-9)
    period = DRAWN.slip_duration + DRAWN.stick_duration
    expected = DRAWN.first_slip + DRAWN.slip_duration + period * np.arange(len(rests))
    assert len(rests) == 10
    np.testing.assert_allclose(rests, expected, atol=1e-8)


def test_stribecks_curve_tends_to_constant_friction():
    end = DRAWN.first_slip + DRAWN.slip_duration
    errors = []
    for speed in (1e-2, 1e-3, 1e-4, 1e-5):
        drawn = stick_slip.Drawn(**{**DRAWN.__dict__, "stribeck": speed})
        errors.append(drawn.integrated(np.array([0.0, 0.5]))[1][0] - end)
    # the block leaves rest, and comes to it, over the speeds at which the curve bends: a root of them in time
    assert all(0 < after < 0.5 * before for before, after in itertools.pairwise(errors)), errors
    assert errors[-1] < 2e-4


def test_bristle_creeps_below_and_slides_above_the_static_load():
    """Steady sliding carries μ(v) N; a held block keeps the bristle at pull/(σ0 N)."""
    times = np.linspace(0, 1, 11)
    curve, sigma = (0.4, 0.25, 0.01), (1e4, 100.0)
    x, v, z = stick_slip.bristle(times, 1.0, 10.0, curve, sigma, lambda t: min(t, 0.5) * 5.0)
    assert z[-1] == pytest.approx(2.5 / (1e4 * 10), rel=1e-3)
    assert abs(x[-1] - z[-1]) < 1e-4
    _, v, _ = stick_slip.bristle(times, 1.0, 10.0, curve, sigma, lambda t: 6.0)
    np.testing.assert_allclose(np.diff(v)[4:] / 0.1, 6.0 - 0.25 * 10, rtol=1e-3)


PIN = RubbingPendulum(mass=2.0, arm=0.4, inertia=2.0 * 0.16 + 0.02, coefficient=0.3, radius=0.03)


def test_rubbing_pendulum_loses_what_its_pin_takes():
    """Energy: d/dt (½ J φ̇² - m g l cos φ) = -μ r N |φ̇|; over a swing the regularised one tends to the dry one."""
    times = np.linspace(0, 4, 201)
    angle, turns = PIN.dry(times, 1.2)
    assert len(turns) > 4
    assert all(abs(b) < abs(a) for a, b in itertools.pairwise(turns))
    errors = [np.abs(PIN.regularised(times, 1.2, v) - angle).max() for v in (2e-4, 1e-4)]
    assert errors[1] < errors[0] < 2e-2
    # small swings: the loss of amplitude per half swing is 2 μ r/l, where N = m g
    small = RubbingPendulum(mass=2.0, arm=0.4, inertia=0.34, coefficient=0.01, radius=0.03)
    turns = np.abs(small.dry(np.linspace(0, 3, 11), 0.05)[1])
    np.testing.assert_allclose(-np.diff(turns), 2 * 0.01 * 0.03 / 0.4, rtol=5e-3)


def test_two_sliders_without_friction_keep_their_energy():
    pair = TwoSliders(1.0, 2.0, 1.0, 0.0, 1e-3)
    angle, _ = pair.motion(np.linspace(0, 0.8, 81), 0.6, lambda t: 40.0)
    rate = np.gradient(angle, 0.01, edge_order=2)
    kinetic = 0.5 * rate**2 * (1.0 * np.sin(angle) ** 2 + 2.0 * np.cos(angle) ** 2)
    work = 40.0 * (np.cos(0.6) - np.cos(angle)) - 2.0 * 9.81 * (np.sin(angle) - np.sin(0.6))
    np.testing.assert_allclose(kinetic, work, atol=0.02 * work.max())


def test_two_sliders_lock_themselves():
    """Slow upward motion needs S = m_B g/(s - μ c); towards tan θ = μ the rod force grows beyond all bounds."""
    pair = TwoSliders(1.0, 2.0, 1.0, 0.5, 1e-6)

    def needed(angle):
        state = pair._state(angle, 1e-3)
        low, high = 0.0, 1e5
        for _ in range(200):
            middle = 0.5 * (low + high)
            _, ay, _ = pair.solve(state, middle)
            low, high = (middle, high) if ay < 0 else (low, middle)
        return pair.solve(state, high)[2]

    c, s = np.cos(0.8), np.sin(0.8)
    assert needed(0.8) == pytest.approx(2.0 * 9.81 / (s - 0.5 * c), rel=1e-4)
    assert needed(np.arctan(0.5) + 0.02) > 10 * needed(0.8)


SIX = dyads.SixBar(0.1, 0.32, 0.2, 0.22, -0.6, 0.35, 0.25, (0.3, 0.05), (0.62, -0.1))


def test_six_bar_keeps_its_lengths():
    points = SIX.points(np.linspace(0, 2 * np.pi, 73))
    for pair, length in (("AB", 0.32), ("BC", 0.2), ("CD", 0.22), ("DE", 0.35), ("EF", 0.25)):
        np.testing.assert_allclose(np.hypot(*(points[pair[0]] - points[pair[1]])), length, atol=1e-14)
    turn = np.sum((points["B"] - points["C"]) * (points["D"] - points["C"]), axis=0) / (0.2 * 0.22)
    np.testing.assert_allclose(turn, np.cos(0.6), atol=1e-13)


CRANK = rssr.Arm((0, 0, 0), (0, 0, 1), (0.06, 0, 0))
ROCKER = rssr.Arm((0.3, 0.1, 0.2), (0, 1, 0), (0.28, 0.1, 0.35))


@pytest.mark.parametrize("branch", [1, -1])
def test_rssr_closes_and_its_slope_is_the_derivative(branch):
    rod = 0.45
    angle = np.linspace(0, 2 * np.pi, 49)
    out = rssr.output(CRANK, ROCKER, rod, angle, branch)
    np.testing.assert_allclose(np.linalg.norm(ROCKER.at(out) - CRANK.at(angle), axis=1), rod, atol=1e-14)
    h = 1e-6
    difference = rssr.output(CRANK, ROCKER, rod, angle + h, branch) - rssr.output(CRANK, ROCKER, rod, angle - h, branch)
    np.testing.assert_allclose(rssr.slopes(CRANK, ROCKER, angle, out), difference / (2 * h), atol=1e-8)


def test_andrews_squeezer_meets_its_published_rates_accelerations_and_multipliers():
    """Rates to the eight digits of the published ones, accelerations and multipliers to six: those came from a method
    that holds the loops closed in position only."""
    found = andrews.solve(np.array([0.0, 0.03]), spring=True)
    np.testing.assert_allclose(found.qdot[-1], andrews.PUBLISHED_RATES, rtol=1e-7)
    second, multipliers = andrews.solved(found.q[-1], found.qdot[-1], spring=True)
    np.testing.assert_allclose(second, andrews.PUBLISHED_ACCELERATIONS, rtol=2e-6)
    np.testing.assert_allclose(multipliers, andrews.PUBLISHED_MULTIPLIERS, rtol=2e-6)
