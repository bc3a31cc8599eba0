"""Positions passed in a run where constraints depend on each other that do not elsewhere: there a motion may continue in
more than one way."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import SECOND_RUN, Check
from nivel.analysis.trust.passages import Passage, can_be_singular, passages, why_not
from nivel.analysis.trust.subject import Run
from nivel.results.trust import Item

SHOWN = 5  # times in a sentence
BLIND = "at t = {time} s the motion may continue in more than one way"


@dataclass(frozen=True)
class Passages:
    """All passages of a run, in the order of time."""

    every: tuple[Passage, ...]


@dataclass(frozen=True)
class Unsearched:
    """Why singular positions were not searched for."""

    why: str


def look(run: Run) -> Passages | None:
    """The singular positions that the run passed."""
    found = tuple(passages(run))
    return Passages(found) if found else None


def say(found: Passages) -> Item:
    """When, and which constraints depend on each other then."""
    every = found.every
    times = ", ".join(f"{each.time:.6g}" for each in every[:SHOWN]) + (" …" if len(every) > SHOWN else "")
    joints = ", ".join(dict.fromkeys(name for each in every for name in each.joints))
    text = (
        f"Singular: at t = {times} s the machine passes a position where its motion branches (constraints of {joints} depend on each "
        f"other); the computed motion continues by inertia, but a real machine may take another branch; reactions near this position are "
        f"not reliable (green if none, amber otherwise)"
    )
    return Item("singular", "amber", text, row=joints, time=every[0].time)


def look_unsearched(run: Run) -> Unsearched | None:
    """Why the machine, which may have some, was not searched for singular positions."""
    why = why_not(run) if can_be_singular(run) else ""
    return Unsearched(why) if why else None


def say_unsearched(found: Unsearched) -> Item:
    """That it was not. The line is green: nothing is known against the result."""
    return Item("unexamined", "green", f"Not examined: singular positions that the machine may pass: {found.why}")


CHECKS = (
    Check("singular", Run, look, say, 250, (SECOND_RUN,), "Singular position", blind=BLIND),
    Check("unsearched", Run, look_unsearched, say_unsearched, 912, (SECOND_RUN,), "Not examined", line="unexamined"),
)
