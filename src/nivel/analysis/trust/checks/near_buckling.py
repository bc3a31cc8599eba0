"""Buckling near the states of beams: next to it a small error of the stiffness is a large one of the deflection.

The lowest stiffness is extrapolated to finer elements: where they would take all that is left of it, a state that was found is none.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.checks.beam_mesh import THRESHOLD
from nivel.analysis.trust.checks.element_size import OTHERS
from nivel.analysis.trust.subject import Equilibria
from nivel.results.motion import common_frames
from nivel.results.trust import Item, number

SOFT: Final = 0.5  # of the lowest stiffness of the machine as drawn: below it loads have taken much of it


@dataclass(frozen=True)
class OtherStability:
    """At `time` [s] the number of unstable directions is another with other elements, `words` says which."""

    time: float
    words: str


@dataclass(frozen=True)
class Softened:
    """At `time` [s] loads have taken the share `taken` of the lowest stiffness; what is left is wrong by the share `off` of it, infinite
    where finer elements leave nothing."""

    time: float
    taken: float
    off: float


def look(subject: Equilibria) -> OtherStability | Softened | None:
    """Whether finer elements have the states, and how soft they are."""
    compared, result = subject.elements, subject.result
    if compared is None or compared.result is None or compared.why:
        return None
    if not compared.by_arc:
        first, second = common_frames(result.time, compared.result.time)
        counts = result.array("unstable_directions")[first], compared.result.array("unstable_directions")[second]
        other = np.flatnonzero(counts[0] != counts[1])
        if len(other):
            return OtherStability(float(result.time[first][other[0]]), compared.pair.words)
    own, its = compared.own, compared.its
    if own is None or its is None or not 0.0 < own.last < SOFT * own.drawn or not its.last > 0.0:
        return None
    exact = own.last - compared.pair.factor * (own.last - its.last)
    off = abs(own.last / exact - 1.0) if exact > 0.0 else float("inf")
    return Softened(float(result.time[-1]), 1.0 - own.last / own.drawn, off)


def say(found: OtherStability | Softened) -> Item:
    """How near buckling is, and what to do."""
    at, advice = f"at t = {found.time:.6g} s", "use twice as many `elements`"
    if isinstance(found, OtherStability):
        said = (
            f"Mesh: {at} the stability is another with {found.words} elements: the machine is near buckling; {advice}"
        )
        return Item("mesh", "red", f"{said} (green if it is the same, red otherwise)", time=found.time)
    if not np.isfinite(found.off):
        said = f"Mesh: {at} finer elements take all that loads leave of the stiffness: the machine is at its buckling load; {advice}"
        return Item("mesh", "red", f"{said} (green if it stays, red otherwise)", time=found.time)
    said = (
        f"Mesh: {at} loads have taken {number(found.taken)} of the lowest stiffness, near buckling; what is left is off by about "
        f"{number(found.off)} of it; {advice}"
    )
    return THRESHOLD.item("mesh", said, found.off, found.time)


CHECKS = (
    Check("near_buckling", Equilibria, look, say, 284, (OTHERS, FRAMES), "Mesh", THRESHOLD, line="mesh", quiet=True),
)
