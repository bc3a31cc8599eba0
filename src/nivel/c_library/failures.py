"""Failures of a machine that runs without Python: what is said of each status, with the name of what failed where it has one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from nivel.judge.during.stop import Status
from nivel.system.system import System


class Failure(NamedTuple):
    """A status, a sentence on it with {} for the name of what failed, and the names that it may have."""

    status: Status
    sentence: str
    names: tuple[str, ...] = ()


class _Kind(NamedTuple):
    sentence: str
    names: Callable[[System], Sequence[str]] = lambda system: ()


def _rails(system: System) -> Sequence[str]:
    """Names of joint coordinates by the number of the coordinate."""
    coordinates = system.record.joints.coordinate.tolist()
    named = dict(zip(coordinates, system.layout.coordinates["joint_coordinate"], strict=True))
    return [named.get(k, "a coordinate") for k in range(max(coordinates, default=-1) + 1)]


_KINDS = {
    Status.SINGULAR: _Kind(
        "the constraint {} depends on the others here: the step is too long for this motion, or the machine is in a singular position",
        lambda system: system.rows,
    ),
    Status.NOT_FINITE: _Kind(
        "the state is no longer a number: the step is too long for this motion, or a function has no value"
    ),
    Status.FRICTION_DIVERGES: _Kind(
        "no friction {} is consistent with the reactions that it causes", lambda system: system.frictions
    ),
    Status.BRISTLE_TOO_FAST: _Kind(
        "the bristles of {} relax faster than the step can follow", lambda system: system.frictions
    ),
    Status.CONTRADICTION: _Kind(
        "the constraint {}, which repeated others at the start, contradicts them now", lambda system: system.rows
    ),
    Status.ROTATION_SINGULAR: _Kind(
        "the rotation coordinates of {} come to a singular position", lambda system: system.bodies
    ),
    Status.NOT_CONVERGED: _Kind(
        "the iteration of an implicit step finds no solution: the step is too long, or a force jumps or is too stiff"
    ),
    Status.STEP_TOO_SMALL: _Kind("the error of even the smallest step is above the tolerance"),
    Status.EVENT_NOT_FINITE: _Kind("the value of the event {} is no longer a number", lambda system: system.events),
    Status.MULTIPLIERS_NOT_FOUND: _Kind("the augmented Lagrangian finds no multipliers"),
    Status.NO_MASS_LEFT: _Kind(
        "the modes of {} take up all the mass and inertia of its frame", lambda system: system.bodies
    ),
    Status.NOT_ON_RAIL: _Kind("{} has no place on its beam, or is beyond its end", _rails),
    Status.NOT_CLOSED: _Kind(
        "joints cannot be closed by changes of positions, {} least of all: the step is too long, or the machine jams",
        lambda system: system.rows,
    ),
    Status.OPEN: _Kind("joints are open by a tenth of the machine: the step is too long, or the machine jams"),
    Status.NO_VOLUME: _Kind(
        "the volume {} has no fluid left in it, or no room for it", lambda system: [node.name for node in system.nodes]
    ),
}


def failures_of(system: System) -> list[Failure]:
    """Every failure that a run of fixed steps of this machine may have, in the order of their numbers."""
    return [Failure(status, kind.sentence, tuple(kind.names(system))) for status, kind in sorted(_KINDS.items())]
