"""Start, where it is not what was given: positions that were moved to close joints, velocities that were changed to fit them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.subject import Linearisation, Run
from nivel.machine.bodies.body import Body
from nivel.results.trust import ROUND_OFF, Item, Threshold, number

THRESHOLD = Threshold(
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


@dataclass(frozen=True)
class Moved:
    """The body that was moved farthest to close a joint: its name, by how much [m] and [rad], as a share of the machine's size or of a
    radian, and the row that was open by `gap`."""

    name: str
    distance: float
    angle: float
    share: float
    gap: float
    row: str


@dataclass(frozen=True)
class Settled:
    """The body that is farthest from where it was given in the equilibrium from which a run starts: by how much [m] and [rad], and its
    distance as a share of the machine's size."""

    name: str
    distance: float
    angle: float
    share: float


@dataclass(frozen=True)
class Changed:
    """The body whose given velocity was changed most: by how much [m/s] and [rad/s], and as a share of what was given."""

    name: str
    velocity: float
    angular_velocity: float
    share: float


def look_for_moves(subject: Run | Linearisation) -> Moved | None:
    """The farthest move to close joints; start values of joints and drivers move bodies too, as was asked for."""
    assembly, size = subject.assembly, subject.scales.size
    gap, row = assembly.get("gap", 0.0), assembly.get("gap_row", "")
    if not gap > ROUND_OFF * max(size, 1.0) or row.partition(".")[0] in {
        driver.name for driver in subject.machine.drivers
    }:
        return None
    moves = [Moved(name, d, a, max(d / size, a), gap, row) for name, d, a in assembly.get("moved", ())]
    return max(moves, key=lambda each: each.share, default=None)


def say_moves(found: Moved) -> Item:
    """How far the body was moved, and why."""
    amount = f"{number(found.distance)} m and {number(found.angle)} rad"
    why = f"to close {found.row}, which was open by {number(found.gap)} as given"
    return THRESHOLD.item("start", f"Start: {found.name} was moved by {amount} {why}", found.share, 0.0, found.name)


def look_at_equilibrium(run: Run) -> Settled | None:
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


def say_equilibrium(found: Settled) -> Item:
    """How far the equilibrium is from what was given."""
    amount = f"{number(found.distance)} m and {number(found.angle)} rad"
    said = f"in the equilibrium at the start {found.name} is {amount} from where it was given: the machine may have snapped through"
    return SNAPPED.item("start", f"Start: {said}", found.share, 0.0, found.name)


def look_for_changes(subject: Run | Linearisation) -> Changed | None:
    """The largest change of a velocity that stands in the machine file."""
    given = {body.name: _speeds(body) for body in subject.machine.bodies}
    found = []
    for name, velocity, angular in subject.assembly.get("velocity_change", ()):
        v, w = given.get(name, (0.0, 0.0))
        shares = [change / own for change, own in ((velocity, v), (angular, w)) if own > 0.0]
        if shares:
            found.append(Changed(name, velocity, angular, max(shares)))
    return max(found, key=lambda each: each.share, default=None)


def say_changes(found: Changed) -> Item:
    """What was changed of the velocity that was given."""
    amount = f"{number(found.velocity)} m/s and {number(found.angular_velocity)} rad/s"
    said = f"the given velocity of {found.name} was changed by {amount}, {number(found.share)} of it, to fit the joints"
    return THRESHOLD.item("start", f"Start: {said}", found.share, 0.0, found.name)


def _speeds(body: Body) -> tuple[float, float]:
    """Magnitudes of the velocity and the angular velocity of a body as given."""
    angular = body.angular_velocity or body.angular_velocity_body or (0.0, 0.0, 0.0)
    return float(np.linalg.norm(body.velocity)), float(np.linalg.norm(angular))


OF = (Run, Linearisation)
CHECKS = (
    Check(
        "start_equilibrium",
        Run,
        look_at_equilibrium,
        say_equilibrium,
        119,
        (FRAMES,),
        "Start",
        SNAPPED,
        line="start",
        quiet=True,
    ),
    Check("start_moved", OF, look_for_moves, say_moves, 120, (), "Start", THRESHOLD, line="start", quiet=True),
    Check("start_velocity", OF, look_for_changes, say_changes, 121, (), "Start", THRESHOLD, line="start", quiet=True),
)
