"""States of equilibrium: how well they are balanced, how stable they are, and what statics does not tell of them."""

import numpy as np

from nivel.judge.after.report import FRAMES, Check
from nivel.judge.after.subject import Equilibria
from nivel.lazy import Struct, replace
from nivel.results.motion import peak
from nivel.results.trust import Item, Threshold, Verdict, number
from nivel.words.wording import first_of

SHOWN = 6
RESIDUAL = Threshold(
    1e-8,
    1e-5,
    "Largest unbalanced force as a share of the largest load. Loads are rarely known to 1e-3; 1e-5 is two decades below. Newton's method "
    "ends far below 1e-8, unless the machine has both very stiff and very soft parts.",
)


class Residual(Struct):
    """The largest unbalanced force, as a share of the largest load, and its time [s]. rounded : round-off of positions explains all that
    is not green."""

    value: float
    time: float
    rounded: bool


class Stability(Struct):
    """States of all that are unstable, in how many directions at most, and the time [s] of the first. known : False where it depends on
    sampled blocks. conservative : all loads have a potential."""

    known: bool
    unstable: int = 0
    states: int = 0
    directions: int = 0
    time: float = 0.0
    conservative: bool = True


class Remark(Struct):
    """What is said of all states: name of the line, verdict, and text."""

    line: str
    verdict: Verdict
    said: str


def _look_at_residual(subject: Equilibria) -> Residual:
    """Forces left over; those that round-off explains are as good as none."""
    left, result = peak(subject.result, "residual"), subject.result
    values, rounded = result.array("residual"), result.array("residual_round_off")
    explained = bool(np.all(values <= np.maximum(rounded, RESIDUAL.green)))
    return Residual(left.value, left.time, explained and RESIDUAL.verdict(left.value) != "green")


def _say_residual(found: Residual) -> Item:
    said = f"unbalanced forces are at most {number(found.value)} of the largest load, at t = {found.time:.6g} s"
    if not found.rounded:
        return RESIDUAL.item("residual", f"Equilibrium: {said}", found.value, found.time)
    said += "; round-off of the positions makes as much of them, with parts so stiff"
    return replace(RESIDUAL.item("residual", f"Equilibrium: {said}", found.value, found.time), verdict="green")


def _look_at_stability(subject: Equilibria) -> Stability:
    counts, time = subject.result.array("unstable_directions"), subject.result.time
    if np.any(counts < 0):
        return Stability(False)
    unstable = np.flatnonzero(counts > 0)
    first = float(time[unstable[0]]) if len(unstable) else 0.0
    return Stability(True, len(unstable), len(counts), int(counts.max()), first, not subject.without_potential)


def _say_stability(found: Stability) -> Item:
    if not found.known:
        text = (
            "Stability: not determined, because it depends on sampled blocks; a run from this state shows whether the machine "
            "stays there (amber)"
        )
        return Item("stability", "amber", text)
    if not found.unstable and not found.conservative:
        text = (
            "Stability: no state has a direction of negative stiffness, but loads without a potential can make it flutter, which is not "
            "examined; `nivel linearise` shows it (amber)"
        )
        return Item("stability", "amber", text)
    if not found.unstable:
        said = "Stability: every state is stable: no direction of negative stiffness (green)"
        return Item("stability", "green", said)
    directions = "1 direction" if found.directions == 1 else f"up to {found.directions} directions"
    text = (
        f"Stability: {found.unstable} of {found.states} states are unstable, in {directions}, the first at t = {found.time:.6g} s: left "
        f"alone, a machine does not stay there (amber)"
    )
    return Item("stability", "amber", text, time=found.time)


def _look_at_critical(subject: Equilibria) -> Remark | None:
    named = [
        f"{kind} at t = {t:.9g} s"
        if between is None
        else f"{kind} between the states of t = {between[0]:.9g} s and {between[1]:.9g} s"
        for kind, t, between in subject.critical
    ]
    text = f"Critical points: {first_of(named, SHOWN)} (amber if there are any)"
    return Remark("critical", "amber", text) if named else None


def _look_at_potential(subject: Equilibria) -> Remark | None:
    """Whether some force has none, as one that follows a body."""
    loads = "some loads have no potential (follower forces, or torques about a fixed axis)"
    text = f"Potential: {loads}: flutter is not examined (green if all loads have one)"
    return Remark("potential", "amber", text) if subject.without_potential else None


def _look_at_vibrations(subject: Equilibria) -> Remark | None:
    said = f"{subject.rigid} with frequency zero: rigid-body motions of the machine"
    return Remark("vibrations", "amber", f"Vibrations: {said} (green if none)") if subject.rigid else None


def _look_at_free(subject: Equilibria) -> Remark | None:
    """Rigid motions of the whole machine, where its vibrations do not tell of them."""
    if not subject.free_motions or subject.rigid:
        return None
    several = "1 motion" if subject.free_motions == 1 else f"{subject.free_motions} motions"
    said = f"nothing holds the machine as a whole in {several}: it rests here, and would anywhere else"
    return Remark("free", "amber", f"Free: {said} (green if it is held)")


def _look_at_rest(subject: Equilibria) -> Remark | None:
    text = f"At rest: {'; '.join(subject.at_rest)} (said, always green)"
    return Remark("at_rest", "green", text) if subject.at_rest else None


def _say_remark(found: Remark) -> Item:
    return Item(found.line, found.verdict, found.said)


CHECKS = (
    Check("residual", Equilibria, _look_at_residual, _say_residual, 10, (FRAMES,), "Equilibrium", RESIDUAL),
    Check("stability", Equilibria, _look_at_stability, _say_stability, 40, (FRAMES,), "Stability"),
    Check("critical", Equilibria, _look_at_critical, _say_remark, 42, (), "Critical points"),
    Check("potential", Equilibria, _look_at_potential, _say_remark, 44, (), "Potential"),
    Check("vibrations", Equilibria, _look_at_vibrations, _say_remark, 46, (), "Vibrations"),
    Check("free", Equilibria, _look_at_free, _say_remark, 47, (), "Free as a whole"),
    Check("at_rest", Equilibria, _look_at_rest, _say_remark, 48, (), "At rest"),
)
