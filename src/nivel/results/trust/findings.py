"""Findings of checks beyond the balance of energy, as lines of the trust report; what is in order is not told."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from nivel.results.trust.basis import Lacking
from nivel.results.trust.bending import Bent
from nivel.results.trust.missed_impulse import Unseen
from nivel.results.trust.part_energy import PartError
from nivel.results.trust.passed_contacts import Passed
from nivel.results.trust.second_look import Damped, Growth, OwnError
from nivel.results.trust.steps_seen import Rounding, Turn
from nivel.results.trust.verdicts import CHECKS, THRESHOLDS, Item, Threshold, number, quantity

SHOWN = 5  # functions of which each has a line
# What is hidden between the places where steps look counts above so many times what two runs are apart by, and this share of a load.
BEYOND_AGREED, LEAST_HIDDEN = 10.0, 1e-10


@dataclass(frozen=True)
class Passage:
    """A position passed at `time` [s] in which rows of `joints` depend on each other; left : of their independence, as a share."""

    time: float
    joints: tuple[str, ...]
    left: float


@dataclass(frozen=True)
class Fast:
    """The fastest rate [1/s] of a machine and the part that it is of, the step [s] of a run, and the longest with which `method` holds
    that rate [s]."""

    part: str
    rate: float
    step: float
    held: float
    method: str


@dataclass(frozen=True)
class Findings:
    """Each None, or empty, where it was not looked at; see the modules of their types. unseen : by steps. between : samples, of functions
    that are sampled. method : the integrator. agreed : what two runs are apart by, as a share of the largest motion."""

    unseen: Sequence[Unseen] = ()
    between: Sequence[Unseen] = ()
    turn: Turn | None = None
    rounding: Rounding | None = None
    own: OwnError | None = None
    damped: Damped | None = None
    growth: Growth | None = None
    unstiffened: Bent | None = None
    passages: Sequence[Passage] = ()
    passed: Sequence[Passed] = ()
    bent: Bent | None = None
    coarse: Item | None = None
    lacking: Lacking | None = None
    meshed: Bent | None = None
    part: PartError | None = None
    method: str = ""
    agreed: float | None = None


def finding_items(found: Findings) -> Iterator[Item]:
    """The lines of what is not green."""
    yield from _unseen_items(found.unseen, found.agreed)
    yield from _sampling_items(found.between)
    yield from (_passed_item(each) for each in found.passed[:SHOWN])
    if found.turn is not None:
        yield from _told(_turn_item(found.turn))
    if found.rounding is not None:
        yield from _told(_rounding_item(found.rounding))
    if found.passages:
        yield _passage_item(found.passages)
    if found.unstiffened is not None:
        yield from _told(_unstiffened_item(found.unstiffened))
    if found.bent is not None:
        yield from _told(_bent_item(found.bent))
    if found.coarse is not None:
        yield from _told(found.coarse)
    if found.meshed is not None:
        yield from _told(_meshed_item(found.meshed))
    if found.lacking is not None:
        yield from _told(_lacking_item(found.lacking))
    if found.part is not None:
        yield from _told(_part_item(found.part))
    if found.own is not None:
        yield from _told(_own_item(found.own))
    if found.damped is not None:
        yield _damped_item(found.damped, found.method)
    if found.growth is not None:
        yield _growth_item(found.growth)


def _told(item: Item) -> Iterator[Item]:
    if item.verdict != "green":
        yield item


def measured(
    name: str, text: str, value: float, time: float | None, row: str, threshold: Threshold | None = None
) -> Item:
    """An item held against a threshold, by default that of its name."""
    threshold = threshold or CHECKS[name]
    verdict = threshold.verdict(value)
    return Item(name, verdict, f"{text} ({threshold})", value, threshold.green, threshold.amber, row, time)


def _unseen_items(unseen: Sequence[Unseen], agreed: float | None) -> Iterator[Item]:
    told = sorted((each for each in unseen if _is_missed(each, agreed)), key=lambda each: -each.share)
    for each in told[:SHOWN]:
        by = "" if each.of == "time" else f" along {each.of}"
        said = f"the steps miss {number(min(each.share, 1.0))} of {each.name} at t = {each.time:.6g} s, where it changes{by} within"
        advice = f"{number(each.scale)} s, with steps of {number(each.step)} s; use steps of {number(min(each.scale, each.step) / 10.0)} s"
        if each.share < CHECKS["loads"].green:
            much = f"this is {number(each.hidden)} of it over the whole run, more than the two runs differ, and both may miss it"
            yield Item("loads", "amber", f"Loads: {said} {advice} ({much})", each.share, row=each.name, time=each.time)
        else:
            yield measured("loads", f"Loads: {said} {advice}", each.share, each.time, each.name)


def _is_missed(each: Unseen, agreed: float | None) -> bool:
    """Whether a load is missed by much, or by more than a headline that two runs agree on allows."""
    if not each.share < CHECKS["loads"].green:
        return True
    return agreed is not None and each.hidden > BEYOND_AGREED * max(agreed, LEAST_HIDDEN)


def _sampling_items(between: Sequence[Unseen]) -> Iterator[Item]:
    told = sorted((each for each in between if not each.share < CHECKS["sampling"].green), key=lambda each: -each.share)
    for each in told[:SHOWN]:
        said = f"after t = {each.time:.6g} s {each.name} changes by {number(each.share)} of its range and back between two samples"
        advice = f"{number(each.step)} s apart, within {number(each.scale)} s; use a shorter sample_time if the block shall see it"
        yield measured("sampling", f"Sampling: {said} {advice}", each.share, each.time, each.name)


def _passed_item(passed: Passed) -> Item:
    text = (
        f"Contact: {' and '.join(passed.bodies)} pass through each other at t = {passed.time:.6g} s, by {number(passed.overlap)} of "
        f"{passed.of}, and {passed.contact} does not push them apart: they overlap for only "
        f"{number(passed.lasted)} s; use steps of {number(passed.lasted / 10.0)} s, or a method that chooses its steps "
        f"(green if none do, red otherwise)"
    )
    return Item("contact", "red", text, passed.overlap, row=passed.contact, time=passed.time)


def steps_item(fast: Fast) -> Item:
    """Why a run with steps of fixed size is wrong, where its steps are too long for what is fastest."""
    of = f", of {fast.part}" if fast.part else ""
    step = fast.held if fast.step > fast.held else CHECKS["steps"].green / fast.rate
    does = "holds" if fast.step > fast.held else "follows"
    said = f"the fastest rate of the machine is {number(fast.rate)}/s{of}, and {fast.method} {does} it with steps below {number(step)} s"
    text = f"Steps: {said}, but the step is {number(fast.step)} s; use a shorter step, or `integrator: radau`"
    return measured("steps", text, fast.step * fast.rate, None, fast.part)


def _turn_item(turn: Turn) -> Item:
    threshold = Threshold(CHECKS["turn"].amber, math.inf, "") if turn.counted else CHECKS["turn"]
    lost = "forces that depend on its angle are not resolved" if turn.counted else "its turns can no longer be counted"
    meaning = lost if turn.angle > CHECKS["turn"].amber else "that is more than the method resolves"
    said = (
        f"Turning: {turn.body} rotates by {number(turn.angle)} rad in one step at t = {turn.time:.6g} s, and {meaning}"
    )
    return measured("turn", f"{said}; use shorter steps", turn.angle, turn.time, turn.body, threshold)


def _rounding_item(rounding: Rounding) -> Item:
    far = f"{rounding.body} is {number(rounding.distance)} m from the origin, where positions are rounded to {number(rounding.unit)} m"
    lost = f"over all steps this may add up to {number(rounding.share)} of the machine's size"
    return measured(
        "rounding", f"Round-off: {far}; {lost}; move the machine to the origin", rounding.share, None, rounding.body
    )


def _own_item(own: OwnError) -> Item:
    its = f"{number(own.extent)} {own.units}"
    said = f"{own.name} is off by {number(own.error)} {own.units}, {number(own.share)} of its own motion over {its}"
    return measured("parts", f"Parts: {said}", own.share, None, own.name)


def _part_item(part: PartError) -> Item:
    its = f"{number(part.share)} of its largest energy {quantity(part.energy, 'J')}"
    said = (
        f"Parts: the energy of {part.body} and the bodies joined to it has an error of {its}, at t = {part.time:.6g} s"
    )
    return measured("parts", said, part.share, part.time, part.body, THRESHOLDS["energy"])


def _passage_item(passages: Sequence[Passage]) -> Item:
    times = ", ".join(f"{each.time:.6g}" for each in passages[:SHOWN]) + (" …" if len(passages) > SHOWN else "")
    joints = ", ".join(dict.fromkeys(name for each in passages for name in each.joints))
    text = (
        f"Singular: at t = {times} s the machine passes a position where its motion branches (constraints of {joints} depend on each "
        f"other); the computed motion continues by inertia, but a real machine may take another branch; reactions near this position are "
        f"not reliable (green if none, amber otherwise)"
    )
    return Item("singular", "amber", text, row=joints, time=passages[0].time)


def _unstiffened_item(found: Bent) -> Item:
    said = (
        f"Stiffening: {found.body} has no geometric stiffness; at t = {found.time:.6g} s the square of its rotational speed is "
        f"{number(found.value)} of that of its lowest frequency; reduce it with `stiffening: true`"
    )
    return measured("stiffening", said, found.value, found.time, found.body)


def _bent_item(found: Bent) -> Item:
    said = (
        f"Bending: {found.body} bends by {number(found.value)} of its size at t = {found.time:.6g} s, but modes describe small "
        f"displacements: use a beam in its place, or several bodies"
    )
    return measured("bending", said, found.value, found.time, found.body)


def _meshed_item(found: Bent) -> Item:
    said = (
        f"Mesh: the finite elements of {found.body} have an error of {number(found.value)} of its strain energy at t = {found.time:.6g} s; "
        f"reduce it with smaller elements"
    )
    return measured("mesh", said, found.value, found.time, found.body)


def _lacking_item(lacking: Lacking) -> Item:
    said = (
        f"Modes: {lacking.body} has {lacking.modes} modes; those left out, mainly one at {number(lacking.frequency)} Hz, would have "
        f"{number(lacking.share)} of its strain energy at t = {lacking.time:.6g} s; use more `modes`"
    )
    return measured("modes", said, lacking.share, lacking.time, lacking.body)


def _damped_item(damped: Damped, method: str) -> Item:
    by = f"{method} takes" if method else "the method takes"
    text = (
        f"Damped: {by} {quantity(damped.lost, 'J')} from the motion, and {quantity(damped.lost_finer, 'J')} with finer steps: "
        f"vibrations faster than the steps are damped numerically; use steps of a tenth of their period, or add damping to the "
        f"model if these vibrations do not matter "
        f"(green if finer steps lose less, amber otherwise)"
    )
    return Item("damped", "amber", text, damped.lost)


def _growth_item(growth: Growth) -> Item:
    text = (
        f"Sensitivity: neighbouring motions separate by a factor e every {number(growth.time_constant)} s, and have separated at t = "
        f"{growth.parted:.6g} s: the motion is chaotic; after that time only means and extremes are meaningful "
        f"(green if they stay together, amber otherwise)"
    )
    return Item("sensitivity", "amber", text, time=growth.parted)
