"""Losses of a translation: what the machine file of another program's model has under `left_out`."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Equilibria, Positions, Run
from nivel.results.trust import Item


@dataclass(frozen=True)
class Loss:
    """A part of the model that has an influence on the motion and is not in the machine."""

    part: str


def look(subject: Run | Equilibria | Positions) -> list[Loss]:
    """All parts that the machine file names."""
    return [Loss(part) for part in subject.machine.left_out]


def say(loss: Loss) -> Item:
    """The part, and what ends the line."""
    advice = "where it is written as elements of the machine, or has no part in this motion, take it out of `left_out`"
    return Item("losses", "amber", f"Left out of the model: {loss.part}; {advice}", row=loss.part)


CHECKS = (Check("losses", (Run, Equilibria, Positions), look, say, 915, (), "Left out of the model"),)
