"""Signatures of records for people: what each field takes, in words."""

from functools import cache
from inspect import Parameter, Signature
from typing import Annotated, Any

from pydantic import BaseModel, TypeAdapter
from pydantic.fields import FieldInfo

FEW = 6  # words that are listed


class Words:
    """An annotation that is shown as it stands."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


class PlainSignature:
    """Attribute `__signature__` of a record class, as `inspect.signature` and `help` ask for it. Objects have none."""

    def __get__(self, record: BaseModel | None, owner: type[BaseModel]) -> Signature:
        if record is not None:
            raise AttributeError("__signature__")
        return _signature(owner)


@cache
def _signature(record: type[BaseModel]) -> Signature:
    return Signature([_parameter(name, field) for name, field in record.model_fields.items()])


def _parameter(name: str, field: FieldInfo) -> Parameter:
    default = Parameter.empty if field.is_required() else field.get_default(call_default_factory=True)
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=Words(words_of(field)))


def words_of(field: FieldInfo) -> str:
    """What a field takes: ``a mass in kg``, which may be a text with a unit too."""
    annotation: Any = field.annotation
    for each in field.metadata:
        annotation = Annotated[annotation, each]
    return in_words(TypeAdapter(annotation).json_schema(mode="validation")).replace(" | null", "")


def in_words(schema: dict[str, Any]) -> str:
    """A JSON schema in words."""

    def say(part: dict[str, Any]) -> str:
        if "description" in part and "or with a unit" in part["description"]:
            return str(part["description"]).removesuffix(", or with a unit")
        if "$ref" in part:
            return part["$ref"].rsplit("/", 1)[1]
        if "const" in part:
            return repr(part["const"])
        if "enum" in part:
            listed = [repr(each) for each in part["enum"]]
            return " | ".join(listed if len(listed) <= FEW else [*listed[:FEW], "…"])
        for choice in ("anyOf", "oneOf"):
            if choice in part:
                return " | ".join(dict.fromkeys(map(say, part[choice])))
        if part.get("type") == "array":
            return _list(part, say)
        kind = str(part.get("type", "value"))
        return {"string": "text", "integer": "whole number", "boolean": "true or false"}.get(kind, kind)

    return say(schema)


def _list(part: dict[str, Any], say: Any) -> str:
    entries = part.get("prefixItems")
    if entries:
        kinds = list(dict.fromkeys(map(say, entries)))
        return f"({', '.join(map(say, entries))})" if len(kinds) > 1 else f"{len(entries)} × ({kinds[0]})"
    return f"list of ({say(part['items'])})" if "items" in part else "list"
