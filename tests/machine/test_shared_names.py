"""Parameters that have the name of a unit or of a constant: which of the two a name is, and what is said of it."""

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nivel import PointForce, Torque
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.parameters import resolve
from nivel.machine.units.arithmetic import bind, evaluate
from nivel.machine.units.grammar import parse
from nivel.machine.units.measure import measure, name_notes
from nivel.machine.units.quantity import read_quantity
from nivel.machine.units.tree import ExpressionError, Number
from nivel.machine.units.unit import UNITS, dimension

NAMES = {
    "m": Number(3.0, dimension(kg=1)),
    "g": Number(9.81, dimension(m=1, s=-2)),
    "h": Number(0.5, dimension(m=1)),
    "t": Number(7.0),
    "e": Number(0.3),
    "k": Number(2.0),
}


def meant(text):
    tree = bind(parse(text), NAMES)
    return evaluate(tree), measure(tree)


@pytest.mark.parametrize(
    ("text", "value", "its"),
    [
        ("3 m", 3.0, dimension(m=1)),
        ("3*m", 9.0, dimension(kg=1)),
        ("m*g", 29.43, dimension(kg=1, m=1, s=-2)),
        ("m*9.81 m/s^2", 29.43, dimension(kg=1, m=1, s=-2)),
        ("9.81 m/s^2*m", 29.43, dimension(kg=1, m=1, s=-2)),
        ("5 g", 0.005, dimension(kg=1)),
        ("5*g", 49.05, dimension(m=1, s=-2)),
        ("2 h", 7200.0, dimension(s=1)),
        ("h/(2 h)", 0.5 / 7200, dimension(m=1, s=-1)),
        ("1 t", 1000.0, dimension(kg=1)),
        ("t/2", 3.5, None),
        ("2*e", 0.6, None),
        ("2 e", 0.6, None),
        ("exp(1)", math.e, None),
        ("10 N*m", 10.0, dimension(kg=1, m=2, s=-2)),
        ("-1 kg*m^2", -1.0, dimension(kg=1, m=2)),
        ("(10 N*m)*2", 20.0, dimension(kg=1, m=2, s=-2)),
        ("(10 N)*m", 30.0, dimension(kg=2, m=1, s=-2)),
        ("2*(10 N m)", 20.0, dimension(kg=1, m=2, s=-2)),
        ("20 N/m*h", 10.0, dimension(kg=1, m=1, s=-2)),
        ("5 N*s/m + 0", 5.0, dimension(kg=1, s=-1)),
        ("2 kg/(m*s)", 2.0, dimension(kg=1, m=-1, s=-1)),
        ("k*1 N/m", 2.0, dimension(kg=1, s=-2)),
        ("F/m", 4.0, dimension(m=1, s=-2)),
    ],
)
def test_a_name_is_the_unit_after_a_number_and_the_parameter_elsewhere(text, value, its):
    text = text.replace("F", "(12 N)")
    found, dimension_found = meant(text)
    assert found == pytest.approx(value, rel=1e-14)
    assert dimension_found == its


@pytest.mark.parametrize("text", ["10 N*m + 3", "2 kg*g*k", "2*(5 N*h)"])
def test_what_may_be_either_is_refused_with_both_ways_to_write_it(text):
    with pytest.raises(ExpressionError, match="may be the unit or the parameter: write a space in place"):
        meant(text)


# quantities as they stand in files, which no parameter changes
plain = st.builds(
    "{}{} {}{}".format,
    st.sampled_from(["", "-"]),
    st.sampled_from(["3", "0.5", "1e3"]),
    st.sampled_from(sorted(set(UNITS) - {"°"})),
    st.lists(
        st.tuples(st.sampled_from([" ", "*", "/"]), st.sampled_from(["m", "kg", "s", "N", "m^2", "s^-1"])).map("".join),
        max_size=2,
    ).map("".join),
)


@settings(max_examples=200, deadline=None)
@given(plain)
def test_no_parameter_changes_a_quantity_with_units(text):
    try:
        expected = bind(parse(text), {})
    except ExpressionError:
        return  # `3 m/s kg`: which part the last unit belongs to is unclear
    if re.search(r"/.*\*", text):
        return  # what multiplies a quotient of units is the parameter
    found = bind(parse(text), dict.fromkeys(UNITS, Number(17.0)))
    assert evaluate(found) == evaluate(expected)
    assert measure(found) == measure(expected)


@pytest.mark.parametrize("name", sorted(set(UNITS) - {"°", "min"}))
def test_every_unit_may_be_the_name_of_a_parameter(name):
    values, faults = resolve({name: 2.0, "twice": f"2*{name}", "unit": f"3 {name}"})
    assert not faults
    assert values["twice"] == Number(4.0)
    assert values["unit"] == Number(3.0 * UNITS[name].factor, UNITS[name].dimension)


@pytest.mark.parametrize("name", ["pi", "time", "sin", "min", "lookup", "and"])
def test_functions_and_other_words_stay_reserved(name):
    _, faults = resolve({name: 1})
    assert "has a meaning already" in faults[name]


def test_a_parameter_with_the_name_of_a_unit_may_be_used_before_it_is_defined():
    values, faults = resolve({"weight": "m*g", "L": "2 m", "m": "L*1 kg/m", "g": "9.81 m/s^2"})
    assert not faults
    assert values["weight"] == Number(19.62, dimension(kg=1, m=1, s=-2))


def test_the_notes_name_the_parameter_and_what_it_is_not():
    (units, constant) = name_notes(NAMES)
    assert units == (
        "in expressions `m` (3 kg), `g` (9.81 m/s^2), `h` (0.5 m) and `t` (7) are the parameters, not the metre, the gram, the hour"
        " and the tonne; directly after a number they are the units: `2 m`"
    )
    assert constant == "in expressions `e` (0.3) is the parameter, not the constant 2.7183"
    assert name_notes({"length": Number(2.0), "m": None}) == ()


MACHINE = """\
format: 1
parameters: {m: 3 kg, g: 9.81 m/s^2, e: 0.3, h: 50 cm}
functions:
  bump(e): 2*e
gravity: [0, 0, -g]
bodies:
  rod: {mass: m, inertia: [1 kg*m^2, 2 kg m^2, 3], position: [0, 0, 2*h]}
joints:
  rail: {type: translational, bodies: [ground, rod], point: [0, 0, 0], axis: [0, 0, 1]}
forces:
  lift: {type: force, body: rod, vector: [0, 0, m*g + 20 N/m*(h - rod.z) + bump(e)]}
"""


def test_a_machine_is_read_with_such_parameters():
    machine = parse_machine(MACHINE, "machine.yaml")
    (rod,), (lift,) = machine.bodies, machine.forces
    assert rod.position is not None
    assert rod.inertia is not None
    assert (rod.mass, rod.position[2], machine.gravity[2]) == (3.0, 1.0, -9.81)
    assert (rod.inertia.xx, rod.inertia.yy) == (1.0, 2.0)
    assert isinstance(lift, PointForce)
    assert isinstance(lift.vector[2], Expression)
    assert lift.vector[2](0.0, {"rod.z": 0.1}) == pytest.approx(29.43 + 8.0 + 0.6)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("position: [0, 0, 2*h]", "position: [0, 0, 2*m]", "(`m` is the parameter here, not the metre)"),
        ("mass: m", "mass: 2 kg*g", "(`g` is the gram here; the parameter is written `(2 N)*g`)"),
        ("mass: m", "mass: 2*h", "(`h` is the parameter here, not the hour)"),
    ],
)
def test_a_fault_says_which_of_the_two_a_name_is(old, new, said):
    with pytest.raises(ModelError) as caught:
        parse_machine(MACHINE.replace(old, new), "machine.yaml")
    assert said in str(caught.value)


def test_a_parameter_called_t_is_not_taken_for_a_slip():
    with pytest.raises(ModelError) as caught:
        parse_machine(MACHINE.replace("m: 3 kg", "m: 3 kg, t: 2 kg").replace("2*h", "2*t"), "machine.yaml")
    assert "the time is written" not in str(caught.value)
    assert "(`t` is the parameter here, not the tonne)" in str(caught.value)


@pytest.mark.parametrize(("name", "said"), [("L", "litre is `l` or `dm^3`"), ("l", "litre is `L` or `dm^3`")])
def test_a_parameter_that_takes_the_litre_away_is_named(name, said):
    text = f"format: 1\nparameters: {{{name}: 1.2 m}}\nhydraulics:\n  supply: {{type: volume, volume: 0.5 {name}}}\n"
    with pytest.raises(ModelError, match=f"`{name}` is your parameter; {re.escape(said)}"):
        parse_machine(text, "a.yaml")


def test_a_part_takes_such_parameters_from_the_file_that_uses_it(tmp_path):
    (tmp_path / "part.yaml").write_text(MACHINE.replace("gravity: [0, 0, -g]\n", ""), encoding="utf-8")
    whole = "format: 1\nparameters: {m: 5 kg}\nassemblies:\n  a: {file: part.yaml, parameters: {m: 2*m, h: 7 m, g: 2 m/s^2}}\n"
    machine = parse_machine(whole, str(tmp_path / "whole.yaml"))
    (rod,) = machine.bodies
    assert rod.mass == 10.0
    assert rod.position is not None
    assert rod.position[2] == pytest.approx(14.0)


def test_columns_of_csv_files_keep_their_units(tmp_path):
    (tmp_path / "lift.csv").write_text("time [s],force [N/m*m],torque [N*m]\n0,1,2\n1,3,4\n", encoding="utf-8")
    text = MACHINE + "  turn: {type: torque, body: rod, vector: [{csv: lift.csv, column: torque}, 0, 0]}\n"
    machine = parse_machine(text, str(tmp_path / "machine.yaml"))
    turn = machine.forces[1]
    assert isinstance(turn, Torque)
    assert isinstance(turn.vector[0], Table)
    assert turn.vector[0].values == (2.0, 4.0)


def test_quantities_in_python_know_no_parameters():
    assert read_quantity("2*m", "length", {}) == 2.0
