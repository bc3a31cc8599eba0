"""Records whose fields must fit together: what does not is reported at the field, and all of it at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple, Self

from pydantic import ValidationError, model_validator
from pydantic_core import InitErrorDetails

from nivel.machine.quantity import fault
from nivel.machine.record import Record

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


def refuse(record: str, problems: Iterable[Problem]) -> None:
    """Raise a ValidationError with all `problems`, if there are any."""
    lines = [
        InitErrorDetails(type=fault(each.message, at_key=each.at_key), loc=each.place, input=None) for each in problems
    ]
    if lines:
        raise ValidationError.from_exception_data(record, lines)
