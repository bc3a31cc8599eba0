"""Blocks of a control against closed forms, exact discrete solutions and SciPy's linear systems."""

from functools import cache

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, RegularGridInterpolator
from scipy.linalg import expm
from scipy.signal import TransferFunction, butter, lsim, step

from nivel.api import Machine
from nivel.files import parse_machine

START = """
format: 1
bodies:
  cart: {mass: 2, inertia: [1, 1, 1], velocity: [1, 0, 0]}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}
"""
# the cart moves by 1 m/s: rail.displacement is the time
BLOCKS = """
control:
  way_along: {type: signal, value: rail.displacement}
  wave: {type: signal, value: sin(7*time)}
  scaled: {type: gain, input: wave, gain: 3}
  total: {type: sum, inputs: [way_along, wave, 2], factors: [1, -2, 0.5]}
  cut: {type: limit, input: 2*wave, limits: [-1, 0.5]}
  dead: {type: dead-zone, input: wave, band: [-0.3, 0.4]}
  pick: {type: switch, when: wave > 0.5, then: 1, otherwise: way_along}
  look: {type: lookup, input: wave, points: [-1, 0, 1], values: [2, 0, 5]}
  integral: {type: integrator, input: wave, gain: 2, start: 0.3}
  full: {type: integrator, input: 1, limits: [0, 0.25]}
  second: {type: transfer-function, input: 1, numerator: [1, 3], denominator: [2, 1, 50]}
  second_sampled: {type: transfer-function, input: 1, numerator: [1, 3], denominator: [2, 1, 50], sample_time: 20 ms}
  slow: {type: low-pass, input: 1, frequency: 3 Hz, damping: 0.5*sqrt(2)}
  fast: {type: high-pass, input: 1, time_constant: 0.1}
  quiet: {type: notch, input: 1, frequency: 5 Hz, damping: 0.2}
  early: {type: lead-lag, input: 1, lead: 0.3, lag: 0.05}
  slope: {type: derivative, input: way_along, time_constant: 0.05}
  pair: {type: state-space, inputs: [1, way_along], A: [[0, 1], [-9, -2]], B: [[0, 1], [1, 0]], C: [[1, 0], [0, 2]], D: [[0, 0], [1, 1]]}
  late: {type: delay, input: way_along, time: 30 ms, sample_time: 10 ms}
  at_once: {type: signal, value: way_along, sample_time: 10 ms}
  part_late: {type: signal, value: way_along, sample_time: 10 ms, latency: 4 ms}
  one_late: {type: signal, value: way_along, sample_time: 10 ms, latency: 10 ms}
  after_one: {type: signal, value: one_late, sample_time: 10 ms}
  after_part: {type: signal, value: part_late, sample_time: 2 ms}
  dead_time: {type: delay, input: way_along, time: 37 ms, sample_time: 10 ms}
  after_dead: {type: signal, value: dead_time, sample_time: 1 ms}
  kept: {type: hold, input: wave, when: 0.101 - abs(time - 0.3), sample_time: 5 ms}
  coarse: {type: quantiser, input: wave, step: 0.25, limits: [-0.75, 1], sample_time: 5 ms}
  flat: {type: map, inputs: [wave, way_along], points: [[-1, 0, 1], [0, 0.5]], values: [[1, 2], [3, 5], [-1, 4]]}
  round:
    type: map
    inputs: [wave, way_along, wave]
    points: [[-1, 0, 1], [0, 0.5, 1], [-1, 0.2, 1]]
    values: [[1, 2, 3], [3, 5, 1], [-1, 4, 2], [1, 2, 3], [3, 5, 1], [-1, 4, 2.5], [1, 2, 3], [3, 5.5, 1], [-1, 4, 2]]
    interpolation: cubic
  offset_late: {type: signal, value: way_along, sample_time: 10 ms, latency: 25 ms, offset: 2 ms}
  mean: {type: moving-average, input: way_along, samples: 4, sample_time: 10 ms}
  held_back: {type: rate-limit, input: "step(time, 0.1, 0, 0.101, 1)", rate: 2, sample_time: 10 ms}
  relay: {type: hysteresis, input: wave, on: 0.5, off: -0.5, values: [3, 7], sample_time: 1 ms}
  trap: {type: trapezoid, last: -0.5, begin: 0.1, speed: 2, acceleration: 10}
  way: {type: waypoints, times: [0.1, 0.3, 0.5, 0.9], values: [0, 1, -1]}
simulation: {duration: 1, step: 1 ms, output_interval: 1 ms}
"""


def simulated(text, **settings):
    return Machine.from_record(parse_machine(text, allow_code=True)).simulate(**settings)


@cache
def lab(integrator):
    return simulated(START + BLOCKS, integrator=integrator, tolerance=1e-9 if integrator == "dopri5" else None)


def held(t, period, offset=0.0, late=0.0):
    """Time of the sample that holds at t, or -1 before the first."""
    k = np.floor((t - offset - late) / period + 1e-6)
    return np.where(k >= 0.0, k * period + offset, 0.0)


def state_space(t):
    """Both outputs of the block `pair`, whose inputs are 1 and t."""
    A, B = np.array([[0, 1], [-9, -2.0]]), np.array([[0, 1], [1.0, 0]])
    _, y, _ = lsim((A, B, [[1, 0], [0, 2]], [[0, 0], [1, 1]]), np.column_stack([np.ones_like(t), t]), t)
    return y.T


def trapezoid(t):
    """0.5 m backwards from 0.1 s on: to 2 m/s in 0.2 s and 0.2 m, 0.05 s at that speed, and back to rest."""
    s = t - 0.1
    return -np.select(
        [s < 0, s < 0.2, s < 0.25, s < 0.45], [0 * s, 5 * s**2, 0.2 + 2 * (s - 0.2), 0.5 - 5 * (0.45 - s) ** 2], 0.5
    )


def quintic(s):
    s = np.clip(s, 0.0, 1.0)
    return s**3 * (10 - 15 * s + 6 * s**2)


def rated(t):
    """A step at 0.1 s followed by 0.02 at each sample: 1 is in by a whole number of them."""
    return np.clip(0.02 * (np.floor(t / 0.01 + 1e-6) - 10), 0.0, 1.0)


def relay(t):
    """Off until sin 7 t > 0.5, on until it is less than -0.5, looked at each millisecond."""
    on, out = False, []
    for each in np.sin(7 * t):
        on = each > 0.5 or (on and each >= -0.5)
        out.append(7.0 if on else 3.0)
    return np.array(out)


def stepped(numerator, denominator, t):
    return step(TransferFunction(numerator, denominator), T=t)[1]


def expected(t):
    wave, w = np.sin(7 * t), 10 * np.pi
    second = stepped([1, 3], [2, 1, 50], t)
    low = butter(2, 6 * np.pi, analog=True)
    return {
        "scaled": 3 * wave,
        "total": t - 2 * wave + 1,
        "cut": np.clip(2 * wave, -1, 0.5),
        "dead": np.where(wave > 0.4, wave - 0.4, np.where(wave < -0.3, wave + 0.3, 0.0)),
        "pick": np.where(wave > 0.5, 1.0, t),
        "look": np.interp(wave, [-1, 0, 1], [2, 0, 5]),
        "integral": 0.3 + 2 * (1 - np.cos(7 * t)) / 7,
        "full": np.minimum(t, 0.25),
        "second": second,
        "second_sampled": second[np.rint(held(t, 0.02) * 1000).astype(int)],
        "slow": stepped(*low, t),
        "fast": np.exp(-10 * t),
        "quiet": stepped([1, 0, w**2], [1, 0.4 * w, w**2], t),
        "early": 1 + 5 * np.exp(-20 * t),
        "slope": 1 - np.exp(-20 * t),
        "pair": state_space(t)[0],
        "pair.y2": state_space(t)[1],
        "late": np.maximum(held(t, 0.01) - 0.03, 0.0),
        "at_once": held(t, 0.01),
        "part_late": held(t, 0.01, 0.0, 0.004),
        "one_late": held(t, 0.01, 0.0, 0.01),
        "after_one": held(t, 0.01, 0.0, 0.01),
        "after_part": held(t, 0.01, 0.0, 0.004),
        "dead_time": held(t, 0.01, 0.0, 0.037),
        "after_dead": held(t, 0.01, 0.0, 0.037),
        "kept": np.sin(7 * held(np.where((t < 0.1995) | (t > 0.4045), t, 0.195), 0.005)),
        "coarse": np.clip(0.25 * np.floor(np.sin(7 * held(t, 0.005)) / 0.25 + 0.5), -0.75, 1.0),
        "flat": RegularGridInterpolator(GRID[:2], FLAT)(np.column_stack([wave, np.minimum(t, 0.5)])),
        "round": np.array([rounded(*each) for each in zip(wave, t, strict=True)]),
        "offset_late": held(t, 0.01, 0.002, 0.025),
        "mean": np.mean([np.maximum(held(t, 0.01) - 0.01 * k, 0.0) for k in range(4)], axis=0),
        "held_back": rated(t - 0.0),
        "relay": relay(t),
        "trap": trapezoid(t),
        "way": quintic((t - 0.1) / 0.2) - 2 * quintic((t - 0.5) / 0.4),
    }


GRID = [-1, 0, 1], [0, 0.5], [0, 0.5, 1], [-1, 0.2, 1]
FLAT = [[1, 2], [3, 5], [-1, 4]]
ROUND = [[[1, 2, 3], [3, 5, 1], [-1, 4, 2]], [[1, 2, 3], [3, 5, 1], [-1, 4, 2.5]], [[1, 2, 3], [3, 5.5, 1], [-1, 4, 2]]]


def rounded(wave, t):
    """Natural cubic splines along one axis after the other."""
    values = np.array(ROUND)
    for points, at in zip((GRID[0], GRID[2], GRID[3]), (wave, t, wave), strict=True):
        values = CubicSpline(points, values, bc_type="natural")(at)
    return values


NAMES = list(expected(np.linspace(0.0, 1.0, 1001)))


@pytest.mark.parametrize("name", NAMES)
def test_a_block_gives_what_its_formula_says(name):
    result = lab("rk4")
    t = np.linspace(0.0, 1.0, 1001)
    # where a fixed step meets a limit, the integral has an error of the order of the step
    tolerance = 5e-4 if name == "full" else 3e-8
    np.testing.assert_allclose(result[f"control.{name}"], expected(t)[name], rtol=0, atol=tolerance)


@pytest.mark.parametrize("name", NAMES)
def test_steps_that_are_chosen_give_the_same(name):
    """A block whose value jumps does so a rounding error of the time earlier or later."""
    chosen, fixed = lab("dopri5")[f"control.{name}"], lab("rk4")[f"control.{name}"]
    off = np.abs(np.asarray(chosen) - np.asarray(fixed)) > 1e-6
    assert off.sum() <= 2


def test_the_rates_of_set_points_are_their_derivatives():
    result = lab("rk4")
    for name in ("trap", "way"):
        rate = np.gradient(np.asarray(result[f"control.{name}"]), 1e-3)
        np.testing.assert_allclose(result[f"control.{name}.rate"], rate, atol=0.02)


PID = """
control:
  wish: {type: signal, value: "step(time, 0.02, 0, 0.0201, 0.4)"}
  drive:
    {type: pid, reference: wish, measured: rail.displacement, kp: 300, ki: 900, kd: 30, filter_time: 4 ms, set_point_weight: 0.7,
     limits: [-30, 25], tracking_time: 50 ms, sample_time: 5 ms, %s}
forces:
  push: {type: motor, coordinate: rail, effort: drive}
  brake: {type: joint-spring-damper, coordinate: rail, stiffness: 70, damping: 4}
simulation: {duration: 1, step: 0.5 ms, output_interval: 0.5 ms}
"""


def sampled_pid(steps, late=0):
    """Displacement and force each half millisecond, of the cart with spring and damper and the controller of Åström and Hägglund.

    late : half milliseconds from a sample to its write.
    """
    T, h, Tf, Kp, Ki, Kd, weight, Tt = 5e-3, 5e-4, 4e-3, 300.0, 900.0, 30.0, 0.7, 0.05
    M = np.array([[0, 1, 0], [-35, -2, 0.5], [0, 0, 0]])
    exact = expm(M * h)
    x, force, out, integral, derivative, before, pending = np.array([0.0, 1.0]), 0.0, [], 0.0, 0.0, None, {}
    for n in range(steps + 1):
        if n % 10 == 0:
            r, y = (0.4 if n * h > 0.0201 else 0.0), x[0]
            a = Tf / (Tf + T)
            derivative = a * derivative + (1 - a) * Kd * ((y if before is None else before) - y) / T
            v = Kp * (weight * r - y) + integral + derivative
            u = min(max(v, -30.0), 25.0)
            integral += Ki * T * (r - y) + T / Tt * (u - v)
            before, pending[n + late] = y, u
        force = pending.pop(n, force)
        out.append((x[0], force))
        x = (exact @ [*x, force])[:2]
    return np.array(out).T


@pytest.mark.parametrize(("latency", "late"), [("0 s", 0), ("2 ms", 4), ("5 ms", 10), ("12 ms", 24)])
def test_a_sampled_controller_with_its_limits_is_the_exact_discrete_one(latency, late):
    result = simulated(START + PID % f"latency: {latency}")
    x, force = sampled_pid(2000, late)
    assert np.ptp(force) == pytest.approx(55.0)  # both limits were reached
    np.testing.assert_allclose(result["rail.displacement"], x, rtol=0, atol=1e-9)
    np.testing.assert_allclose(result["control.drive"], force, rtol=0, atol=3e-7)


def test_a_continuous_controller_is_the_linear_system_that_it_says():
    """Cart, integral of the error, filtered measured value: ẋ = A x + b."""
    kp, ki, kd, tf, m = 300.0, 900.0, 30.0, 0.01, 2.0
    text = f"""
control:
  drive: {{type: pid, input: 0.4 - rail.displacement, kp: {kp}, ki: {ki}, kd: {kd}, filter_time: {tf}}}
forces:
  push: {{type: motor, coordinate: rail, effort: drive}}
simulation: {{duration: 1, step: 0.2 ms, output_interval: 10 ms}}
"""
    result = simulated(START + text)
    # x, v, ∫e, z of ż = (e - z)/tf with u = kp e + ki ∫e + kd (e - z)/tf, e = 0.4 - x
    gain = kp + kd / tf
    A = np.array([[0, 1, 0, 0], [-gain / m, 0, ki / m, -kd / tf / m], [-1, 0, 0, 0], [-1 / tf, 0, 0, -1 / tf]])
    b = np.array([0, 0.4 * gain / m, 0.4, 0.4 / tf])
    rest, start = -np.linalg.solve(A, b), np.array([0, 1.0, 0, 0.4])
    exact = np.array([rest + expm(A * t) @ (start - rest) for t in result.time])
    np.testing.assert_allclose(result["rail.displacement"], exact[:, 0], rtol=0, atol=1e-8)


LOOP = """
control:
  outer: {type: gain, input: 0.3 - rail.displacement, gain: 8, sample_time: 10 ms}
  inner: {type: pid, reference: outer, measured: rail.displacement_rate, kp: 30, ki: 100, sample_time: 5 ms}
  force: {type: limit, input: inner, limits: [-50, 50]}
  seen: {type: signal, value: force + 1, sample_time: 5 ms}
forces:
  push: {type: motor, coordinate: rail, effort: force}
simulation: {duration: 0.5, step: 1 ms, output_interval: 1 ms}
"""


def test_the_order_in_the_file_does_not_matter_and_a_chain_has_no_delay():
    head, tail = LOOP.index("  outer"), LOOP.index("forces:")
    turned = LOOP[:head] + "\n".join(reversed(LOOP[head:tail].splitlines())) + "\n" + LOOP[tail:]
    first, second = simulated(START + LOOP), simulated(START + turned)
    for name in ("rail.displacement", "control.inner", "control.seen"):
        np.testing.assert_array_equal(first[name], second[name])
    np.testing.assert_array_equal(first["control.seen"], np.asarray(first["control.force"]) + 1)


@pytest.mark.parametrize("integrator", ["dopri5", "radau", "generalised-alpha", "ros2", "bdf"])
def test_all_methods_give_the_motion_of_the_sampled_loop(integrator):
    settings = {} if integrator in ("generalised-alpha", "ros2") else {"tolerance": 1e-9}
    if not settings:
        settings = {"step": 2.5e-4}
    reference = simulated(START + LOOP, step=2.5e-4, output_interval=5e-3)
    result = simulated(START + LOOP, integrator=integrator, output_interval=5e-3, **settings)
    off = np.abs(np.asarray(result["rail.displacement"]) - np.asarray(reference["rail.displacement"]))
    assert off.max() < (1e-5 if integrator in ("generalised-alpha", "ros2") else 2e-7)


def test_exact_tangents_hold_through_chains_of_signals():
    """A stiff continuous loop through signals, a table, a law and filters: Radau, whose tangents are exact, against dop853."""
    text = """
control:
  error: {type: signal, value: 0.3 - rail.displacement}
  curve: {type: lookup, input: 3*error, points: [-3, -1, 0, 1, 3], values: [-20, -4, 0, 4, 20], interpolation: cubic}
  quick: {type: low-pass, input: curve, time_constant: 0.2 ms}
  force: {type: limit, input: 40*quick - 10*rail.displacement_rate*abs(rail.displacement_rate), limits: [-100, 100]}
forces:
  push: {type: motor, coordinate: rail, effort: force}
simulation: {duration: 0.5, step: 1 ms, output_interval: 5 ms, tolerance: 1e-9}
"""
    stiff = simulated(START + text, integrator="radau")
    plain = simulated(START + text, integrator="dop853")
    np.testing.assert_allclose(stiff["rail.displacement"], plain["rail.displacement"], rtol=0, atol=1e-8)


STATE_MACHINE = """
control:
  cycle:
    type: state-machine
    sample_time: 10 ms
    states:
      wait: {next: {go: rail.displacement > 0.205}}
      go: {value: 5*rail.displacement, outputs: {valve: 2}, next: {stop: [cycle.time > 0.102, rail.displacement > 0]}}
      stop: {value: -1, next: {wait: 0 > 1}}
simulation: {duration: 0.5, step: 1 ms, output_interval: 1 ms}
"""


def test_a_state_machine_moves_on_at_the_first_sample_at_which_its_guards_hold():
    result = simulated(START + STATE_MACHINE)
    k = np.arange(501)
    state = np.select([k < 210, k < 320], [0.0, 1.0], 2.0)
    np.testing.assert_array_equal(result["control.cycle.state"], state)
    np.testing.assert_array_equal(result["control.cycle.valve"], np.where(state == 1, 2.0, 0.0))
    value = np.select([state == 0, state == 1], [0.0, 5 * np.floor(k / 10 + 1e-9) * 0.01], -1.0)
    np.testing.assert_allclose(result["control.cycle"], value, atol=1e-12)
    since = np.select([k < 210, k < 320], [k, k - 210], k - 320) * 1e-3
    np.testing.assert_allclose(result["control.cycle.time"], since, atol=1e-12)


SEVERAL = """
control:
  choice:
    type: state-machine
    sample_time: 10 ms
    states:
      wait: {next: {later: time > 0.305, first: rail.displacement > 0.105, second: rail.displacement > 0.055}}
      second: {next: {wait: choice.time > 0.025, first: choice.time > 0.045}}
      first: {next: {wait: time > 10, later: choice.time > 0.055}}
      later: {}
simulation: {duration: 0.4, step: 1 ms, output_interval: 10 ms}
"""


def test_the_first_transition_that_holds_is_taken_of_several():
    """The rail moves at 1 m/s. From 0.06 s on `second`, back after 30 ms, `second` again; from 0.12 s on `first` comes before it."""
    result = simulated(START + SEVERAL)
    k = np.arange(41)  # of samples
    wait, second, first, later = 0.0, 1.0, 2.0, 3.0
    expected = np.select(
        [k < 6, k < 9, k < 10, k < 13, k < 14, k < 20], [wait, second, wait, second, wait, first], later
    )
    np.testing.assert_array_equal(result["control.choice.state"], expected)


PYTHON = """
control:
  filtered:
    type: python
    law: {source: "%s", function: law, arguments: [rail.displacement, filtered.x, 3]}
    states: {x: 0.5}
    %s
simulation: {duration: 0.5, step: 1 ms, output_interval: 10 ms}
"""
TEXT = "def law(y, x, k):\\n    if y < 0.2:\\n        return x + y, k * (y - x)\\n    return x, 0.0\\n"


def test_a_block_in_python_has_states_of_its_own():
    """ẋ = 3 (t - x) until 0.2 s, x + t; then x rests. Sampled, the same numbers are the values after the sample."""
    continuous = simulated(START + PYTHON % (TEXT, ""))
    t = continuous.time
    x = t - 1 / 3 + (0.5 + 1 / 3) * np.exp(-3 * t)
    before = t < 0.199
    np.testing.assert_allclose(np.asarray(continuous["control.filtered"])[before], (x + t)[before], atol=1e-9)
    sampled = simulated(START + PYTHON % (TEXT, "sample_time: 10 ms"))
    state, values = 0.5, []
    for each in t:
        values.append(state + each if each < 0.2 - 1e-9 else state)
        state = 3 * (each - state) if each < 0.2 - 1e-9 else 0.0
    np.testing.assert_allclose(sampled["control.filtered"], values, atol=1e-9)


ARM = """
format: 1
gravity: [0, -9.81, 0]
bodies:
  arm: {mass: 3, centre_of_mass: [0.5, 0, 0], inertia: [0.1, 0.3, 0.3]}
joints:
  hinge: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
control:
  hold: {type: pid, input: 0.4 - hinge.angle, kp: 60, ki: 40, kd: 8, limits: [-40, 40], filter_time: 20 ms%s}
forces:
  motor: {type: motor, coordinate: hinge, effort: hold}
simulation: {duration: 1, step: 1 ms, start: equilibrium}
"""


@pytest.mark.parametrize("sampled", ["", ", sample_time: 4 ms"])
def test_a_run_from_equilibrium_stands_still_under_its_controller(sampled):
    """At rest the error is zero, and the integral carries the weight: 3 · 9.81 · 0.5 cos 0.4."""
    result = simulated(ARM % sampled)
    np.testing.assert_allclose(result["hinge.angle"], 0.4, rtol=0, atol=1e-9)
    np.testing.assert_allclose(result["control.hold.integral"], 3 * 9.81 * 0.5 * np.cos(0.4), rtol=1e-7)


def test_what_forces_report_is_seen_by_samples_and_events():
    text = """
forces:
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 50}
control:
  tension: {type: signal, value: spring.magnitude, sample_time: 10 ms}
events:
  tight: {when: abs(spring.magnitude) - 5}
simulation: {duration: 0.2, step: 1 ms, output_interval: 1 ms}
"""
    result = simulated(START + text)
    x = np.sin(5 * result.time) / 5
    held_at = np.rint(held(result.time, 0.01) * 1000).astype(int)
    np.testing.assert_allclose(np.abs(result["control.tension"]), 50 * np.abs(x[held_at]), atol=1e-8)
    (event,) = result.events
    assert event.time == pytest.approx(np.arcsin(0.5) / 5, abs=1e-8)


def test_a_block_that_stays_at_its_limit_is_said():
    text = """
control:
  stuck: {type: pid, input: 5 + rail.displacement, kp: 3, limits: [-1, 1]}
  free: {type: pid, input: rail.displacement, kp: 1, limits: [-1, 1]}
simulation: {duration: 0.5, step: 1 ms}
"""
    result = simulated(START + text)
    assert any("stuck stood at its limits" in str(item) for item in result.trust.items)
    assert not any("free stood" in str(item) for item in result.trust.items)


def test_a_driver_follows_a_smooth_step():
    text = """
drivers:
  move: {coordinate: rail, value: "step(time, 0.1, 0, 0.4, 0.2) + step(time, 0.5, 0, 0.7, -0.1)"}
simulation: {duration: 1, step: 1 ms, output_interval: 10 ms}
"""
    result = simulated(START.replace("velocity: [1, 0, 0]", "velocity: [0, 0, 0]") + text)
    t = result.time
    way = 0.2 * quintic((t - 0.1) / 0.3) - 0.1 * quintic((t - 0.5) / 0.2)
    np.testing.assert_allclose(result["rail.displacement"], way, rtol=0, atol=1e-12)
    s = np.clip((t - 0.1) / 0.3, 0, 1)
    force = 2 * 0.2 / 0.3**2 * 60 * s * (1 - s) * (1 - 2 * s)
    np.testing.assert_allclose(result["driver.move.effort"][t < 0.49], force[t < 0.49], rtol=0, atol=1e-9)


@pytest.mark.parametrize(("sampled", "verdict"), [("", "green"), (", sample_time: 4 ms", "amber")])
def test_statics_say_of_stability_what_they_know(sampled, verdict):
    """Under the continuous controller small motions die out; of a sampled one nothing is claimed."""
    result = Machine.from_record(parse_machine(ARM % sampled)).statics()
    (stability,) = [item for item in result.trust.items if item.name == "stability"]
    assert stability.verdict == verdict
    assert ("not determined" in stability.text) == bool(sampled)
    np.testing.assert_allclose(result["hinge.angle"], 0.4, rtol=0, atol=1e-9)


BUS = """
control:
  way_along: {type: signal, value: rail.displacement}
  can: {type: bus, inputs: {place: way_along, twice: 2*way_along}, cycle: 20 ms, sample_time: 1 ms, latency: 2 ms, jitter: 5 ms, lost: 0.2}
  hiss: {type: noise, deviation: 2, band: [10 Hz, 50 Hz], seed: 3}
  other: {type: noise, deviation: 2, band: [10 Hz, 50 Hz], seed: 4}
simulation: {duration: 40, step: 1 ms, output_interval: 1 ms}
"""


@cache
def imperfect():
    return simulated(START + BUS)


def test_messages_of_a_bus_arrive_once_a_cycle_with_their_jitter():
    t, place = imperfect().array("time"), imperfect().array("control.can.place")
    np.testing.assert_array_equal(imperfect().array("control.can"), place)
    np.testing.assert_allclose(imperfect().array("control.can.twice"), 2 * place, atol=1e-12)
    come = np.flatnonzero(np.diff(place)) + 1
    ways = t[come] - place[come]  # a message has the time at which it was sent
    assert np.allclose(place[come] / 0.02, np.rint(place[come] / 0.02), atol=1e-9)
    assert ways.min() > 0.002
    assert ways.max() < 0.007 + 1e-9
    counts = np.bincount(np.rint(1e3 * ways).astype(int), minlength=8)[3:8]
    share, n = len(come) / 2000, len(come)
    assert share == pytest.approx(0.8, abs=4 * np.sqrt(0.16 / 2000))
    np.testing.assert_allclose(counts / n, 0.2, atol=4 * np.sqrt(0.16 / n))


def test_noise_has_its_deviation_and_its_band():
    t, hiss = imperfect().array("time"), imperfect().array("control.hiss")
    power = np.abs(np.fft.rfft(hiss * np.hanning(len(t)))) ** 2
    frequency = np.fft.rfftfreq(len(t), 1e-3)
    inside = (frequency > 9.9) & (frequency < 50.1)
    assert power[~inside].sum() < 1e-4 * power.sum()
    halves = [power[(frequency > low) & (frequency < low + 20)].sum() / power.sum() for low in (10, 30)]
    np.testing.assert_allclose(halves, 0.5, atol=0.03)
    assert hiss.std() == pytest.approx(2.0, rel=0.01)
    assert np.mean(hiss**4) / hiss.var() ** 2 == pytest.approx(3.0, abs=0.15)  # of a normal distribution
    assert abs(np.corrcoef(hiss, imperfect().array("control.other"))[0, 1]) < 0.1


def test_a_late_value_is_late_once_in_a_chain_of_samples():
    """Each of n blocks is T late: the last is n T late, whether the others are sampled with it or between."""
    chain = "".join(
        f"  b{k}: {{type: signal, value: {'rail.displacement' if not k else f'b{k - 1}'}, sample_time: 10 ms, latency: {late} ms}}\n"
        for k, late in enumerate((10, 20, 4, 10))
    )
    result = simulated(f"{START}control:\n{chain}simulation: {{duration: 0.3, step: 1 ms, output_interval: 1 ms}}")
    t = result.array("time")
    np.testing.assert_allclose(result.array("control.b1"), held(t, 0.01, 0.0, 0.03), atol=1e-12)
    # the third takes a sample at multiples of 10 ms, and the fourth takes what came 4 ms after one at the next
    np.testing.assert_allclose(result.array("control.b3"), held(t - 0.02, 0.01, 0.0, 0.03), atol=1e-12)
