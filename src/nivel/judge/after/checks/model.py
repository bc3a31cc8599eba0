"""Model of a run: what its translation left out, what had no part in it, unusual numbers, and a start that is not what was given."""

import math
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from nivel.elements.joints.joint import CoordinateRates
from nivel.judge.after.report import FRAMES, Check
from nivel.judge.after.subject import Equilibria, Linearisation, Positions, Run
from nivel.judge.before.unusual import excess, in_words, remarks, stretched_ropes
from nivel.lazy import Struct
from nivel.machine.bodies.body import Body
from nivel.machine.given import Usual
from nivel.machine.machine_record import MachineRecord
from nivel.results.trust import ROUND_OFF, Item, Threshold, number
from nivel.system.joint_frames import as_placed


class Loss(Struct):
    """A part of the model that has an influence on the motion and is not in the machine."""

    part: str


def _look_at_losses(subject: Run | Equilibria | Positions) -> list[Loss]:
    return [Loss(part) for part in subject.machine.left_out]


def _say_loss(loss: Loss) -> Item:
    """The part, and what ends the line."""
    advice = "where it is written as elements of the machine, or has no part in this motion, take it out of `left_out`"
    return Item("losses", "amber", f"Left out of the model: {loss.part}; {advice}", row=loss.part)


AT_REST = 1e-6  # of the machine's size, or of a radian: bodies that stay nearer to their start do not move


class Still(Struct):
    """A run in which nothing moves: how far any body was from its start [m] and [rad] at most."""

    distance: float
    angle: float


def _look_for_rest(run: Run) -> Still | None:
    """The largest motion of any body, where it is none."""
    result, size = run.result, run.scales.size
    if len(result.time) < 2 or not {"position", "orientation"} <= result.variables.keys() or not run.machine.bodies:
        return None
    place, theta = result.array("position"), result.array("orientation")
    distance = float(np.max(np.linalg.norm(place - place[0], axis=-1), initial=0.0))
    sine = np.minimum(np.linalg.norm(theta - theta[0], axis=-1), np.linalg.norm(theta + theta[0], axis=-1))
    angle = 2.0 * float(np.max(sine, initial=0.0))  # of a small turn, |θ - θ₀| is half of it
    return Still(distance, angle) if distance <= AT_REST * size and angle <= AT_REST else None


def _say_rest(found: Still) -> Item:
    """That nothing moved. It may be what was asked for."""
    text = (
        f"Still: nothing moved by more than {number(found.distance)} m or turned by more than {number(found.angle)} rad"
    )
    return Item("still", "green", f"{text} (said, always green)")


class Missed(Struct):
    """An event that never came, and whether it would have ended the run."""

    name: str
    stops: bool


def _look_for_missed(run: Run) -> list[Missed]:
    """All events of the machine that the run has not met, where it reached an end."""
    came = {event.name for event in run.finished.events}
    return [Missed(event.name, event.stop) for event in run.machine.events if event.name not in came]


def _say_missed(found: Missed) -> Item:
    """That it never came. It may be what was hoped for."""
    text = f"Missed events: {found.name} never came{', so the run went on to its duration' if found.stops else ''} (said, always green)"
    return Item("missed_events", "green", text, row=found.name)


SHOWN = 8  # numbers of which each has a line
UNUSUAL = Threshold(
    1.0,
    math.inf,
    "By how many times a number is beyond those of real machines, from small instruments to the largest that are built. The result is "
    "exact for the model all the same; the model may have a slip of a unit.",
)


class Unusual(Struct):
    """A number of the machine file or of the result, in words, and by how many times it is beyond what is usual; infinite where that is
    no matter of its size. time [s] : of a result, when it is largest."""

    name: str
    said: str
    share: float
    time: float | None = None


def _look_for_unusual(subject: Run | Equilibria | Positions) -> list[Unusual]:
    found = [Unusual(remark.place, str(remark.fault), remark.number) for remark in remarks(subject.machine)]
    found += [
        Unusual(rope.place.removeprefix("forces."), str(rope.fault), rope.number)
        for rope in stretched_ropes(subject.machine, partial(as_placed, subject.machine))
    ]
    found += _of_result(subject)
    return sorted(found, key=lambda each: -each.share)[:SHOWN]


def _say_unusual(found: Unusual) -> Item:
    text = f"Plausibility: {found.said}"
    if math.isinf(found.share):
        return Item("plausible", "amber", text, row=found.name)
    return UNUSUAL.item("plausible", text, found.share, found.time, found.name)


def _of_result(subject: Run | Equilibria | Positions) -> Iterator[Unusual]:
    """Outputs of elements, speeds of bodies and joints, and the size of the machine."""
    machine, result = subject.machine, subject.result
    if not len(result.time):
        return
    kinds = {("hydraulics", each.name): type(each).usual for each in machine.hydraulics}
    kinds |= {("force", each.name): type(each).usual for each in machine.forces}
    for name in result.variables:
        section, _, output = name.partition(".")
        owner, _, word = output.partition(".")
        ranges = kinds.get((section, owner), {})
        known = next((usual for start, usual in ranges.items() if word.startswith(start)), None)
        if known is not None:
            yield from _of_columns(subject, result.array(name)[:, None], [output], [known])
    names = result.coordinates.get("body", ())
    for variable, usual in Body.usual.items():
        if variable in result.variables:
            speed = np.linalg.norm(result.array(variable), axis=-1)
            yield from _of_columns(subject, speed, [f"{variable} of {name}" for name in names], [usual] * len(names))
    if "joint_rate" in result.variables:
        labels = result.coordinates[result.variables["joint_rate"].dims[1]]
        units = ["rad/s" if each.rpartition(".")[2].startswith("angle") else "m/s" for each in labels]
        usual = [CoordinateRates.usual[each] for each in units]
        yield from _of_columns(subject, result.array("joint_rate"), [f"rate of {each}" for each in labels], usual)
    size, kind = subject.scales.size, subject.scales.size_kind
    if machine.joints or machine.beams:  # what flies freely may be anywhere
        share = excess(size, MachineRecord.usual["size"])
        if share > 1.0:
            yield Unusual(kind, f"the {kind} is {in_words(size, MachineRecord.usual['size'])}", share)


def _of_columns(
    subject: Run | Equilibria | Positions, values: Any, names: list[str], ranges: list[Usual]
) -> Iterator[Unusual]:
    """The largest magnitude of each column that is beyond its range; small ones, as of a valve that is shut, are usual."""
    sizes = np.abs(np.nan_to_num(np.asarray(values, dtype=float), nan=0.0))
    frames = np.argmax(sizes, axis=0)
    for k, (name, usual) in enumerate(zip(names, ranges, strict=True)):
        value = float(sizes[frames[k], k])
        share = excess(value, Usual(0.0, usual.most, usual.unit))
        if share > 1.0:
            time = float(subject.result.time[frames[k]])
            yield Unusual(name, f"{name} is {in_words(value, usual)}, at t = {time:.6g} s", share, time)


MOVED = Threshold(
    1e-2,
    math.inf,
    "Of the machine's size, of a radian or of the velocity that was given. Drawings are rounded to less than a hundredth; a start that "
    "differs by more is another one.",
)

SNAPPED = Threshold(
    0.5,
    math.inf,
    "Of the machine's size. Loads move a machine less than that to its equilibrium; farther away it is another one than "
    "that near to the drawing.",
)


class Moved(Struct):
    """The body that was moved farthest to close a joint: its name, by how much [m] and [rad], as a share of the machine's size or of a
    radian, and the row that was open by `gap`."""

    name: str
    distance: float
    angle: float
    share: float
    gap: float
    row: str


class Settled(Struct):
    """The body that is farthest from where it was given in the equilibrium from which a run starts: by how much [m] and [rad], and its
    distance as a share of the machine's size."""

    name: str
    distance: float
    angle: float
    share: float


class Changed(Struct):
    """The body whose given velocity was changed most: by how much [m/s] and [rad/s], and as a share of what was given."""

    name: str
    velocity: float
    angular_velocity: float
    share: float


def _look_for_moves(subject: Run | Linearisation) -> Moved | None:
    """The farthest move to close joints; start values of joints move bodies too, as was asked for, and so do drivers and couplings."""
    moved = _farthest(subject)
    return moved if moved is not None and not _is_of_law(subject, moved) else None


def _look_for_laws(subject: Run | Linearisation) -> Moved | None:
    """The farthest move to where the law of a driver or a coupling begins, where it is not small."""
    moved = _farthest(subject)
    return moved if moved is not None and _is_of_law(subject, moved) and not moved.share < MOVED.green else None


def _farthest(subject: Run | Linearisation) -> Moved | None:
    assembly, size = subject.assembly, subject.scales.size
    gap, row = assembly.get("gap", 0.0), assembly.get("gap_row", "")
    if not gap > ROUND_OFF * max(size, 1.0):
        return None
    moves = [Moved(name, d, a, max(d / size, a), gap, row) for name, d, a in assembly.get("moved", ())]
    return max(moves, key=lambda move: move.share, default=None)


def _is_of_law(subject: Run | Linearisation, moved: Moved) -> bool:
    laws = (*subject.machine.drivers, *subject.machine.couplings)
    return moved.row.partition(".")[0] in {law.name for law in laws}


def _say_moves(found: Moved) -> Item:
    amount = f"{number(found.distance)} m and {number(found.angle)} rad"
    why = f"to close {found.row}, which was open by {number(found.gap)} as given"
    return MOVED.item("start", f"Start: {found.name} was moved by {amount} {why}", found.share, 0.0, found.name)


def _say_law(found: Moved) -> Item:
    """How far the body was moved, and by what. It is what was asked for."""
    amount = f"{number(found.distance)} m and {number(found.angle)} rad"
    text = f"Start: {found.name} was moved by {amount} to where {found.row} begins (said, always green)"
    return Item("start", "green", text, row=found.name, time=0.0)


def _look_at_equilibrium(run: Run) -> Settled | None:
    """The farthest way to the equilibrium from which the run starts; None where it starts from no equilibrium."""
    result, size = run.result, run.scales.size
    if run.machine.simulation.start != "equilibrium" or "position" not in result.variables:
        return None
    place, theta = result.array("position", slice(0, 1))[0], result.array("orientation", slice(0, 1))[0]
    found = []
    for k, name in enumerate(result.coordinates["body"]):
        if name not in run.machine.poses:
            continue  # a node of a beam
        position, given = run.machine.poses[name]
        distance = float(np.linalg.norm(place[k] - position))
        angle = 2.0 * float(np.arccos(np.clip(abs(np.dot(theta[k], given)), 0.0, 1.0)))
        found.append(Settled(name, distance, angle, distance / size))  # a drum turns as it likes
    return max(found, key=lambda each: each.share, default=None)


def _say_equilibrium(found: Settled) -> Item:
    amount = f"{number(found.distance)} m and {number(found.angle)} rad"
    said = f"in the equilibrium at the start {found.name} is {amount} from where it was given: the machine may have snapped through"
    return SNAPPED.item("start", f"Start: {said}", found.share, 0.0, found.name)


def _look_for_changes(subject: Run | Linearisation) -> Changed | None:
    """The largest change of a velocity that stands in the machine file."""
    given = {body.name: _speeds(body) for body in subject.machine.bodies}
    found = []
    for name, velocity, angular in subject.assembly.get("velocity_change", ()):
        v, w = given.get(name, (0.0, 0.0))
        shares = [change / own for change, own in ((velocity, v), (angular, w)) if own > 0.0]
        if shares:
            found.append(Changed(name, velocity, angular, max(shares)))
    return max(found, key=lambda each: each.share, default=None)


def _say_changes(found: Changed) -> Item:
    amount = f"{number(found.velocity)} m/s and {number(found.angular_velocity)} rad/s"
    said = f"the given velocity of {found.name} was changed by {amount}, {number(found.share)} of it, to fit the joints"
    return MOVED.item("start", f"Start: {said}", found.share, 0.0, found.name)


def _speeds(body: Body) -> tuple[float, float]:
    """Magnitudes of the velocity and the angular velocity of a body as given."""
    angular = body.angular_velocity or body.angular_velocity_body or (0.0, 0.0, 0.0)
    return float(np.linalg.norm(body.velocity)), float(np.linalg.norm(angular))


STARTED, PLACED = (Run, Linearisation), (Run, Equilibria, Positions)


CHECKS = (
    Check("losses", PLACED, _look_at_losses, _say_loss, 915, (), "Left out of the model"),
    Check("missed_events", Run, _look_for_missed, _say_missed, 916, (FRAMES,), "Missed events"),
    Check("still", Run, _look_for_rest, _say_rest, 917, (FRAMES,), "Still"),
    Check("plausible", PLACED, _look_for_unusual, _say_unusual, 920, (), "Plausibility", UNUSUAL, quiet=True),
    Check("start_equilibrium", Run, _look_at_equilibrium, _say_equilibrium, 119, (FRAMES,), line="start", quiet=True),
    Check("start_moved", STARTED, _look_for_moves, _say_moves, 120, (), "Start", MOVED, line="start", quiet=True),
    Check("start_law", STARTED, _look_for_laws, _say_law, 122, line="start"),
    Check("start_velocity", STARTED, _look_for_changes, _say_changes, 121, line="start", quiet=True),
)
