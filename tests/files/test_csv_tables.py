"""Tables of CSV files: headings, units, separators, and what is wrong with its line."""

import pytest

from nivel.errors import ModelError
from nivel.files import parse_machine

START = """format: 1
bodies:
  arm: {mass: 3, inertia: [1, 1, 1]}
joints:
  boom: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
drivers:
  turn: {coordinate: boom, value: %s}
"""


def table(folder, csv, text):
    (folder / "c.csv").write_text(csv, encoding="utf-8")
    return parse_machine(START % text, str(folder / "m.yaml")).drivers[0].value


def faults(folder, csv, text):
    with pytest.raises(ModelError) as caught:
        table(folder, csv, text)
    return [
        f"{fault.file.rpartition('/')[2]}:{fault.line} {fault.path}: {fault.message}" for fault in caught.value.faults
    ]


@pytest.mark.parametrize(
    ("csv", "text"),
    [
        ("time [ms], boom [deg]\n0, 0\n500, 90\n1000, -45\n", "{csv: c.csv}"),
        ("time,boom\n0,0\n0.5,90\n1,-45\n", "{csv: c.csv, units: deg}"),
        ("t (s);x;boom (deg)\n0,0;1;0\n0,5;2;90\n\n1,0;3;-45\n", "{csv: c.csv, column: boom}"),
        ("boom\tt\n0\t0\n90\t0.5\n-45\t1\n", "{csv: c.csv, time: t, column: boom, units: deg, time_units: s}"),
    ],
)
def test_a_column_becomes_a_table_in_si(tmp_path, csv, text):
    found = table(tmp_path, csv, text)
    assert found.times == pytest.approx((0, 0.5, 1))
    assert found.values == pytest.approx((0, 1.5707963267948966, -0.7853981633974483))


def test_a_table_may_be_smooth_and_over_a_symbol(tmp_path):
    text = START.replace("drivers", "sensors").replace("turn: {coordinate: boom, value", "turn: {value")
    (tmp_path / "c.csv").write_text("angle [deg], value\n0, 1\n90, 2\n180, 4\n", encoding="utf-8")
    machine = parse_machine(text % "{csv: c.csv, of: boom.angle, interpolation: cubic}", str(tmp_path / "m.yaml"))
    value = machine.sensors[0].value
    assert (value.of, value.interpolation, value.times[2]) == ("boom.angle", "cubic", pytest.approx(3.141592653589793))


FAULTS = [
    (
        "t, boom\n0, 0\n1, x\n",
        "{csv: c.csv}",
        "c.csv:3 drivers.turn.value: a number was expected in the column `boom`, got ` x`",
    ),
    (
        "t, boom\n0, 0\n1\n",
        "{csv: c.csv}",
        "c.csv:3 drivers.turn.value: a number was expected in the column `boom`, got nothing",
    ),
    (
        "t, boom\n0, 0\n0, 1\n",
        "{csv: c.csv}",
        "c.csv:3 drivers.turn.value: `t` increases; 0 does not come after 0; delete one of both rows",
    ),
    ("0, 0\n1, 1\n", "{csv: c.csv}", "c.csv:1 drivers.turn.value: the first row names the columns"),
    ("t, a, boom\n0, 0, 0\n", "{csv: c.csv}", "m.yaml:7 drivers.turn.value.csv: `column` is missing"),
    ("t, boom\n0, 0\n", "{csv: c.csv, column: bom}", "the column `bom` is not known; did you mean `boom`?"),
    ("t, boom\n0, 0\n", "{csv: c.csv, units: frobs}", "m.yaml:7 drivers.turn.value.units: the unit `frobs`"),
    ("t, boom [kg]\n0, 0\n1, 1\n", "{csv: c.csv}", "`0.0 kg` is a mass (kg); an angle (rad) was expected"),
    ("t, boom\n0, 0\n", "{csv: c.csv, colum: boom}", "the key `colum` is not known; did you mean `column`?"),
    ("", "{csv: c.csv}", "a heading with two columns or more"),
    ("t, boom\n0, 0\n", "{csv: d.csv}", "m.yaml:7 drivers.turn.value.csv: there is no file"),
]


@pytest.mark.parametrize(("csv", "text", "fault"), FAULTS, ids=[fault for *_, fault in FAULTS])
def test_what_is_wrong_is_told_with_its_line(tmp_path, csv, text, fault):
    found = faults(tmp_path, csv, text)
    assert len(found) == 1, found
    assert fault in found[0]
