"""Everyday machines of textbooks, of which no file names a method: green, exact by closed forms, and as exact as the report says."""

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.special import ellipj, ellipk

import nivel
from lanes import tail
from nivel.analysis.plan.plan import plan_run
from nivel.machine.settings.run import SimulationSettings

ROOT = Path(__file__).parents[3]
EVERYDAY, EXAMPLES = ROOT / "benchmarks" / "everyday", ROOT / "examples"
NAMES = sorted(path.stem for path in EVERYDAY.glob("*.yaml"))
# how parallel cranks go on where all bars are in line is no question of steps
NOT_GREEN = {"coupling-rod"}
FEW = ["stiff-spring", "motor-at-its-limit", "disc-brake", "dripping-tank"]
# of the run that is taken for exact, and a share of the largest value of a variable, below which errors are its round-off
EXACT, ROUND_OFF = {"integrator": "radau", "tolerance": 1e-11}, 1e-10
# residuals, which are round-off themselves
LEFT_OUT = ("constraint_", "energy_error")
G = 9.81


def machine(name):
    return nivel.load(EVERYDAY / f"{name}.yaml")


def damped(t, *, mass, stiffness, damping, start=0.0, speed=0.0):
    """x of m ẍ + d ẋ + k x = 0."""
    decay = damping / (2.0 * mass)
    omega = np.sqrt(stiffness / mass - decay**2)
    return np.exp(-decay * t) * (start * np.cos(omega * t) + (speed + decay * start) / omega * np.sin(omega * t))


def pendulum(t):
    """θ = 2 asin(k sn(K - ω₀ t)), k = sin(θ₀/2), of a bar of 1 m with a square section of 4 cm."""
    m = np.sin(np.radians(30.0)) ** 2
    omega = np.sqrt(G * 0.5 / ((1.0 + 0.04**2) / 12.0 + 0.25))
    return 2.0 * np.arcsin(np.sqrt(m) * ellipj(ellipk(m) - omega * t, m)[0])


def vibrating(t, share):
    """An angle of two discs: both turn with 4 rad/s, and against each other with 10 rad/s · cos Ω t."""
    omega = np.sqrt(500.0 * (1.0 / 0.2 + 1.0 / 0.3))
    return 4.0 * t + share * 10.0 / omega * np.sin(omega * t)


def limited(t):
    """20 rad/s² up to 10 N m/gain below the speed of 20 rad/s, which then is approached with the rate gain/J."""
    first, rate = 19.98 / 20.0, 500.0 / 0.5
    later = np.maximum(t - first, 0.0)
    return 10.0 * np.minimum(t, first) ** 2 + 20.0 * later + 0.02 / rate * np.expm1(-rate * later)


def dc_motor(t):
    """L di/dt = u - R i - K ω, J dω/dt = K i - d ω, as the exponential of a matrix; the angle."""
    A = np.array(
        [[-1.0 / 2e-3, -0.2 / 2e-3, 0, 24.0 / 2e-3], [0.2 / 0.02, -0.004 / 0.02, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]]
    )
    return np.array([expm(A * each)[2, 3] for each in t])


def stopping(t, speed, deceleration):
    """The way of what is braked to rest."""
    t = np.minimum(t, speed / deceleration)
    return speed * t - 0.5 * deceleration * t**2


def geared(t):
    """J ω̇ = 2 N m - d ω, with what the gears of 3 and 4 to 1 make of inertias and damping at the motor."""
    J, d = 0.01 + 0.05 / 9.0 + 0.5 / 144.0, 0.6 / 144.0
    return 2.0 / d * (t + J / d * np.expm1(-d / J * t))


def tapped(t):
    """1000 N from 5 s to 5.001 s: the difference of two steps."""
    k, decay = 200.0, 0.5 / 4.0

    def step(s):
        omega = np.sqrt(k / 2.0 - decay**2)
        answer = 1000.0 / k * (1.0 - np.exp(-decay * s) * (np.cos(omega * s) + decay / omega * np.sin(omega * s)))
        return np.where(s > 0.0, answer, 0.0)

    return step(t - 5.0) - step(t - 5.001)


def bounced(t):
    """1 m/s to a spring at 0.5 m, half of a period on it, and back."""
    omega = 1000.0
    on, off = 0.5, 0.5 + np.pi / omega
    return np.select([t < on, t < off], [t, 0.5 + np.sin(omega * (t - on)) / omega], 0.5 - (t - off))


def bowled(t):
    """It slides until the friction μ m g at the lever h, by its depth less than r, has turned it with v/h; then it rolls."""
    v, mu, h, r = 4.0, 0.2, 0.0998, 0.1
    slides = np.minimum(t, v / (mu * G * (1.0 + h**2 / (0.4 * r**2))))
    return v * t - 0.5 * mu * G * slides**2 - mu * G * slides * (t - slides)


# Of the largest value. The stiff spring vibrates 159 times, each time with an error of its own.
WITHIN = {"stiff-spring": 3e-7}
CLOSED_FORMS = {
    ("stiff-spring", "rail.displacement"): lambda t: 1e-3 * np.cos(1000.0 * t),
    ("damped-oscillator", "rail.displacement"): lambda t: damped(t, mass=2.0, stiffness=200.0, damping=4.0, start=0.1),
    ("resonance", "rail.displacement"): lambda t: 3.0 / 400.0 * (np.sin(10.0 * t) - 10.0 * t * np.cos(10.0 * t)),
    ("torsional-vibrator", "a.angle"): lambda t: vibrating(t, 0.6),
    ("torsional-vibrator", "b.angle"): lambda t: vibrating(t, -0.4),
    ("pendulum", "hinge.angle"): pendulum,
    ("atwood", "b.displacement"): lambda t: 0.5 * G / 13.0 * t**2,
    ("motor-at-its-limit", "axle.angle"): limited,
    ("dc-motor", "axle.angle"): dc_motor,
    ("clutch", "b.angle"): lambda t: 40.0 * t - stopping(t, 40.0, 50.0),
    ("disc-brake", "axle.angle"): lambda t: stopping(t, 30.0, 25.0),
    ("sliding-block", "rail.displacement"): lambda t: stopping(t, 2.0, 0.3 * G),
    ("bowling-ball", "ball.position.x"): bowled,
    ("roller-on-a-slope", "roller.position.x"): lambda t: 3.3552 / 3.0 * t**2,
    ("gear-train", "a.angle"): geared,
    ("elastic-wall", "rail.displacement"): bounced,
    ("tapped-oscillator", "rail.displacement"): tapped,
}


@pytest.mark.parametrize(("name", "quantity"), CLOSED_FORMS)
def test_a_closed_form_is_met_within_a_ten_millionth(name, quantity):
    result = machine(name).simulate(verify=True)
    exact = CLOSED_FORMS[name, quantity](result.time)
    assert result.trust.verdict == "green"
    assert np.max(np.abs(result.array(quantity) - exact)) < WITHIN.get(name, 1e-7) * np.max(np.abs(exact))


@pytest.mark.parametrize("name", tail(NAMES, FEW))
def test_an_everyday_machine_is_green(name):
    trust = machine(name).simulate(verify=True).trust
    told = "\n".join(item.text for item in trust.items if item.verdict != "green")
    assert trust.verdict == ("amber" if name in NOT_GREEN else "green"), told


def ratios(machine, result):
    """(variable, estimated over true error, true error, the same as a share of its largest value) where it is above round-off: the largest
    of each number over all frames up to the end of the second run."""
    exact = machine.simulate(verify=False, output_interval=result.settings["output_interval"], **EXACT)
    known = np.isin(result.time, exact.time)
    for name in result.variables:
        if name.startswith(LEFT_OUT) or name not in exact.variables:
            continue
        true, given = exact.array(name)[np.isin(exact.time, result.time)], result.array(name)[known]
        estimate = result.estimated_error(name)[known]
        until = np.isfinite(estimate)
        size = np.nanmax(np.abs(true), initial=0.0)
        error = np.atleast_1d(np.nanmax(np.where(until, np.abs(given - true), 0.0), axis=0, initial=0.0))
        stated = np.atleast_1d(np.nanmax(np.where(until, estimate, 0.0), axis=0, initial=0.0))
        for index in map(tuple, np.argwhere((error > ROUND_OFF * size) & (size > 0.0))):
            yield f"{name}{[*map(int, index)]}", float(stated[index] / error[index]), error[index], error[index] / size


@pytest.mark.full
def test_stated_errors_are_at_least_a_third_of_the_true_ones():
    found = []
    for name in NAMES:
        one = machine(name)
        if one.beams:
            continue  # exact runs follow all their vibrations
        found += [ratio for _, ratio, _, _ in ratios(one, one.simulate(verify=True))]
    assert len(found) > 2000
    assert np.mean(np.array(found) >= 1.0 / 3.0) >= 0.95


@pytest.mark.parametrize(
    ("name", "settings", "integrator"),
    [
        ("hydraulic-press", {}, "extrapolated-euler"),
        ("hydraulic-press", {"tolerance": 1e-6}, "radau"),
        ("hydraulic-press", {"step": 2e-4, "output_interval": 7e-3}, "extrapolated-euler"),
        ("cantilever", {"tolerance": 1e-6}, "radau"),
        ("clutch", {"tolerance": 1e-6, "step": 2e-4}, "radau"),
        ("pendulum", {"tolerance": 1e-6, "output_interval": 7e-3}, "dopri5"),
    ],
)
def test_settings_go_with_a_method_that_has_them(name, settings, integrator):
    record = machine(name).record
    plan = plan_run(record.with_simulation(record.simulation.replace(**settings)), set(settings))
    assert plan.settings.integrator == integrator
    assert plan.settings.tolerance == (None if integrator == "extrapolated-euler" else settings["tolerance"])
    assert plan.reason


def test_machines_with_gas_begin_with_a_method_that_chooses_its_steps_but_step_by_step():
    record = nivel.load(EXAMPLES / "hydraulics" / "pneumatic-pusher.yaml").record
    kept = SimulationSettings(duration=record.simulation.duration)
    assert plan_run(record.replace(simulation=kept)).settings.integrator == "radau"
    assert plan_run(record.replace(simulation=kept), stepwise=True).settings.integrator == "extrapolated-euler"
