"""Faults between those fields of a record that are right by themselves, where others are not: all faults come at once."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar, Self

from pydantic import BaseModel, ModelWrapValidatorHandler, ValidationError, create_model, model_validator

if TYPE_CHECKING:
    from nivel.machine.checked import Checked, Problem


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


@cache
def _without(record: Any, hidden: frozenset[str]) -> Any:
    """The partial record of `record` that hides some fields."""
    fields: dict[str, Any] = dict.fromkeys(hidden, (Any, None))
    partial: Any = create_model(record.__name__, __base__=(_Partial, record), **fields)
    partial.hidden = hidden
    return partial
