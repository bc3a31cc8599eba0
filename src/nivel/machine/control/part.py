"""Parts of blocks: parts, each one number with a function that gives it, its rate, or its value after a sample."""

from __future__ import annotations

from typing import Literal

from nivel.lazy import dataclass
from nivel.machine.control.unit_output import UnitOutput
from nivel.machine.laws.time_function import TimeFunction, signals_of
from nivel.machine.units.formula import Formula, LinearFunction

Role = Literal["signal", "state", "sample", "memory"]

VALUE = "value"


PartFunction = TimeFunction | LinearFunction | Formula | UnitOutput


def signals_read(function: PartFunction) -> tuple[str, ...]:
    """The paths of the signals that the function of a part depends on; `time` is none."""
    return function.signals if isinstance(function, LinearFunction | Formula | UnitOutput) else signals_of(function)


@dataclass(frozen=True)
class Part:
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
