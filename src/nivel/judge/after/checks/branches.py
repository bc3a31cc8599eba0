"""Branches of the motion: singular positions that a run passes, and velocities that jump there against the inertia.

Velocities at two frames and the accelerations there tell a jump between them. Where steps are chosen, very short ones tell it as well:
then the method has followed the motion round a corner, which joints that are open by round-off make of two branches that cross.
"""

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.run import LEAST, PARTS, TAKEN
from nivel.judge.after.passages import LEAST_FRAMES, Passage, Track, can_be_singular, passages, row_pivots, why_not
from nivel.judge.after.report import SECOND_RUN, STEPS, Check
from nivel.judge.after.subject import Run
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.results.scales import Readable
from nivel.results.trust import Item

SHOWN = 5  # times in a sentence
SEVERAL = "at t = {time} s the motion may continue in more than one way"


class Passages(Struct):
    """All passages of a run, in the order of time."""

    every: tuple[Passage, ...]


class Unsearched(Struct):
    """Why singular positions were not searched for."""

    why: str


def _look_for_passages(run: Run) -> Passages | None:
    found = tuple(passages(run))
    return Passages(found) if found else None


def _say_passages(found: Passages) -> Item:
    every = found.every
    times = ", ".join(f"{each.time:.6g}" for each in every[:SHOWN]) + (" …" if len(every) > SHOWN else "")
    joints = ", ".join(dict.fromkeys(name for each in every for name in each.joints))
    text = (
        f"Singular: at t = {times} s the machine passes a position where its motion branches (constraints of {joints} depend on each "
        f"other); the computed motion continues by inertia, but a real machine may take another branch; reactions near this position are "
        f"not reliable (green if none, amber otherwise)"
    )
    return Item("singular", "amber", text, row=joints, time=every[0].time)


def _look_unsearched(run: Run) -> Unsearched | None:
    """Why the machine, which may have some, was not searched for singular positions."""
    why = why_not(run) if can_be_singular(run) else ""
    return Unsearched(why) if why else None


def _say_unsearched(found: Unsearched) -> Item:
    """That it was not. The line is green: nothing is known against the result."""
    return Item("unexamined", "green", f"Not examined: singular positions that the machine may pass: {found.why}")


# A jump is this share of the largest velocities there, and so many times the usual one around it.
JUMP, UNUSUAL, AROUND = 1e-2, 20.0, 5
SHORT = 1e-4  # of the usual longest step: steps are very short
# A pivot falls to this share of its middle value, squared, within a frame of a jump; the value is of so many frames.
NEAR, FRAMES = 3e-2, 24
MOST = 20  # intervals between frames that are examined
SURFACES = ("contact", "stop")


class Change(Struct):
    """A motion that changes its branch at `time` [s], in a position where rows of `joints` depend on each other. struck : the machine has
    surfaces, which may make velocities jump too. second : it is that of the second run."""

    time: float
    joints: tuple[str, ...]
    struck: bool
    second: bool


def _look_for_change(run: Run) -> Change | None:
    """The first change of the run, or of its second run."""
    if not can_be_singular(run) or why_not(run):
        return None
    own = _intervals(run, run.result, run.pace)
    other = run.second
    others = _intervals(run, other.result, other.pace) if other is not None and other.pace is not None else own[:0]
    if not len(own) and not len(others):
        return None
    pivots = row_pivots(run.prepared, run.plan.methods, run.plan.settings.duration)
    track = Track.of(run.result, pivots)
    some = np.unique(np.linspace(0, len(track.time) - 1, FRAMES).round().astype(int))
    middle = np.median(np.nan_to_num([track.at(int(k))[1] for k in some], nan=np.inf), axis=0)
    struck = any(force.type in SURFACES for force in run.machine.forces)
    if (found := _near_singular(track, own, middle)) is not None:
        return Change(*found, struck, second=False)
    if other is not None and (found := _near_singular(Track.of(other.result, pivots), others, middle)) is not None:
        return Change(*found, struck, second=True)
    return None


def _near_singular(track: Track, intervals: NDArray[np.intp], middle: Array) -> tuple[float, tuple[str, ...]] | None:
    """Time [s] and joints of the first of these intervals between frames that a singular position is in, as the motion on either side
    goes on."""
    for k in intervals[:MOST].tolist():
        for beside in {max(k - 1, 1), min(k + 2, len(track.time) - 2)}:
            place, row, least = track.least(beside, (k, k + 1), middle)
            if least < NEAR**2:
                time, _ = track.at(place, beside)
                return time, track.pivots.joints(row)
    return None


def _intervals(run: Run, result: Readable, pace: Array) -> NDArray[np.intp]:
    """Intervals between frames of a result with a jump or very short steps."""
    if len(result.time) < LEAST_FRAMES:
        return np.zeros(0, dtype=np.intp)
    short = short_steps(result.time, pace, run.plan.settings.duration) if run.plan.settings.steps == 0 else []
    return np.union1d(jumps(result, run.scales.size), short).astype(np.intp)


def jumps(result: Readable, size: float) -> NDArray[np.intp]:
    """Intervals between frames in which the velocity of a body changes by what no acceleration explains. size : of the machine [m]."""
    names = ("velocity", "angular_velocity", "acceleration", "angular_acceleration")
    if any(name not in result.variables for name in names):
        return np.zeros(0, dtype=np.intp)
    v, a = (np.stack([result.array(pair[0]) / size, result.array(pair[1])], axis=1) for pair in (names[:2], names[2:]))
    explained = 0.5 * np.diff(result.time)[:, None, None, None] * (a[1:] + a[:-1])
    left = np.abs(np.diff(v, axis=0) - explained).max(axis=(1, 2, 3), initial=0.0)
    speed = np.abs(v).max(axis=(1, 2, 3), initial=0.0)
    near = np.pad(left, AROUND, mode="edge")
    usual = np.median(np.lib.stride_tricks.sliding_window_view(near, 2 * AROUND + 1), axis=1)
    return np.flatnonzero((left > JUMP * np.maximum(speed[1:], speed[:-1])) & (left > UNUSUAL * usual))


def short_steps(time: Array, pace: Array, duration: float) -> NDArray[np.intp]:
    """Intervals between frames at `time` [s] with very short steps, where steps are chosen."""
    taken, least = pace[TAKEN], pace[LEAST]
    moved = taken > 0.0
    if not moved.any():
        return np.zeros(0, dtype=np.intp)
    short = np.flatnonzero(moved & (least < SHORT * np.median(taken[moved])))
    at = (short + 0.5) / PARTS * duration
    return np.clip(np.searchsorted(time, at) - 1, 0, len(time) - 2)


def _say_change(found: Change) -> Item:
    joints, green = ", ".join(found.joints), "(green if no branch is changed)"
    among = f"(constraints of {joints} depend on each other)"
    at, verdict = f"at t = {found.time:.6g} s", "amber"
    if found.second:
        text = (
            f"the second run changes the branch of its motion {at} {among}, so it tells nothing of this run after that"
        )
    elif found.struck:
        text = (
            f"velocities jump {at}, in or near a position where the motion branches {among}: unless something is struck there, the "
            f"motion has changed its branch against its inertia"
        )
    else:
        verdict = "red"
        text = (
            f"{at} the computed motion turns from one branch to another, in a position where both are possible {among}; by inertia it "
            f"would go straight on. What follows is not the motion of this model: take a larger tolerance, fixed steps or another method"
        )
    return Item("branch", verdict, f"Branch: {text} {green}", row=joints, time=found.time)


CHANGED = "at t = {time} s one of them changes the branch of its motion"


CHECKS = (
    Check("singular", Run, _look_for_passages, _say_passages, 250, (SECOND_RUN,), "Singular position", blind=SEVERAL),
    Check("unsearched", Run, _look_unsearched, _say_unsearched, 912, (SECOND_RUN,), line="unexamined"),
    Check("branch", Run, _look_for_change, _say_change, 252, (STEPS,), "Branch", blind=CHANGED),
)
