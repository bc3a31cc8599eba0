"""Steadiness of what linear equations are about: eigenvalues describe a motion where the machine rests in equilibrium, or moves so that
the equations stay the same."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Linearisation
from nivel.results.trust import Item


@dataclass(frozen=True)
class Steadiness:
    """Whether the machine moves, and why it does so unsteadily, in sentences; none where it is steady."""

    moves: bool
    reasons: tuple[str, ...]


def look(subject: Linearisation) -> Steadiness:
    """As the equations are at later moments of the motion."""
    return Steadiness(subject.moves, subject.unsteady)


def say(found: Steadiness) -> Item:
    """Whether there are eigenvalues to read."""
    if found.reasons:
        return Item("steady", "amber", f"Steady: {'; '.join(found.reasons)} (green if at rest, or if A stays the same)")
    how = "A is the same at two later moments of the motion" if found.moves else "the machine rests in equilibrium"
    return Item("steady", "green", f"Steady: {how} (green)")


CHECKS = (Check("steady", Linearisation, look, say, 10, (), "Steady"),)
