"""Steadiness of what linear equations are about: eigenvalues describe a motion where the machine rests in equilibrium, or moves so that
the equations stay the same; growth that round-off hides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Linearisation
from nivel.results.trust import Item, number

# Growth by less than this share of its eigenvalue, and of the slowest one that is told from zero, is none that matters.
GROWTH = 1e-6


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


@dataclass(frozen=True)
class Hidden:
    """A mode that grows by `rate` [1/s], which is known to `known` [1/s] alone."""

    mode: int
    rate: float
    known: float


def look_for_growth(subject: Linearisation) -> Hidden | None:
    """The first mode whose growth may be round-off."""
    values, known = subject.eigenvalues, subject.round_off
    size = np.abs(values)
    slowest = min(size[size > known], default=0.0)
    hidden = np.flatnonzero((values.real > GROWTH * np.maximum(size, slowest)) & (values.real <= known))
    if not len(hidden):
        return None
    k = int(hidden[0])
    return Hidden(int(np.sum(values[: k + 1].imag >= 0.0)), float(values[k].real), float(known[k]))


def say_growth(found: Hidden) -> Item:
    """That stability is not known."""
    said = (
        f"Growth: mode {found.mode} grows by {number(found.rate)}/s, which may be round-off of faster motions: it is known to "
        f"{number(found.known)}/s; make what is far stiffer than the rest rigid (green without such modes)"
    )
    return Item("growth", "amber", said)


CHECKS = (
    Check("steady", Linearisation, look, say, 10, (), "Steady"),
    Check("growth", Linearisation, look_for_growth, say_growth, 11, (), "Growth"),
)
