"""Kinds of elements by their words in machine files. A kind is found by what the file in its room says; nothing lists it."""

import re
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, reduce
from importlib import import_module
from operator import or_
from pathlib import Path
from typing import Annotated, Any, Generic, Protocol, TypeVar

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler, TypeAdapter, ValidationInfo
from pydantic_core import CoreSchema, PydanticKnownError, core_schema

from nivel.known import Family, MachineRecord, SystemBuilder
from nivel.lazy import Struct


def _nothing(builder: SystemBuilder, element: Any) -> None:
    """What a kind adds whose record says all."""


class Kind(Struct):
    """record : its keys in machine files. add(builder, record) : adds its rows to the tables of a machine. families : kernels that it may
    need. families_of(machine, record) : those that an element needs, where they are not all."""

    record: type[Any]
    add: Callable[[SystemBuilder, Any], None] = _nothing
    families: tuple[Family, ...] = ()
    families_of: Callable[[MachineRecord, Any], tuple[Family, ...]] | None = None

    def needed(self, machine: MachineRecord, element: Any) -> tuple[Family, ...]:
        """The kernels that an element of `machine` needs."""
        return self.families if self.families_of is None else self.families_of(machine, element)

    @property
    def type(self) -> str:
        """The word for it in machine files."""
        return str(self.record.model_fields["type"].default)


class Worded(Protocol):
    """What has a word in machine files."""

    @property
    def type(self) -> str: ...


KindT = TypeVar("KindT", bound=Worded)


class Kinds(Mapping[str, KindT], Generic[KindT]):
    """Kinds of some rooms by their words. A module is imported when its word is asked for, and all of them where kinds are counted.

    noun : what one of them is called in messages. mark : what a word stands behind in the file of its kind.
    """

    def __init__(self, *rooms: str, noun: str, mark: str = r'^    type: Literal\["([\w-]+)"\]') -> None:
        self._rooms, self._noun, self._mark = rooms, noun, re.compile(mark, re.MULTILINE)
        self._kinds: dict[str, KindT] = {}

    @cached_property
    def _files(self) -> dict[str, Path]:
        """Module → its file, of all modules of the rooms."""
        folders = [(room, Path(str(import_module(room).__file__)).parent) for room in self._rooms]
        return {
            ".".join((room, *file.relative_to(folder).with_suffix("").parts)): file
            for room, folder in folders
            for file in sorted(folder.rglob("*.py"))
            if file.name != "__init__.py"
        }

    @cached_property
    def homes(self) -> dict[str, str]:
        """Word → module whose record has it, found without importing it."""
        return {
            word: module for module, file in self._files.items() for word in self._mark.findall(file.read_text("utf-8"))
        }

    @cached_property
    def _all(self) -> bool:
        for module in self._files:
            self._import(module)
        return True

    def _import(self, module: str) -> None:
        self._kinds |= {kind.type: kind for kind in getattr(import_module(module), "KINDS", ())}

    def __getitem__(self, word: str) -> KindT:
        if word not in self._kinds and word in self.homes:
            self._import(self.homes[word])
        if word not in self._kinds and word in self.homes:
            # a record that others read stands alone, its kernels in other files of the folder
            folder = self.homes[word].rpartition(".")[0]
            for module in self._files:
                if module.rpartition(".")[0] == folder:
                    self._import(module)
        if word not in self._kinds:
            _ = self._all
        return self._kinds[word]

    def __iter__(self) -> Iterator[str]:
        _ = self._all
        return iter(sorted(self._kinds))

    def __len__(self) -> int:
        return sum(1 for _ in self)  # a list of them would ask for their number

    @property
    def records(self) -> list[Any]:
        """The records of all kinds."""
        kinds: list[Any] = [*self.values()]
        return [kind.record for kind in kinds]

    def record_named(self, name: str) -> Any:
        """The record whose class has this name: an attribute of its room. Raises AttributeError with all names."""
        if not name[0].isupper():  # a module of the room, which the import finds by itself
            raise AttributeError(name)
        for module, file in self._files.items():
            if f"class {name}(" in file.read_text("utf-8"):
                return getattr(import_module(module), name)
        records = {record.__name__: record for record in self.records}
        if name not in records:
            raise AttributeError(f"no {self._noun} `{name}`; there are {', '.join(sorted(records))}", name=name)
        return records[name]

    @property
    def names(self) -> list[str]:
        """Names of the classes of all records."""
        return [record.__name__ for record in self.records]

    def register(self, kind: KindT) -> None:
        """Let machines have a kind that is not of the package. Raises ValueError where its word is taken."""
        if kind.type in self:
            raise ValueError(f"there is a {self._noun} of type '{kind.type}' already")
        self._kinds[kind.type] = kind

    def withdraw(self, word: str) -> None:
        """Let machines have a kind no longer that was registered."""
        del self._kinds[word]


class OneOf:
    """Annotation of what is a record of one of some kinds, told apart by its `type`."""

    def __init__(self, kinds: Kinds[Any]) -> None:
        self._kinds = kinds

    def read(self, value: Any, info: ValidationInfo) -> Any:
        """The record. Raises ValidationError or PydanticKnownError."""
        word = value.get("type", _NONE) if isinstance(value, Mapping) else getattr(value, "type", _NONE)
        if word is _NONE:
            raise PydanticKnownError("union_tag_not_found", {"discriminator": "'type'"})
        if not isinstance(word, str) or word not in self._kinds:
            expected = ", ".join(map(repr, self._kinds))
            context = {"discriminator": "'type'", "tag": str(word), "expected_tags": expected}
            raise PydanticKnownError("union_tag_invalid", context)
        record = self._kinds[word].record
        return record.__pydantic_validator__.validate_python(value, context=info.context)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        records: Any = Annotated[reduce(or_, self._kinds.records), Field(discriminator="type")]
        return handler(TypeAdapter(records).core_schema)


class RecordAt:
    """Annotation of what is a record, or one of some, of the class at `module:name`, which is imported when the first one is read."""

    def __init__(self, place: str) -> None:
        self.place = place

    @cached_property
    def _reader(self) -> TypeAdapter[Any]:
        module, _, name = self.place.partition(":")
        return TypeAdapter(getattr(import_module(module), name))

    def read(self, value: Any, info: ValidationInfo) -> Any:
        """The record. Raises ValidationError."""
        return self._reader.validator.validate_python(value, context=info.context)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        found: Any = {**self._reader.core_schema, "ref": (ref := f"{self.place.replace(':', '.')}:0")}
        if found["type"].startswith("function"):  # of one class, whose definition is told once
            return handler(core_schema.definitions_schema(core_schema.definition_reference_schema(ref), [found]))
        return handler(self._reader.core_schema)


class WordOf:
    """Annotation of the word of one of some kinds."""

    def __init__(self, kinds: Kinds[Any]) -> None:
        self._kinds = kinds

    def read(self, value: Any) -> str:
        """The word. Raises PydanticKnownError."""
        if isinstance(value, str) and value in self._kinds:
            return value
        *others, last = map(repr, self._kinds)
        raise PydanticKnownError("literal_error", {"expected": f"{', '.join(others)} or {last}"})

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"enum": [*self._kinds], "type": "string"}


_NONE: Any = object()
