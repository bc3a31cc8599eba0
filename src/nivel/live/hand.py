"""The hand of a live machine: a force that follows inputs, by which the operator picks up a body with the mouse.

Its inputs stand behind those of the machine, so they are on the tape as all others: a recording has what the hand did.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from nivel.machine.forces.hand import Hand
from nivel.machine.laws.time_function import Expression
from nivel.machine.machine_record import MachineRecord
from nivel.machine.signals.input import Input

PULL, BODY, POINT, TOWARDS = 0, 1, 2, 5  # of its inputs
COUNT: Final = 8
FARTHEST: Final = 1e4  # m
MOST_BODIES: Final = 10_000
_PARTS: Final = ("pull", "body", *(f"{what}_{axis}" for what in ("point", "towards") for axis in "xyz"))


def with_hand(machine: MachineRecord) -> MachineRecord:
    """The machine with a hand that rests."""
    name = _free_name(machine)
    inputs = [f"{name}_{part}" for part in _PARTS]
    ranges = [(0.0, 1.0), (0.0, float(MOST_BODIES)), *[(-FARTHEST, FARTHEST)] * 6]
    values = [Expression(f"{each}.value") for each in inputs]
    hand = Hand(
        name=name,
        pull=values[PULL],
        body_number=values[BODY],
        point=(values[2], values[3], values[4]),
        towards=(values[5], values[6], values[7]),
    )
    added = (Input(name=each, range=limits, hold=True) for each, limits in zip(inputs, ranges, strict=True))
    return machine.replace(inputs=(*machine.inputs, *added), forces=(*machine.forces, hand))


def _free_name(machine: MachineRecord) -> str:
    taken = {each.name for each in (*machine.forces, *machine.inputs, *machine.sensors)}
    names = ("hand", *(f"hand{k}" for k in range(2, 100)))
    return next(name for name in names if not any(each == name or each.startswith(f"{name}_") for each in taken))


def grip(present: Sequence[float], body: int, point: Sequence[float], towards: Sequence[float]) -> list[float]:
    """Wanted values of the inputs that hold a point of a body, towards a point in space. present : values at the end of the last tick.

    A hand that holds another point lets go first, and holds when it has the new one: inputs go straight from value to value.
    """
    wanted = [1.0, float(body), *point, *towards]
    if list(present[BODY:TOWARDS]) == wanted[BODY:TOWARDS]:
        return wanted
    if present[PULL] != 0.0:
        return [0.0, *present[BODY:]]
    return [0.0, *wanted[BODY:]]
