"""Positions of a kinematic analysis: steps that were shortened, branches of positions, and states that have a history."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Positions
from nivel.results.trust import Item, number

# share of the least singular value at the start below which a position is near a singular one; names and times in a sentence
NEAR, SHOWN = 1e-3, 4


@dataclass(frozen=True)
class Shortened:
    """Steps that were shortened on the way."""

    count: int


@dataclass(frozen=True)
class Branches:
    """The least singular value of the constraints, as a share of that at the start, its time [s], and the joints that depend on each other
    most there. passed : pairs of times [s] between which a singular position was passed."""

    share: float
    time: float
    joints: tuple[str, ...]
    passed: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Histories:
    """First-order states, which keep their values of the start."""

    states: tuple[str, ...]


def look_at_branches(subject: Positions) -> Branches | None:
    """The singular position that it came nearest to; None of machines without constraints."""
    near = subject.near
    return Branches(near.least, near.time, near.joints, subject.passed) if near is not None else None


def look_at_steps(subject: Positions) -> Shortened | None:
    """Steps that were shortened."""
    return Shortened(subject.halved) if subject.halved else None


def say_steps(found: Shortened) -> Item:
    """How many steps were shortened."""
    said = f"{found.count} were shortened, because the machine moves fast or comes near a singular position"
    return Item("steps", "green", f"Steps: {said} (said, always green)")


def say_branches(found: Branches) -> Item:
    """Whether the positions are the only ones to which the drivers lead."""
    among = f" (among {', '.join(found.joints[:SHOWN])})" if found.joints else ""
    if found.passed:
        some = ", ".join(f"{a:.6g} and {b:.6g} s" for a, b in found.passed[:SHOWN])
        more = f" and {len(found.passed) - SHOWN} times more" if len(found.passed) > SHOWN else ""
        said = f"Branches: a singular position is passed between {some}{more}{among}: the positions beyond it are one of several branches"
        text = f"{said} that fit the drivers (amber if any is passed)"
        return Item("branches", "amber", text, time=found.passed[0][1])
    time = found.time
    if found.share < NEAR:
        said = f"Branches: the machine comes near a singular position at t = {time:.6g} s{among}, where branches of positions meet"
        return Item("branches", "amber", f"{said} (amber below {NEAR:g} of the distance at the start)", time=time)
    least = f"the distance from singular ones is at least {number(found.share)} of that at the start"
    said = f"Branches: the positions stay on one branch; {least} (green from {NEAR:g} on)"
    return Item("branches", "green", said, time=time)


def look_at_histories(subject: Positions) -> Histories | None:
    """States that kinematics does not compute."""
    states = tuple(fact.name for fact in subject.prepared.motion.system.states if not fact.integral)
    return Histories(states) if states else None


def say_histories(found: Histories) -> Item:
    """What depends on them is wrong."""
    more = f" and {len(found.states) - SHOWN} more" if len(found.states) > SHOWN else ""
    some = f"{', '.join(found.states[:SHOWN])}{more}"
    said = f"States: {some} have a history, which kinematics does not compute: they keep their initial values"
    wrong = "efforts and reactions that depend on them are wrong"
    return Item("states", "amber", f"{said}, and {wrong} (green if there are none)")


CHECKS = (
    Check("shortened_steps", Positions, look_at_steps, say_steps, 34, line="steps"),
    Check("branches", Positions, look_at_branches, say_branches, 36, (), "Branches of positions"),
    Check("histories", Positions, look_at_histories, say_histories, 38, line="states"),
)
