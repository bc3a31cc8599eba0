"""Elements of a machine by name, to be read."""

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Final, Generic, TypeVar

from nivel.errors import Fault, ModelError
from nivel.machine.core.record import Record
from nivel.words.arguments import checked_arguments
from nivel.words.wording import unknown_word

Element = TypeVar("Element", bound=Record)

_UNCHANGED: Final = "nothing changes a machine; write"
_ANOTHER: Final = "which gives another one"
Value = TypeVar("Value")


class NamedValues(dict[str, Value]):
    """Values by name; a wrong name is answered with the nearest. `singular` is one of them in words."""

    def __init__(self, singular: str, values: Mapping[str, Value]) -> None:
        super().__init__(values)
        self._singular = singular

    def __missing__(self, name: object) -> Value:
        raise ModelError(Fault.at("", unknown_word(str(name), list(self), self._singular)))


class Named(Mapping[str, Element], Generic[Element]):
    """The elements of one kind, in the order of the machine: ``machine.bodies["rod"].mass``.

    A mapping that cannot be changed: `len`, `in`, iteration over the names, `.values()`, `.items()`. `singular` is one element in words.
    """

    def __init__(self, singular: str, records: Iterable[Element], prefix: str = "") -> None:
        self._singular = singular
        self._records = {str(getattr(record, "name", "")).removeprefix(prefix): record for record in records}

    @checked_arguments
    def __getitem__(self, name: str) -> Element:
        """The element of this name. Raises ModelError with the nearest name where there is none."""
        if name not in self._records:
            raise ModelError(Fault.at("", unknown_word(name, list(self._records), self._singular)))
        return self._records[name]

    if not TYPE_CHECKING:  # what type checkers refuse of a mapping that cannot be changed

        def __setitem__(self, name: str, element: object) -> None:
            """Refused: nothing changes a machine. Raises ModelError with the line to write."""
            raise ModelError(Fault.at(str(name), f"{_UNCHANGED} `machine = machine.replace({name})`, {_ANOTHER}"))

        def __delitem__(self, name: str) -> None:
            """As `__setitem__`."""
            raise ModelError(Fault.at(str(name), f"{_UNCHANGED} `machine = machine.without({name!r})`, {_ANOTHER}"))

        def __getattr__(self, name: str) -> Element:
            message = f"elements are read by their names: write [{name!r}]" if not name.startswith("_") else name
            raise AttributeError(message)

    def __contains__(self, name: object) -> bool:
        return name in self._records

    def __iter__(self) -> Iterator[str]:
        return iter(self._records)

    def __len__(self) -> int:
        return len(self._records)

    def __repr__(self) -> str:
        kinds = {name: getattr(record, "type", "") for name, record in self._records.items()}
        return "{" + ", ".join(f"{name}: {kind}" if kind else name for name, kind in kinds.items()) + "}"

    def _ipython_key_completions_(self) -> list[str]:
        return list(self._records)
