"""Efforts of inverse dynamics: whether the motion is one of the machine, how far it can be trusted, and whether the efforts make it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.checks.joints import THRESHOLD
from nivel.analysis.trust.subject import Actuated
from nivel.results.trust import Item, Verdict

SHOWN = 4  # states in a sentence


@dataclass(frozen=True)
class OfMotion:
    """The verdict on the motion, and its headline."""

    verdict: Verdict
    headline: str


@dataclass(frozen=True)
class Opened:
    """How far joints are open in the motion, as a share of their scales."""

    share: float


@dataclass(frozen=True)
class Held:
    """First-order states that the motion does not have."""

    states: tuple[str, ...]


@dataclass(frozen=True)
class Missing:
    """The largest share of the generalised forces that no effort gives, when [s], as which effort on which coordinate (empty: on none
    alone), and whether limits hold efforts back."""

    share: float
    time: float
    effort: float
    coordinate: str
    limited: bool


@dataclass(frozen=True)
class Surplus:
    """How many actuators more than needed there are."""

    actuators: int


def look_at_motion(subject: Actuated) -> OfMotion | None:
    """What the trust report of the motion says; None where nothing is against it."""
    trust = subject.result.trust
    return OfMotion(trust.verdict, trust.headline) if trust.verdict != "green" else None


def say_motion(found: OfMotion) -> Item:
    """Efforts are no better than the motion that they belong to."""
    said = f"Motion: its own trust report is {found.verdict}, {found.headline}"
    return Item("motion", found.verdict, f"{said} (the colour is that of the motion)")


def look_at_joints(subject: Actuated) -> Opened | None:
    """The joint of this machine that the motion opens most; None where they are closed."""
    share = subject.efforts.violation
    return None if share < THRESHOLD.green else Opened(share)


def say_joints(found: Opened) -> Item:
    """That it may be a motion of another machine."""
    said = f"Joints: the motion has joints open by {found.share:.3g} of their scales, so it is not quite one of this machine"
    return THRESHOLD.item("violation", f"{said}: is it of another one?", found.share)


def look_at_states(subject: Actuated) -> Held | None:
    """States that keep their values of the start."""
    return Held(subject.efforts.held) if subject.efforts.held else None


def say_states(found: Held) -> Item:
    """What depends on them is wrong."""
    more = f" and {len(found.states) - SHOWN} more" if len(found.states) > SHOWN else ""
    said = (
        f"States: the motion has no history of {', '.join(found.states[:SHOWN])}{more}: they keep their initial values"
    )
    wrong = "and what forces make of them is not that of the motion; give the result of a run"
    return Item("states", "amber", f"{said}, {wrong} (green if there are none)")


def look_at_missing(subject: Actuated) -> Missing | None:
    """What the efforts do not give; None where they make the whole motion."""
    efforts = subject.efforts
    if efforts.complete:
        return None
    k = int(np.argmax(efforts.missing_share))
    share, effort, time = float(efforts.missing_share[k]), float(efforts.missing[k]), float(efforts.time[k])
    return Missing(share, time, effort, efforts.missing_at, efforts.limited)


def say_missing(found: Missing) -> Item:
    """How much is missing, where, and why."""
    where = f", most of it as {found.effort:.4g} on {found.coordinate}" if found.coordinate else ""
    why = "limits hold the actuators back" if found.limited else "no actuator gives it"
    said = (
        f"Efforts: they do not make this motion: {100.0 * found.share:.3g} % of the generalised forces are missing at "
        f"t = {found.time:.6g} s{where}; {why}"
    )
    return Item("missing", "amber", f"{said} (green if none are)", found.share, time=found.time)


def look_at_surplus(subject: Actuated) -> Surplus | None:
    """Actuators more than needed."""
    efforts = subject.efforts
    return None if efforts.unique else Surplus(len(efforts.actuators) - efforts.rank)


def say_surplus(found: Surplus) -> Item:
    """That other efforts make the same motion."""
    several = f"{found.actuators} more actuator{'s' * (found.actuators > 1)} than needed"
    said = f"Efforts: {several}: these are those of least weighted norm, others do as well"
    return Item("unique", "green", f"{said} (said, always green)")


CHECKS = (
    Check("motion", Actuated, look_at_motion, say_motion, 12, (), "Motion"),
    Check("open_joints", Actuated, look_at_joints, say_joints, 20, line="violation"),
    Check("held_states", Actuated, look_at_states, say_states, 38, line="states"),
    Check("missing", Actuated, look_at_missing, say_missing, 40, (), "Efforts"),
    Check("surplus", Actuated, look_at_surplus, say_surplus, 42, (), "Efforts", line="unique"),
)
