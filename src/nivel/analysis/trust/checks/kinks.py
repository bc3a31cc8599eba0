"""Kinks and jumps of the equations of motion at the state of linear equations, which have one of two slopes, or none."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Linearisation
from nivel.results.trust import Item

SHOWN = 4  # kinks in a sentence


@dataclass(frozen=True)
class Kinked:
    """The kinks at a state in words, and whether a force jumps at one of them."""

    kinks: tuple[str, ...]
    jumps: bool


def look(subject: Linearisation) -> Kinked | None:
    """The kinks; None where the equations are smooth."""
    kinks = subject.kinks
    return Kinked(tuple(map(str, kinks)), any(each.jumps for each in kinks)) if kinks else None


def say(found: Kinked) -> Item:
    """Both slopes of each."""
    more = f"; and {len(found.kinks) - SHOWN} more" if len(found.kinks) > SHOWN else ""
    some = "; ".join(found.kinks[:SHOWN]) + more
    if found.jumps:
        said = "the equations jump at this state, so that there are no linear ones whose eigenvalues describe a motion"
    else:
        said = "the equations have a kink at this state, and the linear ones have one of two slopes"
    return Item("kinks", "amber", f"Kinks: {said}: {some} (amber if there are any)")


CHECKS = (Check("kinks", Linearisation, look, say, 20, (), "Kinks"),)
