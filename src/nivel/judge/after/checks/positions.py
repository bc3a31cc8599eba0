"""Positions of kinematic analyses: branches, places that a posture reaches, ranges of a coordinate, and curves of all positions."""

import numpy as np

from nivel.judge.after.checks.joints import OPENING
from nivel.judge.after.report import Check
from nivel.judge.after.subject import Curve, Led, Positions, Reach
from nivel.lazy import Struct
from nivel.results.trust import Item, Threshold, Verdict, number
from nivel.words.wording import first_of

# share of the least singular value at the start below which a position is near a singular one; names and times in a sentence
NEAR_SINGULAR, SHOWN = 1e-3, 4


class Shortened(Struct):
    """Steps that were shortened on the way."""

    count: int


class Branches(Struct):
    """The least singular value of the constraints, as a share of that at the start, its time [s], and the joints that depend on each other
    most there. passed : pairs of times [s] between which a singular position was passed."""

    share: float
    time: float
    joints: tuple[str, ...]
    passed: tuple[tuple[float, float], ...]


class Histories(Struct):
    """First-order states that a motion does not have; they keep their values of the start."""

    states: tuple[str, ...]


def _look_at_branches(subject: Positions) -> Branches | None:
    """The singular position that it came nearest to; None of machines without constraints."""
    near = subject.near
    return Branches(near.least, near.time, near.joints, subject.passed) if near is not None else None


def _look_at_steps(subject: Positions) -> Shortened | None:
    return Shortened(subject.halved) if subject.halved else None


def _say_steps(found: Shortened) -> Item:
    said = f"{found.count} were shortened, because the machine moves fast or comes near a singular position"
    return Item("steps", "green", f"Steps: {said} (said, always green)")


def _say_branches(found: Branches) -> Item:
    among = f" (among {', '.join(found.joints[:SHOWN])})" if found.joints else ""
    if found.passed:
        some = first_of([f"{a:.6g} and {b:.6g} s" for a, b in found.passed], SHOWN, more="times more")
        said = f"Branches: a singular position is passed between {some}{among}: the positions beyond it are one of several branches"
        text = f"{said} that fit the drivers (amber if any is passed)"
        return Item("branches", "amber", text, time=found.passed[0][1])
    time = found.time
    if found.share < NEAR_SINGULAR:
        said = f"Branches: the machine comes near a singular position at t = {time:.6g} s{among}, where branches of positions meet"
        return Item(
            "branches", "amber", f"{said} (amber below {NEAR_SINGULAR:g} of the distance at the start)", time=time
        )
    least = f"the distance from singular ones is at least {number(found.share)} of that at the start"
    said = f"Branches: the positions stay on one branch; {least} (green from {NEAR_SINGULAR:g} on)"
    return Item("branches", "green", said, time=time)


def _look_at_histories(subject: Positions) -> Histories | None:
    states = tuple(fact.name for fact in subject.prepared.motion.system.states if not fact.integral)
    return Histories(states) if states else None


def _say_histories(found: Histories) -> Item:
    said = f"States: {first_of(found.states, SHOWN)} have a history, which kinematics does not compute: they keep their initial values"
    wrong = "efforts and reactions that depend on them are wrong"
    return Item("states", "amber", f"{said}, and {wrong} (green if there are none)")


# singular values below this share of the largest are near a singular posture
NEAR = 1e-3
# [m] or [m/m]: what no coordinate moves, as across the plane of an arm, has singular values of round-off all along
STILL = 1e-9
# lines of kinematics that are of positions
OF_POSITIONS = ("violation", "followed", "branches")
ENDS = Threshold(
    1e-6,
    1e-3,
    "Ends of a range and turning points of the curve of positions are found in two ways, each to round-off. What they differ by is how far "
    "one of them is from the end, as a share of the range.",
)


class Reached(Struct):
    """How many places are reached of how many; the largest errors of those [m], [rad], and of the others."""

    count: int
    reached: int
    position: float
    orientation: float
    missed: float


class Postures(Struct):
    """Times [s] at which a posture was found only from another start, so that coordinates may jump, and at which it is near a singular
    one."""

    jumps: tuple[float, ...]
    singular: tuple[float, ...]


class Ways(Struct):
    """The worst line of the kinematic analyses of both ways: its verdict and text, empty where all are green."""

    verdict: Verdict
    text: str


class Ends(Struct):
    """What the ends of a range differ by from the nearest turning points, as a share of the range; at which end [rad or m]."""

    difference: float
    end: float
    unit: str


class Opening(Struct):
    """How far joints are open at most, as a share of their sizes."""

    share: float


class Whole(Struct):
    """Whether a curve comes back to where it began, and at how many places others cross it."""

    closed: bool
    crossed: int
    positions: int


def _look_at_places(subject: Led) -> Reached:
    """Errors of the places, evaluated at the postures that were found."""
    path = subject.path
    error, there = path.error, path.reached
    position, orientation = (float(error[there, k].max(initial=0.0)) for k in (0, 1))
    missed = float(error[~there, 0].max(initial=0.0))
    return Reached(len(there), int(there.sum()), position, orientation, missed)


def _say_places(found: Reached) -> Item:
    near = f"to {number(found.position)} m and {number(found.orientation)} rad"
    if found.reached == found.count:
        return Item("places", "green", f"Places: all {found.count} are reached {near} (green if all are)")
    away = f"the nearest postures found to the others are up to {number(found.missed)} m away"
    said = f"Places: {found.reached} of {found.count} are reached; {away}"
    return Item("places", "amber" if found.reached else "red", f"{said} (green if all are reached, red if none is)")


def _look_at_postures(subject: Led) -> Postures:
    """Postures that do not follow from the one before, and singular ones."""
    path, size = subject.path, subject.path.smallest_singular_value
    anew = np.flatnonzero((path.starts > 1) & path.reached & (np.arange(len(size)) > 0))
    largest = float(size.max(initial=0.0))
    near = np.flatnonzero((size < NEAR * largest) & (largest > STILL))
    return Postures(tuple(map(float, path.time[anew])), tuple(map(float, path.time[near])))


def _say_postures(found: Postures) -> Item:
    said = []
    if found.jumps:
        said.append(
            f"at t = {_listed(found.jumps)} s the posture was found from another start, so coordinates may jump there"
        )
    if found.singular:
        near = f"near t = {_listed(found.singular)} s a posture is nearly singular"
        said.append(f"{near}: small changes of the path are large ones of coordinates")
    if said:
        return Item("postures", "amber", f"Postures: {'; '.join(said)} (green if each follows from the one before)")
    return Item(
        "postures", "green", "Postures: each follows from the one before (amber at jumps and singular postures)"
    )


def _listed(times: tuple[float, ...]) -> str:
    return first_of([f"{each:.6g}" for each in times], SHOWN)


def _look_at_ways(subject: Reach) -> Ways:
    """The kinematic analyses of both ways, as far as positions go: that they end is what was asked for, at a singular position, near which
    speeds are beyond all bounds."""
    items = [item for trust in subject.ways for item in trust.items if item.name in OF_POSITIONS]
    passed = [trust.found.get("branches") for trust in subject.ways]
    if not any(each and each["passed"] for each in passed):
        items = [item for item in items if item.name != "branches"]
    for colour in ("red", "amber"):
        for item in items:
            if item.verdict == colour:
                return Ways(colour, item.text)
    return Ways("green", "")


def _say_ways(found: Ways) -> Item:
    told = found.text or "joints stay closed, and the coordinate follows its driver"
    return Item("ways", found.verdict, f"Ways: {told} (the worst line of both)")


def _look_at_ends(subject: Reach) -> Ends | None:
    """Ends at which the machine jams, against the turning points of the curve of positions."""
    span = max(subject.range.high - subject.range.low, 1e-300)
    found = subject.range
    jams = [end for end, why in ((found.low, found.low_reason), (found.high, found.high_reason)) if why]
    if not jams or not subject.turning:
        return None
    aside = [min(abs(end - each) for each in subject.turning) / span for end in jams]
    return Ends(max(aside), jams[int(np.argmax(aside))], found.unit)


def _say_ends(found: Ends) -> Item:
    away = f"{number(found.difference)} of the range away from turning points of the curve of positions"
    said = f"Ends: {away}, at {found.end:.6g} {found.unit}"
    return ENDS.item("ends", said, found.difference)


def _look_at_opening(subject: Curve) -> Opening:
    return Opening(subject.opening)


def _say_opening(found: Opening) -> Item:
    return OPENING.item("violation", f"Joints: open by at most {number(found.share)} of their sizes", found.share)


def _look_at_curve(subject: Curve) -> Whole:
    curve = subject.curve
    return Whole(curve.closed, len(curve.crossed), len(curve.arc))


def _say_curve(found: Whole) -> Item:
    rule = "green if it comes back to its begin and no other crosses it"
    if not found.closed:
        text = f"Curve: it does not come back within {found.positions} positions: turning points beyond are not known ({rule})"
        return Item("curve", "amber", text)
    if found.crossed:
        text = f"Curve: another one crosses it at {found.crossed} places: the positions behind are one of several branches ({rule})"
        return Item("curve", "amber", text)
    return Item("curve", "green", f"Curve: it comes back to its begin, and no other crosses it ({rule})")


CHECKS = (
    Check("shortened_steps", Positions, _look_at_steps, _say_steps, 34, line="steps"),
    Check("branches", Positions, _look_at_branches, _say_branches, 36, (), "Branches of positions"),
    Check("histories", Positions, _look_at_histories, _say_histories, 38, line="states"),
    Check("places", Led, _look_at_places, _say_places, 10, (), "Places"),
    Check("postures", Led, _look_at_postures, _say_postures, 36, (), "Postures"),
    Check("ways", Reach, _look_at_ways, _say_ways, 10, (), "Ways"),
    Check("ends", Reach, _look_at_ends, _say_ends, 12, (), "Ends", ENDS),
    Check("opening", Curve, _look_at_opening, _say_opening, 10, (), "Joints closed", OPENING, line="violation"),
    Check("curve", Curve, _look_at_curve, _say_curve, 36, (), "Curve"),
)
