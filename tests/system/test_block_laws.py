"""Laws of blocks are programs: what each computes, and that none needs a compiler."""

import math
import sys
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from nivel import PythonLaw
from nivel.elements.control import BLOCKS
from nivel.elements.control.units import CBlock, FmuBlock, UserBlock
from nivel.files import parse_machine
from nivel.kernels.record import program
from nivel.machine.control.order import parts_of
from nivel.machine.control.part import beyond, bounded_rate, limited
from nivel.machine.machine_record import MachineRecord
from nivel.system.laws.program import expression_program

sys.path.insert(0, str(Path(__file__).parents[1] / "machine"))
from everything import EVERYTHING

VALUES = (-2.0, -1.0, -0.3, 0.0, 0.4, 0.5, 1.7)


def value(law, time=0.0, **values):
    """Of a formula; values : of its symbols, by the names of the parts of a block."""
    arguments = [time, *(values[path.partition(".")[2] or path] for path in law.signals)]
    return program.run.code(np.array([*expression_program(law, ["time", *law.signals]), *arguments]))


def control(*blocks):
    text = "format: 1\nbodies: {mass: {mass: 2 kg, inertia: [1, 1, 1]}}\njoints:\n"
    text += "  rail: {type: translational, bodies: [ground, mass], point: [0, 0, 0], axis: [1, 0, 0]}\ncontrol:\n"
    return parse_machine(text + "".join(f"  {block}\n" for block in blocks)).control


def law_of(block, name):
    """The function of a part of a block."""
    (found,) = [each.part.function for each in parts_of(control(block)) if each.part.name == name]
    return found


def test_no_block_but_one_in_python_has_a_law_that_is_compiled():
    machine = MachineRecord.model_validate(EVERYTHING, context={"parameters": {}})
    assert {type(block) for block in machine.control} == set(BLOCKS.records) - {
        FmuBlock,
        CBlock,
    }  # their files stand beside a machine
    for each in parts_of(machine.control):
        assert isinstance(each.part.function, PythonLaw) == isinstance(each.block, UserBlock), each.path


def test_limits_bands_and_rates_at_limits():
    for x, rate in product(VALUES, VALUES):
        assert value(limited("x", (-1.0, 0.5)), x=x) == min(max(x, -1.0), 0.5)
        assert value(beyond("x", (-1.0, 0.5)), x=x) == (x - 0.5 if x > 0.5 else x + 1.0 if x < -1.0 else 0.0)
        held = (x >= 0.5 and rate > 0.0) or (x <= -1.0 and rate < 0.0)
        assert value(bounded_rate("rate", "x", (-1.0, 0.5)), x=x, rate=rate) == (0.0 if held else rate)


@pytest.mark.parametrize(
    "law", [limited("x", (-1.0, 1.0)), beyond("x", (-1.0, 1.0)), bounded_rate("x", "x", (-1.0, 1.0))]
)
def test_what_is_no_number_stays_none(law):
    assert math.isnan(value(law, x=math.nan))


def test_a_rate_limit_follows_within_its_rates():
    sampled = law_of("a: {type: rate-limit, input: rail.displacement, rates: [-2, 3], sample_time: 0.1}", "value")
    smooth = law_of("a: {type: rate-limit, input: rail.displacement, rates: [-2, 3], time_constant: 0.5}", "value")
    for x, target in product(VALUES, VALUES):
        assert value(sampled, before=x, input=target) == pytest.approx(x + min(max(target - x, -0.2), 0.3), abs=1e-15)
        assert value(smooth, value=x, input=target) == min(max((target - x) / 0.5, -2.0), 3.0)


def test_a_relay_keeps_its_state_between_its_thresholds():
    law = law_of("a: {type: hysteresis, input: rail.displacement, on: 0.45, off: -0.5, sample_time: 0.1}", "on")
    for x, on in product(VALUES, (0.0, 1.0)):
        assert value(law, input=x, on=on) == (1.0 if x > 0.45 else 0.0 if x < -0.5 else on)


@pytest.mark.parametrize(("last", "speed"), [(-0.5, 2.0), (3.0, 1.0), (0.5, 50.0)])
def test_a_trapezoid_ends_exactly_and_its_rate_is_its_slope(last, speed):
    """A way with and without a stretch at top speed; the slope by differences within the parabolas, which are exact."""
    block = control(f"a: {{type: trapezoid, first: 0.2, last: {last}, begin: 0.1, speed: {speed}, acceleration: 10}}")[
        0
    ]
    place, rate = (each.function for each in block.parts)
    assert [value(place, t) for t in (-1.0, 0.1)] == [0.2, 0.2]
    assert [value(place, t) for t in (rate.times[-1], 9.0)] == [last, last]
    for before, after in zip(rate.times, rate.times[1:], strict=False):
        t, h = 0.5 * (before + after), 0.1 * (after - before)
        slope = np.interp(t, rate.times, rate.values)
        assert (value(place, t + h) - value(place, t - h)) / (2 * h) == pytest.approx(slope, rel=1e-12)


def test_a_machine_of_many_states_takes_the_first_transition_that_holds():
    states = [
        f"s{k}: {{value: {k * k}, next: {{s{(k + 3) % 9}: [x > 1, x > 2], s{(k + 1) % 9}: x > 0}}}}" for k in range(9)
    ]
    text = f"cycle: {{type: state-machine, sample_time: 0.1, states: {{{', '.join(states)}}}}}".replace("x >", "time >")
    block = control(text)[0]
    functions = {part.name: part.function for part in block.parts}
    for state, x in product(range(9), (-1.0, 0.5, 1.5, 2.5)):
        guards = {name: value(law, x) for name, law in functions.items() if name.startswith("guard")}
        after = (state + 3) % 9 if x > 2.0 else (state + 1) % 9 if x > 0.0 else state
        assert value(functions["state"], state=state, **guards) == after
        assert value(functions["value"], state=state) == state * state


def test_as_many_waypoints_as_one_likes():
    times = [0.1 * k for k in range(200)]
    block = control(f"way: {{type: waypoints, times: {times}, values: {[float(k % 3) for k in range(200)]}}}")[0]
    place, rate = (each.function for each in block.parts)
    assert [value(place, time) for time in times[:9]] == pytest.approx([0, 1, 2] * 3, abs=1e-12)
    assert value(rate, 0.05) == pytest.approx(1.875 / 0.1)  # 30 s² (1 - s)² at a half, over the time
