"""An instance of a part: every name and every mention of one gets the prefix."""

from typing import get_args

import pytest
from base_machine import FULL, write_files
from pydantic import BaseModel

from nivel import Body, Driver, Expression, Joint, Marker, PointForce, PythonLaw, Sensor, Table
from nivel.elements.forces import FORCES
from nivel.elements.joints.couplings import Belt, FunctionCoupling, Gear, LinearCoupling, Rack
from nivel.files import read_machine
from nivel.files.substitution import MENTIONS, NotRepresentableError, renamed
from nivel.machine.uses.references import SECTIONS

RECORDS = (Body, Marker, Joint, Gear, Belt, Rack, LinearCoupling, FunctionCoupling, Driver, *FORCES.records, Sensor)
TEXTS = {
    "type",
    "name",
    "units",
    "quantity",
    "sequence",
    "file",
    "surface",
    "interface",
    "label",
    "colour",
    "parts",
    "function",  # of a place, with what it names put in
    "coefficients",  # keys of the file of a tyre
}  # texts that name no element


def parts(record, seen):
    """`record` and the records in its fields."""
    if record not in seen:
        seen.add(record)
        for field in record.model_fields.values():
            for each in types(field.annotation):
                if isinstance(each, type) and issubclass(each, BaseModel):
                    parts(each, seen)
    return seen


def types(annotation):
    inner = get_args(annotation)
    return {annotation} | set().union(*map(types, inner)) if inner else {annotation}


@pytest.mark.parametrize("record", RECORDS, ids=lambda record: record.__name__)
def test_every_field_that_may_hold_a_name_is_known(record):
    for part in parts(record, set()):
        for name, field in part.model_fields.items():
            if str in types(field.annotation):
                assert name in MENTIONS or name in TEXTS, f"{part.__name__}.{name}"


def test_no_name_of_the_full_machine_is_left(tmp_path):
    machine = read_machine(write_files(tmp_path), allow_code=True)
    elements = renamed({section: getattr(machine, section) for section in SECTIONS}, "new_")
    changed = machine.replace(**elements)  # checked: whatever is mentioned exists
    text = changed.model_dump_json()
    own = {element.name for section in SECTIONS for element in getattr(machine, section)}
    assert len(own) > 50
    assert FULL.count("type: ") > 25
    for section in SECTIONS:
        for element in getattr(changed, section):
            assert element.name.startswith("new_")
    for name in own - {"table", "law", "centre", "brake"}:  # those are words of the format as well
        assert f'"{name}"' not in text
        assert f'"{name}.' not in text
    back = renamed({section: getattr(changed, section) for section in SECTIONS}, "")
    assert back["bodies"] == changed.bodies


def push(function):
    return PointForce(name="push", body="a", vector=(function, 0, 0))


@pytest.mark.parametrize(
    ("function", "expected"),
    [
        (Expression("2.0*a.x - sin(b.angle)*time"), Expression("2.0*n_a.x - sin(n_b.angle)*time")),
        (Table((0, 1), (2, 3), of="b.angle"), Table((0, 1), (2, 3), of="n_b.angle")),
        (Table((0, 1), (2, 3)), Table((0, 1), (2, 3))),
        (
            PythonLaw("def f(t, x, s): return x", "f", ("time", "b.angle", 2.0)),
            PythonLaw("def f(t, x, s): return x", "f", ("time", "n_b.angle", 2.0)),
        ),
    ],
)
def test_signals_are_renamed(function, expected):
    (force,) = renamed({"forces": (push(function),)}, "n_")["forces"]
    assert (force.name, force.body) == ("n_push", "n_a")
    assert force.vector[0] == push(expected).vector[0]


def test_a_minus_sign_is_no_part_of_a_name_in_an_expression():
    with pytest.raises(NotRepresentableError, match=r"forces\.push: names that start with `n-`"):
        renamed({"forces": (push(Expression("a.x")),)}, "n-")
    (force,) = renamed({"forces": (push(Table((0, 1), (2, 3), of="b.angle")),)}, "n-")["forces"]
    assert force.vector[0].of == "n-b.angle"
