"""Steps of a run: too long for what is fastest, turns of bodies in a step, and what no frame shows."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.run import TURNED
from nivel.judge.after.report import FIXED_STEPS, FRAMES, Check, Need
from nivel.judge.after.subject import Actuated, Positions, Run
from nivel.judge.during.growth import fastest, held_step
from nivel.lazy import Struct
from nivel.results.curve import ROUNDED, Curve, curve, extreme
from nivel.results.frames.contents import shape_of
from nivel.results.frames.loads import with_probes
from nivel.results.result import Result
from nivel.results.trust import Item, Threshold, amount, number, worst

STEP_RATE = Threshold(
    0.3,
    math.inf,
    "The fastest rate of the machine times the step, reported if a run is red. Above 0.3 an explicit method does not resolve motions "
    "of this rate; above 1 to 3 it diverges.",
)
EXPLICIT = Need("an explicit method", lambda run: run.prepared.integrator.kind == "explicit")
RATES_KNOWN, MOVING = (FIXED_STEPS, EXPLICIT), (Run, Positions, Actuated)


class Fast(Struct):
    """The fastest rate [1/s] of a machine and the part that it is of, the step [s] of a run, and the longest with which `method` holds
    that rate [s]."""

    part: str
    rate: float
    step: float
    held: float
    method: str


def _look_at_steps(run: Run) -> Fast | None:
    """The fastest rate at the start or in the last state; None where the run is not red, or has failed: then its advice has told."""
    if worst(run.items) != "red" or run.outcome == "failed":
        return None
    settings, prepared, last = run.plan.settings, run.prepared, run.finished.last
    states = [(0.0, prepared.start), *([last] if last is not None else [])]
    found = [each for each in (fastest(prepared.motion, t, y) for t, y in states) if each is not None]
    most = max(found, key=lambda each: each.rate, default=None)
    if most is None:
        return None
    return Fast(most.part, most.rate, settings.step, held_step(settings.integrator, most.rate), settings.integrator)


def _say_steps(found: Fast) -> Item:
    of = f", of {found.part}" if found.part else ""
    too_long = found.step > found.held
    step, does = (found.held, "holds") if too_long else (STEP_RATE.green / found.rate, "follows")
    said = f"the fastest rate of the machine is {number(found.rate)}/s{of}, and {found.method} {does} it with steps below {number(step)} s"
    text = f"Steps: {said}, but the step is {number(found.step)} s; use a shorter step, or `integrator: radau`"
    return STEP_RATE.item("steps", text, found.step * found.rate, row=found.part)


TURN_IN_STEP = Threshold(
    0.5,
    3.0,
    "Rotation in a step, in radians. At 0.5 the error of methods of order four is 2e-4 rad a turn. Near half a turn (3 rad) no method "
    "can determine the sense of the rotation.",
)
TURNED_FAR = "{row} rotates too far in a step"


class Turn(Struct):
    """The largest angle [rad] by which a body turned in one step, and at which `time` [s]. counted : turns are part of the state, so that
    none is lost."""

    body: str
    angle: float
    time: float
    counted: bool = False


def _look_at_turns(run: Run) -> Turn | None:
    """The largest turn in a step; the body is the fastest one then. Where steps are chosen no body turns too far."""
    result, settings, turned = run.result, run.plan.settings, run.pace[TURNED]
    counted = settings.coordinates == "relative"
    if "angular_velocity" not in result.variables or not turned.size:
        return None
    part = int(np.argmax(turned))
    time = float((part + 0.5) / len(turned) * settings.duration)
    frame = min(int(np.searchsorted(result.time, time)), len(result.time) - 1)
    speed = np.linalg.norm(result.array("angular_velocity", slice(frame, frame + 1))[0], axis=-1)
    return Turn(result.coordinates["body"][int(np.nan_to_num(speed).argmax())], float(turned[part]), time, counted)


def _say_turn(found: Turn) -> Item:
    threshold = Threshold(TURN_IN_STEP.amber, math.inf, "") if found.counted else TURN_IN_STEP
    lost = "forces that depend on its angle are not resolved" if found.counted else "its turns can no longer be counted"
    meaning = lost if found.angle > TURN_IN_STEP.amber else "that is more than the method resolves"
    turns = f"{found.body} rotates by {number(found.angle)} rad in one step at t = {found.time:.6g} s"
    said = f"Turning: {turns}, and {meaning}; use shorter steps"
    return threshold.item("turn", said, found.angle, found.time, found.body)


# a peak that may be larger by this share is told; below it plots and tables show it
HIDDEN = 0.05
# of its range in the frames: a motion that goes otherwise between them is another one than they show
OTHERWISE = 1e-2
# of the largest range of a variable: less is no motion
STILL = 1e-9
# frames that are looked at, at most
MOST = 20_000
TOGETHER = 32  # curves that are looked at at once
LOADS = ("force.", "driver.", "sensor.", "hydraulics.")
# of modes only the sum is a place: fast ones of small amplitude swing between all frames
MOTIONS = ("position", "joint_coordinate")
NOT_SHOWN = (".sticks", ".count", "_local")


class Hidden(Struct):
    """The number whose peak frames may hide most of, as a share of its largest stored value."""

    name: str
    share: float


class Otherwise(Struct):
    """The number that goes otherwise between frames, or positions, by `off` [units], the largest as a share of its range. motion : it is a
    place, or an analysis of positions was made, of which each number is one of the motion that was asked for."""

    name: str
    off: float
    units: str
    share: float
    motion: bool
    positions: bool


def _look_between_frames(run: Run) -> Hidden | None:
    result, worst = run.result, Hidden("", HIDDEN)
    if len(result.time) > MOST:
        return None
    for names, of in _curves(result):
        found = extreme(of)
        shares = found.doubt / np.maximum(np.abs(found.value), 1e-300)
        for name, share in zip(names, shares.tolist(), strict=True):
            if np.isfinite(share) and share > worst.share:
                worst = Hidden(name, share)
    return worst if worst.name else None


def _curves(result: Result) -> Iterator[tuple[list[str], Curve]]:
    for name in ("joint_force", "joint_torque"):
        if name in result.variables:
            size = np.linalg.norm(result.array(name), axis=2)
            of = with_probes(result, name, curve(result.time, size))
            floor = 1e-9 * float(np.max(size, initial=0.0))
            joints = [f"{joint}.{name.removeprefix('joint_')}" for joint in result.coordinates["joint"]]
            yield from _in_blocks(joints, of, size.max(axis=0, initial=0.0) > floor)
    names = [
        # numbers without units are shares, directions and marks of what sticks
        name
        for name, variable in result.variables.items()
        if name.startswith(LOADS)
        and variable.dims == ("time",)
        and (variable.units or result.units(name)) not in ("", "1")
    ]
    if names:
        every = curve(result.time, np.column_stack([result.array(name) for name in names]))
        size = np.max(np.abs(every.value), axis=0, initial=0.0)
        yield from _in_blocks(names, every, np.ptp(every.value, axis=0) > 1e-9 * size)


def _in_blocks(names: list[str], of: Curve, chosen: NDArray[np.bool_]) -> Iterator[tuple[list[str], Curve]]:
    """The chosen columns, some at a time: what is made of them is many times as large."""
    columns = np.flatnonzero(chosen)
    for start in range(0, len(columns), TOGETHER):
        k = columns[start : start + TOGETHER]
        parts = (each[:, k] for each in (of.value, of.rate, of.doubt, of.hidden))
        yield [names[each] for each in k], Curve(of.time, *parts)


def _say_between_frames(found: Hidden) -> Item:
    """The line is green: the stored numbers are right."""
    why = f"that of {found.name} may be {number(100.0 * found.share)} % larger than any stored number"
    said = f"Not examined: peaks, work and cycles between frames: {why}; a shorter output_interval shows them"
    return Item("unexamined", "green", said, row=found.name)


def _look_otherwise(subject: Run | Positions | Actuated) -> Otherwise | None:
    """The worst number at a probe: of places, if one of these goes otherwise, else of all; of efforts what their own times leave open."""
    positions = not isinstance(subject, Run)
    found = [
        each
        for variable, off in subject.between_frames.items()
        if not variable.endswith(NOT_SHOWN)
        for each in _of_variable(subject.result, variable, np.asarray(off, dtype=float), positions)
    ]
    if not found and isinstance(subject, Actuated):
        name, off, units, share = subject.efforts.open_between
        if off > ROUNDED * _energy(subject) / (subject.scales.size if units == "N" else 1.0):
            return Otherwise(f"the effort of {name}", off, units, share, motion=True, positions=True)
        return None
    return max(found, key=lambda each: (each.motion, each.share), default=None)


def _energy(subject: Actuated) -> float:
    """[J] the largest kinetic energy: efforts that are nothing beside it are round-off."""
    known = "kinetic_energy" in subject.result.variables
    return float(np.max(subject.result.array("kinetic_energy"), initial=0.0)) if known else 0.0


def _of_variable(result: Any, variable: str, off: NDArray[np.float64], positions: bool) -> Iterator[Otherwise]:
    values = result.array(variable).reshape(len(result.time), -1)
    off = np.where(off > ROUNDED * np.abs(values).max(initial=0.0), off, 0.0)
    if not off.any():
        return
    ranges = np.ptp(values, axis=0)
    # a column that hardly moves beside the others of its variable moves by their round-off
    share = off / np.maximum(ranges, max(STILL * float(ranges.max(initial=0.0)), 1e-300))
    k = int(np.argmax(share))
    dims = result.variables[variable].dims[1:]
    place = np.unravel_index(k, shape_of(result.variables[variable], result.coordinates)) if dims else ()
    names = [result.coordinates[dim][at] for dim, at in zip(dims, place, strict=True)]
    name = ".".join([*names[:1], variable.removeprefix("joint_") if names else variable, *names[1:]])
    is_motion = positions or (variable in MOTIONS and float(share[k]) > OTHERWISE)
    units = result.units(name) if name in result else result.variables[variable].units
    yield Otherwise(name, float(off[k]), units, float(share[k]), is_motion, positions)


def _say_otherwise(found: Otherwise) -> Item:
    """Amber where the motion itself is another one between frames."""
    frames, what = (
        ("positions", "more positions show") if found.positions else ("frames", "a shorter output_interval shows")
    )
    off = f"{found.name} may go {amount(found.off, found.units)} beyond what {frames} show"
    if found.motion:
        said = f"Between {frames}: {off}; {what} it (green if it goes along a smooth curve)"
        return Item("between_frames", "amber", said, row=found.name)
    return Item(
        "unexamined", "green", f"Not examined: peaks, work and cycles between frames: {off}; {what} it", row=found.name
    )


CHECKS = (
    Check("steps", Run, _look_at_steps, _say_steps, 350, RATES_KNOWN, "Steps", STEP_RATE, quiet=True, last=True),
    Check("turn", Run, _look_at_turns, _say_turn, 230, (FIXED_STEPS,), "Turning", TURN_IN_STEP, TURNED_FAR, quiet=True),
    Check("between_frames", Run, _look_between_frames, _say_between_frames, 914, (FRAMES,), line="unexamined"),
    Check("otherwise", MOVING, _look_otherwise, _say_otherwise, 27, (FRAMES,), "Between frames", line="between_frames"),
)
