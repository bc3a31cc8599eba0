"""Inputs of a machine: laws read them, tables off line set them, results have them; against the closed form and SciPy."""

import itertools

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from nivel import Table
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files.reader import parse_machine
from nivel.files.writer import write_machine
from simulating import slide, solid

FORCE, MASS, DAMPING, TAU = 20.0, 2.0, 3.0, 0.1
TIMES, VALUES = (0.0, 0.4, 0.9, 1.0), (0.0, 1.0, 1.0, -0.5)
CART = {
    "bodies": {"cart": solid(MASS)},
    "joints": {"rail": slide("ground", "cart")},
    "inputs": {"lever": {"range": [-1, 1], "rate": 20}, "brake": {"range": [0, 2], "rest": 1}},
    "states": {"filtered": {"rate": f"(lever.value - filtered.value)/{TAU}"}},
    "forces": {
        "drive": {"type": "motor", "coordinate": "rail", "effort": f"{FORCE}*lever.value"},
        "drag": {"type": "motor", "coordinate": "rail", "effort": f"-{DAMPING}*brake.value*rail.displacement_rate"},
    },
    "events": {"half": {"when": "lever.value - 0.5", "direction": "rising"}},
    "simulation": {"duration": 1.2, "step": "1 ms", "output_interval": "10 ms"},
}


def cart(**changes):
    import yaml

    text = "format: 1\nname: cart\n" + yaml.safe_dump({**CART, **changes}, sort_keys=False)
    return Machine.from_record(parse_machine(text))


def expected(times):
    """x, v and the filtered lever, by SciPy on the equations written anew."""

    def rate(t, y):
        u = np.interp(t, TIMES, VALUES)
        return y[1], (FORCE * u - DAMPING * y[1]) / MASS, (u - y[2]) / TAU

    out, y = [np.zeros(3)], np.zeros(3)
    for a, b in itertools.pairwise(times):
        y = solve_ivp(rate, (a, b), y, rtol=1e-10, atol=1e-12, max_step=0.01).y[:, -1]
        out.append(y)
    return np.array(out)


@pytest.mark.parametrize("integrator", ["rk4", "radau", "generalised-alpha"])
def test_a_machine_follows_the_table_of_an_input(integrator):
    result = cart().simulate(inputs={"lever": Table(TIMES, VALUES)}, integrator=integrator)
    want = expected(result.time)
    tolerance = {"rk4": 1e-9, "radau": 1e-5, "generalised-alpha": 1e-4}[integrator]
    np.testing.assert_allclose(result.array("rail.displacement"), want[:, 0], atol=tolerance)
    np.testing.assert_allclose(result.array("state.filtered"), want[:, 2], atol=10 * tolerance)
    np.testing.assert_allclose(result.array("lever.value"), np.interp(result.time, TIMES, VALUES), atol=1e-12)
    (event,) = result.events
    assert event.time == pytest.approx(0.2, abs=1e-6)


def test_an_input_rests_without_a_signal():
    result = cart().simulate(duration=0.1)
    assert np.all(result.array("lever.value") == 0.0)
    assert np.all(result.array("brake.value") == 1.0)


def test_a_file_of_columns_has_units_and_gives_the_same_run(tmp_path):
    path = tmp_path / "lever.csv"
    path.write_text(
        "time [ms],lever [deg]\n" + "".join(f"{1e3 * t},{np.degrees(v)}\n" for t, v in zip(TIMES, VALUES, strict=True))
    )
    of_file = cart().simulate(inputs={"lever": path})
    of_table = cart().simulate(inputs={"lever": Table(TIMES, VALUES)})
    np.testing.assert_allclose(of_file.array("rail.displacement"), of_table.array("rail.displacement"), rtol=1e-12)


FAULTS = [
    ({"throttle": 0.5}, "there is no input `throttle`"),
    ({"lever": 2.0}, "2 at 0 s is outside the range from -1 to 1"),
    ({"lever": Table((0.0, 1.0), (0.0, 1.5))}, "1.5 at 1 s is outside the range"),
    ({"lever": Table((0.0, 0.01), (0.0, 1.0))}, "the value changes by 1; `rate` allows 0.2"),
    ({"lever": "missing.csv"}, "inputs.lever: .*missing.csv"),
]


@pytest.mark.parametrize(("inputs", "message"), FAULTS)
def test_what_an_input_cannot_follow_is_refused(inputs, message):
    with pytest.raises(ModelError, match=message):
        cart().simulate(inputs=inputs)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "1:1: the file is empty"),
        ("t,value\n0,1\n", "1:1: a first line `time,lever` or `time,value` was expected, got `t,value`"),
        ("time,value\n0,1\n1,x\n2\n", "(?s)3:1.*`x`.*4:1: there is no column 2"),
        ("time,value\n1,0\n0.5,0\n", "3:1: times increase"),
        ("time,value\n", "no line of numbers"),
    ],
)
def test_faults_of_a_file_of_columns_have_their_lines(tmp_path, text, message):
    path = tmp_path / "lever.csv"
    path.write_text(text)
    with pytest.raises(ModelError, match=message):
        cart().simulate(inputs={"lever": path})


RECORDS = [
    ({"range": [1, -1]}, "the least value comes first"),
    ({"range": [0, 1], "rest": 3}, "3 is outside the range from 0 to 1"),
    ({"signal": "sin(time)"}, "a number or a table of time was expected"),
    ({"signal": {"times": [0, 1, 2], "values": [0, 1, 0], "interpolation": "cubic"}}, "is `linear`"),
    ({"gamepad": {"dead_zone": 0.1}}, "one of `axis` and `button` is needed"),
    ({"gamepad": {"axis": 0, "button": 1}}, "one of `axis` and `button` is needed"),
    ({"keys": {"raise": ""}}, "a key such as `a` or `ArrowUp` was expected"),
    ({"control": "button", "stick": "left-x"}, "`stick` belongs to a slider"),
    ({"rate": 0}, "greater than zero"),
]


@pytest.mark.parametrize(("record", "message"), RECORDS)
def test_faults_of_an_input_are_told(record, message):
    with pytest.raises(ModelError, match=message):
        cart(inputs={"lever": record})


def test_an_input_that_is_misspelt_is_told_with_the_right_name():
    with pytest.raises(ModelError, match=r"did you mean `lever.value`"):
        cart(forces={"drive": {"type": "motor", "coordinate": "rail", "effort": "3*levr.value"}})


def test_inputs_come_back_from_a_file():
    machine = cart(
        inputs={
            **CART["inputs"],
            "lever": {"keys": {"raise": "D", "lower": "ArrowLeft"}, "gamepad": {"axis": 2, "exponent": 2}},
        }
    )
    lever = next(each for each in machine.record.inputs if each.name == "lever")
    assert lever.keys.raise_ == "d"
    assert parse_machine(write_machine(machine.record)) == machine.record
