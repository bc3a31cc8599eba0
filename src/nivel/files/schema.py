"""The JSON schema of machine files, for editors that complete and check while one types."""

from copy import deepcopy
from typing import Any

from nivel.files.include import KEY as MASS_PROPERTIES
from nivel.files.include import Include
from nivel.files.joint_parts import BACKLASH, DESCRIBED, FILLED, MORE, RECORDS, STOPS
from nivel.files.outline import FORMAT, SETS, SHARING
from nivel.lazy import nivel
from nivel.machine.core.record import Record
from nivel.machine.laws.time_function import CURVE
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS
from nivel.machine.uses.references import SECTIONS

_DRAFT = "https://json-schema.org/draft/2020-12/schema"
_QUANTITY = {"anyOf": [{"type": "number"}, {"type": "string"}]}


def schema() -> dict[str, Any]:
    """JSON schema (2020-12) of the YAML form: the record's, with mappings by name, `format`, `parameters` and other
    files.
    """
    machine = deepcopy(MachineRecord.model_json_schema(by_alias=True, mode="validation"))
    definitions, properties = machine["$defs"], machine["properties"]
    included = _definition(Include, definitions)
    assembly = _definition(nivel.files.assembly.Assembly, definitions)
    definitions["Body"]["properties"][MASS_PROPERTIES] = {"type": "string", "description": "file with mass and inertia"}
    definitions["Mesh"]["properties"]["part"] = {"type": "string", "description": "name of a solid of a STEP file"}
    definitions["Joint"]["properties"] |= {
        key: {"anyOf": _forms(key, definitions), "description": text} for key, text in DESCRIBED.items()
    }
    tyre, contact, *on_soil = (definitions[name] for name in ("Tyre", "Contact", "Blade", "SoilWheel", "Track"))
    shared = {
        "tyres": {word: each for word, each in tyre["properties"].items() if word not in ("name", "type", "wheel")},
        "ground": {word: tyre["properties"][word] for word in ("plane", "heights", "grip")}
        | {"soil": on_soil[0]["properties"]["soil"]},
    }
    components = [definitions[name] for of in SHARING["catalogue"] for name in _references(properties[of]["items"])]
    shared["catalogue"] = {word: {} for each in components for word in each["properties"] if word != "name"}
    naming = {"tyres": (tyre,), "ground": (tyre, contact, *on_soil), "catalogue": components}
    for section, key in SETS.items():
        for element in naming[section]:
            element["properties"][key] = {
                "type": "string",
                "description": f"an entry of `{section}`, whose keys it has",
            }
    tyre["required"] = ["wheel"]
    for force in on_soil:
        force["required"] = [word for word in force["required"] if word not in shared["ground"]]
    named = set()
    for section in SECTIONS:
        items = properties[section].pop("items")
        named |= set(_references(items))
        properties[section] = {"type": ["object", "null"], "additionalProperties": items, "title": section}
    for name in named:
        _without_name(definitions[name])
    for definition in definitions.values():
        _with_type(definition)
    for each in components:
        if needed := [word for word in each.get("required", []) if word != "type"]:
            each["required"] = [word for word in each["required"] if word == "type"]
            each["anyOf"] = [{"required": needed}, {"required": [SETS["catalogue"]]}]
    for word in ("assembly", "simulation"):
        properties[word] = {"anyOf": [properties[word], {"type": "null"}]}
    one = [{"type": "string"}, included]
    machine["properties"] = {
        "format": {"const": FORMAT, "description": "version of the file format"},
        "parameters": _by_name(_QUANTITY, "named numbers for use in every quantity; they may use each other"),
        "functions": _by_name(
            {"anyOf": [*_QUANTITY["anyOf"], CURVE]},
            "named functions: `bump(x): …` an expression of its arguments, or a curve through points",
        ),
        "include": {
            "anyOf": [*one, {"type": "array", "items": {"anyOf": one}}],
            "description": "files whose sections stand in this one",
        },
        "assemblies": _by_name(assembly, "parts that stand in files of their own"),
        **{
            section: _by_name(_closed(words), f"keys that several elements share, by the key `{SETS[section]}`")
            for section, words in shared.items()
        },
        **properties,
    }
    machine["required"] = ["format"]
    _with_what_they_take(machine)
    return {"$schema": _DRAFT, **machine, "title": "nivel machine"}


def _forms(key: str, definitions: dict[str, Any]) -> list[dict[str, Any]]:
    """What may stand at a key of a joint: a quantity or a mapping, for its coordinate or for each."""
    plain = [] if key in (STOPS, BACKLASH) else _QUANTITY["anyOf"]
    record = {} if key not in RECORDS else definitions[RECORDS[key]]["properties"]
    words = {word: each for word, each in record.items() if word not in FILLED} | dict.fromkeys(
        MORE.get(key, ()), _QUANTITY
    )
    own = [*plain, *([_closed(words)] if words else [])]
    return [*own, _closed({coordinate: {"anyOf": own} for coordinate in COORDINATE_KINDS})]


def _by_name(each: dict[str, Any], text: str) -> dict[str, Any]:
    return {"type": ["object", "null"], "additionalProperties": each, "description": text}


def _closed(properties: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _definition(record: type[Record], definitions: dict[str, Any]) -> dict[str, str]:
    """Put the schema of `record` into `definitions` and refer to it."""
    its = record.model_json_schema(by_alias=True, mode="validation")
    definitions |= its.pop("$defs", {})
    definitions[record.__name__] = its
    return {"$ref": f"#/$defs/{record.__name__}"}


def _references(items: dict[str, Any]) -> list[str]:
    """Names of the definitions that `items` refers to."""
    choices = items.get("oneOf", [items])
    return [choice["$ref"].rsplit("/", 1)[1] for choice in choices]


def _without_name(definition: dict[str, Any]) -> None:
    definition["properties"].pop("name", None)
    definition["required"] = [word for word in definition.get("required", []) if word != "name"]


def _with_type(definition: dict[str, Any]) -> None:
    """Where the type tells which record it is, a file has to give it, although in Python the class does, unless it is that of what has
    none."""
    its = definition["properties"].get("type", {})
    if "const" in its and not its.pop("optional", False):
        definition["required"] = ["type", *definition.get("required", [])]


def _with_what_they_take(node: Any) -> None:
    """The meaning of a quantity is followed by what it takes, with the unit, which would be lost where a field has a meaning of its own."""
    for each in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        _with_what_they_take(each)
    if isinstance(node, dict) and isinstance(takes := node.get("takes"), str):
        del node["takes"]
        if takes not in node["description"]:
            node["description"] += f" ({takes})"
