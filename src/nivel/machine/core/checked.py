"""Records whose fields must fit together: what does not is reported at the field, and all of it at once."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cache
from typing import Any, ClassVar, NamedTuple, Self

from pydantic import (
    BaseModel,
    ModelWrapValidatorHandler,
    ValidationError,
    ValidationInfo,
    create_model,
    model_validator,
)
from pydantic_core import InitErrorDetails

from nivel.machine.core.record import Record, meant_keys, respelt, restated
from nivel.machine.units.quantity import fault


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


def refuse(record: str, problems: Iterable[Problem]) -> None:
    """Raise a ValidationError with all `problems`, if there are any."""
    if lines := lines_of(problems):
        raise ValidationError.from_exception_data(record, lines)


def lines_of(problems: Iterable[Problem]) -> list[InitErrorDetails]:
    """The lines of a ValidationError that say these problems."""
    return [
        InitErrorDetails(type=fault(each.message, at_key=each.at_key), loc=each.place, input=None) for each in problems
    ]
