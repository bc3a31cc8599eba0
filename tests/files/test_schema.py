"""The JSON schema that editors use."""

from nivel.files import schema
from nivel.machine import Body, Joint, MachineRecord, SimulationSettings

SCHEMA = schema()


def test_sections_are_mappings_by_name():
    assert set(SCHEMA["properties"]) == {"format", "parameters", *MachineRecord.model_fields}
    assert SCHEMA["required"] == ["format", "bodies"]
    for section, record in {"bodies": Body, "joints": Joint}.items():
        items = SCHEMA["properties"][section]["additionalProperties"]
        definition = SCHEMA["$defs"][items["$ref"].rsplit("/", 1)[1]]
        assert set(definition["properties"]) == set(record.model_fields) - {"name"}
        assert definition["additionalProperties"] is False


def test_quantities_are_numbers_or_texts_and_say_their_unit():
    step = SCHEMA["$defs"]["SimulationSettings"]["properties"]["step"]
    assert {"type": "string"} in step["anyOf"]
    assert "time in s" in step["description"]
    assert set(SCHEMA["$defs"]["SimulationSettings"]["properties"]) == set(SimulationSettings.model_fields)


def test_keys_are_those_of_the_file():
    assert "from" in SCHEMA["$defs"]["Box"]["properties"]
    assert "from_" not in SCHEMA["$defs"]["Box"]["properties"]


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
