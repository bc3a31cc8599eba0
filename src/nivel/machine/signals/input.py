"""An input in words: a signal from outside, which an operator, a table or another program sets while the machine moves."""

import re
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, ValidationInfo

from nivel.machine.core.coefficient import Truth
from nivel.machine.core.record import Checked, Name, Problem, superfluous
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord, TwoNumbers
from nivel.machine.laws.time_function import Measured, OneFunction, varying
from nivel.machine.laws.varying_value import Table
from nivel.machine.units.quantity import ANY, Duration, Quantity, Real, Whole, fault, listed, of_one_kind, shown

Number = Annotated[OneNumber, Quantity(ANY)]
Stick = Literal["left-x", "left-y", "right-x", "right-y"]

# Values of a table may pass a limit by this share of the range, which is round-off.
ROUND_OFF = 1e-9


def _key(value: Any) -> Any:
    if not isinstance(value, str) or not value.isprintable() or not 1 <= len(value) <= 20:
        raise fault(f"a key such as `a` or `ArrowUp` was expected, got {shown(value)}")
    return value.lower() if len(value) == 1 else value


Key = Annotated[str, BeforeValidator(_key)]


class Gamepad(Checked):
    """What of a gamepad or joystick sets an input: an axis from -1 to 1, or a button from 0 to 1, as browsers number them.

    Within the dead zone the input rests. Beyond it the deflection x, from 0 to 1, counts as x to the power `exponent`.
    """

    axis: Annotated[Whole, Field(ge=0, le=31)] | None = None
    button: Annotated[Whole, Field(ge=0, le=31)] | None = None
    reverse: Truth = Field("the other way round", default=False)
    dead_zone: Annotated[Real, Field(ge=0.0, lt=1.0)] = Field("share of the way at rest", default=0.08)
    exponent: Annotated[Real, Field(ge=1.0, le=10.0)] = Field("1: proportional; more: finer near rest", default=1.0)

    def problems(self) -> Iterator[Problem]:
        if (self.axis is None) == (self.button is None):
            yield Problem((), "one of `axis` and `button` is needed: its number, from 0")


class Keys(Checked):
    """The keys of a keyboard that raise and lower an input while they are held down."""

    raise_: Key | None = Field("key that moves the input to its upper end", default=None, key="raise")
    lower: Key | None = Field("key that moves the input to its lower end", default=None)

    def problems(self) -> Iterator[Problem]:
        if self.lower is not None and self.lower == self.raise_:
            yield Problem(("lower",), f"`{self.lower}` raises it already; another key was expected")


class Input(Checked):
    """A signal from outside, read as `NAME.value`. Off line it has its rest value, or follows `signal`; live an operator sets it.

    A live input follows its operator no faster than `rate`, and goes back to `rest` when the operator is lost.
    """

    collection: ClassVar[str] = "inputs"

    name: Name
    range: Annotated[TwoNumbers[Number], BeforeValidator(listed)] = Field(
        "least and greatest value", default=(-1.0, 1.0)
    )
    rest: Maybe[Number] = Field(
        "value of an untouched input; default 0, or the end of the range nearest to it", default=None
    )
    rate: Maybe[Annotated[OneNumber, Quantity(ANY, positive=True)]] = Field(
        "greatest change per second; absent, no limit", default=None
    )
    units: str = Field("SI unit of the value, for people", default="")
    label: str = Field("what the page calls it; default follows from the name", default="")
    description: str = Field("what it moves, for the operator", default="")
    signal: Maybe[Annotated[OneFunction, varying(ANY)]] = Field(
        "value in runs without an operator: a number, or a table of time", default=None
    )
    hold: Truth = Field("whether it stays where it is left, and does not go back to rest", default=False)
    control: Literal["slider", "button"] = Field("what the page shows for it", default="slider")
    stick: Stick | None = Field("axis of a stick on the page that moves it as well", default=None)
    keys: Maybe[OneRecord[Keys]] = Field("keys that raise and lower it", default=None)
    gamepad: Maybe[OneRecord[Gamepad]] = Field("axis or button of a gamepad", default=None)

    @property
    def rest_value(self) -> float:
        """Value of the untouched input."""
        low, high = self.range
        return min(max(0.0, low), high) if self.rest is None else self.rest

    @property
    def course(self) -> float | Table:
        """Value over time without an operator."""
        if self.signal is None:
            return self.rest_value
        assert isinstance(self.signal, float | int | Table)  # the record was checked
        return self.signal

    def problems(self) -> Iterator[Problem]:
        low, high = self.range
        if not low < high:
            yield Problem(
                ("range",), f"the least value comes first and is below the greatest; got {low:g} and {high:g}"
            )
            return
        if self.rest is not None and not low <= self.rest <= high:
            yield Problem(("rest",), f"{self.rest:g} is outside the range from {low:g} to {high:g}")
        if self.control == "button":
            yield from (
                superfluous(name, "belongs to a slider; a button is pressed or not")
                for name in ("stick",)
                if getattr(self, name) is not None
            )
        yield from self._problems_of_signal()

    def _problems_of_signal(self) -> Iterator[Problem]:
        signal, (low, high) = self.signal, self.range
        if signal is None:
            return
        if not isinstance(signal, float | int | Table) or (isinstance(signal, Table) and signal.signals):
            yield Problem(("signal",), "a number or a table of time was expected: {times: [0, 1], values: [0, 0.5]}")
            return
        if isinstance(signal, Table) and signal.interpolation != "linear":
            yield Problem(
                ("signal",), "a table of an input is `linear`: between the points of a curve it might leave the range"
            )
            return
        times, values = (signal.times, signal.values) if isinstance(signal, Table) else ((0.0,), (float(signal),))
        slack = ROUND_OFF * (high - low)
        for time, value in zip(times, values, strict=True):
            if not low - slack <= value <= high + slack:
                yield Problem(("signal",), f"{value:g} at {time:g} s is outside the range from {low:g} to {high:g}")
                return
        if self.rate is None:
            return
        for k in range(1, len(times)):
            change, within = values[k] - values[k - 1], times[k] - times[k - 1]
            if abs(change) > self.rate * within * (1.0 + 1e-6) + slack:
                message = f"from {times[k - 1]:g} s to {times[k]:g} s the value changes by {change:g}; `rate` allows {self.rate * within:g}"
                yield Problem(("signal",), message)
                return


# An event in words: an expression that passes zero.

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
        "expression of `time` and symbols; the event is where it passes zero"
    )
    direction: Literal["rising", "falling", "both"] = Field("of the value where it passes zero", default="both")
    stop: Truth = Field("whether the run ends at the event", default=False)

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
    start: Annotated[OneNumber, Quantity(ANY)] = Field("value at t = 0, before the first sample", default=0.0)
    rate: Maybe[Measured] = Field("ẋ per second: expression of `time` and symbols", default=None)
    update: Maybe[Measured] = Field("value after each sample: expression of `time` and symbols", default=None)
    every: Maybe[Duration] = Field("time between samples; the first one is at t = 0", default=None)
    event: Name | None = Field("event at which a sample is taken", default=None)
    scale: Maybe[Annotated[OneNumber, Quantity(ANY, positive=True)]] = Field(
        "size of values that matter, by which errors are measured; default |start|, or 1", default=None
    )
    units: str = Field("SI unit of the value, for people", default="")

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
