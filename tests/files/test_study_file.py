"""Study files: what they say, every fault at its place, and the schema for editors."""

from pathlib import Path

import pytest

import nivel
from nivel.analysis.sweep.resolution import resolve
from nivel.errors import ModelError
from nivel.files.study_file import study_and_faults, study_schema

MACHINE = """
format: 1
parameters: {stiffness: 100 N/m}
bodies: {block: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
forces: {spring: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: stiffness}}
simulation: {duration: 1, step: 1 ms}
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "machine.yaml").write_text(MACHINE, encoding="utf-8")
    return tmp_path


def parsed(text, file="study.yaml", **words):
    found, faults = study_and_faults(text, file, **words)
    if faults:
        raise ModelError(faults)
    return found


def study(folder, text, **words):
    content = f"format: 1\nmachine: machine.yaml\n{text}"
    (folder / "study.yaml").write_text(content, encoding="utf-8")
    return parsed(content, str(folder / "study.yaml"), **words)


def resolved(folder, text):
    found = study(folder, text)
    return resolve(found, nivel.load(found.machine_file))


def told(error):
    """line, path and message of every fault."""
    return [(each.line, each.path, each.message) for each in error.value.faults]


def test_nominal_values_are_those_of_the_machine(folder):
    found = resolved(
        folder,
        "parameters:\n"
        "  block.mass: {type: tolerance, tolerance: 10 g}\n"
        "  parameters.stiffness: {type: normal, deviation: 1 N/m}\n"
        "design: random\nsamples: 3\n",
    )
    assert found.parameters["block.mass"].bounds == pytest.approx((1.99, 2.01), rel=1e-15)
    assert found.parameters["parameters.stiffness"].mean == 100.0


def test_all_faults_of_a_file_are_told_at_once_with_their_lines(folder):
    text = (
        "parameters:\n"  # line 3
        "  a: {type: rang, from: 1, to: 2}\n"
        "  b: 3\n"
        "  c: {type: range, from: 1 kg, to: 1 m, count: 2}\n"
        "  d: {csv: nothing.csv}\n"
        "outputs:\n"
        "  e: {type: max, off: x}\n"
        "  f: {type: python, python: f.py, function: f}\n"
        "  g: {type: final, of: x, at_least: 2 N, at_most: 1 N}\n"
        "design: sobol\n"
    )
    with pytest.raises(ModelError) as error:
        study(folder, text)
    faults = told(error)
    assert [(line, path) for line, path, _ in faults] == [
        (4, "parameters.a"),
        (5, "parameters.b"),
        (6, "parameters.c.to"),
        (7, "parameters.d.csv"),
        (9, "outputs.e.off"),
        (10, "outputs.f.python"),
        (11, "outputs.g.at_most"),
        (12, "design"),
    ]
    assert "did you mean `range`" in faults[0][2]
    assert "`1 m` is a length (m), but `1 kg` is a mass (kg)" in faults[2][2]
    assert "--allow-code" in faults[5][2]


def test_all_that_does_not_fit_the_machine_is_told_at_its_line(folder):
    text = (
        "set: {block.mas: 3}\n"
        "parameters:\n"
        "  block.mass: {type: range, from: 1 m, to: 2 m, count: 2}\n"
        "  parameters.stiffness: {type: range, from: 1 N/m, to: 2 N/m, count: 2}\n"
        "  blok.mass: [1, 2]\n"
        "settings: {step: -1 ms, durtion: 3}\n"
    )
    with pytest.raises(ModelError) as error:
        resolved(folder, text)
    assert [(line, path) for line, path, _ in told(error)] == [
        (3, "set.block.mas"),
        (5, "parameters.block.mass.from"),
        (7, "parameters.blok.mass"),
        (8, "settings.step"),
        (8, "settings.durtion"),
    ]


def test_faults_of_the_file_and_of_what_does_not_fit_its_machine_are_told_at_once(folder):
    text = (
        "parameters:\n"  # line 3
        "  block.mass: {type: rang, from: 1, to: 2}\n"
        "  blok.mass: [1, 2]\n"
        "outputs:\n"
        "  a: {type: max, off: x}\n"
        "  b: {type: max, of: rail.displacment}\n"
        "desing: rows\n"
        "samples: 3\n"
        "settings: {durtion: 3}\n"
    )
    (folder / "study.yaml").write_text(f"format: 1\nmachine: machine.yaml\n{text}", encoding="utf-8")
    with pytest.raises(ModelError) as error:
        nivel.load_study(folder / "study.yaml")
    assert sorted((line, path) for line, path, _ in told(error)) == [
        (4, "parameters.block.mass"),
        (5, "parameters.blok.mass"),
        (7, "outputs.a.off"),
        (8, "outputs.b.of"),
        (9, "desing"),
        (11, "settings.durtion"),
    ]
    machine = (folder / "machine.yaml").read_text(encoding="utf-8")
    (folder / "machine.yaml").write_text(machine.replace("mass: 2", "mas: 2"), encoding="utf-8")
    with pytest.raises(ModelError) as error:
        nivel.load_study(folder / "study.yaml")
    assert {"study.yaml", "machine.yaml"} == {Path(each.file).name for each in error.value.faults}


@pytest.mark.parametrize("text", ["machine: [1]\n", "parameters: {a: [1]}\n", "machine: machine.yaml\ndesign: sobol\n"])
def test_a_study_whose_machine_cannot_be_asked_tells_what_is_wrong_in_itself(folder, text):
    (folder / "study.yaml").write_text(f"format: 1\n{text}", encoding="utf-8")
    with pytest.raises(ModelError) as error:
        nivel.load_study(folder / "study.yaml")
    assert {Path(each.file).name for each in error.value.faults} == {"study.yaml"}


def test_outputs_and_histories_that_no_run_has_are_told_before_anything_runs(folder):
    text = (
        "parameters: {block.mass: [1, 2]}\n"
        "outputs:\n"
        "  a: {type: max, of: rail.displacment}\n"
        "  b: {type: max, of: rail.displacement, at_most: 3 N}\n"
        "  c: {type: event-time, event: hit}\n"
        "  d: {type: rms, of: block.position}\n"
        "  e: {type: integral, of: rail.displacement.rate, at_most: 5 mm}\n"
        "  f: {type: final, of: force.spring.magnitude, at_least: 2 kN}\n"
        "save: [rail.displacement, block.velocty]\n"
    )
    with pytest.raises(ModelError) as error:
        resolved(folder, text)
    faults = told(error)
    assert [(line, path) for line, path, _ in faults] == [
        (5, "outputs.a.of"),
        (6, "outputs.b.at_most"),
        (7, "outputs.c.event"),
        (8, "outputs.d.of"),
        (11, "save"),
    ]
    assert "did you mean `rail.displacement`" in faults[0][2]
    assert "the number is in m" in faults[1][2]
    assert "as block.position.x" in faults[3][2]
    assert "did you mean `block.velocity`" in faults[4][2]


def test_a_tolerance_in_another_unit_is_told_as_it_is_written(folder):
    with pytest.raises(ModelError, match="`10 mm` is a length") as error:
        resolved(
            folder,
            "parameters: {block.mass: {type: tolerance, tolerance: 10 mm}}\ndesign: random\nsamples: 2\n",
        )
    assert told(error)[0][1] == "parameters.block.mass.tolerance"


def test_columns_of_tables_are_values_with_their_unit(folder):
    (folder / "cases.csv").write_text("mass [g], name\n1500, a\n2500, b\n", encoding="utf-8")
    found = resolved(folder, "parameters: {block.mass: {csv: cases.csv, column: mass}}\n")
    assert [float(str(each).split()[0]) for each in found.parameters["block.mass"].values] == [1500.0, 2.5]
    (folder / "cases.csv").write_text("mass [g], name\n1500, a\nheavy, b\n", encoding="utf-8")
    with pytest.raises(ModelError) as error:
        study(folder, "parameters: {block.mass: {csv: cases.csv, column: mass}}\n")
    assert error.value.faults[0].file.endswith("cases.csv")
    assert error.value.faults[0].line == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("design: sobol\nsamples: 100\n", "needs a power of two, got `100`; write `samples: 128`"),
        ("samples: 10\n", "`design: grid` takes all values"),
        ("parameters: {a: [1, 2], b: [1]}\ndesign: rows\n", "2 of `a`, 1 of `b`"),
        ("parameters: {a: {type: uniform, from: 1, to: 2}}\n", "takes values one by one"),
        ("parameters: {a: {type: range, from: 1, to: 2}}\n", "write `count: 5`"),
        ("parameters: {a: {type: uniform, from: 2, to: 1}}\n", "an upper bound above `2`"),
        ("parameters: {a: {type: triangular, from: 2, to: 3, peak: 4}}\n", "a value from `2` to `3`"),
        ("parameters: {a: {type: range, from: 0, to: 3, count: 2, spacing: logarithmic}}\n", "a value above zero"),
        ("parameters: {a: {type: normal, deviation: 0}}\n", "a deviation above zero"),
        ("parameters: {a: {type: tolerance, tolerance: [1, 2, 3]}}\n", "one quantity, or two"),
        ("parameters: {a: []}\n", "at least one value is needed"),
        ("outputs: {1a: {type: final, of: x}}\n", "`1a` is not a name"),
        ("outputs: {a: {type: max, of: x, from: 2 s, to: 1 s}}\n", "a time after 2 s"),
        ("analysis: linearise\nverify: true\n", "makes no second run"),
        ("bodies: {}\n", "this is a machine, not a study"),
    ],
)
def test_faults_say_what_to_write(text, message):
    with pytest.raises(ModelError) as error:
        parsed(f"format: 1\nmachine: a.yaml\n{text}")
    assert message in str(error.value)


def test_the_schema_has_every_kind_and_the_settings_of_the_analysis():
    jsonschema = pytest.importorskip("jsonschema")
    its = study_schema()
    jsonschema.Draft202012Validator.check_schema(its)
    checked = jsonschema.Draft202012Validator(its)
    good = {
        "format": 1,
        "machine": "a.yaml",
        "parameters": {"a": [1, "2 kg"], "b": {"csv": "t.csv"}, "c": {"type": "range", "from": 1, "to": 2, "count": 3}},
        "analysis": "statics",
        "settings": {"modes": 3},
        "outputs": {"d": {"type": "max", "of": "x", "from": "1 s", "at_most": "5 N"}},
    }
    assert not list(checked.iter_errors(good))
    for path, wrong in (
        ("settings", {"mods": 3}),
        ("outputs", {"d": {"type": "mx", "of": "x"}}),
        ("parameters", {"a": 3}),
    ):
        assert list(checked.iter_errors({**good, path: wrong})), path
