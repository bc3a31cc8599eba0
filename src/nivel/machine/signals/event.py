"""An event in words: an expression that passes zero."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, ValidationInfo

from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import Truth
from nivel.machine.core.record import Name
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import Measured
from nivel.machine.units.quantity import ANY, Duration, Quantity, fault, of_one_kind, shown

_COMPARISONS = ("<", ">", "=")


def _passing(text: str) -> str:
    """The keys that say what a comparison means; those of an example where there is more than one."""
    sides = re.split(r"[<>]=?|==?", text)
    if len(sides) != 2 or " and " in text or " or " in text:
        return "for `hinge.angle > 2` `when: hinge.angle - 2, direction: rising`"
    left, right = (side.strip() for side in sides)
    right = f"({right})" if re.search(r"[^eE(]\s*[-+]", right) else right
    difference = left if right in ("0", "0.0") else f"{left} - {right}"
    direction = ", direction: rising" if ">" in text else ", direction: falling" if "<" in text else ""
    return f"`when: {difference}{direction}`"


def _passes_zero(value: Any, info: ValidationInfo) -> Any:
    """Refuse comparisons, which people try first, and sums of unlike terms."""
    if isinstance(value, str) and any(sign in value for sign in _COMPARISONS):
        raise fault(
            f"an event is where an expression passes zero, not a comparison as in {shown(value)}: write {_passing(value)}"
        )
    return of_one_kind(value, info)


class Event(Checked):
    """A moment that a run finds and keeps: where the value of an expression changes its sign."""

    collection: ClassVar[str] = "events"

    name: Name
    when: Annotated[Measured, BeforeValidator(_passes_zero)] = Field(
        description="expression of `time` and symbols; the event is where it passes zero"
    )
    direction: Literal["rising", "falling", "both"] = Field(
        default="both", description="of the value where it passes zero"
    )
    stop: Truth = Field(default=False, description="whether the run ends at the event")

    def problems(self) -> Iterator[Problem]:
        when = self.when
        if isinstance(when, float | int):
            yield Problem(("when",), f"{when:.6g} does not vary, so it never passes zero; use `time` or symbols")
        elif isinstance(when, Table) and when.interpolation == "linear" and min(when.values) * max(when.values) >= 0:
            yield Problem(
                ("when",),
                f"the values of the table go from {min(when.values):.6g} to {max(when.values):.6g}, so they never pass zero",
            )


# A first-order state in words: a quantity with a memory, which laws, sensors and events read as `NAME.value`.


class State(Checked):
    """A state x of the machine beside its motion: continuous, ẋ = `rate`, or sampled, x := `update` at given times or at an event.

    Sampled states that change at the same time do so together, all from the values before.
    """

    collection: ClassVar[str] = "states"

    name: Name
    start: Annotated[OneNumber, Quantity(ANY)] = Field(
        default=0.0, description="value at t = 0, before the first sample"
    )
    rate: Maybe[Measured] = Field(default=None, description="ẋ per second: expression of `time` and symbols")
    update: Maybe[Measured] = Field(
        default=None, description="value after each sample: expression of `time` and symbols"
    )
    every: Maybe[Duration] = Field(default=None, description="time between samples; the first one is at t = 0")
    event: Name | None = Field(default=None, description="event at which a sample is taken")
    scale: Maybe[Annotated[OneNumber, Quantity(ANY, positive=True)]] = Field(
        default=None, description="size of values that matter, by which errors are measured; default |start|, or 1"
    )
    units: str = Field(default="", description="SI unit of the value, for people")

    @property
    def size(self) -> float:
        """What errors of the value are measured by, at least."""
        return self.scale or abs(self.start) or 1.0

    def problems(self) -> Iterator[Problem]:
        if (self.rate is None) == (self.update is None):
            got = "" if self.rate is None else "; got both"
            yield Problem((), f"a state needs `rate` (it is continuous) or `update` (it is sampled){got}")
            return
        times = [name for name in ("every", "event") if getattr(self, name) is not None]
        if self.update is not None and not times:
            yield Problem((), "a sampled state needs `every` (time between samples) or `event` (which takes a sample)")
        if self.rate is not None:
            for name in times:
                yield superfluous(name, "belongs to a sampled state, one with `update`")
