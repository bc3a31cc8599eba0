"""Parts of blocks: parts, each one number with a function that gives it, its rate, or its value after a sample."""

from typing import Literal

from nivel.lazy import Struct
from nivel.machine.laws.time_function import TimeFunction, signals_of
from nivel.machine.units.formula import Formula, LinearFunction, formula
from nivel.machine.units.tree import TIME


class UnitFacts(Struct):
    """A unit as a block uses it: name of the block, file of the unit, and its variables that are inputs and outputs.

    own_process, time_limit : whether it runs in a process of its own, and how long [s] a call may take there.
    """

    block: str
    file: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    own_process: bool
    time_limit: float


class FmuFacts(UnitFacts):
    """An FMU, with values of its parameters."""

    parameters: tuple[tuple[str, float], ...] = ()


class CFacts(UnitFacts):
    """A C function, with its name and the start of its state."""

    function: str = ""
    state: tuple[float, ...] = ()


class UnitOutput(Struct):
    """The value of one output of a unit after a sample. inputs : paths of the signals that it is called with."""

    facts: UnitFacts
    number: int
    inputs: tuple[str, ...]

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the signals that it depends on, each once."""
        return tuple(dict.fromkeys(path for path in self.inputs if path != TIME))


Role = Literal["signal", "state", "sample", "memory"]

VALUE = "value"


PartFunction = TimeFunction | LinearFunction | Formula | UnitOutput


def signals_read(function: PartFunction) -> tuple[str, ...]:
    """The paths of the signals that the function of a part depends on; `time` is none."""
    return function.signals if isinstance(function, LinearFunction | Formula | UnitOutput) else signals_of(function)


class Part(Struct):
    """One number of a block; its symbol is `BLOCK.name`, and `value` is what the block puts out.

    role : "signal", a function of the present; "state", whose rate the function is; "sample", which the function gives at each sample
    and which holds between them, and "memory", the same after all samples of that time, from the values before.
    start : of states, samples and memories. begins : gives the value just before the first sample of the block, in place of `start`.
    offset : after the samples of its block [s]. holds : it keeps its value in statics. key : of the block, whose text the function is.
    """

    name: str
    role: Role
    function: PartFunction
    start: float = 0.0
    begins: PartFunction | None = None
    offset: float = 0.0
    holds: bool = False
    key: str = ""


def limited(value: str, limits: tuple[float, float]) -> Formula:
    """The value, at least the lower and at most the upper limit."""
    return formula("min(max(value, lower), upper)", value=value, lower=limits[0], upper=limits[1])


def beyond(value: str, band: tuple[float, float]) -> Formula:
    """How far the value is outside of a band; zero inside."""
    return formula("value - min(max(value, lower), upper)", value=value, lower=band[0], upper=band[1])


def bounded_rate(rate: str, value: str, limits: tuple[float, float]) -> Formula:
    """The rate, or zero where it would lead a value at a limit beyond it."""
    text = "if(value >= upper and rate > 0 or value <= lower and rate < 0, 0, rate)"
    return formula(text, rate=rate, value=value, lower=limits[0], upper=limits[1])
