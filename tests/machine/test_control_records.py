"""What is refused of a control, with file, line and element, and what blocks read."""

import pytest

from nivel import Expression
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.files.writer import write_machine

START = """format: 1
gravity: [0, -9.81, 0]
bodies:
  arm: {mass: 3, centre_of_mass: [0.5, 0, 0], inertia: [0.1, 0.3, 0.3]}
joints:
  boom: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
forces:
  drive: {type: motor, coordinate: boom, effort: 10}
control:
"""


def faults(*blocks):
    with pytest.raises(ModelError) as caught:
        parse_machine(START + "".join(f"  {block}\n" for block in blocks), "m.yaml")
    return [f"{fault.line} {fault.path}: {fault.message}" for fault in caught.value.faults]


ONE_BLOCK = [
    (
        "a: {type: gain, input: 2*a, gain: 2}",
        "10 control.a.input: `a` depends on its own value at the same instant: an algebraic loop",
    ),
    (
        "a: {type: pid, input: 1 - boom.angel, kp: 1}",
        "10 control.a.input: `boom` has no `angel`; did you mean `boom.angle`?",
    ),
    (
        "a: {type: pid, input: 1 m - boom.angle, kp: 1}",
        "10 control.a.input: `1 m - boom.angle`: `boom.angle` is an angle (rad); a length",
    ),
    (
        "a: {type: pid, input: 1, kp: 1, sample_time: -1 ms}",
        "10 control.a.sample_time: a time greater than zero was expected",
    ),
    ("a: {type: pid, input: 1, kp: 1, latency: 1 ms}", "10 control.a.latency: `latency` belongs to a sampled block"),
    (
        "a: {type: pid, input: 1, kp: 1, sample_time: 1 ms, latency: 1 s}",
        "10 control.a.latency: the latency is 1000 samples",
    ),
    ("a: {type: pid, input: 1}", "10 control.a: all gains are zero"),
    ("a: {type: pid, input: 1, measured: 1, kp: 1}", "10 control.a.measured: `measured` stands in place of `input`"),
    ("a: {type: pid, kp: 1}", "10 control.a: a controller needs its `input`"),
    ("a: {type: pid, input: 1, kd: 1}", "10 control.a: `filter_time` is missing"),
    ("a: {type: pid, input: 1, ki: 1, limits: [0, 1]}", "10 control.a: `tracking_time` is missing"),
    ("a: {type: limit, input: 1, limits: [1, -1]}", "10 control.a.limits: the lower limit comes first"),
    ("a: {type: pidd, input: 1}", "10 control.a: the type `pidd` is not known; did you mean `pid`?"),
    ("m: {type: gain, input: 1, gain: 1}", "10 control.m: `m` is a unit; choose another name"),
    ("time: {type: gain, input: 1, gain: 1}", "10 control.time: `time` has a meaning already"),
    ("a: {type: sum, inputs: [1, 2], factors: [1]}", "10 control.a.factors: there are 2 inputs and 1 factors"),
    ("a: {type: low-pass, input: 1}", "10 control.a: a filter needs `time_constant` or `frequency`; got neither"),
    (
        "a: {type: high-pass, input: 1, time_constant: 1, start: 2}",
        "10 control.a.start: there is no steady state with the value 2",
    ),
    (
        "a: {type: transfer-function, input: 1, numerator: [1, 2, 3], denominator: [1, 2]}",
        "10 control.a.numerator: the numerator has a higher power of s (2) than the denominator (1)",
    ),
    (
        "a: {type: state-space, inputs: [1], A: [[1, 2]], B: [[1]], C: [[1]]}",
        "10 control.a.A: a matrix of 1 rows and 1 columns was expected, got 1 rows of 2",
    ),
    ("a: {type: noise, deviation: 1, band: [3, 2]}", "10 control.a.band: a band is from a frequency to a higher one"),
    (
        "a: {type: noise, deviation: 1, band: [0, 60], sample_time: 10 ms}",
        "10 control.a.band: samples of every 0.01 s have frequencies up to 50 Hz, got 60 Hz",
    ),
    ("a: {type: quantiser, input: 1, step: 1}", "10 control.a: `sample_time` is missing"),
    (
        "a: {type: bus, inputs: [1, level], cycle: 1 ms, sample_time: 1 ms}",
        "10 control.a.inputs: signals with names were expected, as in `inputs: {angle: hinge.angle}`",
    ),
    ("a: {type: map, inputs: [1], points: [[1, 2]], values: [[1, 2]]}", "10 control.a.inputs: a map has two or three"),
    (
        "a: {type: map, inputs: [1, 2], points: [[1, 2], [3, 4]], values: [[1, 2]]}",
        "10 control.a.values: 2 rows of 2 values were expected",
    ),
    (
        "a: {type: bus, inputs: {x: 1}, cycle: 10 ms, sample_time: 1 ms, latency: 5 ms, jitter: 5 ms}",
        "10 control.a.jitter: messages arrive before the next is sent",
    ),
    (
        "a: {type: bus, inputs: {x: 1}, cycle: 2.5 ms, sample_time: 1 ms}",
        "10 control.a.cycle: 0.0025 s is no whole number of samples",
    ),
    ("a: {type: delay, input: 1, time: 3.5 ms}", "10 control.a: `sample_time` is missing"),
    (
        "a: {type: rate-limit, input: 1, rate: 1}",
        "10 control.a: `sample_time` is missing, or for a continuous one the `time_constant`",
    ),
    ("a: {type: hysteresis, input: 1, on: 1, off: 2, sample_time: 1}", "10 control.a.off: `off` is less than `on`"),
    ("a: {type: lookup, input: 1, points: [0, 0], values: [1, 2]}", "10 control.a.points: points increase strictly"),
    ("a: {type: waypoints, times: [0, 1, 0.5], values: [0, 1, 2]}", "10 control.a.times: times increase"),
    (
        "a: {type: cascade, measured_speed: 1, speed_gain: 1, reference: 1}",
        "10 control.a: of a position controller `measured`",
    ),
    (
        "a: {type: switch, when: drive.power > 2, then: 1, otherwise: 2}",
        "10 control.a.when: `drive.power` is known only when",
    ),
    (
        "a: {type: signal, value: drive.magnitude}",
        "10 control.a.value: `drive.magnitude` is known only when all forces are",
    ),
    ("a: {type: state-machine, sample_time: 1, states: {x: {next: {y: 1 == 2}}}}", "`==` is hardly ever true"),
    (
        "a: {type: state-machine, sample_time: 1, states: {x: {next: {y: 1 > 2}}}}",
        "`x` leads to a state that is not there",
    ),
    ("a: {type: state-machine, sample_time: 1, states: {x: {next: {x: boom.angl > 2}}}}", "`boom` has no `angl`"),
]


@pytest.mark.parametrize(("block", "fault"), ONE_BLOCK, ids=[fault for _, fault in ONE_BLOCK])
def test_a_faulty_block_is_named_with_its_line(block, fault):
    found = faults(block)
    assert len(found) == 1, found
    assert fault in found[0]


def test_an_algebraic_loop_through_blocks_is_named():
    (found,) = faults(
        "a: {type: gain, input: c, gain: 2}",
        "b: {type: low-pass, input: a, time_constant: 1}",
        "c: {type: sum, inputs: [a, boom.angle]}",
    )
    assert found.startswith("10 control.a.input: `a`, `c` depend on each other at the same instant: an algebraic loop")


@pytest.mark.parametrize(
    "cut",
    [
        "a: {type: low-pass, input: c, time_constant: 1}",
        "a: {type: delay, input: c, time: 1 ms, sample_time: 1 ms}",
        "a: {type: gain, input: c, gain: 2, sample_time: 1 ms, latency: 1 ms}",
        "a: {type: transfer-function, input: c, numerator: [1], denominator: [1, 1]}",
        "a: {type: integrator, input: c}",
    ],
)
def test_what_has_no_direct_feedthrough_cuts_a_loop(cut):
    machine = parse_machine(f"{START}  {cut}\n  c: {{type: gain, input: a, gain: 2}}\n", "m.yaml")
    assert parse_machine(write_machine(machine), "m.yaml") == machine


def test_all_faults_of_a_control_come_at_once():
    found = faults(
        "a: {type: gain, input: boom.angl, gain: 1}",
        "b: {type: gain, input: b, gain: 1}",
        "c: {type: switch, when: boom.angl > 1, then: 1, otherwise: 2}",
    )
    assert [each.split(":")[0] for each in found] == ["10 control.a.input", "11 control.b.input", "12 control.c.when"]


def test_states_and_blocks_share_their_names():
    with pytest.raises(ModelError, match="states and blocks of the control share their names"):
        parse_machine(f"{START}  a: {{type: gain, input: 1, gain: 1}}\nstates:\n  a: {{rate: 1}}\n", "m.yaml")


def test_a_fixed_step_that_misses_samples_is_refused_at_the_block():
    machine = parse_machine(f"{START}  a: {{type: gain, input: 1, gain: 1, sample_time: 1.5 ms}}\n", "m.yaml")
    with pytest.raises(ModelError, match=r"control.a.sample_time.*no whole number of steps"):
        Machine.from_record(machine).simulate(duration=0.1, integrator="rk4", step=1e-3)


PART = """format: 1
bodies:
  arm: {mass: 3, centre_of_mass: [0.5, 0, 0], inertia: [0.1, 0.3, 0.3]}
joints:
  boom: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
control:
  hold: {type: pid, input: 0.2 - boom.angle, kp: 3}
  steps: {type: state-machine, sample_time: 1 ms, states: {x: {next: {y: hold > 1}}, y: {value: arm.x}}}
forces:
  drive: {type: motor, coordinate: boom, effort: hold}
"""


def test_blocks_of_placed_parts_take_signals_of_their_part(tmp_path):
    (tmp_path / "part.yaml").write_text(PART, encoding="utf-8")
    turned = "orientation: {axis: [0, 0, 1], angle: 90 deg}"
    text = f"format: 1\nassemblies:\n  left: {{file: part.yaml, position: [0, 1, 0], {turned}, prefix: left_}}\n"
    machine = parse_machine(text, str(tmp_path / "m.yaml"))
    hold, steps = machine.control
    assert hold.input.text == "0.2 - left_boom.angle"
    assert machine.forces[0].effort.text == "left_hold.value"
    assert steps.states[0].next[0].when[0].signals == ("left_hold.value",)
    assert "left_arm.y" in steps.states[1].value.text


def test_a_smooth_step_is_the_quintic_with_its_exact_derivatives():
    """10 s³ - 15 s⁴ + 6 s⁵ between 1 s and 3 s, from 2 to 5; derivatives by differences."""
    step = Expression("step(time, 1, 2, 3, 5)")
    for t in (0.0, 1.0, 1.3, 2.0, 2.9, 3.0, 4.0):
        s = min(max((t - 1) / 2, 0), 1)
        assert step(t) == pytest.approx(2 + 3 * (10 * s**3 - 15 * s**4 + 6 * s**5), rel=1e-14)
        assert step.derivative(t) == pytest.approx((step(t + 1e-6) - step(t - 1e-6)) / 2e-6, abs=1e-8)
        rate = step.derivative
        assert rate.derivative(t) == pytest.approx((rate(t + 1e-6) - rate(t - 1e-6)) / 2e-6, abs=1e-5)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("step(time, 0, 0, 1)", "`step` takes 5 arguments, got 4"),
        ("step(time, 0, 1 m, 1 s, 2 kg)", "a length (m) and a mass (kg) cannot be joined"),
        ("step(boom.angle, 0 rad, 1, 1 m, 2)", "cannot be compared"),
    ],
)
def test_faulty_steps(text, fault):
    (found,) = faults(f'a: {{type: signal, value: "{text}"}}')
    assert fault in found
