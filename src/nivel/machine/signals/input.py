"""An input in words: a signal from outside, which an operator, a table or another program sets while the machine moves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import Truth
from nivel.machine.core.record import Name
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord, TwoNumbers
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import ANY, Quantity, Real, Whole, fault, listed, shown

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
    reverse: Truth = Field(default=False, description="the other way round")
    dead_zone: Annotated[Real, Field(ge=0.0, lt=1.0)] = Field(default=0.08, description="share of the way at rest")
    exponent: Annotated[Real, Field(ge=1.0, le=10.0)] = Field(
        default=1.0, description="1: proportional; more: finer near rest"
    )

    def problems(self) -> Iterator[Problem]:
        if (self.axis is None) == (self.button is None):
            yield Problem((), "one of `axis` and `button` is needed: its number, from 0")


class Keys(Checked):
    """The keys of a keyboard that raise and lower an input while they are held down."""

    raise_: Key | None = Field(default=None, key="raise", description="key that moves the input to its upper end")
    lower: Key | None = Field(default=None, description="key that moves the input to its lower end")

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
        default=(-1.0, 1.0), description="least and greatest value"
    )
    rest: Maybe[Number] = Field(
        default=None, description="value of an untouched input; default 0, or the end of the range nearest to it"
    )
    rate: Maybe[Annotated[OneNumber, Quantity(ANY, positive=True)]] = Field(
        default=None, description="greatest change per second; absent, no limit"
    )
    units: str = Field(default="", description="SI unit of the value, for people")
    label: str = Field(default="", description="what the page calls it; default follows from the name")
    description: str = Field(default="", description="what it moves, for the operator")
    signal: Maybe[Annotated[OneFunction, varying(ANY)]] = Field(
        default=None, description="value in runs without an operator: a number, or a table of time"
    )
    hold: Truth = Field(default=False, description="whether it stays where it is left, and does not go back to rest")
    control: Literal["slider", "button"] = Field(default="slider", description="what the page shows for it")
    stick: Stick | None = Field(default=None, description="axis of a stick on the page that moves it as well")
    keys: Maybe[OneRecord[Keys]] = Field(default=None, description="keys that raise and lower it")
    gamepad: Maybe[OneRecord[Gamepad]] = Field(default=None, description="axis or button of a gamepad")

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
