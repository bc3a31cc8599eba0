"""The JSON schema that editors use."""

import pytest

from nivel import Beam, Body, Joint, MachineRecord, Sensor, SimulationSettings
from nivel.elements.forces import FORCES
from nivel.elements.joints.couplings import Belt, FunctionCoupling, Gear, LinearCoupling, Rack
from nivel.files import schema
from nivel.files.outline import FILE_WORDS, SETS
from nivel.machine.bodies.shape import Box
from nivel.machine.core.record import field_words
from nivel.machine.uses.references import SECTIONS

SCHEMA = schema()
OF_FILES = {
    "Body": {"mass_properties"},
    "Joint": {"rotor_inertia", "stops", "friction", "backlash"},
    "Tyre": {"tyre", "ground"},
    "Blade": {"ground"},
    "SoilWheel": {"ground"},
    "Track": {"ground"},
    "Contact": {"ground"},
}  # keys that only files have


def definition(record):
    """Records of one name in two modules have these before their names."""
    found = SCHEMA["$defs"]
    return found.get(record.__name__) or found[f"{record.__module__}.{record.__name__}".replace(".", "__")]


def test_sections_are_mappings_by_name():
    assert set(SCHEMA["properties"]) == {
        "format",
        "parameters",
        "functions",
        *FILE_WORDS,
        *SETS,
        *MachineRecord.model_fields,
    }
    assert SCHEMA["required"] == ["format"]
    for section in SECTIONS:
        assert SCHEMA["properties"][section]["type"] == ["object", "null"]


@pytest.mark.parametrize("record", [Beam, Body, Joint, Sensor, *FORCES.records], ids=lambda record: record.__name__)
def test_elements_have_the_keys_of_their_records_but_no_name(record):
    its = definition(record)
    named = {"part"} if record in FORCES.records else set()
    assert set(its["properties"]) == set(field_words(record)) - {"name"} | OF_FILES.get(record.__name__, set()) | named
    assert "name" not in its["required"]
    assert its["additionalProperties"] is False


@pytest.mark.parametrize(
    ("section", "records"),
    [("forces", FORCES.records), ("couplings", (Gear, Belt, Rack, LinearCoupling, FunctionCoupling))],
)
def test_elements_of_several_types_are_told_apart_by_the_type(section, records):
    choices = SCHEMA["properties"][section]["additionalProperties"]["oneOf"]
    assert {choice["$ref"].rsplit("/", 1)[1] for choice in choices} == {record.__name__ for record in records}
    for record in records:
        assert "type" in definition(record)["required"]


def test_quantities_are_numbers_or_texts_and_say_their_unit():
    step = definition(SimulationSettings)["properties"]["step"]
    assert {"type": "string"} in step["anyOf"]
    assert "time in s" in step["description"]
    assert set(definition(SimulationSettings)["properties"]) == set(SimulationSettings.model_fields)


def test_keys_are_those_of_the_file():
    for record in (Box, Beam):
        assert "from" in definition(record)["properties"]
        assert "from_" not in definition(record)["properties"]


def test_all_references_resolve():
    def references(node):
        if isinstance(node, dict):
            if "$ref" in node:
                yield node["$ref"]
            for value in node.values():
                yield from references(value)
        elif isinstance(node, list):
            for value in node:
                yield from references(value)

    for reference in references(SCHEMA):
        assert reference.startswith("#/$defs/")
        assert reference.rsplit("/", 1)[1] in SCHEMA["$defs"]
