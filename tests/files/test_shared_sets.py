"""Sections `tyres` and `ground`: forces have the keys of the sets that they name, and faults stand where the sets do."""

import pytest

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
