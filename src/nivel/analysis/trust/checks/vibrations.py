"""Vibrations of linear equations that the elements of beams or the modes of flexible bodies make wrong: from which one on."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import Check, Need
from nivel.analysis.trust.checks.beam_mesh import THRESHOLD
from nivel.analysis.trust.checks.modes import NEAR_LEFT, modal_bases
from nivel.analysis.trust.subject import Linearisation
from nivel.results.trust import Item, number

Array = NDArray[np.float64]
TURN = 2.0 * np.pi
OTHERS = Need("a machine with other elements of beams", lambda subject: subject.others is not None)


@dataclass(frozen=True)
class WrongByElements:
    """The elements of `beams`, of this lowest order: which share of itself the vibration of the mode `first`, of this frequency [Hz], is
    off by, the first of those that are off by more than the limit; `below` the most of slower ones, or of all where `first` is None.
    slowest : the share of the slowest one. why : nothing of this is known."""

    beams: tuple[str, ...]
    order: int
    words: str
    first: int | None = None
    frequency: float = 0.0
    share: float = 0.0
    below: float = 0.0
    slowest: float = 0.0
    why: str = ""


@dataclass(frozen=True)
class BeyondModes:
    """A flexible body that leaves out modes from the frequency `left` [Hz] on, so that vibrations above `limit` [Hz] are not its own, of
    which there are some; whether all are."""

    body: str
    left: float
    limit: float
    all: bool


def look_at_elements(subject: Linearisation) -> WrongByElements | None:
    """How far the vibrations are from those with other elements, each against that of the same rank."""
    others = subject.others
    assert others is not None
    known = WrongByElements(others.pair.beams, others.pair.order, others.pair.words, why=others.why)
    own, its = vibrating(subject.eigenvalues), vibrating(others.eigenvalues)
    if others.why or not len(own):
        return known if others.why else None
    off = np.full(len(own), np.inf)
    count = min(len(own), len(its))
    values, theirs = subject.eigenvalues[own[:count]], others.eigenvalues[its[:count]]
    off[:count] = others.pair.factor * np.abs(values - theirs) / np.abs(values)
    known = replace(known, slowest=float(off[0]))
    wrong = np.flatnonzero(~(off < THRESHOLD.green))
    if not len(wrong):
        return replace(known, below=float(off.max()))
    k = int(wrong[0])
    first = int(np.sum(subject.eigenvalues[: own[k] + 1].imag >= 0.0))
    frequency = float(np.abs(subject.eigenvalues[own[k]])) / TURN
    below = float(off[:k].max()) if k else 0.0
    return replace(known, first=first, frequency=frequency, share=float(off[k]), below=below)


def vibrating(eigenvalues: NDArray[np.complex128]) -> NDArray[np.intp]:
    """Places of the vibrations, a pair once."""
    return np.flatnonzero(eigenvalues.imag > 0.0)


def say_elements(found: WrongByElements) -> Item:
    """From which vibration on they are wrong; the colour is that of the slowest."""
    names = ", ".join(found.beams)
    if found.why:
        said = f"Mesh: the elements of {names} are not judged: with {found.words} {found.why}"
        return Item("mesh", "amber", f"{said} (green if judged, amber otherwise)")
    if found.first is None:
        said = f"Mesh: by the elements of {names} every vibration is off by less than {number(found.below)} of it"
        return THRESHOLD.item("mesh", said, found.slowest)
    by = f"by {number(found.share)} of it" if np.isfinite(found.share) else "by an unknown share"
    less = f"; those below by less than {number(found.below)}" if found.below else ""
    advice = "use twice as many `elements`" + (", or `order: 2`" if found.order == 1 else "")
    said = (
        f"Mesh: by the elements of {names} the vibration of mode {found.first}, {number(found.frequency)} Hz, is off {by}, and those "
        f"above by more{less}; if they matter, {advice}; the colour is that of the slowest one"
    )
    return THRESHOLD.item("mesh", said, found.slowest)


def look_at_modes(subject: Linearisation) -> list[BeyondModes]:
    """Flexible bodies that lack modes of the frequencies of these vibrations."""
    machine, values = subject.machine, np.abs(subject.eigenvalues[vibrating(subject.eigenvalues)])
    if not machine.is_flexible or not len(values):
        return []
    out = []
    for basis in modal_bases(machine, subject.prepared):
        if len(basis.left.eigenvalues):
            lowest = float(np.sqrt(basis.left.eigenvalues.min()))
            if values.max() > NEAR_LEFT * lowest:
                every = bool(values.min() > NEAR_LEFT * lowest)
                out.append(BeyondModes(basis.body.name, lowest / TURN, NEAR_LEFT * lowest / TURN, every))
    return out


def say_modes(found: BeyondModes) -> Item:
    """Above which frequency vibrations are not those of the whole body; amber if that is all of them."""
    said = (
        f"Modes: {found.body} leaves out modes from {number(found.left)} Hz on, so vibrations above {number(found.limit)} Hz are not those "
        f"of the whole body; use more `modes` if they matter"
    )
    return Item("modes", "amber" if found.all else "green", f"{said} (amber if these are all)", row=found.body)


CHECKS = (
    Check("elements_of_vibrations", Linearisation, look_at_elements, say_elements, 292, (OTHERS,), line="mesh"),
    Check("modes_of_vibrations", Linearisation, look_at_modes, say_modes, 304, line="modes"),
)
