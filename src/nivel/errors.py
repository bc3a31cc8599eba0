"""The exceptions of nivel.

    NivelError
    ├── ModelError     the user's machine or settings are at fault (exit code 2)
    └── SolveError     the computation failed; what was computed is kept (exit code 3)

Anything else that escapes is a defect of nivel.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, replace
from math import inf
from typing import Final

LONGEST: Final = 2000  # characters of a line; names may be of any length


def plain(text: str) -> str:
    """`text` without what would steer a terminal, and not longer than LONGEST."""
    if len(text) > LONGEST:
        text = f"{text[:LONGEST]}…"
    return "".join(each if each.isprintable() or each in "\n " else repr(each)[1:-1] for each in text)


class NivelError(Exception):
    """Base of everything nivel raises on purpose."""


@dataclass(frozen=True, order=True)
class Fault:
    """One thing that is wrong in a machine, with the place where it stands.

    line, column : 1-based position in `file`; 0 where the machine was written in Python.
    path : the element in words, e.g. ``joints.hinge.axis``.
    message : what stood there and what would be right.
    """

    file: str
    line: int
    column: int
    path: str
    message: str

    def __post_init__(self) -> None:
        for field in ("file", "path", "message"):
            object.__setattr__(self, field, plain(getattr(self, field)))

    @classmethod
    def at(cls, path: str, message: str) -> "Fault":
        """A fault of an element whose place in a file is not known here: `Origin.placed` finds it."""
        return cls("", 0, 0, path, message)

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}: " if self.line else ""
        return f"{place}{self.path}: {self.message}" if self.path else f"{place}{self.message}"


@dataclass(frozen=True)
class Finding:
    """A sentence about a machine that is right by itself and may be a slip all the same: what stands at a place and what is usual, or fits.

    place : as in a machine file, ``hydraulics.pump.displacement``. number : by how many times a value is beyond what is usual; infinite
    where that is no matter of its size.
    """

    place: str
    text: str
    number: float = inf

    @property
    def fault(self) -> Fault:
        """The same, to be told with its place in the file."""
        return Fault.at(self.place, self.text)


class ModelError(NivelError):
    """The machine or its settings are at fault; `faults` lists everything that was found."""

    def __init__(self, faults: Iterable[Fault] | Fault | str) -> None:
        if isinstance(faults, str):
            faults = Fault.at("", faults)
        if isinstance(faults, Fault):
            faults = (faults,)
        self.faults: tuple[Fault, ...] = tuple(sorted(set(faults)))
        super().__init__("\n".join(str(fault) for fault in self.faults))


def refuse(faults: Iterable[Fault]) -> None:
    """Raises ModelError with all faults where there are any."""
    if found := tuple(faults):
        raise ModelError(found)


class SolveError(NivelError):
    """The computation failed at `time` (seconds); `advice` says what to try.

    `result` is everything computed up to the failure, or None if nothing was.
    """

    def __init__(self, message: str, *, time: float, advice: str = "", result: object = None) -> None:
        self.message = message
        self.time = time
        self.advice = advice
        self.result = result
        super().__init__(f"{message}\n{advice}" if advice else message)


@contextmanager
def retold(tell: Callable[[Fault], Fault]) -> Iterator[None]:
    """Faults that come up inside are told as `tell` has them."""
    try:
        yield
    except ModelError as error:
        raise ModelError(map(tell, error.faults)) from None


def located(place: str) -> AbstractContextManager[None]:
    """Faults without a place that come up inside get this one."""
    return retold(lambda fault: replace(fault, path=fault.path or place))


@contextmanager
def gathered(faults: list[Fault], tell: Callable[[Fault], Fault] = lambda fault: fault) -> Iterator[None]:
    """Faults that come up inside are added to `faults`, as `tell` has them, and what is left of the block is left out."""
    try:
        yield
    except ModelError as error:
        faults += map(tell, error.faults)
