"""Any value in any field of any record: a record, or a fault in words."""

from functools import partial

from everything import EVERYTHING

from lanes import parts
from nivel import MachineRecord
from nivel.machine.core.record import Record
from wrong_values import WRONG, told_or_done

PARTS = 24  # of the wrong values, one for all tests


def records(record):
    """`record` and all records in it."""
    yield record
    for name in type(record).model_fields:
        value = getattr(record, name)
        for each in value if isinstance(value, tuple) else (value,):
            if isinstance(each, Record):
                yield from records(each)


@parts(PARTS)
def test_records_refuse_any_value_of_any_field_in_words(part):
    seen = set()
    for record in records(MachineRecord(**EVERYTHING)):
        base = {name: getattr(record, name) for name in record.model_fields_set}
        for name in type(record).model_fields:
            if (type(record), name) in seen:
                continue
            seen.add((type(record), name))
            for value in WRONG[(len(seen) + part) % PARTS :: PARTS]:
                told_or_done(partial(type(record), **{**base, name: value}))
    assert len(seen) > 200
