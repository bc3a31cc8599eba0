"""Base of all blocks of a control, and their inputs: signals, numbers and conditions."""

import math
import re
from abc import abstractmethod
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final

from pydantic import BeforeValidator, WithJsonSchema

from nivel.known import PartFunction
from nivel.machine.control.part import VALUE, Part
from nivel.machine.core.coefficient import NotNegative
from nivel.machine.core.record import Checked, Name, Problem, entry, superfluous
from nivel.machine.given import Field, ManyNumbers, ManyRows, Maybe, OneNumber, TwoNumbers
from nivel.machine.laws.time_function import Measured
from nivel.machine.units.formula import linear
from nivel.machine.units.quantity import ANY, Duration, Quantity, fault, listed, of_one_kind, shown

Input = Annotated[Measured, BeforeValidator(of_one_kind)]
Number = Annotated[OneNumber, Quantity(ANY)]
PositiveNumber = Annotated[OneNumber, Quantity(ANY, positive=True)]
Numbers = Annotated[ManyNumbers[Number], BeforeValidator(listed)]
Matrix = Annotated[ManyRows[Numbers], BeforeValidator(listed)]
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

    quantities : its symbols. delays : the latency is part of what it computes.
    """

    collection: ClassVar[str] = "control"
    quantities: ClassVar[tuple[str, ...]] = (VALUE,)
    delays: ClassVar[bool] = False

    name: Name
    if TYPE_CHECKING:  # the word of every kind
        type: Any
    sample_time: Maybe[Duration] = Field("time between samples; without it the block is continuous", default=None)
    offset: NotNegativeTime = Field("time of the first sample", default=0.0)
    latency: NotNegativeTime = Field("from a sample to the change of the value", default=0.0)
    units: str = Field("SI unit of the value, for people", default="")
    scale: Maybe[PositiveNumber] = Field(
        "size of values that matter, by which errors of continuous states are measured", default=None
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
        if self.output == VALUE:
            return parts
        start = next(part.start for part in parts if part.name == COMPUTED)
        return (*parts, *self.late(VALUE, COMPUTED, self.latency, start, "queued"))

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
        return COMPUTED if self.latency and self.sample_time and not self.delays else VALUE

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

    def samples_in(self, time: float) -> tuple[int, float]:
        """Whole samples in a time [s], and the rest of it [s], which is zero within round-off."""
        whole = math.floor(time / self.period + WHOLE)
        rest = time - whole * self.period
        return whole, rest if rest > WHOLE * self.period else 0.0

    def late(self, name: str, before: str, time: float, start: float, queue: str) -> Iterator[Part]:
        """A part that is what the part `before` was a `time` [s] ago, and the samples that wait for it, `queue_1`, `queue_2`, …

        Memories advance at the end of a sample: `queue_k` then is the sample k - 1 samples before, and was that of k samples before until
        then. The late part is written before others of its instant are computed. So it finds `queue_k` as it was with a whole number of
        samples, and moved on by one between them.
        """
        whole, rest = self.samples_in(time)
        names = [before, *(f"{queue}_{k + 1}" for k in range(whole + 1 if rest and whole else whole))]
        for earlier, later in pairwise(names):
            yield Part(later, "memory", linear((1.0, self.path(earlier))), start)
        yield Part(name, "sample", linear((1.0, self.path(names[-1]))), start, offset=rest)

    def problems(self) -> Iterator[Problem]:
        if self.sample_time is None:
            for key in ("offset", "latency"):
                if getattr(self, key):
                    yield superfluous(key, "belongs to a sampled block, one with `sample_time`")
        elif self.latency > MOST_DELAYED * self.sample_time:
            count = self.latency / self.sample_time
            message = f"the latency is {count:.4g} samples; up to {MOST_DELAYED} are taken: take a longer `sample_time`"
            yield Problem(("latency",), message)


_COMPARISON: Final = re.compile(r"(<=|>=|==|!=|<|>|=)")


def _difference(value: Any) -> Any:
    """`a > b` and `b < a` as `a - (b)`."""
    if not isinstance(value, str):
        return value
    left, *rest = _COMPARISON.split(value)
    if not rest:
        return value
    if len(rest) > 2:
        raise fault(f"one comparison was expected, got {shown(value)}; several stand in a list")
    sign, right = rest
    if "=" in sign.replace("<=", "").replace(">=", "") or sign == "!=":
        raise fault(f"`{sign}` is hardly ever true of numbers that vary; write `>` or `<`: {shown(value)}")
    if not left.strip() or not right.strip():
        raise fault(f"a comparison has two sides: {shown(value)}")
    greater, less = (left, right) if sign[0] == ">" else (right, left)
    return f"({greater.strip()}) - ({less.strip()})"


# positive where the condition holds
Condition = Annotated[
    Input, BeforeValidator(_difference), WithJsonSchema({"anyOf": [{"type": "string"}, {"type": "number"}]})
]
