"""Functions of the motion that jump, and runs whose steps shrink to nothing there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from nivel.integrate.loop.run import DONE_STEPS, TAKEN, TIME, Run
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.arithmetic import COMPARISONS, Call, Lookup, Negative, Node, Operation, signals
from nivel.machine.units.expression import Expression
from nivel.wording import shown

# A status of a run beside those of kernels.
CRAWLS: Final = -1
# A run is looked at after so many steps. It crawls where they were this much shorter than its longest one, and so many are left at least.
LOOKED_AT, SHORT, LEFT = 10_000, 1e-5, 1e7
JUMPING: Final = ("sign", "floor", "mod", "if", "not")


@dataclass
class Crawl:
    """Whether a run of this duration [s] makes next to no way any more."""

    duration: float
    steps: int = 0
    time: float = 0.0

    def seen(self, run: Run) -> bool:
        """Called between chunks of steps."""
        steps, time = int(run.counter[DONE_STEPS]), float(run.clock[TIME])
        if steps - self.steps < LOOKED_AT:
            return False
        mean = (time - self.time) / (steps - self.steps)
        self.steps, self.time = steps, time
        return mean < SHORT * float(run.pace[TAKEN].max()) and self.duration - time > LEFT * mean


def jumping_functions(machine: MachineRecord) -> tuple[str, ...]:
    """Names and texts of the functions that jump where something of the motion passes a value; those of samples jump anyway."""
    return tuple(
        f"{shown(each.function.text)} of {each.section}.{each.part}"
        for each in machine.functions
        if each.sampling is None and isinstance(each.function, Expression) and any(_jumps(each.function.tree))
    )


def _jumps(node: Node) -> Iterator[bool]:
    """Of each part of an expression whether it jumps with a signal."""
    match node:
        case Negative(operand):
            yield from _jumps(operand)
        case Operation(symbol, left, right):
            yield symbol in COMPARISONS and bool(signals(node))
            yield from _jumps(left)
            yield from _jumps(right)
        case Lookup(argument):
            yield from _jumps(argument)
        case Call(function, arguments):
            yield function in JUMPING and bool(signals(arguments[0]))
            for argument in arguments:
                yield from _jumps(argument)


def crawling(time: float, step: float, jumping: tuple[str, ...]) -> tuple[str, str]:
    """(message, advice) of a run that crawls."""
    return f"stopped at t = {time:.6g} s: steps have shrunk to {step:.2g} s, and the end is out of reach", jump_advice(
        jumping
    )


def jump_advice(jumping: tuple[str, ...]) -> str:
    """What to do about functions that jump."""
    few = " and ".join(jumping[:3])
    return (
        f"{few} {'jumps' if len(jumping) == 1 else 'jump'}: where it brings the motion to rest it turns round in every step. "
        f"Dry friction is a force `type: friction` with `model: stiction`, which stands still. Else let it pass smoothly, "
        f"tanh(v/(1 mm/s)) in place of sign(v), or take a fixed step."
    )
