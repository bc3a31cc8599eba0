"""Linear equations: what they are about, growth that round-off hides, kinks, and vibrations that elements of beams or modes of bodies
make wrong."""

import numpy as np
from numpy.typing import NDArray

from nivel.judge.after.checks.beams import MESH
from nivel.judge.after.checks.modes import NEAR_LEFT, modal_bases
from nivel.judge.after.report import Check, Need
from nivel.judge.after.subject import Linearisation
from nivel.lazy import Struct, replace
from nivel.results.trust import Item, number
from nivel.words.wording import first_of


class Steadiness(Struct):
    """Whether the machine moves, and why it does so unsteadily, in sentences; none where it is steady."""

    moves: bool
    reasons: tuple[str, ...]


def _look_at_steadiness(subject: Linearisation) -> Steadiness:
    return Steadiness(subject.moves, subject.unsteady)


def _say_steadiness(found: Steadiness) -> Item:
    if found.reasons:
        return Item("steady", "amber", f"Steady: {'; '.join(found.reasons)} (green if at rest, or if A stays the same)")
    how = "A is the same at two later moments of the motion" if found.moves else "the machine rests in equilibrium"
    return Item("steady", "green", f"Steady: {how} (green)")


# Growth by less than this share of its eigenvalue, and of the slowest one that is told from zero, is none that matters.
GROWTH = 1e-6


class Hidden(Struct):
    """A mode that grows by `rate` [1/s], which is known to `known` [1/s] alone."""

    mode: int
    rate: float
    known: float


def _look_for_growth(subject: Linearisation) -> Hidden | None:
    """The first mode whose growth may be round-off."""
    values, known = subject.eigenvalues, subject.round_off
    size = np.abs(values)
    slowest = min(size[size > known], default=0.0)
    hidden = np.flatnonzero((values.real > GROWTH * np.maximum(size, slowest)) & (values.real <= known))
    if not len(hidden):
        return None
    k = int(hidden[0])
    return Hidden(int(np.sum(values[: k + 1].imag >= 0.0)), float(values[k].real), float(known[k]))


def _say_growth(found: Hidden) -> Item:
    said = (
        f"Growth: mode {found.mode} grows by {number(found.rate)}/s, which may be round-off of faster motions: it is known to "
        f"{number(found.known)}/s; make what is far stiffer than the rest rigid (green without such modes)"
    )
    return Item("growth", "amber", said)


SHOWN = 4  # kinks in a sentence


class Kinked(Struct):
    """The kinks at a state in words, and whether a force jumps at one of them."""

    kinks: tuple[str, ...]
    jumps: bool


def _look_at_kinks(subject: Linearisation) -> Kinked | None:
    """The kinks; None where the equations are smooth."""
    kinks = subject.kinks
    return Kinked(tuple(map(str, kinks)), any(each.jumps for each in kinks)) if kinks else None


def _say_kinks(found: Kinked) -> Item:
    some = first_of(found.kinks, SHOWN, "; ")
    if found.jumps:
        said = "the equations jump at this state, so that there are no linear ones whose eigenvalues describe a motion"
    else:
        said = "the equations have a kink at this state, and the linear ones have one of two slopes"
    return Item("kinks", "amber", f"Kinks: {said}: {some} (amber if there are any)")


TURN = 2.0 * np.pi
OTHERS = Need("a machine with other elements of beams", lambda subject: subject.others is not None)


class WrongByElements(Struct):
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


class BeyondModes(Struct):
    """A flexible body that leaves out modes from the frequency `left` [Hz] on, so that vibrations above `limit` [Hz] are not its own, of
    which there are some; whether all are."""

    body: str
    left: float
    limit: float
    all: bool


def _look_at_elements(subject: Linearisation) -> WrongByElements | None:
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
    wrong = np.flatnonzero(~(off < MESH.green))
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


def _say_elements(found: WrongByElements) -> Item:
    """From which vibration on they are wrong; the colour is that of the slowest."""
    names = ", ".join(found.beams)
    if found.why:
        said = f"Mesh: the elements of {names} are not judged: with {found.words} {found.why}"
        return Item("mesh", "amber", f"{said} (green if judged, amber otherwise)")
    if found.first is None:
        said = f"Mesh: by the elements of {names} every vibration is off by less than {number(found.below)} of it"
        return MESH.item("mesh", said, found.slowest)
    by = f"by {number(found.share)} of it" if np.isfinite(found.share) else "by an unknown share"
    less = f"; those below by less than {number(found.below)}" if found.below else ""
    advice = "use twice as many `elements`" + (", or `order: 2`" if found.order == 1 else "")
    said = (
        f"Mesh: by the elements of {names} the vibration of mode {found.first}, {number(found.frequency)} Hz, is off {by}, and those "
        f"above by more{less}; if they matter, {advice}; the colour is that of the slowest one"
    )
    return MESH.item("mesh", said, found.slowest)


def _look_at_modes(subject: Linearisation) -> list[BeyondModes]:
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


def _say_modes(found: BeyondModes) -> Item:
    """Above which frequency vibrations are not those of the whole body; amber if that is all of them."""
    said = (
        f"Modes: {found.body} leaves out modes from {number(found.left)} Hz on, so vibrations above {number(found.limit)} Hz are not those "
        f"of the whole body; use more `modes` if they matter"
    )
    return Item("modes", "amber" if found.all else "green", f"{said} (amber if these are all)", row=found.body)


CHECKS = (
    Check("steady", Linearisation, _look_at_steadiness, _say_steadiness, 10, (), "Steady"),
    Check("growth", Linearisation, _look_for_growth, _say_growth, 11, (), "Growth"),
    Check("kinks", Linearisation, _look_at_kinks, _say_kinks, 20, (), "Kinks"),
    Check("elements_of_vibrations", Linearisation, _look_at_elements, _say_elements, 292, (OTHERS,), line="mesh"),
    Check("modes_of_vibrations", Linearisation, _look_at_modes, _say_modes, 304, line="modes"),
)
