"""Bases of all records of a machine: frozen, nothing unknown accepted, faults in plain words and all at once, of fields and of what must
fit together between them."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from inspect import Parameter, Signature
from typing import Annotated, Any, ClassVar, NamedTuple, Self

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    ModelWrapValidatorHandler,
    TypeAdapter,
    ValidationError,
    ValidationInfo,
    WithJsonSchema,
    create_model,
    model_validator,
)
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails, InitErrorDetails

from nivel.errors import Fault, ModelError
from nivel.machine.example_line import list_line, mapping_line, missing_line
from nivel.machine.given import RecordClass
from nivel.machine.units.quantity import FAULT, REPORTED, fault, reported
from nivel.words.arguments import checked_arguments
from nivel.words.wording import meant_word, shown, unknown_word

# Signatures of records for people: what each field takes, in words.

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


NAME = re.compile(r"[^\W\d_][\w-]*")
_ROUGHLY = r"^[^\s\d._-][^\s.]*$"  # in the schema: regular expressions of JSON know no classes of letters
GROUND = "ground"


def _named(value: Any) -> str:
    if not isinstance(value, str):
        raise fault(f"a name was expected, got {shown(value)}")
    if not NAME.fullmatch(value):
        raise fault(f"`{value}` is not a name: a name starts with a letter and has letters, digits, `-` and `_` only")
    return value


def _named_file(value: Any) -> str:
    if not isinstance(value, str) or not value.strip():
        raise fault(f"the name of a file was expected, got {shown(value)}")
    return value


Name = Annotated[str, BeforeValidator(_named), WithJsonSchema({"type": "string", "pattern": _ROUGHLY})]
FileName = Annotated[str, BeforeValidator(_named_file)]


STATION = re.compile(rf"{NAME.pattern}(\.[\w-]+)?")


def _named_body(value: Any) -> str:
    if isinstance(value, str) and STATION.fullmatch(value):
        return value
    return _named(value)


# of something that markers can be on: a body, or `BEAM.STATION`
BodyName = Annotated[
    str, BeforeValidator(_named_body), WithJsonSchema({"type": "string", "pattern": r"^[^\s\d._-][^\s]*$"})
]


class Record(BaseModel, metaclass=RecordClass):
    """A part of a machine in words. Made with keywords; `replace` gives a changed copy. Faults come as a ModelError."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        populate_by_name=True,
        hide_input_in_errors=True,
        allow_inf_nan=False,
        defer_build=True,
    )
    collection: ClassVar[str] = ""  # the section of the machine that holds such records
    # Fields that are one of several records, and where in the place of a fault pydantic puts the type that it chose.
    tagged: ClassVar[Mapping[str, int]] = {}
    # keys that mean a field too, and its name
    _spellings: ClassVar[Mapping[str, str]] = {}
    always: ClassVar[frozenset[str]] = frozenset()  # fields that a file is given also with their defaults
    where_given: ClassVar[frozenset[str]] = frozenset()  # the same where they were given

    @checked_arguments
    def __init__(self, /, **data: Any) -> None:
        """Raises ModelError with everything that is wrong."""
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise ModelError(_faults(type(self), data, error)) from None

    # Without this mark pydantic would call __init__ for nested records too, and lose the places of faults in them.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    @checked_arguments
    def replace(self, **changes: Any) -> Self:
        """A copy in which `changes` hold, checked like a new record."""
        given = {name: getattr(self, name) for name in self.model_fields_set}
        return type(self)(**(given | changes))

    def __setattr__(self, field: str, value: Any) -> None:
        """Refused: nothing changes a record. Raises ModelError with the line to write."""
        own = str(getattr(self, "name", None) or self.collection)
        line = (
            f"machine = machine.with_values({{'{own}.{field}': {value!r}}})" if own else f"replace({field}={value!r})"
        )
        message = f"a record never changes; write `{line}`, which gives another one"
        raise ModelError(Fault.at(f"{own}.{field}" if own else field, message))

    def __dir__(self) -> list[str]:
        """What completion offers: the fields, and what a record can do; not the machinery below it."""
        own = {name for each in type(self).__mro__ if issubclass(each, Record) for name in vars(each)}
        return [
            *type(self).model_fields,
            *sorted(
                own
                - {
                    "problems",
                    "lines_beside",
                    "tagged",
                    "collection",
                    "always",
                    "where_given",
                    "model_config",
                    "usual",
                    "model_rebuild",
                }
            ),
        ]

    def __str__(self) -> str:
        return repr(self)

    def __repr_args__(self) -> Any:
        """Only what differs from the default."""
        fields = type(self).model_fields
        return [
            (name, value)
            for name, value in super().__repr_args__()
            if name and value != fields[name].get_default(call_default_factory=True)
        ]

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: Any) -> None:
        """Help and editors show what each field takes, in words; found out when somebody asks."""
        super().__pydantic_init_subclass__(**kwargs)
        cls.__signature__ = PlainSignature()  # type: ignore[assignment]

    @classmethod
    def model_rebuild(cls, **given: Any) -> bool | None:
        """As pydantic has it, which puts its own signature in the place of the one in words."""
        done = super().model_rebuild(**{"_parent_namespace_depth": 3, **given})
        cls.__signature__ = PlainSignature()  # type: ignore[assignment]
        return done

    @model_validator(mode="wrap")
    @classmethod
    def _in_plain_words(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            return handler(respelt(data, cls))
        except ValidationError as error:
            raise restated(error, cls) from None


def respelt(data: Any, record: type[Record]) -> Any:
    """`data` with the names of fields in place of their other spellings; a key that is given both ways stays unknown."""
    if not record._spellings or not isinstance(data, Mapping):
        return data
    return {
        new if (new := record._spellings.get(key, key)) == key or new not in data else key: data[key] for key in data
    }


def restated(error: ValidationError, record: type[Record], more: Sequence[InitErrorDetails] = ()) -> ValidationError:
    """The same error in our own words, with `more` lines."""
    found = error.errors(include_url=False)
    meant = meant_keys(found, record)
    lines = [
        _restated_line(line, record)
        for line in found
        if not (line["type"] == "missing" and line["loc"][-1] in meant)  # a misspelt key is told once
    ]
    return ValidationError.from_exception_data(record.__name__, [*lines, *more])


def meant_keys(lines: Sequence[ErrorDetails], record: type[Record]) -> set[str | int]:
    """Keys of the record that unknown ones are slips of: these are told, and not that they are missing."""
    unknown = (line["loc"] for line in lines if line["type"] == "extra_forbidden")
    words = (meant_word(str(place[0]), field_words(record)) for place in unknown if len(place) == 1)
    return {word for word in words if word is not None}


def _restated_line(line: ErrorDetails, record: type[Record]) -> InitErrorDetails:
    kind = (
        reported()
        if line["type"] == REPORTED
        else fault(_sentence(line, record), at_key=_is_about_key(line), lacking=line.get("ctx", {}).get("lacking"))
    )
    place = [step for step in line["loc"] if step != "[key]"]
    tag = record.tagged.get(str(place[0])) if place else None
    if tag is not None and len(place) > tag:
        del place[tag]
    if line["type"] == "missing":
        place.pop()  # its parent lacks it
    return InitErrorDetails(type=kind, loc=tuple(place), input=line["input"])


def _is_about_key(line: ErrorDetails) -> bool:
    return line["type"] == "extra_forbidden" or "[key]" in line["loc"] or bool(line.get("ctx", {}).get("at_key"))


_SENTENCES = {
    "tuple_type": "a list was expected, got {input}",
    "model_type": "a mapping was expected, got {input}",
    "model_attributes_type": "a mapping was expected, got {input}",
    "dict_type": "a mapping was expected, got {input}",
    "string_type": "a text was expected, got {input}",
    **dict.fromkeys(("float_type", "float_parsing"), "a number was expected, got {input}"),
    **dict.fromkeys(("int_type", "int_parsing", "int_from_float"), "a whole number was expected, got {input}"),
    **dict.fromkeys(("bool_type", "bool_parsing"), "`true` or `false` was expected, got {input}"),
    "finite_number": "a finite number is needed, got {input}",
    "greater_than": "a number greater than {gt:g} was expected, got {input}",
    "greater_than_equal": "a number of at least {ge:g} was expected, got {input}",
    "less_than": "a number less than {lt:g} was expected, got {input}",
    "less_than_equal": "a number of at most {le:g} was expected, got {input}",
}


def _sentence(line: ErrorDetails, record: type[Record]) -> str:
    """What pydantic found, in the words of a machine file."""
    context = line.get("ctx", {})
    match line["type"]:
        case "nivel":
            return str(context["message"])
        case "missing" if isinstance(line["loc"][-1], int):
            return _too_few(line["input"], line["loc"])
        case "missing":
            return f"`{line['loc'][-1]}` is missing{_of_missing(str(line['loc'][-1]), record)}"
        case "extra_forbidden":
            return unknown_word(str(line["loc"][-1]), field_words(record), "key")
        case "too_short" | "too_long":
            count = context.get("actual_length")
            wanted = context.get("min_length", context.get("max_length"))
            return f"{wanted} entries were expected, got {'more' if count is None else count}"
        case "literal_error" if isinstance(line["input"], list | tuple | Mapping):
            return f"one of {', '.join(_quoted(context['expected']))} was expected, got {shown(line['input'])}"
        case "literal_error":
            return unknown_word(shown(line["input"]).strip("`"), _quoted(context["expected"]), "word")
        case "union_tag_invalid":
            return unknown_word(shown(context["tag"]).strip("`"), _quoted(context["expected_tags"]), "type")
        case "union_tag_not_found":
            if isinstance(line["input"], Mapping | Record):
                return "`type` is missing"
            return f"a mapping was expected, got {shown(line['input'])}" + mapping_line(
                str(line["loc"][-1]), line["input"]
            )
        case kind if kind in _SENTENCES:
            sentence = _SENTENCES[kind].format(**context | {"input": shown(line["input"])})
            return sentence + _line_to_write(line, record)
    return line["msg"]


_ALONG_TWO_AXES = ("HeightField",)  # records whose pairs of numbers are along x and y
_IN_SPACE = ("position", "point", "velocity", "centre_of_mass", "centre", "gravity", "vector", "axis", "x_axis")


def _too_few(given: Sequence[Any], place: Sequence[int | str]) -> str:
    """That a list is too short; of two components in space also the line to write."""
    said = f"entries are missing: there {'is' if len(given) == 1 else 'are'} only {len(given)}"
    in_space = len(place) > 1 and place[-2] in _IN_SPACE and isinstance(given, list | tuple) and len(given) == 2
    return f"{said}; write `{place[-2]}: [{given[0]}, {given[1]}, 0]`" if in_space else said


def _of_missing(key: str, record: type[Record]) -> str:
    """What the field `key` takes, as the end of the sentence that it is missing."""
    if line := missing_line(key):
        return line
    field = next((each for name, each in record.model_fields.items() if key in (name, each.alias)), None)
    if field is None:
        return ""
    said = words_of(field)
    takes = f"one of {said.replace(chr(39), '').replace(' |', ',')}" if said.startswith("'") else said
    told = [each for each in (takes if takes.startswith(("a ", "an ", "one of ")) else "", field.description) if each]
    return f": {', '.join(told)}" if told else ""


def _line_to_write(line: ErrorDetails, record: type[Record]) -> str:
    """What would be right where a list or a mapping was expected, as the end of the sentence."""
    field = next((step for step in reversed(line["loc"]) if isinstance(step, str)), record.__name__.lower())
    if line["type"] == "tuple_type":
        if record.__name__ in _ALONG_TWO_AXES:
            return f"; write `{field}: [{line['input']}, {line['input']}]`"
        return list_line(field, line["input"])
    return mapping_line(field, line["input"]) if _SENTENCES[line["type"]].startswith("a mapping") else ""


def _quoted(text: object) -> list[str]:
    """The words in quotes in pydantic's list of what it expected."""
    return re.findall(r"'([^']*)'", str(text))


def field_words(record: type[Record]) -> list[str]:
    """The keys that `record` knows, as they are written in a file."""
    return [field.alias or name for name, field in record.model_fields.items()]


def _faults(record: type[Record], data: Mapping[str, Any], error: ValidationError) -> list[Fault]:
    """The faults of a record that was made in Python: no file, the element in words."""
    start = [record.collection, str(data["name"])] if record.collection and "name" in data else []
    return [
        Fault.at(".".join([*start, *words(line["loc"], data)]), line["msg"])
        for line in error.errors(include_url=False)
        if line["type"] == FAULT
    ]


def words(location: Sequence[int | str], data: Any) -> list[str]:
    """`location` in `data`, with the names of named elements in place of their numbers."""
    path: list[str] = []
    for step in location:
        if isinstance(step, int):
            data = data[step] if isinstance(data, Sequence) and step < len(data) else None
            path.append(str(entry(data, "name") or step))
        else:
            data = entry(data, step)
            path.append(step)
    return path


def entry(data: Any, key: str) -> Any:
    """What stands under `key` in a mapping or a record; None if nothing does."""
    if isinstance(data, Mapping):
        return data.get(key)
    return getattr(data, key, None) if isinstance(data, Record) else None


Place = tuple[str | int, ...]


class Problem(NamedTuple):
    """What is wrong and where in the record; `at_key`: the key should not stand there at all."""

    place: Place
    message: str
    at_key: bool = False


def superfluous(key: str, why: str) -> Problem:
    """The key `key` must not be given; `why` completes the sentence."""
    return Problem((key,), f"`{key}` {why}", at_key=True)


class Checked(Record):
    """A record that looks for what is wrong between its fields once each of them is right by itself."""

    def problems(self) -> Iterator[Problem]:
        """Everything that is wrong."""
        return iter(())

    @model_validator(mode="after")
    def _no_problems(self) -> Self:
        refuse(type(self).__name__, self.problems())
        return self

    @model_validator(mode="wrap")
    @classmethod
    def _in_plain_words(cls, data: Any, handler: ModelWrapValidatorHandler[Self], info: ValidationInfo) -> Self:
        """With what is wrong between the other fields, where some are wrong by themselves."""
        try:
            return handler(respelt(data, cls))
        except ValidationError as error:
            raise restated(error, cls, cls.lines_beside(error, data, info)) from None

    @classmethod
    def lines_beside(cls, error: ValidationError, data: Any, info: ValidationInfo) -> list[InitErrorDetails]:
        """What is wrong in `data` between the fields that `error` is not about."""
        found = error.errors(include_url=False)
        wrong = {line["loc"][0] for line in found if line["loc"]} | meant_keys(found, cls)
        return lines_of(problems_beside(cls, data, wrong, info.context))


class _HiddenError(Exception):
    """A field was asked for that is wrong by itself."""


class _Partial(BaseModel):
    """A record whose fields `hidden` are left out and may not be looked at. It refuses nothing."""

    hidden: ClassVar[frozenset[str]] = frozenset()

    def __getattribute__(self, name: str) -> Any:
        if name in type(self).hidden:
            raise _HiddenError
        return super().__getattribute__(name)

    @model_validator(mode="after")
    def _no_problems(self) -> Self:
        return self

    @model_validator(mode="wrap")
    @classmethod
    def _in_plain_words(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        return handler(data)


def problems_beside(record: type[Checked], data: Any, wrong: Collection[object], context: Any) -> Iterator[Problem]:
    """The problems that `record` finds in `data` before it looks at a field that is `wrong`, by its name or its key in a file."""
    if not isinstance(data, Mapping):
        return
    its: Any = record  # a class can be hashed, which is not seen of those with fields
    keys = {name: {name, field.alias} for name, field in record.model_fields.items()}
    hidden = frozenset(name for name in keys if not keys[name].isdisjoint(wrong))
    known = set[str | None]().union(*(keys[name] for name in keys if name not in hidden))
    right = {key: value for key, value in data.items() if key in known}
    try:
        yield from _without(its, hidden).model_validate(right, context=context).problems()
    except (ValidationError, _HiddenError):
        return


def without_problems(record: type[Checked], data: Any) -> Any:
    """The `record` of `data`, whatever is wrong between its fields. Raises ValidationError for what is wrong by itself."""
    its: Any = record
    return _without(its, frozenset()).model_validate(data)


@cache
def _without(record: Any, hidden: frozenset[str]) -> Any:
    """The partial record of `record` that hides some fields."""
    fields: dict[str, Any] = dict.fromkeys(hidden, (Any, None))
    partial: Any = create_model(record.__name__, __base__=(_Partial, record), **fields)
    partial.hidden = hidden
    return partial


def refuse(record: str, problems: Iterable[Problem]) -> None:
    """Raise a ValidationError with all `problems`, if there are any."""
    if lines := lines_of(problems):
        raise ValidationError.from_exception_data(record, lines)


def lines_of(problems: Iterable[Problem]) -> list[InitErrorDetails]:
    """The lines of a ValidationError that say these problems."""
    return [
        InitErrorDetails(type=fault(each.message, at_key=each.at_key), loc=each.place, input=None) for each in problems
    ]
