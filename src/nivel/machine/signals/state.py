"""A first-order state in words: a quantity with a memory, which laws, sensors and events read as `NAME.value`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar

from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.record import Name
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.laws.time_function import Measured
from nivel.machine.units.quantity import ANY, Duration, Quantity


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
