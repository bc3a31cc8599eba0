"""Sections `tyres`, `ground` and `catalogue`: elements have the keys of the sets that they name, and faults stand where the sets do."""

import math
import re
from pathlib import Path

import pytest
import yaml

from nivel import load
from nivel.errors import ModelError
from nivel.files import parse_machine

TEXT = """format: 1
tyres:
  wide: {radius: 40 cm, width: 30 cm, nominal_load: 10 kN}
ground:
  yard: {plane: {body: ground}, heights: {size: [40, 8], function: 0.1*x}, grip: 0.5}
bodies:
  a: {mass: 1, inertia: [1, 1, 1], shape: {type: sphere, radius: 0.3}}
markers: {hub: {body: a, axis: [0, 1, 0]}}
forces:
  first: {type: tyre, wheel: hub, tyre: wide, ground: yard}
  second: {type: tyre, wheel: hub, tyre: wide, ground: yard, grip: 0.9, radius: 41 cm}
  ball: {type: contact, body: a, ground: yard, stiffness: 1e5, restitution: 0.5}
"""


def test_a_force_has_the_keys_of_its_sets_and_overrides_them():
    first, second, ball = parse_machine(TEXT, "m.yaml").forces
    assert (first.radius, first.grip, first.nominal_load) == (0.4, 0.5, 1e4)
    assert (second.radius, second.grip, second.width) == (pytest.approx(0.41), 0.9, 0.3)
    assert first.heights == second.heights == ball.heights
    assert ball.plane == first.plane


def test_a_set_is_changed_from_outside():
    changed = parse_machine(TEXT, "m.yaml", overrides={"tyres.wide.width": "25 cm"})
    assert changed.forces[0].width == changed.forces[1].width == 0.25


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("tyre: wide, ground: yard}", "tyre: wid, ground: yard}", 10, "did you mean `wide`?"),
        ("ground: yard, stiffness", "ground: [1], stiffness", 12, "`ground`"),
        ("radius: 40 cm", "radius: 40 kg", 3, "length"),
        ("width: 30 cm", "wdth: 30 cm", 3, "did you mean `width`?"),
        ("function: 0.1*x", "function: 0.1*u", 5, "`0.1*u`"),
        ("wide: {", "wide: 3 #", 3, "a mapping was expected"),
    ],
)
def test_what_is_wrong_in_a_set_is_said_where_it_stands(old, new, line, said):
    with pytest.raises(ModelError) as error:
        parse_machine(TEXT.replace(old, new, 1), "m.yaml")
    found = [fault for fault in error.value.faults if fault.line == line and said in fault.message]
    assert len(found) == 1, str(error.value)


ROOT = Path(__file__).parents[2]
CATALOGUE = ROOT / "examples" / "hydraulics" / "catalogue"
LEADS = "ports: {A: tank, B: line}"
# an element of each file of parts, without the keys that its parts have
USED = {
    "pumps": f"type: pump, part: PART, {LEADS}, speed: 1500 rpm",
    "motors": f"type: hydraulic-motor, part: PART, {LEADS}, coordinate: shaft",
    "valves": "type: directional-valve, part: PART, ports: {P: line, T: tank, A: a, B: b}, command: 0",
    "cylinders": "type: cylinder, part: PART, bodies: [ground, rotor], points: [[0, 0, 0], [1, 0, 0]], "
    "ports: {A: a, B: b}, stroke: 0.4, retracted_length: 0.8",
    "hoses": f"type: line, part: PART, {LEADS}, length: 2 m",
    "oils": "part: PART",
    "electric-motors": "type: induction-motor, part: PART, coordinate: shaft, voltage: 400 V, frequency: 50 Hz",
}
SHAFT = """format: 1
include: {file}
bodies:
  rotor: {{mass: 5, inertia: [1, 1, 1], position: [1, 0, 0]}}
joints:
  shaft: {{type: revolute, bodies: [ground, rotor], point: [1, 0, 0], axis: [1, 0, 0]}}
{used}
hydraulics:
  {component}
  tank: {{type: tank}}
  line: {{type: volume}}
  a: {{type: volume}}
  b: {{type: volume}}
  relief: {{type: relief-valve, ports: {{P: line, T: tank}}, opens_at: 1 bar, opening_range: 1 bar, flow: 1 L/s, pressure_drop: 1 bar}}
  first: {{type: orifice, ports: {{A: line, B: a}}, diameter: 1 mm}}
  second: {{type: orifice, ports: {{A: line, B: b}}, diameter: 1 mm}}
"""


def test_every_file_of_parts_is_used():
    assert {path.stem for path in CATALOGUE.glob("*.yaml")} == USED.keys()


@pytest.mark.parametrize("file", USED)
def test_parts_of_the_catalogue_have_all_that_an_element_needs(file):
    path = CATALOGUE / f"{file}.yaml"
    for part, keys in yaml.safe_load(path.read_text(encoding="utf-8"))["catalogue"].items():
        element = f"it: {{{USED[file].replace('PART', str(part))}}}"
        section = {"oils": "fluids", "electric-motors": "forces"}.get(file)
        used, component = ("", element) if section is None else (f"{section}: {{{element}}}", "")
        text = SHAFT.format(file=path, used=used, component=component)
        machine = parse_machine(text, "m.yaml")
        found = next(each for each in (*machine.hydraulics, *machine.forces, *machine.fluids) if each.name == "it")
        assert keys.keys() <= found.model_fields_set
        if file == "pumps":
            assert found.displacement == pytest.approx(float(part.split("-")[1]) * 1e-6 / (2 * math.pi))


def test_the_page_on_data_sheets_shows_a_machine_of_parts(tmp_path):
    page = (ROOT / "docs" / "data-sheets.md").read_text(encoding="utf-8")
    parts, text, *_ = re.findall(r"^```yaml\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    (tmp_path / "parts.yaml").write_text(parts, encoding="utf-8")
    (tmp_path / "machine.yaml").write_text(text, encoding="utf-8")
    result = load(tmp_path / "machine.yaml").simulate(verify=False)
    assert result.array("hydraulics.pump.flow")[-1] == pytest.approx(45e-6 * 25, rel=0.06)
    changed = load(tmp_path / "machine.yaml", {"catalogue.a10vso-45.displacement": "63 cm^3/rev"})
    assert next(each for each in changed.record.hydraulics if each.name == "pump").displacement > 9e-6


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("part: big", "part: bg", 6, "did you mean `big`?"),
        ("displacement: 45 cm^3/rev", "displacement: 45 kg", 3, "a volume per angle"),
        ("nominal_speed", "nominal_sped", 3, "did you mean `nominal_speed`?"),
        ("catalogue:", "tyres:", 6, "entry of `catalogue`"),
    ],
)
def test_what_is_wrong_in_a_part_is_said_where_it_stands(old, new, line, said):
    text = """format: 1
catalogue:
  big: {displacement: 45 cm^3/rev, nominal_speed: 1500 rpm}
hydraulics:
  line: {type: volume}
  pump: {type: pump, part: big, ports: {A: tank, B: line}, speed: 1500 rpm}
  tank: {type: tank}
"""
    with pytest.raises(ModelError) as error:
        parse_machine(text.replace(old, new, 1), "m.yaml")
    assert [fault for fault in error.value.faults if fault.line == line and said in fault.message], str(error.value)
