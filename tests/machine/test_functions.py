"""Every function of a machine is found, wherever it stands: what is looked at for narrow features and corners is what is found here."""

from typing import get_args

import pytest
from everything import EVERYTHING

from nivel.machine import MachineRecord
from nivel.machine.control.block import Block
from nivel.machine.core.record import Record
from nivel.machine.laws.functions import functions_of
from nivel.machine.units.expression import Expression

MACHINE = MachineRecord(**EVERYTHING)
MARK, OTHER = Expression("sin(3*time)"), Expression("cos(2*time)")


def may_vary(annotation):
    """Whether a field is a function, or a tuple of them."""
    if isinstance(annotation, type) and issubclass(annotation, Record):
        return False
    return annotation is Expression or any(may_vary(each) for each in get_args(annotation))


def varying_fields(record):
    return [name for name, field in type(record).model_fields.items() if may_vary(field.annotation)]


def marked(record, name, value=MARK):
    before = getattr(record, name)
    return (value,) * max(1, len(before)) if isinstance(before, tuple) else value


def variants(record):
    """(place of a field, copies of the record in which it is MARK)."""
    fields = varying_fields(record)
    for name in fields:
        mark = marked(record, name)
        copies = [record.model_copy(update={name: mark})]
        # of some blocks a field counts only beside others, or without them
        copies += [
            record.model_copy(update={**{each: marked(record, each, other) for each in fields}, name: mark})
            for other in (OTHER, None)
            if isinstance(record, Block)
        ]
        yield name, copies
    for name in type(record).model_fields:
        value = getattr(record, name)
        inside = value if isinstance(value, tuple) else (value,)
        for k, each in enumerate(inside):
            if isinstance(each, Record):
                for place, copies in variants(each):
                    given = [
                        (*inside[:k], copy, *inside[k + 1 :]) if isinstance(value, tuple) else copy for copy in copies
                    ]
                    yield f"{name}.{place}", [record.model_copy(update={name: one}) for one in given]


def found(section, part):
    machine = MachineRecord.model_construct(name="one", **{section: (part,)})
    try:
        return any(each.function == MARK for each in functions_of(machine))
    except (TypeError, AttributeError):  # a block that cannot be without what was left out
        return False


SECTIONS = [name for name in MachineRecord.model_fields if isinstance(getattr(MACHINE, name), tuple)]


@pytest.mark.parametrize("section", [name for name in SECTIONS if name != "gravity"])
def test_every_function_is_found(section):
    for part in getattr(MACHINE, section):
        for place, copies in variants(part):
            assert any(found(section, copy) for copy in copies), f"{part.name}.{place}"


def test_functions_stand_in_all_these_sections():
    """The test above is not empty where functions are known to be."""
    having = {
        section
        for section in SECTIONS
        if section != "gravity"
        for part in getattr(MACHINE, section)
        if [*variants(part)]
    }
    assert having >= {"drivers", "forces", "hydraulics", "control", "inputs", "states", "events"}
