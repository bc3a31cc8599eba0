"""Base of all blocks of a control."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final

from pydantic import BeforeValidator

from nivel.machine.control.part import VALUE, Part, PartFunction
from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import NotNegative
from nivel.machine.core.record import Name, entry
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber, TwoNumbers
from nivel.machine.laws.time_function import Measured
from nivel.machine.units.linear_function import linear
from nivel.machine.units.quantity import ANY, Duration, Quantity, listed, of_one_kind

Input = Annotated[Measured, BeforeValidator(of_one_kind)]
Number = Annotated[OneNumber, Quantity(ANY)]
PositiveNumber = Annotated[OneNumber, Quantity(ANY, positive=True)]
Numbers = Annotated[ManyNumbers[Number], BeforeValidator(listed)]
Pair = Annotated[TwoNumbers[Number], BeforeValidator(listed)]
NotNegativeTime = Annotated[OneNumber, Quantity("time"), NotNegative]

COMPUTED: Final = "computed"  # a value before its latency
MOST_DELAYED: Final = 200  # samples that wait
WHOLE: Final = 1e-9  # of a ratio of times that is a whole number


def names_in(given: Any) -> tuple[str, ...]:
    """Names in a mapping from names, or in a list of what has names, of raw data or records."""
    if isinstance(given, Mapping):
        found = list(given)
    else:
        found = [entry(each, "name") for each in given] if isinstance(given, list | tuple) else []
    return tuple(name for name in found if isinstance(name, str))


class Block(Checked):
    """A named block: signals in, a value out, which everything that varies reads as `NAME.value`.

    quantities : its symbols.
    """

    collection: ClassVar[str] = "control"
    quantities: ClassVar[tuple[str, ...]] = (VALUE,)

    name: Name
    if TYPE_CHECKING:  # the word of every kind
        type: Any
    sample_time: Maybe[Duration] = Field(
        default=None, description="time between samples; without it the block is continuous"
    )
    offset: NotNegativeTime = Field(default=0.0, description="time of the first sample")
    latency: NotNegativeTime = Field(default=0.0, description="from a sample to the change of the value")
    units: str = Field(default="", description="SI unit of the value, for people")
    scale: Maybe[PositiveNumber] = Field(
        default=None, description="size of values that matter, by which errors of continuous states are measured"
    )

    @classmethod
    def symbols(cls, given: Any) -> tuple[str, ...]:
        """The quantities of a block of this kind, which may be raw data."""
        return cls.quantities

    @abstractmethod
    def computation(self) -> tuple[Part, ...]:
        """The parts of which one is called `self.output`."""

    @property
    def parts(self) -> tuple[Part, ...]:
        """All parts, the latency included."""
        parts = self.computation()
        return (*parts, *self._latency_parts(parts)) if self.latency and self.sample_time else parts

    @property
    def is_sampled(self) -> bool:
        return self.sample_time is not None

    @property
    def period(self) -> float:
        """Time between samples [s]; zero for continuous blocks."""
        return self.sample_time or 0.0

    @property
    def output(self) -> str:
        """Name of the part that is the value, before any latency."""
        return COMPUTED if self.latency and self.sample_time else VALUE

    @property
    def size(self) -> float:
        """What errors of its continuous states are measured by, at least."""
        return self.scale or 1.0

    def path(self, part: str) -> str:
        """Symbol of a part."""
        return f"{self.name}.{part}"

    def present(self, name: str, function: PartFunction, *, start: float = 0.0, key: str = "") -> Part:
        """A part that depends on the present: a signal, or its sample."""
        return Part(name, "sample" if self.is_sampled else "signal", function, start=start, key=key)

    def remembered(self, name: str, rate: PartFunction, after: PartFunction, start: float = 0.0) -> Part:
        """A part with a memory: its `rate`, or of a sampled block its value `after` a sample."""
        return Part(name, "memory", after, start) if self.is_sampled else Part(name, "state", rate, start)

    def _latency_parts(self, parts: tuple[Part, ...]) -> Iterator[Part]:
        """The value, which is written a latency after each sample, and the values that wait for it.

        At the end of sample j `queued_k` is the value computed k - 1 samples before, and was that of k samples before until then. A write
        at the very time of a sample comes after it, and takes the value of then; one between samples finds all moved on by one.
        """
        start = next(part.start for part in parts if part.name == COMPUTED)
        whole = math.floor(self.latency / self.period + WHOLE)
        rest = self.latency - whole * self.period
        rest = rest if rest > WHOLE * self.period else 0.0
        count = whole + 1 if whole and rest else whole
        names = [COMPUTED, *(f"queued_{k + 1}" for k in range(count))]
        for before, name in pairwise(names):
            yield Part(name, "memory", linear((1.0, self.path(before))), start)
        yield Part(VALUE, "memory", linear((1.0, self.path(names[-1]))), start, offset=rest)

    def problems(self) -> Iterator[Problem]:
        if self.sample_time is None:
            for key in ("offset", "latency"):
                if getattr(self, key):
                    yield superfluous(key, "belongs to a sampled block, one with `sample_time`")
        elif self.latency > MOST_DELAYED * self.sample_time:
            count = self.latency / self.sample_time
            message = f"the latency is {count:.4g} samples; up to {MOST_DELAYED} are taken: take a longer `sample_time`"
            yield Problem(("latency",), message)
