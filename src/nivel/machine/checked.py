"""Records whose fields must fit together: what does not is reported at the field, and all of it at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple, Self

from pydantic import ModelWrapValidatorHandler, ValidationError, ValidationInfo, model_validator
from pydantic_core import InitErrorDetails

from nivel.machine.partial import problems_beside
from nivel.machine.record import Record, restated
from nivel.machine.units.quantity import fault

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
            return handler(data)
        except ValidationError as error:
            raise restated(error, cls, cls.lines_beside(error, data, info)) from None

    @classmethod
    def lines_beside(cls, error: ValidationError, data: Any, info: ValidationInfo) -> list[InitErrorDetails]:
        """What is wrong in `data` between the fields that `error` is not about."""
        wrong = {line["loc"][0] for line in error.errors(include_url=False) if line["loc"]}
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
